// `pelagic render`: images of a sea, without a window.
#pragma once

#include "pelagic/tools/options/render_options.hpp"

namespace pelagic::tools {

/// Draws and writes the images. Throws FileError if one can't be written, gl::GlError without a driver.
void run_render(const RenderOptions& options);

}  // namespace pelagic::tools
