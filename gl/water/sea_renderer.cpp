#include "pelagic/gl/water/sea_renderer.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <stdexcept>
#include <string>

#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/software_renderer.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/gl/water/detail_image.hpp"
#include "pelagic/gl/water/dynamic_wave_textures.hpp"
#include "pelagic/gl/water/foam_image.hpp"
#include "pelagic/gl/water/patch_buffers.hpp"
#include "pelagic/gl/water/patch_split.hpp"
#include "pelagic/gl/water/scene_block.hpp"
#include "pelagic/gl/water/sea_programs.hpp"
#include "pelagic/gl/water/shore_textures.hpp"
#include "pelagic/gl/water/spray_renderer.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/half_float.hpp"

namespace pelagic::gl {
namespace {

/// Makes a texture without texels, with linear filtering within and between its levels, and leaves it
/// bound.
/// \param layers  of an array; 0: no array
Texture make_texture(const Functions& gl, GLenum kind, GLenum format, int levels, int width, int height,
                     int layers = 0) {
    Texture texture(gl);
    gl.BindTexture(kind, texture.name());
    if (layers > 0)
        gl.TexStorage3D(kind, levels, format, width, height, layers);
    else
        gl.TexStorage2D(kind, levels, format, width, height);
    gl.TexParameteri(kind, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    return texture;
}

/// Uploads all levels of the bound texture of half floats.
void upload_halves(const Functions& gl, int levels, int width, int height, const std::uint16_t* halves) {
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 2);
    for (int level = 0; level < levels; ++level) {
        const int columns = std::max(width >> level, 1), rows = std::max(height >> level, 1);
        gl.TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, columns, rows, GL_RED, GL_HALF_FLOAT, halves);
        halves += static_cast<std::ptrdiff_t>(columns) * rows;
    }
}

Texture make_detail_texture(const Functions& gl) {
    constexpr int side = DetailImage::side;
    const DetailImage image = make_detail_image();
    Texture texture = make_texture(gl, GL_TEXTURE_2D, GL_RGBA8, DetailImage::levels, side, side);
    for (int level = 0; level < DetailImage::levels; ++level)
        gl.TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, side >> level, side >> level, GL_RGBA, GL_UNSIGNED_BYTE,
                         image.level(level));
    return texture;
}

Texture make_foam_texture(const Functions& gl, Executor& executor) {
    constexpr int side = FoamImage::side, layers = FoamImage::layers;
    const FoamImage image = make_foam_image(executor);
    Texture texture = make_texture(gl, GL_TEXTURE_2D_ARRAY, GL_RGBA8, FoamImage::levels, side, side, layers);
    for (int level = 0; level < FoamImage::levels; ++level)
        gl.TexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, 0, side >> level, side >> level, layers, GL_RGBA,
                         GL_UNSIGNED_BYTE, image.level(level));
    return texture;
}

Texture make_flow_texture(const Functions& gl, const FlowMap& map) {
    Texture texture = make_texture(gl, GL_TEXTURE_2D, GL_RG8, 1, map.side, map.side);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, map.side, map.side, GL_RG, GL_UNSIGNED_BYTE, map.velocities.data());
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    return texture;
}

/// Makes a layer of each map. Maps smaller than the largest leave the rest of their layer unused.
Texture make_exclusion_texture(const Functions& gl, std::span<const ExclusionMap> maps) {
    int columns = 1, rows = 1;
    for (const ExclusionMap& map : maps) {
        columns = std::max(columns, map.columns() + 2);
        rows = std::max(rows, map.rows() + 2);
    }
    Texture texture =
        make_texture(gl, GL_TEXTURE_2D_ARRAY, GL_RGBA16F, 1, columns, rows, static_cast<int>(maps.size()));
    std::vector<std::uint16_t> halves;
    for (std::size_t layer = 0; layer < maps.size(); ++layer) {
        halves.clear();
        for (const ExclusionMap::Texel& texel : maps[layer].texels())
            for (const float value : {texel.low, texel.high, texel.coverage, 0.f})
                halves.push_back(static_cast<std::uint16_t>(half_of(value)));
        gl.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(layer), maps[layer].columns() + 2,
                         maps[layer].rows() + 2, 1, GL_RGBA, GL_HALF_FLOAT, halves.data());
    }
    return texture;
}

