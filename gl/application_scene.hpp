// What an application has drawn before the sea, for waves to mirror.
#pragma once

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

/// Two textures, both an image of the only eye's viewport, in any size. They are read while draw() runs and stay the application's.
struct ApplicationScene {
    /// Linear radiance in the sky's unit times coverage, and coverage as alpha: 0 where nothing stands. Rough water reads the
    /// coarser mips, where it has any. Filtered linearly, clamped to its edges.
    GLuint radiance = 0;
    /// Of the eye's projection, 1 where nothing stands: GL_DEPTH_COMPONENT24 or 32F, filter GL_NEAREST, no comparison mode.
    GLuint depth = 0;
};

}  // namespace pelagic::gl
