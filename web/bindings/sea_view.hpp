// A sea that is drawn: ocean, quadtree, sky and renderer of one GL context, on one thread.
//
//   SeaView view(functions, sea, {});
//   view.set_light(sky);  while (!view.continue_baking(10)) draw a frame;
//   each frame:  view.simulate(time_s);  view.draw(eyes, ...);
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::web {

struct ViewOptions {
    std::string quality = "high";               ///< of the quadtree: low, medium, high or ultra
    double size_m = 4096;                       ///< side of the square of sea with waves; [256, 8192]
    gl::Shading shading = gl::Shading::medium;  ///< what a pixel may cost
    int sky_face_size = 256;                    ///< texels along a side of the baked sky; a power of two, 16 to 2048
    bool foam = true;                           ///< foam lasts, which costs a tenth to a fifth of a frame more
};

/// What is in the scene's light, for whatever else a page draws: irradiances in the sky's unit, and what radiance is multiplied with.
struct ShownLight {
    glm::vec3 direction, sun_irradiance, sky_irradiance;
    float exposure;
};

class SeaView {
   public:
    /// \param gl  of a context that is current here and in all calls; outlives the view
    SeaView(const gl::Functions& gl, const SeaState& sea, const ViewOptions& options);
    ~SeaView();

    /// The next frame is one of that sea. Throws std::invalid_argument, and keeps the sea that it has.
    void set_sea(const SeaState& sea);
    /// Begins to bake a sky, which is drawn when it is done; the last call counts. Throws std::invalid_argument.
    /// Until the first one is done a plain sky is drawn, without clouds, of the first call's light; without a call, of the default one.
    /// \param stops  brighter than the sky's own exposure
    void set_light(const gl::SkyOptions& sky, float stops);
    /// Bakes on for about that long; true if nothing is left to bake.
    bool continue_baking(double budget_ms);
    bool has_sky() const;      ///< the sky of the last set_light() is the one that is drawn
    ShownLight light() const;  ///< of the sky that is drawn

    /// Computes the frame of that time.
    const Frame& simulate(double time_s);
    double simulate_ms() const;
    /// Of the last simulate(). \\pre there was one, also below
    const Frame& frame() const;
    const Ocean& ocean() const;
    const gl::DrawStatistics& statistics() const;

    /// Into the framebuffer that is bound, which it clears. One selection for all eyes.
    /// \param exposure  what radiance is multiplied with; none: the sky's
    void draw(std::span<const gl::Eye> eyes, std::optional<float> exposure);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::web
