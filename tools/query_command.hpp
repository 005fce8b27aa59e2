// `pelagic query`: how high the water is at given points, which way it faces, how it moves and how white it is.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/tools/events/event_options.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/options/floor_options.hpp"
#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {

class QueryFlags {
   public:
    void add_to(CLI::App& app);
    /// Reads points block by block and prints a row for each of them, so that memory does not grow with the file. Throws
    /// InputError, for what is wrong with the options or the first block before anything is printed, and FileError.
    void run() const;

   private:
    std::vector<double> times(const ResolvedSea& sea) const;

    std::optional<ShoreOptions> shore(const ResolvedSea& sea) const;

    EventFlags events_;
    SeaOptions sea_;
    ComputeFlags compute_;
    FloorFlags floor_;
    std::optional<std::string> points_, time_, times_, interpolation_;
    bool json_ = false, foam_ = false;
};

}  // namespace pelagic::tools
