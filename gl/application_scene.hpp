// Textures of the scene that an application draws before the sea; the waves reflect that scene.
#pragma once

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

/// Holds two textures of the view's single eye, each an image of the eye's viewport in any size.
/// draw() only reads the textures. The application keeps ownership.
struct ApplicationScene {
    /// RGB: linear radiance in the sky's unit, multiplied by coverage. A: coverage, 0 where the
    /// scene is empty. Rough water samples the coarser mips, if the texture has any. Linear
    /// filtering, clamped to the edges.
    GLuint radiance = 0;
    /// Depth in the eye's projection, 1 where the scene is empty. Format GL_DEPTH_COMPONENT24 or
    /// 32F, filter GL_NEAREST, no comparison mode.
    GLuint depth = 0;
};

}  // namespace pelagic::gl
