// A rock in the sea: an example of an application's scene that is drawn before the sea and
// reflected by it.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "pelagic/gl/meshes/lit_mesh.hpp"

namespace pelagic::gl {

class Rock {
   public:
    /// The rock is about 12 m wide and 6 m high.
    /// \param foot_m  position of its base, at the height of the undisturbed water
    /// \throws GlError if the driver rejects a shader
    Rock(const Functions& gl, glm::dvec3 foot_m);

    void set_light(const Sky& sky, float sunlit = 1) { mesh_.set_light(sky, sunlit); }
    void draw(const Eye& eye, float weighing_exposure) { mesh_.draw(eye, world_from_rock_, weighing_exposure); }
    ApplicationScene image(const Eye& eye) { return mesh_.image(eye, world_from_rock_); }

   private:
    LitMesh mesh_;
    glm::dmat4 world_from_rock_;
};

}  // namespace pelagic::gl
