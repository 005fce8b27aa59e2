// Drivers that draw without a graphics processor.
#pragma once

#include <string_view>

namespace pelagic::gl {

/// \param renderer  the driver's GL_RENDERER: Mesa's llvmpipe and softpipe, and SwiftShader
inline bool is_software_renderer(std::string_view renderer) {
    for (const std::string_view name : {"llvmpipe", "softpipe", "SwiftShader"})
        if (renderer.find(name) != std::string_view::npos) return true;
    return false;
}

}  // namespace pelagic::gl
