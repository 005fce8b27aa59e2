// `pelagic info`: what a sea is, before anything is written.
#pragma once

#include <CLI/App.hpp>

#include "pelagic/tools/export_options.hpp"

namespace pelagic::tools {

class InfoFlags {
   public:
    void add_to(CLI::App& app);
    /// Prints the resolved options, heights and periods, the stages, memory and what runs here: a table, or --json.
    /// Throws InputError.
    void run() const;

   private:
    SeaOptions sea_;
    ComputeFlags compute_;
    bool json_ = false;
};

}  // namespace pelagic::tools
