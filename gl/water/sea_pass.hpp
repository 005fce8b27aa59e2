// The order of a drawn frame: upload, selection of patches, water plane at the camera, caustics,
// sea and sky, spray. It has SeaRenderer's requirements on context, framebuffer and thread.
//
//   SeaPass pass(gl, {.resolution = ocean.resolution(), .cascades = ocean.cascade_count()},
//                quadtree_preset_named("medium")->options(2048));
//   pass.renderer().set_sky(baker.complete());
//   each frame:  const Frame& frame = ocean.complete();
//                pass.upload(frame);
//                ocean.schedule(next_s, pass.renderer().map_textures());
//                ... clear the framebuffer and draw your own scene ...
//                pass.draw({.eyes = eyes, .application_scene = scene, .spray = {frame.droplets}});
//                ... with PixelKind::radiance: Display::show() ...
#pragma once

#include <optional>

#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/quadtree/selection.hpp"

namespace pelagic::gl {

/// When the caustics of a frame are baked, by RendererOptions::executor.
enum class CausticsBaking {
    none,         ///< never: a procedural pattern is drawn
    while_drawn,  ///< while every second frame is drawn; the next frame shows them
    before_drawn  ///< draw() waits for them, so that an image depends on its frame alone
};

class SeaPass {
   public:
    /// \param gl  must outlive the pass
    /// \throws GlError  if the driver rejects a shader
    /// \throws std::invalid_argument  if options.cascades is not 1 to 4 or check(quadtree) is not empty
    SeaPass(const Functions& gl, const RendererOptions& options, const QuadtreeOptions& quadtree,
            CausticsBaking caustics = CausticsBaking::none);

    /// Returns the renderer, to set sky, water, floor, shading and exclusion maps.
    SeaRenderer& renderer() { return renderer_; }
    /// Returns the renderer, to read what it draws.
    const SeaRenderer& renderer() const { return renderer_; }
    /// Returns the selection of the last draw().
    const Selection& selection() const { return selection_; }
    /// Replaces the quadtree. Shaders and textures are kept.
    /// \throws std::invalid_argument  if check(quadtree) is not empty
    void set_quadtree(const QuadtreeOptions& quadtree) { selection_ = Selection(quadtree); }

    /// Uploads the frame for the next draw() calls (SeaRenderer::upload()), after the caustics of
    /// the previous one are complete.
    /// \pre the views of the previous frame are valid: Ocean::schedule() comes after upload()
    void upload(const Frame& frame);
    /// Selects the patches for the eyes, bakes caustics if they can be visible, and draws sea, sky
    /// and spray over the application's scene. The camera may dip into the water and caustics are
    /// baked if the ocean has OceanOptions::queries.
    /// \param input  list and camera_water_plane are replaced
    /// \pre the frame's views are valid, upload() and SeaRenderer::set_sky() have been called
    /// \throws std::invalid_argument  as Selection::select(), SeaRenderer::draw() and, for a frame
    ///     without planes, CausticsBaker::schedule()
    DrawStatistics draw(DrawInput input);

   private:
    void complete_caustics();

    SeaRenderer renderer_;
    Selection selection_;
    Surface surface_;
    CausticsBaking caustics_;
    std::optional<CausticsBaker> baker_;
    Frame frame_;
    bool is_baking_ = false, has_baked_ = false;  ///< has_baked_: during the previous frame
};

}  // namespace pelagic::gl
