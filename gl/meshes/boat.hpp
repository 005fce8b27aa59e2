// A small wooden boat, as the web page draws it. Its own axes: x forward, y up from the waterline, z to starboard.
#pragma once

#include <glm/mat4x4.hpp>

#include "pelagic/gl/meshes/lit_mesh.hpp"

namespace pelagic::gl {

class Boat {
   public:
    static constexpr float length_m = 7.2f, beam_m = 2.5f, draught_m = 0.55f;

    /// Throws GlError.
    explicit Boat(const Functions& gl);

    void set_light(const Sky& sky) { mesh_.set_light(sky); }
    /// LitMesh's, where the boat lies.
    void draw(const Eye& eye, const glm::dmat4& world_from_boat, float weighing_exposure) {
        mesh_.draw(eye, world_from_boat, weighing_exposure);
    }
    ApplicationScene image(const Eye& eye, const glm::dmat4& world_from_boat) {
        return mesh_.image(eye, world_from_boat);
    }

   private:
    LitMesh mesh_;
};

}  // namespace pelagic::gl
