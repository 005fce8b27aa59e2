// Who looks at the sea: one eye or two, and what the images are made of.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "pelagic/quadtree/camera.hpp"

namespace pelagic::gl {

/// Part of the framebuffer, in pixels from its lower left corner.
struct Viewport {
    int x = 0, y = 0, width = 0, height = 0;
};

struct Eye {
    /// Clip from world coordinates; any projection of OpenGL's convention. Its far plane should be infinite, else it
    /// cuts the sea before the horizon.
    glm::dmat4 clip_from_world{1};
    glm::dvec3 position_m{};
    Viewport viewport;
};

/// The camera's eye, with an infinite far plane.
Eye eye_of(const Camera& camera, const Viewport& viewport);

/// Two parallel eyes, `apart_m` from each other, beside one another in the framebuffer.
struct EyePair {
    Eye left, right;
};
EyePair eyes_of(const Camera& camera, const Viewport& both, double apart_m);

}  // namespace pelagic::gl
