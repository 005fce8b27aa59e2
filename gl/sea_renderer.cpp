#include "pelagic/gl/sea_renderer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "pelagic/gl/detail_image.hpp"
#include "pelagic/gl/errors.hpp"
#include "pelagic/gl/kept_state.hpp"
#include "pelagic/gl/patch_buffers.hpp"
#include "pelagic/gl/program.hpp"
#include "pelagic/gl/scene_block.hpp"
#include "pelagic/gl/stopwatch.hpp"

namespace pelagic::gl {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double gravity_mps2 = 9.81;
/// The sun seen from the earth: 16 minutes of arc.
constexpr float sun_radius_rad = 0.00465f;

// Sea water for 680, 550 and 440 nm. Absorption: pure water (Pope and Fry 1997; 0.465, 0.0565, 0.0064 1/m) and what lives
// and is dissolved in it where chlorophyll is 0.3 mg/m^3 (Bricaud et al. 1995). Scattering backwards: water's own (Morel
// 1974: half of 0.0007, 0.0019, 0.0049 1/m) and particles' (0.006 1/m).
constexpr glm::vec3 absorption_per_m{0.470f, 0.064f, 0.036f};
constexpr glm::vec3 backscattering_per_m{0.0063f, 0.0070f, 0.0085f};

/// Ripples stand for this part of the roughness that the sea has between its texels; the rest is too fine even for them.
constexpr float detail_part = 0.75f;
/// A tile of ripples in texels of the sea: its longest waves, a third of it, are as long as the sea's shortest.
constexpr double detail_texels = 6;
/// Layers have no period in common: their sizes stand in powers of the golden ratio.
constexpr double golden = 1.6180339887;
constexpr double layer_turns_rad[2] = {0.21, -0.47};

/// The horizon softens over this angle below it.
constexpr double softened_horizon_rad = 0.25 * pi / 180;

enum Unit : GLint { displacement_unit, gradient_unit, detail_unit, sky_unit };

double fraction(double value) { return value - std::floor(value); }

Texture make_detail_texture(const Functions& gl) {
    const DetailImage image = make_detail_image();
    Texture texture(gl);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    gl.TexStorage2D(GL_TEXTURE_2D, DetailImage::levels, GL_RGBA8, DetailImage::side, DetailImage::side);
    for (int level = 0; level < DetailImage::levels; ++level)
        gl.TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, DetailImage::side >> level, DetailImage::side >> level, GL_RGBA,
                         GL_UNSIGNED_BYTE, image.level(level));
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    return texture;
}

/// Where the viewer is in a tile that is turned and repeats, [0, 1).
glm::dvec2 place_in_tile(glm::dvec2 at, double angle, double tile_m) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {fraction((c * at.x + s * at.y) / tile_m), fraction((c * at.y - s * at.x) / tile_m)};
}

}  // namespace

