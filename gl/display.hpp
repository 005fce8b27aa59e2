// From radiance to the screen, as a camera does it: bloom, exposure, the tone curve, sRGB, dithering. One full-screen pass, and
// a few small ones where there is bloom. An application that tone-maps in the sea's own pass (RendererOptions::writes) does not need it.
//
//   target.bind();                                                   // a RenderTarget that holds radiance
//   renderer.draw({..., .exposure = exposure, .weighs_samples = true});
//   display.show(target.resolved(), {.exposure = exposure}, {0, 0, width, height});  // into the application's framebuffer
#pragma once

#include <memory>

#include "pelagic/gl/exposure.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/views.hpp"

namespace pelagic::gl {

struct Look {
    float exposure = 1;  ///< what radiance is multiplied with
    float luminance_of_unit = sun_illuminance_lx;
    float bloom = 0;  ///< part of each pixel's light that is spread around it, [0, 1]; what is spread is not lost
    bool framebuffer_is_srgb = false;
};

class Display {
   public:
    /// \param gl  outlives it. Throws GlError if the driver refuses a shader or can't draw half floats.
    explicit Display(const Functions& gl);
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// Into that part of the bound framebuffer, enlarged or made smaller to fill it. GL state is afterwards what it was.
    void show(const TexturePart& radiance, const Look& look, const Viewport& to);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
