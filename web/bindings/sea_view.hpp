// A sea drawn on one GL context: ocean, quadtree, sky and renderer, on one thread.
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
    double size_m = 4096;                       ///< side of the square with waves; [256, 8192]
    gl::Shading shading = gl::Shading::medium;  ///< cost of a pixel
    int sky_face_size = 256;                    ///< texels a side of the sky; 2^n, 16 to 2048
    bool foam = true;                           ///< 10 to 20 % of a frame
};

/// The light of the scene, for other objects that a page draws: irradiances in the sky's unit, and
/// the factor of radiance.
struct ShownLight {
    glm::vec3 direction, sun_irradiance, sky_irradiance;
    float exposure;
};

class SeaView {
   public:
    /// \pre the context of `gl` is current here and in all calls; `gl` outlives the view
    SeaView(const gl::Functions& gl, const SeaState& sea, const ViewOptions& options);
    ~SeaView();

    /// Replaces the sea from the next frame on. Throws std::invalid_argument and changes nothing
    /// then.
    void set_sea(const SeaState& sea);
    /// Starts to bake a sky, which is drawn when it is complete. Replaces a sky that waits. Until
    /// the first sky is complete, a coarse sky without clouds is drawn. Throws
    /// std::invalid_argument.
    /// \param stops  exposure above that of the sky
    void set_light(const gl::SkyOptions& sky, float stops);
    /// Continues baking for about that time. Returns whether the sky is complete.
    bool continue_baking(double budget_ms);
    bool has_sky() const;      ///< whether the sky of the last set_light() is drawn
    ShownLight light() const;  ///< of the drawn sky

    /// Computes a frame and uploads it.
    const Frame& simulate(double time_s);
    double simulate_ms() const;
    /// Returns the frame of the last simulate(). \pre simulate() was called, also below
    const Frame& frame() const;
    const Ocean& ocean() const;
    const gl::DrawStatistics& statistics() const;

    /// Clears the bound framebuffer and draws into it, with one selection of patches for all eyes.
    /// \param exposure  factor of radiance; none: the sky's
    void draw(std::span<const gl::Eye> eyes, std::optional<float> exposure);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::web