/// Returns the weight of spray in the mean of a pixel's samples: that of weighted_sample() in
/// gl/shaders/film.glsl, for spray away from the sun.
float sample_weight_of_spray(const SceneBlock& block) {
    if (block.output_kind.y == 0 || block.output_kind.z == 0) return 1;
    const glm::vec3 radiance = 0.06f * glm::vec3(block.sun_irradiance) + 0.18f * glm::vec3(block.sky_irradiance);
    const float luminance = 0.2126f * radiance.x + 0.7152f * radiance.y + 0.0722f * radiance.z;
    return 1 / (1 + std::min(block.output_kind.z * luminance, 1023.f));
}

const RendererOptions& checked_renderer_options(const RendererOptions& options) {
    if (options.cascades < 1 || options.cascades > max_cascades)
        throw std::invalid_argument("RendererOptions::cascades is " + std::to_string(options.cascades) +
                                    ", expected 1 to " + std::to_string(max_cascades));
    return options;
}

}  // namespace

glm::dvec3 DrawInput::viewer() const {
    if (viewer_m) return *viewer_m;
    glm::dvec3 sum(0);
    for (const Eye& eye : eyes) sum += eye.position_m;
    return sum / static_cast<double>(std::max(eyes.size(), std::size_t{1}));
}

struct SeaRenderer::State {
    State(const Functions& functions, const RendererOptions& wanted)
        : gl(functions),
          options(checked_renderer_options(wanted)),
          textures(functions, wanted.resolution, wanted.cascades),
          dynamic_waves(functions),
          shore(functions),
          is_software(is_software_renderer(reinterpret_cast<const char*>(functions.GetString(GL_RENDERER)))) {
        const GlStateGuard keep(gl);
        SeaVariant plain = variant();
        plain.dynamic_waves = options.dynamic_waves;
        programs_for(plain);
        detail = make_detail_texture(gl);
        foam = make_foam_texture(gl, *(options.executor ? options.executor : make_serial_executor()));
        if (options.surface == Surface::river) {
            const FlowMap map = winding_channel();
            flow = make_flow_texture(gl, map);
            flow_extent = map.extent;
        }
        empty = VertexArray(gl);
        scene = Buffer(gl);
        gl.BindBuffer(GL_UNIFORM_BUFFER, scene.name());
        gl.BufferData(GL_UNIFORM_BUFFER, sizeof(SceneBlock), nullptr, GL_STREAM_DRAW);
    }

    void bind_textures(const ApplicationScene& application) {
        const auto bind = [&](Unit unit, GLenum kind, GLuint name) {
            gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
            gl.BindTexture(kind, name);
        };
        bind(displacement_unit, GL_TEXTURE_2D_ARRAY, textures.displacement());
        bind(slopes_unit, GL_TEXTURE_2D_ARRAY, textures.slopes());
        bind(moments_unit, GL_TEXTURE_2D_ARRAY, textures.moments());
        bind(detail_unit, GL_TEXTURE_2D, detail.name());
        bind(sky_unit, GL_TEXTURE_CUBE_MAP, sky.name());
        bind(floor_unit, GL_TEXTURE_2D, floor.name());
        bind(caustics_unit, GL_TEXTURE_2D, caustics.name());
        bind(foam_unit, GL_TEXTURE_2D_ARRAY, foam.name());
        bind(snapshots_unit, GL_TEXTURE_2D_ARRAY, textures.snapshots());
        bind(flow_unit, GL_TEXTURE_2D, flow.name());
        bind(scene_radiance_unit, GL_TEXTURE_2D, application.radiance);
        bind(scene_depth_unit, GL_TEXTURE_2D, application.depth);
        bind(shore_weights_unit, GL_TEXTURE_2D, shore.weights());
        bind(shore_water_unit, GL_TEXTURE_2D, shore.water());
        bind(shore_reach_unit, GL_TEXTURE_2D, shore.reach());
        bind(dynamic_waves_unit, GL_TEXTURE_2D, dynamic_waves.texels());
        bind(cloud_shadows_unit, GL_TEXTURE_2D, cloud_shadows.name());
        bind(exclusions_unit(options.surface), GL_TEXTURE_2D_ARRAY, exclusions.name());
    }

