// Detection of drivers that draw on the CPU.
#pragma once

#include <string_view>

namespace pelagic::gl {

/// Returns true for Mesa's llvmpipe and softpipe, and for SwiftShader.
/// \param renderer  the driver's GL_RENDERER
inline bool is_software_renderer(std::string_view renderer) {
    for (const std::string_view name : {"llvmpipe", "softpipe", "SwiftShader"})
        if (renderer.find(name) != std::string_view::npos) return true;
    return false;
}

}  // namespace pelagic::gl
