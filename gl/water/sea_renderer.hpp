// Draws the sea: uploads a frame, then draws the quadtree's patches, the skirt and the sky for one eye or two.
//
//   SeaRenderer renderer(gl, {.patch_vertices = selection.options().vertices, .resolution = ocean.resolution(),
//                             .cascades = ocean.cascade_count()});  // built with OceanOptions::slopes and ::foam
//   renderer.set_sky(baker.complete());
//   each frame:  renderer.upload(ocean.complete());
//                renderer.draw({.eyes = eyes, .viewer_m = head, .list = &selection.select(...)});
//
// Foam is that of the frame's cascades (Cascade::foam_r8): it stays where water broke, fades and drifts. Frames of an ocean without
// OceanOptions::foam show none. a dynamic-wave grid (Frame::dynamic_waves) is drawn where the frame has one.
//
// A frame's shore is drawn with it, by programs that are compiled when the first such frame comes. Its sand is a floor like others:
// renderer.set_floor(floor_of(shore)).
//
// It needs an OpenGL ES 3.0 context, current whenever it is built, called or destroyed; any context does, the application's too.
// No compute shaders, nothing is read back. draw() needs a bound framebuffer with depth, which the application has cleared
// to 1. GL state may be anything before and is the same afterwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "pelagic/gl/application_scene.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/sky/sky_baker.hpp"
#include "pelagic/gl/views.hpp"
#include "pelagic/gl/water/camera_water_plane.hpp"
#include "pelagic/gl/water/caustics.hpp"
#include "pelagic/gl/water/frame_textures.hpp"
#include "pelagic/gl/water/sea_floor.hpp"
#include "pelagic/gl/water/shading.hpp"
#include "pelagic/gl/water/small_water.hpp"
#include "pelagic/gl/water/water_optics.hpp"
#include "pelagic/quadtree/draw_list.hpp"

namespace pelagic::gl {

struct RendererOptions {
    int patch_vertices = 64;   ///< V of the draw lists
    int resolution = 256;      ///< N of the frames' cascades
    std::size_t cascades = 1;  ///< of the frames, 1 to 4
    Shading shading = Shading::high;
    bool framebuffer_is_srgb = false;  ///< it encodes what shaders write; else they do
    PixelKind writes =
        PixelKind::screen;  ///< radiance: linear and not exposed, for an application that has its own camera
    Surface surface = Surface::open;               ///< small water is drawn in place of the frames' cascades
    std::shared_ptr<Executor> executor = nullptr;  ///< bakes textures at the start; null: on this thread
    bool multiview = false;                        ///< the framebuffer holds both eyes as layers (OVR_multiview2)
    /// Frames have a dynamic-wave grid: its programs are compiled at the start, and not when the first such frame is drawn.
    bool dynamic_waves = false;
};

enum class DrawMode { shaded, wireframe };

struct DrawInput {
    std::span<const Eye> eyes;  ///< one or two
    glm::dvec3 viewer_m{};      ///< what positions are relative to: the selection's viewer
    const DrawList* list = nullptr;
    double lod_scale = 2.2;  ///< tau of the selection, by which the displacement's mip follows the mesh
    DrawMode mode = DrawMode::shaded;
    bool draws_sky = true;
    std::optional<float> exposure =
        {};  ///< what radiance is multiplied with before the tone curve; the sky's by default
    /// Where radiance is written: each sample times a weight that is in alpha, which falls with its exposed luminance, for
    /// gl/display.hpp to divide by. Else alpha is 1, and samples average to true radiance.
    bool weighs_samples = false;
    /// The surface at the viewer, for lenses near the water or within it, whose pixels below it show the underwater world;
    /// none: all of them are in the air.
    std::optional<CameraWaterPlane> camera_water_plane = {};
    /// What waves mirror besides the sky, where their rays meet it within the image. Of one eye; not with two, with multiview or
    /// with Shading::headset, which mirror the sky alone.
    std::optional<ApplicationScene> application_scene = {};
};

/// What the last draw() handed to the driver.
struct DrawStatistics {
    int sea_calls = 0;  ///< of the views together: patches and skirt
    int sky_calls = 0;
    int floor_calls = 0;
    std::uint64_t triangles = 0;
    std::size_t instance_bytes = 0;
    /// The application's time in draw() and in the last upload(), and the part of each inside calls in which the driver itself
    /// transforms, rasterises or copies texels: a software driver does that at once.
    double draw_ms = 0, draw_driver_ms = 0;
    double upload_ms = 0, upload_driver_ms = 0;
    std::size_t upload_bytes = 0;
};

class SeaRenderer {
   public:
    /// \param gl  outlives the renderer. Throws GlError if the driver refuses a shader, std::invalid_argument for a number of
    /// cascades that no frame has.
    SeaRenderer(const Functions& gl, const RendererOptions& options);
    ~SeaRenderer();
    SeaRenderer(const SeaRenderer&) = delete;
    SeaRenderer& operator=(const SeaRenderer&) = delete;

    void set_sky(const Sky& sky);
    /// What the sea is made of from now on; Jerlov's type II until then.
    void set_water(const WaterOptics& water);
    /// What lies below; at first it is even and of sand, at the sea's depth. Throws std::invalid_argument(check(floor)).
    void set_floor(const SeaFloor& floor);
    /// Sunlight as the waves gather it, for floors and for shafts of light; without, crests that no wave makes stand for them.
    void set_caustics(const Caustics& caustics);
    /// V of the draw lists from here on: another quality's meshes, without new shaders and textures.
    void set_patch_vertices(int patch_vertices);
    /// How a river flows from now on; a winding channel until then. Throws std::invalid_argument for a map that is not whole.
    void set_flow(const FlowMap& map);
    /// From here on the frame's sea is drawn, at its time; the frame's views may go stale. Throws what
    /// FrameTextures::upload() and ShoreTextures::upload() throw, and std::invalid_argument for a Frame::dynamic_waves that no texture takes,
    /// and draws on what was uploaded before then.
    void upload(const Frame& frame);
    /// Where Ocean::schedule() may write the textures of the frame that is uploaded next, which spares a copy of them
    /// (FrameTextures::map()). Call it before the frame is scheduled.
    std::span<const TextureTargets> map_textures();
    /// \pre upload() and set_sky() have been called; all pointers are set; patches have options.patch_vertices
    const DrawStatistics& draw(const DrawInput& input);

    const FrameTextures& textures() const;
    const DrawStatistics& statistics() const;

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