    void add(const PatchBuffers::Counts& counts) {
        statistics.sea_calls += counts.calls;
        statistics.triangles += counts.triangles;
        statistics.draw_driver_ms += counts.driver_ms;
    }

    /// Returns the variant without the features that depend on the draw, which cost time per pixel.
    SeaVariant variant() const {
        return {.cascades = options.cascades,
                .shading = options.shading,
                .surface = options.surface,
                .multiview = options.multiview};
    }

    /// Returns the programs of a variant. Compiles them at the first use.
    SeaPrograms& programs_for(const SeaVariant& wanted) {
        return programs_by_variant.try_emplace(wanted, gl, wanted).first->second;
    }

    /// Draws the floor as strips of a grid that the vertex shader generates. From the air it is
    /// drawn only if it is a height field, which may rise above the water.
    void draw_floor(int eye) {
        const glm::ivec2 cells = floor_cells(floor_facts);
        programs->floor.use(gl, eye);
        gl.BindVertexArray(empty.name());
        const Stopwatch driver;
        gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (cells.x + 3), cells.y + 2);
        statistics.draw_driver_ms += driver.milliseconds();
        ++statistics.floor_calls;
    }

    void draw_shaded(const DrawInput& input, int eye) {
        if (lens_is_wet || !floor_facts.is_even()) draw_floor(eye);
        // Boats are near, and water that they leave hides the water behind it.
        if (has_exclusions && !split.touching().empty()) {
            programs->patches_with(gl, input.exclusions.size()).use(gl, eye);
            add(buffers->draw_patches(split.touching(), false));
        }
        programs->patches.use(gl, eye);
        add(buffers->draw_patches(has_exclusions ? split.apart() : input.list->batches, false));
        programs->skirt.use(gl, eye);
        add(buffers->draw_skirt(input.list->skirt));
        if (input.mode == DrawMode::surface_data || (!input.draws_sky && !lens_is_wet)) return;
        // The triangle lies on the far plane, so only pixels without sea or floor are drawn.
        programs->background.use(gl, eye);
        gl.DepthMask(GL_FALSE);
        gl.BindVertexArray(empty.name());
        const Stopwatch driver;
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        statistics.draw_driver_ms += driver.milliseconds();
        gl.DepthMask(GL_TRUE);
        ++statistics.sky_calls;
    }

    void draw_spray(const DrawInput& input, const SceneBlock& block, int eye) {
        const bool soft = input.spray.scene_depth != 0 && input.eyes.size() == 1 && !options.multiview;
        gl.ActiveTexture(GL_TEXTURE0 + scene_depth_unit);
        gl.BindTexture(GL_TEXTURE_2D, input.spray.scene_depth);
        const Stopwatch driver;
        spray->draw(eye, soft, sample_weight_of_spray(block));
        statistics.draw_driver_ms += driver.milliseconds();
    }

    /// Returns whether an eye is inside an excluded interior.
    bool is_inside(const DrawInput& input, const Eye& eye) const {
        return std::any_of(input.exclusions.begin(), input.exclusions.end(), [&](const Exclusion& exclusion) {
            return exclusion_maps[exclusion.map].contains(exclusion.in_hull(eye.position_m));
        });
    }

    /// Returns the lens of each eye: {0} in place of `lens` for an eye inside an excluded interior.
    /// In a multiview pass both eyes share one, which is {0} only if both are inside.
    std::array<glm::vec4, 2> lenses_of(const DrawInput& input, const glm::vec4& lens) const {
        if (lens.w <= 0) return {};
        std::array<glm::vec4, 2> lenses{};
        for (std::size_t eye = 0; eye < input.eyes.size(); ++eye)
            if (!is_inside(input, input.eyes[eye])) lenses[eye] = lens;
        if (options.multiview && lenses[1].w > 0) lenses[0] = lens;
        return lenses;
    }

    /// Splits the draw list if exclusions are drawn.
    void split_patches(const DrawInput& input) {
        has_exclusions = !input.exclusions.empty() && input.mode != DrawMode::wireframe;
        if (has_exclusions) split.assign(*input.list, input.exclusions, exclusion_maps, bounds);
    }

    void upload(const SceneBlock& block) {
        gl.BindBuffer(GL_UNIFORM_BUFFER, scene.name());
        gl.BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
    }

    /// Draws nearly black faces with a depth offset, so that they hide the lines behind them, then
    /// the lines.
    void draw_wireframe(const DrawInput& input, int eye) {
        programs->wireframe.use(gl, eye);
        gl.Enable(GL_POLYGON_OFFSET_FILL);
        gl.PolygonOffset(1, 1);
        gl.Uniform1f(programs->wireframe.brightness, 0.06f);
        add(buffers->draw_patches(input.list->batches, false));
        gl.Disable(GL_POLYGON_OFFSET_FILL);
        gl.Uniform1f(programs->wireframe.brightness, 0.9f);
        add(buffers->draw_patches(input.list->batches, true));
    }

    const Functions& gl;
    RendererOptions options;
    FrameTextures textures;
    DynamicWaveTextures dynamic_waves;
    ShoreTextures shore;
    bool is_software;
    SeaFacts facts;
    std::map<SeaVariant, SeaPrograms> programs_by_variant;
    SeaPrograms* programs = nullptr;  ///< programs of the current draw()
    std::optional<PatchBuffers> buffers;  ///< of the last draw list's V
    Texture detail, foam, sky, cloud_shadows, floor, caustics, flow, exclusions;
    std::vector<ExclusionMap> exclusion_maps;
    bool has_exclusions = false;  ///< the current draw() leaves out the interiors of hulls
    PatchSplit split;             ///< of that draw()
    FrameBounds bounds;           ///< of the uploaded frame
    SeaFloor floor_facts;         ///< without heights, which are in the texture
    double focus_depth_m = 0;     ///< of caustics on a height field
    CausticFacts caustic_facts;
    bool lens_is_wet = false;  ///< of the current pass
    FlowExtent flow_extent;
    int sky_face_size = 0;
    SkyLight light;
    CloudShadows shadows;
    WaterOptics water = water_optics(default_jerlov_type);
    VertexArray empty;
    Buffer scene;
    std::optional<SprayRenderer> spray;  ///< created by the first draw() with spray
    DrawStatistics statistics;
};

