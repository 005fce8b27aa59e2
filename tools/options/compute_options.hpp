// How a command computes, never what.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/simd/isa.hpp"

namespace pelagic::tools {

/// --threads and --isa.
struct ComputeOptions {
    int threads = 0;
    std::optional<Isa> isa;
};

/// Declares and checks --threads and --isa.
class ComputeFlags {
   public:
    void add_to(CLI::App& app);
    ComputeOptions resolve() const;  ///< throws InputError
    bool names_isa() const;          ///< here or by PELAGIC_ISA

   private:
    std::optional<std::string> threads_, isa_;
};

}  // namespace pelagic::tools
