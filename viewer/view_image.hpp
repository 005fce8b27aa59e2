// The image of the window: sea, sky and boat. Frame times determine its size and shading; a static
// view is drawn once and kept.
#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "pelagic/gl/meshes/boat.hpp"
#include "pelagic/gl/sky/sky_baker.hpp"
#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/viewer/camera_view.hpp"
#include "pelagic/viewer/render_scale.hpp"
#include "pelagic/viewer/view_scene.hpp"

namespace pelagic::viewer {

class ViewImage {
   public:
    /// Starts baking the sky. The references must outlive the image.
    ViewImage(const gl::Functions& gl, const ViewOptions& options, const ViewSettings& settings,
              ViewStatistics& statistics);

    /// Applies changed settings of light, quality and shading. Waits only for the sky of a new pass.
    void follow_settings(const Ocean& ocean);
    /// Releases the pass, which reads frames of the ocean. follow_settings() makes another one.
    void release_ocean() { pass_.reset(); }
    /// Uploads a frame before the next one is scheduled.
    void upload(const Frame& frame) { pass_->upload(frame); }

    /// Draws the uploaded frame, unless the last image shows it, and copies the image to the window
    /// of `size` pixels.
    /// \param is_saved  the image is drawn at full size, because it is read afterwards
    /// \param passed_s  time since the last frame
    void draw(const Frame& frame, ViewScene& scene, const Camera& camera, glm::ivec2 size, bool is_saved,
              double passed_s);
    /// Adapts scale and shading to the time of the last frame, ms, if they determined it.
    void adapt_to(double frame_ms);

   private:
    /// The inputs of a drawn image: camera, time, size of the window, wireframe, and the number of
    /// changes of all other inputs.
    using Drawn = std::tuple<Camera, double, glm::ivec2, bool, unsigned long long>;

    RenderScale scale_from(float first) const;
    QuadtreeOptions quadtree_of(int vertices) const;
    void open_pass(const Ocean& ocean);
    void apply_sky();
    std::optional<RenderStep> next_step(const Drawn& now, bool is_saved, double passed_s);
    void prepare(const RenderStep& step, glm::ivec2 size);
    void draw_sea(const Frame& frame, ViewScene& scene, const Camera& camera, bool reflects_boat);

    const gl::Functions& gl_;
    const ViewOptions& options_;
    const ViewSettings& settings_;
    ViewStatistics& statistics_;
    gl::SkyBaker baker_;
    std::optional<gl::SeaPass> pass_;
    gl::Boat boat_;
    gl::ExclusionMap boat_interior_;
    std::optional<gl::RenderTarget> wireframe_;
    CameraView view_;
    gl::SkyOptions shown_sky_;
    const gl::Sky* sky_ = nullptr;  ///< of the pass
    float luminance_of_unit_ = 1, unmetered_ev_ = 15;  ///< values of the shown sky
    std::string quality_;                              ///< of the pass, as surface_
    gl::Surface surface_ = gl::Surface::open;
    unsigned long long changes_ = 0;
    bool is_software_;
    std::optional<gl::Shading> fixed_shading_;  ///< of scale_by_time_
    RenderScale scale_by_time_;
    Drawn drawn_;
    RenderStep drawn_step_{0, gl::Shading::headset};
    double still_for_s_ = 0;
    bool was_drawn_by_time_ = false;  ///< the last frame drew the sea at the step of scale_by_time_
};

}  // namespace pelagic::viewer