SeaRenderer::SeaRenderer(const Functions& gl, const RendererOptions& options) : state_(new State(gl, options)) {}
SeaRenderer::~SeaRenderer() = default;

void SeaRenderer::set_flow(const FlowMap& map) {
    require(check(map));
    const GlStateGuard keep(state_->gl);
    state_->flow = make_flow_texture(state_->gl, map);
    state_->flow_extent = map.extent;
}

void SeaRenderer::set_sky(const Sky& sky) {
    State& s = *state_;
    const Functions& gl = s.gl;
    const GlStateGuard keep(gl);
    gl.ActiveTexture(GL_TEXTURE0 + sky_unit);
    if (s.sky_face_size != sky.face_size) {
        s.sky = make_texture(gl, GL_TEXTURE_CUBE_MAP, GL_RGBA16F, sky.levels, sky.face_size, sky.face_size);
        s.sky_face_size = sky.face_size;
    }
    gl.BindTexture(GL_TEXTURE_CUBE_MAP, s.sky.name());
    for (int level = 0; level < sky.levels; ++level)
        for (int face = 0; face < 6; ++face)
            gl.TexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), level, 0, 0,
                             sky.face_size >> level, sky.face_size >> level, GL_RGBA, GL_HALF_FLOAT,
                             sky.face(level, face).data());
    s.light = sky;
    s.shadows = sky.cloud_shadows;
    const std::vector<std::uint8_t>& shadows = s.shadows.texels;
    if (shadows.empty()) return;
    constexpr int side = CloudShadows::side;
    gl.ActiveTexture(GL_TEXTURE0 + cloud_shadows_unit);
    if (s.cloud_shadows.name() == 0)
        s.cloud_shadows = make_texture(gl, GL_TEXTURE_2D, GL_R8, mip_levels(side), side, side);
    gl.BindTexture(GL_TEXTURE_2D, s.cloud_shadows.name());
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side, GL_RED, GL_UNSIGNED_BYTE, shadows.data());
    gl.GenerateMipmap(GL_TEXTURE_2D);
}

void SeaRenderer::set_shading(Shading shading) { state_->options.shading = shading; }

