// A rock in the sea: an example of what an application draws before the sea, and hands in to be mirrored.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "pelagic/gl/meshes/lit_mesh.hpp"

namespace pelagic::gl {

class Rock {
   public:
    /// \param foot_m  where it stands, at rest's height; it is about 12 m wide and 6 m high. Throws GlError.
    Rock(const Functions& gl, glm::dvec3 foot_m);

    void set_light(const Sky& sky) { mesh_.set_light(sky); }
    void draw(const Eye& eye, float weighing_exposure) { mesh_.draw(eye, world_from_rock_, weighing_exposure); }
    ApplicationScene image(const Eye& eye) { return mesh_.image(eye, world_from_rock_); }

   private:
    LitMesh mesh_;
    glm::dmat4 world_from_rock_;
};

}  // namespace pelagic::gl
