// Renders the sea: uploads a frame, then draws the quadtree's patches, the skirt and the sky for
// one or two eyes.
//
//   // The ocean is built with OceanOptions::slopes and ::foam.
//   SeaRenderer renderer(gl, {.resolution = ocean.resolution(), .cascades = ocean.cascade_count()});
//   renderer.set_sky(baker.complete());
//   each frame:  renderer.upload(ocean.complete());
//                renderer.draw({.eyes = eyes, .viewer_m = head, .list = &selection.select(...)});
//
// SeaPass (sea_pass.hpp) makes these calls for an application.
//
// Foam comes from the snapshots of the frame's cascades (sim/snapshot_foam.hpp). Frames of an ocean
// without OceanOptions::foam have no foam. If a frame has a dynamic-wave grid
// (Frame::dynamic_waves), its waves are drawn too.
//
// If a frame has a shore, programs for shores draw it. They are compiled at the first such frame.
// To draw the sand of a shore, call renderer.set_floor(floor_of(shore)).
//
// The renderer needs an OpenGL ES 3.0 context that is current during construction, every call and
// destruction. It may be the application's context. The renderer uses no compute shaders and reads
// nothing back. draw() needs a bound framebuffer with a depth buffer that is cleared to 1. Any GL
// state is accepted and restored.
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
#include "pelagic/gl/water/exclusions.hpp"
#include "pelagic/gl/water/frame_textures.hpp"
#include "pelagic/gl/water/sea_floor.hpp"
#include "pelagic/gl/water/shading.hpp"
#include "pelagic/gl/water/small_water.hpp"
#include "pelagic/gl/water/water_optics.hpp"
#include "pelagic/quadtree/draw_list.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic::gl {

struct RendererOptions {
    int resolution = 256;      ///< N of the frames' cascades
    std::size_t cascades = 1;  ///< number of cascades of the frames, 1 to 4
    Shading shading = Shading::high;
    bool framebuffer_is_srgb = false;  ///< the framebuffer encodes sRGB; else the shaders encode it
    /// PixelKind::radiance writes linear radiance without exposure, for applications with their own
    /// camera model.
    PixelKind writes = PixelKind::screen;
    /// Any value but Surface::open draws small water in place of the frames' cascades.
    Surface surface = Surface::open;
    /// Bakes textures in the constructor; if null, they are baked on the calling thread.
    std::shared_ptr<Executor> executor = nullptr;
    bool multiview = false;  ///< the framebuffer holds both eyes as layers (OVR_multiview2)
    /// Compiles the programs for frames with a dynamic-wave grid in the constructor. If false, they
    /// are compiled when the first such frame is drawn.
    bool dynamic_waves = false;
};

inline constexpr float max_crest_glow = 10;

enum class DrawMode {
    shaded,
    wireframe,
    /// Values of the nearest surface in place of light, for a PixelKind::data without multisampling:
    /// its distance from the eye in metres; x / y and z / y of the unit normal of the water's waves or
    /// of the floor's facet; the fraction covered by foam, or -1 on the floor. Neither sky nor spray is
    /// drawn.
    surface_data
};

/// Options of spray for images: plumes on crests up to 150 m away. `amount` makes up for some of the
/// larger cells; with more, drawing takes longer than with the default options.
inline constexpr SprayOptions drawn_spray{.reach_m = 160, .amount = 1.5};

/// Spray that is drawn over sea and sky. Droplets are hidden by the framebuffer's depths and write
/// none, so other transparent objects may be drawn before or after them. Nothing is drawn for a lens
/// under water.
struct SprayInput {
    std::span<const SprayDroplet> droplets = {};  ///< Frame::droplets; the first 8192 are drawn
    /// Depth of the scene in the eye's projection, 1 where it is empty, as
    /// ApplicationScene::depth. Droplets fade where they meet its surfaces. If 0, or with two eyes
    /// or multiview, surfaces in the framebuffer cut them.
    GLuint scene_depth = 0;
};

struct DrawInput {
    std::span<const Eye> eyes;  ///< one or two
    /// Viewer of the quadtree selection; default: the middle of the eyes. Eyes of separate draws
    /// need the same viewer. Positions in the shaders are relative to it.
    std::optional<glm::dvec3> viewer_m = {};
    const DrawList* list = nullptr;  ///< of a Selection; set by SeaPass
    DrawMode mode = DrawMode::shaded;
    bool draws_sky = true;
    /// Factor applied to radiance before the tone curve. If empty, the sky's exposure is used.
    std::optional<float> exposure = {};
    /// Factor applied to the light that shines through wave crests; [0, max_crest_glow], 1 is true
    /// to nature.
    float crest_glow = 1;
    /// With PixelKind::radiance: multiplies each sample by a weight and writes the weight to alpha.
    /// The weight falls with the exposed luminance; gl/display.hpp divides by it. If false, alpha
    /// is 1, and samples average to true radiance.
    bool weighs_samples = false;
    /// Water surface at the viewer, for lenses near the water or within it. Pixels below it show
    /// the underwater view. If empty, all pixels are rendered as seen from the air. Set by SeaPass.
    std::optional<CameraWaterPlane> camera_water_plane = {};
    /// Scene that waves reflect besides the sky, where reflected rays hit it within the image. It
    /// needs one eye. With two eyes, multiview or Shading::headset only the sky is reflected.
    std::optional<ApplicationScene> application_scene = {};
    /// Hulls whose interiors hold no water, at most max_exclusions. Water inside is not drawn, and
    /// an eye inside sees no underwater view. Where the boxes around three interiors overlap, the
    /// first two count. Ignored beyond the selection's square and in DrawMode::wireframe.
    std::span<const Exclusion> exclusions = {};
    SprayInput spray = {};

