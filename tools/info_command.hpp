// `pelagic info`: what a sea is, before anything is written, or what an export holds.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {

class InfoFlags {
   public:
    void add_to(CLI::App& app);
    /// Prints the resolved options, heights and periods, the stages, memory and what runs here: a table, or --json. With --measure
    /// what the frames of an export hold instead. Throws InputError and FileError.
    void run() const;

   private:
    void measure() const;

    std::optional<std::string> measure_, svg_;
    SeaOptions sea_;
    ComputeFlags compute_;
    bool json_ = false;
};

}  // namespace pelagic::tools
