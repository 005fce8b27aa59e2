// `pelagic query`: how high the water is at given points, which way it faces and how it moves.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/tools/export_options.hpp"

namespace pelagic::tools {

class QueryFlags {
   public:
    void add_to(CLI::App& app);
    /// Reads the points and prints a line for each of them, after a header. Throws InputError, before it prints.
    void run() const;

   private:
    SeaOptions sea_;
    ComputeFlags compute_;
    std::optional<std::string> points_, time_;
};

}  // namespace pelagic::tools
