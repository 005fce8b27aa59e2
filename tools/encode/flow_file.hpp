// A river's flow from an image.
#pragma once

#include <string>

#include "pelagic/gl/water/small_water.hpp"

namespace pelagic::tools {

/// A square PNG of 8 bits a channel, RGB or RGBA: red is the velocity along x, green along z, 128 is none. Throws InputError that names
/// the option and the file.
gl::FlowMap read_flow_map(const std::string& option, const std::string& file);

}  // namespace pelagic::tools