void SeaRenderer::set_water(const WaterOptics& water) { state_->water = water; }

void SeaRenderer::set_floor(const SeaFloor& floor) {
    require(check(floor));
    State& s = *state_;
    const Functions& gl = s.gl;
    s.floor_facts = floor;
    s.floor_facts.heights_m = {};
    s.focus_depth_m = caustics_depth_m(floor, 0);
    s.floor.reset();
    if (floor.is_even()) return;
    const GlStateGuard keep(gl);
    const FloorTexels texels = texels_of(floor);
    gl.ActiveTexture(GL_TEXTURE0 + floor_unit);
    s.floor = make_texture(gl, GL_TEXTURE_2D, GL_R16F, texels.levels, floor.columns, floor.rows);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    upload_halves(gl, texels.levels, floor.columns, floor.rows, texels.halves.data());
}

void SeaRenderer::set_exclusion_maps(std::span<const ExclusionMap> maps) {
    if (maps.size() > max_exclusion_maps)
        throw std::invalid_argument("set_exclusion_maps() got " + std::to_string(maps.size()) +
                                    " maps, expected at most " + std::to_string(max_exclusion_maps));
    State& s = *state_;
    const GlStateGuard keep(s.gl);
    s.exclusions = maps.empty() ? Texture() : make_exclusion_texture(s.gl, maps);
    s.exclusion_maps.assign(maps.begin(), maps.end());
}

void SeaRenderer::set_caustics(const Caustics& caustics) {
    State& s = *state_;
    const Functions& gl = s.gl;
    const GlStateGuard keep(gl);
    gl.ActiveTexture(GL_TEXTURE0 + caustics_unit);
    constexpr int side = Caustics::side, levels = Caustics::levels;
    if (s.caustics.name() == 0) s.caustics = make_texture(gl, GL_TEXTURE_2D, GL_R16F, levels, side, side);
    gl.BindTexture(GL_TEXTURE_2D, s.caustics.name());
    upload_halves(gl, levels, side, side, caustics.halves.data());
    s.caustic_facts = {caustics.grid, caustics.options.depth_m};
}

std::optional<CausticsOptions> SeaRenderer::visible_caustics(double above_water_m) const {
    constexpr double deepest_seen_m = 60, soon_m = 2;
    const double sea_depth_m = state_->facts.sea.depth_m;
    const bool is_even = state_->floor_facts.is_even();
    if (is_even && sea_depth_m >= deepest_seen_m && above_water_m >= soon_m) return {};
    return CausticsOptions{.depth_m = is_even ? caustics_depth_m({}, sea_depth_m) : state_->focus_depth_m,
                           .sun = sun_direction(state_->light.options)};
}

std::span<const TextureTargets> SeaRenderer::map_textures() { return state_->textures.map(); }

void SeaRenderer::upload(const Frame& frame) {
    const Stopwatch all;
    require(state_->dynamic_waves.invalid_value_of(frame.dynamic_waves));
    state_->textures.upload(frame);
    state_->shore.upload(frame.shore);
    state_->dynamic_waves.upload(frame.dynamic_waves);
    const Stopwatch finish;
    if (state_->is_software) state_->gl.Finish();
    const double finish_ms = finish.milliseconds();
    state_->facts = facts_of(frame);
    state_->bounds = frame.bounds;
    state_->facts.has_displacement_mips = state_->textures.has_displacement_mips();
    state_->facts.has_foam = state_->textures.has_foam();
    state_->facts.shore_has_mips = state_->shore.has_mips();
    state_->facts.framebuffer_is_srgb = state_->options.framebuffer_is_srgb;
    state_->facts.surface = state_->options.surface;
    state_->facts.writes_radiance = state_->options.writes == PixelKind::radiance;
    state_->statistics.upload_ms = all.milliseconds();
    state_->statistics.upload_driver_ms = finish_ms + state_->textures.last_driver_ms() +
                                          state_->dynamic_waves.last_driver_ms() + state_->shore.last_driver_ms();
    state_->statistics.upload_bytes =
        state_->textures.uploaded_bytes() + state_->dynamic_waves.uploaded_bytes() + state_->shore.uploaded_bytes();
}

