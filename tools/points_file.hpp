// Points as people keep them: lines `x,z` in metres.
#pragma once

#include <filesystem>
#include <vector>

namespace pelagic::tools {

struct PointList {
    std::vector<double> x, z;
};

/// Reads --points. A first line `x,z` is a header; empty lines, spaces and tabs around numbers, and Windows' line ends
/// don't matter. Throws InputError, one line that names the file, for a bad line its number and its text too.
PointList read_points(const std::filesystem::path& file);

}  // namespace pelagic::tools
