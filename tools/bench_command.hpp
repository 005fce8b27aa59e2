// `pelagic bench`: how long frames take on this machine, beside others.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/tools/benchmark/frame_timing.hpp"
#include "pelagic/tools/options/compute_options.hpp"

namespace pelagic::tools {

class BenchFlags {
   public:
    void add_to(CLI::App& app);
    /// Times what was asked for, and prints tables or writes JSON. Throws InputError and FileError.
    void run() const;

   private:
    TimingPlan resolve() const;

    std::optional<std::string> sizes_, seconds_, json_;
    bool headset_ = false;
    ComputeFlags compute_;
};

}  // namespace pelagic::tools
