// A small wooden boat, for the viewer and the web page. Local axes: x forward, y up from the
// waterline, z to starboard.
#pragma once

#include <glm/mat4x4.hpp>

#include "pelagic/gl/meshes/lit_mesh.hpp"

namespace pelagic::gl {

class Boat {
   public:
    static constexpr float length_m = 7.2f, beam_m = 2.5f, draught_m = 0.55f;

    /// \throws GlError if the driver rejects a shader
    explicit Boat(const Functions& gl);

    void set_light(const Sky& sky) { mesh_.set_light(sky); }
    /// Draws the boat (LitMesh::draw()).
    void draw(const Eye& eye, const glm::dmat4& world_from_boat, float weighing_exposure) {
        mesh_.draw(eye, world_from_boat, weighing_exposure);
    }
    /// Draws the boat into textures that the sea reflects (LitMesh::image()).
    ApplicationScene image(const Eye& eye, const glm::dmat4& world_from_boat) {
        return mesh_.image(eye, world_from_boat);
    }

   private:
    LitMesh mesh_;
};

}  // namespace pelagic::gl
