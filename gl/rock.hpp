// A rock in the sea: an example of what a host draws before the sea, and hands in to be mirrored.
#pragma once

#include <glm/vec3.hpp>

#include "pelagic/gl/host_scene.hpp"
#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/program.hpp"
#include "pelagic/gl/sky_baker.hpp"
#include "pelagic/gl/views.hpp"

namespace pelagic::gl {

class Rock {
   public:
    /// \param foot_m  where it stands, at rest's height; it is about 12 m wide and 6 m high. Throws GlError.
    Rock(const Functions& gl, glm::dvec3 foot_m);

    void set_light(const Sky& sky);
    /// As linear radiance, into the bound framebuffer, which has depth.
    /// \param weighing_exposure  as the sea is drawn with DrawInput::weighs_samples: the exposure; 0 without
    void draw(const Eye& eye, float weighing_exposure);
    /// What the eye sees of it without the sea, in textures that the next call overwrites. Throws GlError where the driver
    /// can't draw half floats.
    HostScene picture(const Eye& eye);

   private:
    const Functions& gl_;
    glm::dvec3 foot_m_;
    Program program_;
    Buffer vertices_, indices_, light_;
    VertexArray array_;
    glm::vec3 sun_direction_{0, 1, 0}, sun_irradiance_{1}, sky_irradiance_{1};
    Texture radiance_, depth_;
    Framebuffer framebuffer_;
    int width_ = 0, height_ = 0;  ///< of the textures
};

}  // namespace pelagic::gl
