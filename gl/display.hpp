// Converts radiance to a displayable image: bloom, exposure, tone curve, sRGB encoding, dithering.
// The conversion is one full-screen pass. Bloom adds a few passes at lower resolution.
// An application that tone-maps in the sea's own pass (RendererOptions::writes) does not need it.
//
//   target.bind();  // a RenderTarget that holds radiance
//   renderer.draw({..., .exposure = exposure, .weighs_samples = true});
//   // Draws into the application's framebuffer.
//   display.show(target.resolved(), {.exposure = exposure}, {0, 0, width, height});
#pragma once

#include <memory>

#include "pelagic/gl/exposure.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/views.hpp"

namespace pelagic::gl {

struct Look {
    float exposure = 1;                            ///< factor that multiplies the radiance
    float luminance_of_unit = sun_illuminance_lx;  ///< luminance of a radiance of 1, cd/m^2
    /// Fraction of each pixel's light that is spread over its surroundings, [0, 1]. The total light
    /// is conserved.
    float bloom = 0;
    bool framebuffer_is_srgb = false;  ///< if false, the shader encodes sRGB and dithers
};

class Display {
   public:
    /// \param gl  must outlive this object
    /// \throws GlError if the driver rejects a shader or cannot render to half floats
    explicit Display(const Functions& gl);
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// Draws the image into the viewport `to` of the bound framebuffer, scaled to fill that
    /// viewport. Restores all GL state that it changes.
    void show(const TexturePart& radiance, const Look& look, const Viewport& to);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
