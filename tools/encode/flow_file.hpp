// Flow maps of rivers, read from images.
#pragma once

#include <string>

#include "pelagic/gl/water/small_water.hpp"

namespace pelagic::tools {

/// Reads a square PNG of 8 bits per channel, RGB or RGBA. Red is the velocity along x, green along
/// z; 128 is zero. Throws InputError that names the option and the file.
gl::FlowMap read_flow_map(const std::string& option, const std::string& file);

}  // namespace pelagic::tools