struct SeaRenderer::State {
    State(const Functions& functions, const RendererOptions& wanted)
        : gl(functions), options(wanted), textures(functions, wanted.resolution) {
        const KeptState keep(gl);
        GLint unpack = 0, alignment = 4;
        gl.GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack);
        gl.GetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
        gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
        gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);

        const std::string defines = options.multiview ? "#define MULTIVIEW\n" : "";
        patches = make_program("sea.vert.glsl", "sea.frag.glsl", defines);
        skirt = make_program("skirt.vert.glsl", "sea.frag.glsl", defines + "#define SKIRT\n");
        background = make_program("sky.vert.glsl", "sky.frag.glsl", defines);
        wireframe = make_program("sea.vert.glsl", "wireframe.frag.glsl", defines);
        buffers = std::make_unique<PatchBuffers>(gl, options.patch_vertices);
        gl.ActiveTexture(GL_TEXTURE0);
        detail = make_detail_texture(gl);
        empty = VertexArray(gl);
        scene = Buffer(gl);
        gl.BindBuffer(GL_UNIFORM_BUFFER, scene.name());
        gl.BufferData(GL_UNIFORM_BUFFER, sizeof(SceneBlock), nullptr, GL_STREAM_DRAW);

        gl.PixelStorei(GL_UNPACK_ALIGNMENT, alignment);
        gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(unpack));
    }

    struct SeaProgram {
        Program program;
        GLint eye_index = -1, brightness = -1;
    };

    SeaProgram make_program(const char* vertex, const char* fragment, const std::string& defines) {
        SeaProgram made{Program(gl, vertex, fragment, defines)};
        gl.UseProgram(made.program.name());
        gl.UniformBlockBinding(made.program.name(), gl.GetUniformBlockIndex(made.program.name(), "Scene"), 0);
        gl.Uniform1i(made.program.uniform("displacement"), displacement_unit);
        gl.Uniform1i(made.program.uniform("gradient"), gradient_unit);
        gl.Uniform1i(made.program.uniform("detail"), detail_unit);
        gl.Uniform1i(made.program.uniform("sky"), sky_unit);
        made.eye_index = made.program.uniform("eye_index");
        made.brightness = made.program.uniform("brightness");
        return made;
    }

    SceneBlock scene_of(const DrawInput& input) const {
        SceneBlock block;
        const QuadtreeGrid& grid = input.list->grid;
        const glm::dvec2 viewer(input.viewer_m.x, input.viewer_m.z);
        const double patch_m = sea.patch_size_m;
        for (std::size_t i = 0; i < input.eyes.size(); ++i) {
            const glm::dmat4 clip = glm::translate(input.eyes[i].clip_from_world, input.viewer_m);
            block.clip_from_viewer[i] = glm::mat4(clip);
            block.viewer_from_clip[i] = glm::mat4(glm::inverse(clip));
            block.eye[i] = glm::vec4(glm::vec3(input.eyes[i].position_m - input.viewer_m), 0);
        }
        const auto to_float = [](glm::dvec2 v) { return glm::vec2(v); };
        // Texel (i, j) stands at i L/N, j L/N; a texture's texel has its middle half a texel further.
        const double half_texel = 0.5 / sea.resolution;
        block.viewer = {fraction(viewer.x / patch_m + half_texel), fraction(viewer.y / patch_m + half_texel),
                        input.viewer_m.y, 1 / patch_m};
        block.grid = {to_float(glm::dvec2(grid.corner) * grid.step_m - viewer), grid.step_m, grid.vertices};
        block.fade = {to_float(grid.fade_centre - viewer), grid.fade_end_m,
                      1 / (grid.fade_end_m - grid.fade_start_m)};
        block.mesh = {1 / (input.lod_scale * grid.vertices), grid.step_m,
                      textures.has_displacement_mips() ? mip_levels(sea.resolution) - 1 : 0,
                      sea.resolution / patch_m};
        block.skirt = {to_float((glm::dvec2(grid.corner) + 0.5 * grid.side) * grid.step_m - viewer), grid.side,
                       grid.deepest_level};
        block.sun = {sun_direction, sun_radius_rad};
        block.sun_irradiance = {sun_irradiance, exposure};
        block.sky_irradiance = {sky_irradiance, sky_levels - 1};
        const double height = std::max(1.5, std::abs(input.viewer_m.y));
        block.haze = {haze_per_m, height / std::tan(softened_horizon_rad)};
        block.water_absorption = {absorption_per_m, sea.depth_m};
        block.output_kind.y = sea_figures.whitecap_jacobian + input.more_foam;
        const float alpha = static_cast<float>(sea.roughness);
        const float detail_square = detail_part * alpha * alpha;
        block.water_scattering = {backscattering_per_m, detail_square};
        const double wind = sea.wind_direction_rad;
        block.waves = {std::max(0.05, sea_figures.significant_wave_height_m), alpha, std::cos(wind), std::sin(wind)};
        place_tiles(block, viewer);
        block.output_kind.x = options.framebuffer_is_srgb ? 0 : 1;
        return block;
    }

    void place_tiles(SceneBlock& block, glm::dvec2 viewer) const {
        const double texel_m = sea.patch_size_m / sea.resolution;
        const double loop = fraction(time_s / sea.loop_period_s);
        glm::dvec2 shifts[2];
        for (int layer = 0; layer < 2; ++layer) {
            const double tile_m = detail_texels * texel_m / (layer == 0 ? 1 : golden * golden * golden);
            const double angle = sea.wind_direction_rad + layer_turns_rad[layer];
            // Ripples travel as waves of a tenth of the tile do in deep water; the way in a loop is whole tiles.
            const double speed = std::sqrt(gravity_mps2 * tile_m / 10 / (2 * pi));
            const double tiles = std::round(speed * sea.loop_period_s / tile_m);
            shifts[layer] = place_in_tile(viewer, angle, tile_m) - glm::dvec2(fraction(tiles * loop), 0);
            block.detail_turn[static_cast<std::size_t>(layer)] = {std::cos(angle) / tile_m, std::sin(angle) / tile_m,
                                                                  std::cos(angle), std::sin(angle)};
        }
        block.detail_shift = {glm::vec2(shifts[0]), glm::vec2(shifts[1])};
        // As the shader turns it: the other way than place_in_tile.
        block.second_shift = {glm::vec2(place_in_tile(viewer, -second_turn_rad, sea.patch_size_m * golden)), 0, 0};
        // Lace is as large as the waves that make it: tiles of 5 m in a calm, of 20 m in a storm.
        const double foam_m = 5 + 1.8 * block.waves.x;
        const glm::dvec4 tiles(foam_m, foam_m / golden / 1.1, 460, 1510);  // gusts: metres
        block.noise_scale = glm::vec4(1.0 / tiles);
        const glm::dvec2 turned(viewer.y, viewer.x);
        const auto placed = [](glm::dvec2 at, double tile) { return glm::vec2(place_in_tile(at, 0, tile)); };
        block.foam_shift = {placed(viewer, tiles.x), placed(turned, tiles.y)};
        block.gust_shift = {placed(viewer, tiles.z), placed(turned, tiles.w)};
    }

    void bind_textures() {
        const GLuint names[] = {textures.displacement(), textures.gradient(), detail.name()};
        for (GLenum unit = 0; unit < 3; ++unit) {
            gl.ActiveTexture(GL_TEXTURE0 + unit);
            gl.BindTexture(GL_TEXTURE_2D, names[unit]);
        }
        gl.ActiveTexture(GL_TEXTURE0 + sky_unit);
        gl.BindTexture(GL_TEXTURE_CUBE_MAP, sky.name());
    }

    void use(const SeaProgram& program, int eye) {
        gl.UseProgram(program.program.name());
        if (program.eye_index >= 0) gl.Uniform1i(program.eye_index, eye);
    }

    void add(const PatchBuffers::Counts& counts) {
        figures.sea_calls += counts.calls;
        figures.triangles += counts.triangles;
        figures.draw_driver_ms += counts.driver_ms;
    }

    void draw_shaded(const DrawInput& input, int eye) {
        use(patches, eye);
        add(buffers->draw_patches(*input.list, false));
        use(skirt, eye);
        add(buffers->draw_skirt(*input.list));
        if (!input.draws_sky) return;
        // Behind the sea, where it did not draw: its triangle lies on the far plane.
        use(background, eye);
        gl.DepthMask(GL_FALSE);
        gl.BindVertexArray(empty.name());
        const Stopwatch driver;
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        figures.draw_driver_ms += driver.milliseconds();
        gl.DepthMask(GL_TRUE);
        ++figures.sky_calls;
    }

    /// Faces a little further away and nearly black, so that they hide the lines behind them.
    void draw_wireframe(const DrawInput& input, int eye) {
        use(wireframe, eye);
        gl.Enable(GL_POLYGON_OFFSET_FILL);
        gl.PolygonOffset(1, 1);
        gl.Uniform1f(wireframe.brightness, 0.06f);
        add(buffers->draw_patches(*input.list, false));
        gl.Disable(GL_POLYGON_OFFSET_FILL);
        gl.Uniform1f(wireframe.brightness, 0.9f);
        add(buffers->draw_patches(*input.list, true));
    }

    const Functions& gl;
    RendererOptions options;
    FrameTextures textures;
    // What the uploaded frame says of itself.
    SeaState sea;
    SeaFigures sea_figures;
    double time_s = 0;
    SeaProgram patches, skirt, background, wireframe;
    std::unique_ptr<PatchBuffers> buffers;
    Texture detail, sky;
    int sky_face_size = 0, sky_levels = 1;
    glm::vec3 sun_direction{0, 1, 0}, sun_irradiance{1}, sky_irradiance{1}, haze_per_m{0};
    float exposure = 1;
    VertexArray empty;
    Buffer scene;
    DrawFigures figures;

    static constexpr double second_turn_rad = 0.3648;  // sea.frag.glsl: the turn of the second copy of the waves
};