const DrawStatistics& SeaRenderer::draw(const DrawInput& input) {
    const Stopwatch all;
    State& s = *state_;
    const Functions& gl = s.gl;
    assert(input.list && !input.eyes.empty() && input.eyes.size() <= 2);
    assert(s.sky_face_size > 0 && "set_sky() first");
    assert(!s.facts.cascades.empty() && "upload() a frame first");
    require(check(input.exclusions, s.exclusion_maps.size()));
    const GlStateGuard keep(gl);
    DrawStatistics& statistics = s.statistics;
    statistics.sea_calls = statistics.sky_calls = statistics.floor_calls = 0;
    statistics.triangles = 0;
    statistics.draw_driver_ms = 0;

    s.facts.flow = s.flow_extent;
    SceneBlock block = scene_block_of(input, s.facts, s.water, s.light);
    block.cloud_light.z = sunlit_at({input.viewer().x, input.viewer().z});
    place_below(block, input, s.facts, s.floor_facts, s.caustic_facts);
    place_exclusions(block, input, s.exclusion_maps);
    const std::array<glm::vec4, 2> lenses = s.lenses_of(input, block.lens);
    block.lens = lenses[0];
    const bool writes_data = input.mode == DrawMode::surface_data;
    const bool mirrors_scene = !writes_data && input.application_scene && input.eyes.size() == 1 &&
                               !s.options.multiview && s.options.shading != Shading::headset;
    SeaVariant variant = s.variant();
    variant.below = lenses[0].w > 0 || lenses[1].w > 0 || block.floor_albedo.w > 0 || !s.floor_facts.is_even();
    variant.mirrors_scene = mirrors_scene;
    variant.surface_data = writes_data;
    variant.dynamic_waves = s.facts.dynamic_waves.resolution > 0;
    variant.shore = s.facts.shore.columns > 0 && s.options.surface == Surface::open;
    s.programs = &s.programs_for(variant);
    s.upload(block);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, s.scene.name());
    s.split_patches(input);
    if (const int vertices = input.list->grid.vertices; !s.buffers || s.buffers->vertices() != vertices)
        s.buffers.emplace(gl, vertices);
    statistics.instance_bytes =
        s.buffers->upload(s.has_exclusions ? s.split.instances() : input.list->instances, input.list->skirt);
    s.bind_textures(mirrors_scene ? *input.application_scene : ApplicationScene{});
    // GlStateGuard has set all other state. Faces are not culled, because folded crests show their
    // undersides.
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LEQUAL);

    const glm::dvec3 viewer_m = input.viewer();
    const bool is_under_water = input.camera_water_plane && viewer_m.y < input.camera_water_plane->height_m &&
                                !s.is_inside(input, input.eyes[0]);
    const bool draws_spray = !input.spray.droplets.empty() && !is_under_water && !writes_data;
    if (draws_spray && !s.spray) s.spray.emplace(gl, s.options.multiview);
    if (draws_spray) s.spray->upload(input.spray.droplets, s.facts.time_s, s.facts.sea.wind_speed_mps, viewer_m);
    const std::size_t passes = s.options.multiview ? 1 : input.eyes.size();
    for (std::size_t eye = 0; eye < passes; ++eye) {
        const Viewport& view = input.eyes[eye].viewport;
        gl.Viewport(view.x, view.y, view.width, view.height);
        if (lenses[eye] != block.lens) {
            block.lens = lenses[eye];
            s.upload(block);
        }
        s.lens_is_wet = block.lens.w > 0;
        if (input.mode == DrawMode::wireframe)
            s.draw_wireframe(input, static_cast<int>(eye));
        else
            s.draw_shaded(input, static_cast<int>(eye));
        if (draws_spray) s.draw_spray(input, block, static_cast<int>(eye));
    }
    statistics.draw_ms = all.milliseconds();
    return statistics;
}

float SeaRenderer::sunlit_at(const glm::dvec2& world_m) const {
    const SeaFacts& facts = state_->facts;
    return state_->shadows.at(facts.unshifted({world_m.x, 0, world_m.y}) - cloud_drift(facts.sea, facts.time_s));
}

const FrameTextures& SeaRenderer::textures() const { return state_->textures; }
const DrawStatistics& SeaRenderer::statistics() const { return state_->statistics; }

}  // namespace pelagic::gl
