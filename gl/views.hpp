// Views of the sea: one eye or two, each with its projection and viewport.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/quadtree/camera.hpp"

namespace pelagic::gl {

/// A rectangle of the framebuffer, in pixels from its lower left corner.
struct Viewport {
    int x = 0, y = 0, width = 0, height = 0;
};

struct Eye {
    /// Matrix from world to clip coordinates; any projection with OpenGL's conventions. The far
    /// plane should be infinite, because a finite one clips the sea before the horizon.
    glm::dmat4 clip_from_world{1};
    glm::dvec3 position_m{};
    Viewport viewport;
};

/// Returns the camera's eye, with an infinite far plane.
Eye eye_of(const Camera& camera, const Viewport& viewport);

/// Returns two parallel eyes side by side in the framebuffer, the left one first.
/// \param both  viewport of both eyes; each eye gets one half of the width
/// \param apart_m  distance between the eyes, m
std::vector<Eye> eyes_of(const Camera& camera, const Viewport& both, double apart_m);

}  // namespace pelagic::gl