SeaRenderer::SeaRenderer(const Functions& gl, const RendererOptions& options) : state_(new State(gl, options)) {}
SeaRenderer::~SeaRenderer() = default;

void SeaRenderer::set_sky(const Sky& sky) {
    State& s = *state_;
    const Functions& gl = s.gl;
    const KeptState keep(gl);
    GLint unpack = 0;
    gl.GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.ActiveTexture(GL_TEXTURE0 + sky_unit);
    if (s.sky_face_size != sky.face_size) {
        s.sky = Texture(gl);
        gl.BindTexture(GL_TEXTURE_CUBE_MAP, s.sky.name());
        gl.TexStorage2D(GL_TEXTURE_CUBE_MAP, sky.levels, GL_RGBA16F, sky.face_size, sky.face_size);
        gl.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        s.sky_face_size = sky.face_size;
        s.sky_levels = sky.levels;
    }
    gl.BindTexture(GL_TEXTURE_CUBE_MAP, s.sky.name());
    for (int level = 0; level < sky.levels; ++level)
        for (int face = 0; face < 6; ++face)
            gl.TexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), level, 0, 0,
                             sky.face_size >> level, sky.face_size >> level, GL_RGBA, GL_HALF_FLOAT,
                             sky.face(level, face).data());
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(unpack));
    s.sun_direction = sky.sun_direction;
    s.sun_irradiance = sky.sun_irradiance;
    s.sky_irradiance = sky.sky_irradiance;
    s.haze_per_m = sky.haze_per_m;
    s.exposure = sky.exposure;
}