    /// Returns viewer_m or its default; the origin if there are no eyes.
    glm::dvec3 viewer() const;
};

/// Statistics of the last draw().
struct DrawStatistics {
    int sea_calls = 0;  ///< draw calls of patches and skirt in all views
    int sky_calls = 0;
    int floor_calls = 0;
    std::uint64_t triangles = 0;
    std::size_t instance_bytes = 0;
    /// Time on the calling thread in draw() and in the last upload(). The driver_ms members count
    /// only GL calls that draw or copy texels; a software driver does that work within these calls.
    double select_ms = 0;  ///< of the selection, by SeaPass
    double draw_ms = 0, draw_driver_ms = 0;
    double upload_ms = 0, upload_driver_ms = 0;
    std::size_t upload_bytes = 0;
};

class SeaRenderer {
   public:
    /// \param gl  must outlive the renderer
    /// \throws GlError  if the driver rejects a shader
    /// \throws std::invalid_argument  if options.cascades is not 1 to 4
    SeaRenderer(const Functions& gl, const RendererOptions& options);
    ~SeaRenderer();
    SeaRenderer(const SeaRenderer&) = delete;
    SeaRenderer& operator=(const SeaRenderer&) = delete;

    /// Sets the light and the image that the water reflects.
    void set_sky(const Sky& sky);
    /// Sets the optical properties of the water. The default is Jerlov type II.
    void set_water(const WaterOptics& water);
    /// Sets the sea floor. The default is even sand at the sea's depth.
    /// \throws std::invalid_argument  with the text of check(floor)
    void set_floor(const SeaFloor& floor);
    /// Sets the caustics for floors and shafts of light. Without them a procedural pattern of
    /// crests, which does not follow the waves, is used.
    void set_caustics(const Caustics& caustics);
    /// Sets the interiors of hulls that DrawInput::exclusions refers to. The maps are copied.
    /// Programs for exclusions are compiled when the first is drawn.
    /// \throws std::invalid_argument  if there are more than max_exclusion_maps
    void set_exclusion_maps(std::span<const ExclusionMap> maps);
    /// Sets the shading of the next draw() calls. Programs are compiled when they first draw.
    void set_shading(Shading shading);
    /// Sets the flow of a river. The default is winding_channel().
    /// \throws std::invalid_argument  with the text of check(map)
    void set_flow(const FlowMap& map);
    /// Uploads the frame for the next draw() calls. The frame's views may become invalid
    /// afterwards. On a software driver it waits for the driver's threads, because vertex shaders
    /// would read mip levels before they are written. After an exception draw() uses the previously
    /// uploaded frame.
    /// \throws std::invalid_argument  what FrameTextures::upload() throws, or for a
    ///                                Frame::dynamic_waves that does not fit a texture
    /// \throws GlError                what ShoreTextures::upload() throws
    void upload(const Frame& frame);
    /// Returns targets to which Ocean::schedule() can write the textures of the next uploaded
    /// frame, which saves a copy (FrameTextures::map()). Call it before Ocean::schedule().
    /// \throws GlError  if the driver does not map a buffer
    std::span<const TextureTargets> map_textures();
    /// Returns the options of the uploaded frame's caustics under the sky's sun, or nothing if no
    /// caustics can be visible: the viewer is high above the water and no floor is in sight.
    /// \param above_water_m  height of the viewer above the surface below it
    std::optional<CausticsOptions> visible_caustics(double above_water_m) const;
    /// Draws the uploaded frame and returns the statistics of this call.
    /// \throws std::invalid_argument  with the text of check(input.exclusions, number of maps);
    ///     nothing is drawn
    /// \pre upload() and set_sky() have been called; all pointers are set
    const DrawStatistics& draw(const DrawInput& input);

    /// Returns the fraction of the sky's sun_irradiance that its clouds let through at a place, for
    /// the application's own objects: the sea there, in the uploaded frame, has it too.
    /// \param world_m  x and z
    float sunlit_at(const glm::dvec2& world_m) const;

    /// Returns the textures of the last uploaded frame.
    const FrameTextures& textures() const;
    /// Returns the statistics of the last draw().
    const DrawStatistics& statistics() const;

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
