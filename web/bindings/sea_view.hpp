// A sea drawn on one GL context: ocean, sky and pass, on one thread.
//
//   SeaView view(functions, sea, {});
//   view.set_light(sky);  while (!view.continue_baking(10)) draw a frame;
//   each frame:  view.simulate(time_s);  view.draw(eyes, ...);
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/jobs/sliced_executor.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/web/bindings/moored_hull.hpp"

namespace pelagic::web {

struct ViewOptions {
    std::string quality = "high";               ///< name of a quadtree preset
    double size_m = 4096;                       ///< side of the square with waves; [256, 8192]
    gl::Shading shading = gl::Shading::medium;  ///< cost of a pixel
    int sky_face_size = 256;                    ///< texels a side of the sky; 2^n, 16 to 2048
    bool foam = true;                           ///< 10 to 20 % of a frame
    std::optional<MooredHull> hull = {};        ///< floats by forces
};

class SeaView {
   public:
    /// \pre the context of `gl` is current here and in all calls; `gl` outlives the view
    SeaView(const gl::Functions& gl, const SeaState& sea, const ViewOptions& options);

    /// Replaces the sea from the next frame on. Keeps the pass if resolution and number of cascades
    /// are equal. Throws std::invalid_argument and changes nothing then.
    void set_sea(const SeaState& sea);
    /// Replaces the hull from the next frame on. The ocean is made again if it has computed no water
    /// below the surface, which hulls need, and is to.
    void set_hull(std::optional<MooredHull> hull);
    /// Returns the hull as of the last simulate(), or null.
    const MooredHull* hull() const { return options_.hull ? &*options_.hull : nullptr; }
    /// Sets mesh and shading. Shaders and textures are kept.
    /// \param quality  name of a quadtree preset
    void set_detail(const std::string& quality, gl::Shading shading);
    /// Starts to bake a sky, which is drawn when it is complete. Replaces a sky that waits. Until
    /// the first sky is complete, a coarse sky without clouds is drawn. Throws
    /// std::invalid_argument.
    /// \param stops  exposure above that of the sky
    void set_light(const gl::SkyOptions& sky, float stops);
    /// Continues baking for about that time. Returns whether the sky is complete.
    bool continue_baking(double budget_ms);
    /// Returns whether the sky of the last set_light() is drawn.
    bool has_sky() const { return !is_baking_ && !next_light_; }
    /// Returns the light of the drawn sky, for other objects that a page draws.
    const gl::SkyLight& light() const { return *sky_; }
    /// Returns the fraction of its sun_irradiance below the eyes of the last draw().
    float sunlit() const { return pass_->renderer().sunlit_at(eye_m_); }
    /// Returns the factor of radiance under that sky.
    float exposure() const;

    /// Computes a frame and uploads it. The hull follows (MooredHull::follow()).
    void simulate(double time_s);
    double simulate_ms() const { return simulate_ms_; }
    /// Returns the frame of the last simulate(); null after set_sea().
    const Frame* frame() const { return frame_; }
    const Ocean& ocean() const { return *ocean_; }
    const gl::DrawStatistics& statistics() const { return pass_->renderer().statistics(); }

    /// Clears the bound framebuffer and draws into it, with one selection of patches for all eyes.
    /// \pre frame() is not null
    /// \param exposure  factor of radiance; none: the sky's
    void draw(std::span<const gl::Eye> eyes, std::optional<float> exposure);

   private:
    void make_ocean(const SeaState& sea);
    void show(const gl::Sky& sky);

    const gl::Functions& gl_;
    ViewOptions options_;
    QuadtreeOptions quadtree_;
    std::shared_ptr<Executor> executor_ = make_serial_executor();
    std::shared_ptr<SlicedExecutor> slices_ = make_sliced_executor();
    std::unique_ptr<Ocean> ocean_;
    gl::SkyBaker plain_, baker_;
    std::optional<gl::SeaPass> pass_;
    const gl::Sky* sky_ = nullptr;  ///< drawn by the pass
    bool has_baked_ = false;        ///< a baked sky is drawn
    bool is_baking_ = false;
    std::optional<gl::SkyOptions> next_light_;  ///< to be baked next
    float stops_ = 0;
    glm::dvec2 eye_m_{0};  ///< x and z, of the last draw()
    const Frame* frame_ = nullptr;
    double simulate_ms_ = 0;
};

}  // namespace pelagic::web
