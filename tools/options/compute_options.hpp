// The options --threads and --isa, which do not affect results.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/simd/isa.hpp"

namespace pelagic::tools {

/// Values of --threads and --isa.
struct ComputeOptions {
    int threads = 0;
    std::optional<Isa> isa;
};

/// Declares and checks --threads and --isa.
class ComputeFlags {
   public:
    void add_to(CLI::App& app);
    /// \throws InputError  if a value is invalid
    ComputeOptions resolve() const;
    /// Returns true if --isa or the environment variable PELAGIC_ISA is set.
    bool names_isa() const;

   private:
    std::optional<std::string> threads_, isa_;
};

}  // namespace pelagic::tools