void SeaRenderer::upload(const Frame& frame) {
    const Stopwatch all;
    state_->textures.upload(frame);
    state_->sea = frame.sea;
    state_->sea_figures = frame.figures;
    state_->time_s = frame.time_s;
    state_->figures.upload_ms = all.milliseconds();
    state_->figures.upload_driver_ms = state_->textures.last_driver_ms();
    state_->figures.upload_bytes = state_->textures.bytes_per_frame();
}

const DrawFigures& SeaRenderer::draw(const DrawInput& input) {
    const Stopwatch all;
    State& s = *state_;
    const Functions& gl = s.gl;
    assert(input.list && !input.eyes.empty() && input.eyes.size() <= 2);
    assert(s.sky_face_size > 0 && "set_sky() first");
    const KeptState keep(gl);
    DrawFigures& figures = s.figures;
    figures.sea_calls = figures.sky_calls = 0;
    figures.triangles = 0;
    figures.draw_driver_ms = 0;

    const SceneBlock block = s.scene_of(input);
    gl.BindBuffer(GL_UNIFORM_BUFFER, s.scene.name());
    gl.BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, s.scene.name());
    figures.instance_bytes = s.buffers->upload(*input.list);
    s.bind_textures();
    for (const GLenum off : {GL_BLEND, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_POLYGON_OFFSET_FILL,
                             GL_CULL_FACE})  // crests that fold show their undersides: nothing is culled
        gl.Disable(off);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LEQUAL);
    gl.DepthMask(GL_TRUE);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

    const std::size_t passes = s.options.multiview ? 1 : input.eyes.size();
    for (std::size_t eye = 0; eye < passes; ++eye) {
        const Viewport& view = input.eyes[eye].viewport;
        gl.Viewport(view.x, view.y, view.width, view.height);
        if (input.mode == DrawMode::wireframe)
            s.draw_wireframe(input, static_cast<int>(eye));
        else
            s.draw_shaded(input, static_cast<int>(eye));
    }
    figures.draw_ms = all.milliseconds();
    return figures;
}

const FrameTextures& SeaRenderer::textures() const { return state_->textures; }
const DrawFigures& SeaRenderer::figures() const { return state_->figures; }

}  // namespace pelagic::gl
