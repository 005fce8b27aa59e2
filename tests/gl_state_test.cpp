// An application may leave GL in any state. The library restores it after every call, and the image
// equals that of a fresh context.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pelagic/gl/display.hpp"
#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/light_meter.hpp"
#include "pelagic/gl/meshes/rock.hpp"
#include "pelagic/gl/program.hpp"
#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

constexpr int state_pixels = 48;

template <class Function>
Function* loaded(const char* name) {
    void* const egl = dlopen("libEGL.so.1", RTLD_NOW);
    const auto get = reinterpret_cast<void* (*)(const char*)>(dlsym(egl, "eglGetProcAddress"));
    return reinterpret_cast<Function*>(get(name));
}

/// Colour, depth and stencil.
struct Target {
    explicit Target(const gl::Functions& gl) : colour(gl), depth(gl), framebuffer(gl) {
        gl.BindRenderbuffer(GL_RENDERBUFFER, colour.name());
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_RGBA8, state_pixels, state_pixels);
        gl.BindRenderbuffer(GL_RENDERBUFFER, depth.name());
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_DEPTH24_STENCIL8, state_pixels, state_pixels);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.name());
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth.name());
        gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    }
    gl::Renderbuffer colour, depth;
    gl::Framebuffer framebuffer;
};

constexpr std::array switches = {GL_CULL_FACE,
                                 GL_BLEND,
                                 GL_STENCIL_TEST,
                                 GL_SCISSOR_TEST,
                                 GL_POLYGON_OFFSET_FILL,
                                 GL_SAMPLE_ALPHA_TO_COVERAGE,
                                 GL_SAMPLE_COVERAGE,
                                 GL_RASTERIZER_DISCARD,
                                 GL_PRIMITIVE_RESTART_FIXED_INDEX};

constexpr std::array integers = {GL_CURRENT_PROGRAM,
                                 GL_VERTEX_ARRAY_BINDING,
                                 GL_ARRAY_BUFFER_BINDING,
                                 GL_ELEMENT_ARRAY_BUFFER_BINDING,
                                 GL_UNIFORM_BUFFER_BINDING,
                                 GL_PIXEL_UNPACK_BUFFER_BINDING,
                                 GL_DRAW_FRAMEBUFFER_BINDING,
                                 GL_READ_FRAMEBUFFER_BINDING,
                                 GL_RENDERBUFFER_BINDING,
                                 GL_ACTIVE_TEXTURE,
                                 GL_UNPACK_ALIGNMENT,
                                 GL_UNPACK_ROW_LENGTH,
                                 GL_UNPACK_IMAGE_HEIGHT,
                                 GL_UNPACK_SKIP_PIXELS,
                                 GL_UNPACK_SKIP_ROWS,
                                 GL_UNPACK_SKIP_IMAGES,
                                 GL_PIXEL_PACK_BUFFER_BINDING,
                                 GL_PACK_ALIGNMENT,
                                 GL_PACK_ROW_LENGTH,
                                 GL_PACK_SKIP_PIXELS,
                                 GL_PACK_SKIP_ROWS,
                                 GL_CULL_FACE_MODE,
                                 GL_FRONT_FACE,
                                 GL_DEPTH_FUNC,
                                 GL_DEPTH_WRITEMASK,
                                 GL_STENCIL_FUNC,
                                 GL_STENCIL_WRITEMASK,
                                 GL_BLEND_SRC_RGB,
                                 GL_BLEND_DST_RGB,
                                 GL_BLEND_SRC_ALPHA,
                                 GL_BLEND_DST_ALPHA,
                                 GL_BLEND_EQUATION_RGB,
                                 GL_BLEND_EQUATION_ALPHA};

/// All state that an application could have set and that drawing could change, by name.
std::map<std::string, std::vector<GLfloat>> state_of(const gl::Functions& gl) {
    std::map<std::string, std::vector<GLfloat>> state;
    for (const GLenum name : switches) state["switch " + std::to_string(name)] = {GLfloat(gl.IsEnabled(name))};
    for (const GLenum name : {GL_DEPTH_TEST, GL_DITHER})
        state["switch " + std::to_string(name)] = {GLfloat(gl.IsEnabled(name))};
    for (const auto name : integers) {
        GLint value = 0;
        gl.GetIntegerv(static_cast<GLenum>(name), &value);
        state["integer " + std::to_string(name)] = {static_cast<GLfloat>(value)};
    }
    for (const auto name : {GL_VIEWPORT, GL_SCISSOR_BOX, GL_COLOR_WRITEMASK, GL_DEPTH_RANGE, GL_POLYGON_OFFSET_FACTOR,
                            GL_POLYGON_OFFSET_UNITS, GL_SAMPLE_COVERAGE_VALUE, GL_COLOR_CLEAR_VALUE,
                            GL_DEPTH_CLEAR_VALUE, GL_BLEND_COLOR}) {
        std::vector<GLfloat> values(4);
        gl.GetFloatv(static_cast<GLenum>(name), values.data());
        state["float " + std::to_string(name)] = values;
    }
    GLint buffer = 0;
    GLint64 start = 0, size = 0;
    gl.GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 0, &buffer);
    gl.GetInteger64i_v(GL_UNIFORM_BUFFER_START, 0, &start);
    gl.GetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, 0, &size);
    state["uniform block 0"] = {GLfloat(buffer), GLfloat(start), GLfloat(size)};
    GLint unit = 0;
    gl.GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    for (GLuint i = 0; i < GLuint{gl::texture_units} + 1; ++i) {
        gl.ActiveTexture(GL_TEXTURE0 + i);
        for (const GLenum name :
             {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP, GL_SAMPLER_BINDING}) {
            GLint value = 0;
            gl.GetIntegerv(name, &value);
            state["unit " + std::to_string(i)].push_back(static_cast<GLfloat>(value));
        }
    }
    gl.ActiveTexture(static_cast<GLenum>(unit));
    return state;
}

/// State of which each item alone would corrupt the image, or crash.
class NastyApplication {
   public:
    explicit NastyApplication(const gl::Functions& gl)
        : gl_(gl),
          buffer_(gl),
          small_(gl),
          texture_(gl),
          layers_(gl),
          cube_(gl),
          array_(gl),
          sampler_(gl),
          program_(gl, "panel.vert.glsl", "panel.frag.glsl") {
        gl.BindVertexArray(array_.name());
        gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, small_.name());
        gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.name());
        gl.BufferData(GL_ARRAY_BUFFER, 1024, nullptr, GL_STATIC_DRAW);
        gl.BindBufferRange(GL_UNIFORM_BUFFER, 0, buffer_.name(), 256, 128);
        gl.BindBuffer(GL_UNIFORM_BUFFER, small_.name());
        gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, small_.name());
        gl.BufferData(GL_PIXEL_UNPACK_BUFFER, 16, nullptr, GL_STATIC_DRAW);
        gl.UseProgram(program_.name());
        for (GLuint unit = 0; unit < GLuint{gl::texture_units} + 1; ++unit) {
            gl.ActiveTexture(GL_TEXTURE0 + unit);
            gl.BindTexture(GL_TEXTURE_2D, texture_.name());
            gl.BindTexture(GL_TEXTURE_2D_ARRAY, layers_.name());
            gl.BindTexture(GL_TEXTURE_CUBE_MAP, cube_.name());
            gl.BindSampler(unit, sampler_.name());
        }
        gl.ActiveTexture(GL_TEXTURE2);
        gl.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
        gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 1'000'000);
        gl.PixelStorei(GL_UNPACK_IMAGE_HEIGHT, 9);
        gl.PixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
        gl.PixelStorei(GL_UNPACK_SKIP_ROWS, 5);
        gl.PixelStorei(GL_UNPACK_SKIP_IMAGES, 2);
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, small_.name());
        gl.PixelStorei(GL_PACK_ALIGNMENT, 8);
        gl.PixelStorei(GL_PACK_ROW_LENGTH, 1'000'000);
        gl.PixelStorei(GL_PACK_SKIP_PIXELS, 3);
        gl.PixelStorei(GL_PACK_SKIP_ROWS, 5);
        loaded<void(GLenum)>("glCullFace")(GL_FRONT_AND_BACK);
        loaded<void(GLenum)>("glFrontFace")(GL_CW);
        loaded<void(GLenum, GLenum)>("glBlendFunc")(GL_ZERO, GL_ONE);
        gl.BlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MIN);
        gl.BlendColor(0.1f, 0.2f, 0.3f, 0.4f);
        loaded<void(GLenum, GLint, GLuint)>("glStencilFunc")(GL_NEVER, 1, 1);
        loaded<void(GLuint)>("glStencilMask")(2);
        loaded<void(GLfloat, GLboolean)>("glSampleCoverage")(0.25f, GL_TRUE);
        gl.Scissor(1, 2, 3, 4);
        gl.PolygonOffset(-50, -1e6f);
        gl.DepthFunc(GL_GREATER);
        gl.DepthRangef(1, 0);
        gl.DepthMask(GL_FALSE);
        gl.ColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
        gl.Viewport(5, 6, 7, 8);
        set_switches(true);
    }
    /// Sets default state as an application would before it clears or reads; `on` restores the
    /// adverse state.
    void set_switches(bool on) const {
        for (const GLenum name : switches) on ? gl_.Enable(name) : gl_.Disable(name);
    }

   private:
    const gl::Functions& gl_;
    gl::Buffer buffer_, small_;
    gl::Texture texture_, layers_, cube_;
    gl::VertexArray array_;
    gl::Sampler sampler_;
    gl::Program program_;
};

/// The scene that is drawn, from 10 m above the rest level.
struct Look {
    const char* name;
    gl::DrawMode mode;
    std::optional<gl::CameraWaterPlane> camera_water_plane = {};
    bool has_rock = false;  ///< the application draws it and passes it in for reflections
};

/// Writes into the first bytes, whatever the application's packing is.
void read_target(const gl::Functions& gl, std::vector<std::uint8_t>& pixels) {
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS}) gl.PixelStorei(name, 0);
    gl.ReadPixels(0, 0, state_pixels, state_pixels, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

/// Runs a renderer's whole lifetime in one context. \param after_each_call  called with the name of
/// each call
template <class Check>
std::vector<std::uint8_t> image(const gl::Functions& gl, const Frame& frame, const Look& look,
                                Check after_each_call) {
    gl::SeaRenderer renderer(gl, {.resolution = frame.cascades[0].resolution(), .cascades = frame.cascades.size()});
    after_each_call("constructor");
    renderer.set_sky(test_sky());
    after_each_call("set_sky");
    renderer.set_floor({.columns = 3, .rows = 2, .heights_m = {-4, -3, -2, -4, -2, 1}, .metres_per_texel = 20});
    after_each_call("set_floor");
    gl::CausticsBaker baker(make_serial_executor());
    baker.schedule(frame, {});
    renderer.set_caustics(baker.complete());
    after_each_call("set_caustics");
    renderer.upload(frame);
    after_each_call("upload");
    const Camera camera{.position_m = {0, 10, 0}, .target_m = {60, 0, 40}};
    const gl::Eye eye = gl::eye_of(camera, {0, 0, state_pixels, state_pixels});
    Selection selection(quadtree_preset_named("low")->options(512));
    const DrawList& list =
        selection.select({.viewer_m = camera.position_m, .views = {&eye.clip_from_world, 1}, .bounds = frame.bounds});
    std::optional<gl::Rock> rock;
    std::optional<gl::ApplicationScene> application_scene;
    if (look.has_rock) {
        rock.emplace(gl, glm::dvec3(60, 0, 40));
        after_each_call("rock's constructor");
        rock->set_light(test_sky());
        application_scene = rock->image(eye);
        after_each_call("rock's image");
        rock->draw(eye, 0);
        after_each_call("rock's draw");
    }
    const SprayDroplet droplet{.x_m = 12, .y_m = 8, .z_m = 8, .radius_m = 1, .opacity = 0.5f};
    renderer.draw({.eyes = {&eye, 1},
                   .list = &list,
                   .mode = look.mode,
                   .camera_water_plane = look.camera_water_plane,
                   .application_scene = application_scene,
                   .spray = {.droplets = {&droplet, 1}}});
    after_each_call("draw");
    std::vector<std::uint8_t> pixels(std::size_t{4} * state_pixels * state_pixels);
    read_target(gl, pixels);
    return pixels;
}

class GlState : public testing::TestWithParam<Look> {};

TEST_P(GlState, OfAnApplicationIsRestoredAndHasNoEffect) {
    Ocean ocean({.cascades = 3, .resolution = 32, .wind_speed_mps = 9}, {.executor = make_serial_executor()});
    const Frame& frame = ocean.frame_at(2);

    gl::HeadlessContext clean_context;
    std::vector<std::uint8_t> clean;
    {
        const Target target(clean_context.functions());
        clean = image(clean_context.functions(), frame, GetParam(), [](const char*) {});
    }
    // The image has more than one colour.
    EXPECT_GT(std::set(clean.begin(), clean.end()).size(), 5u);

    gl::HeadlessContext context;
    const gl::Functions& gl = context.functions();
    const Target target(gl);
    const NastyApplication application(gl);
    const auto before = state_of(gl);
    const auto nasty = image(gl, frame, GetParam(), [&](const char* call) {
        const auto after = state_of(gl);
        for (const auto& [name, values] : before) EXPECT_EQ(after.at(name), values) << name << " after " << call;
    });
    EXPECT_EQ(nasty, clean);
    application.set_switches(false);
}

TEST(GlStateOfDisplay, OfAnApplicationIsRestoredAndHasNoEffect) {
    const auto preview_of = [](const gl::Functions& gl, const gl::TexturePart& part, auto check) {
        gl::Display display(gl);
        check("display's constructor");
        gl::LightMeter meter(gl);
        check("meter's constructor");
        std::vector<std::uint8_t> pixels(std::size_t{4} * state_pixels * state_pixels);
        for (const gl::MeteredCell& cell : meter.measure(part))
            pixels.push_back(static_cast<std::uint8_t>(50 + 10 * cell.mean_of_log2));
        check("measure");
        meter.start(part);
        check("start");
        gl.Finish();
        EXPECT_TRUE(meter.finished());
        check("finished");
        display.show(part, {.bloom = 0.1f}, {0, 0, state_pixels, state_pixels});
        check("show");
        read_target(gl, pixels);
        return pixels;
    };
    const auto texture_of = [](const gl::Functions& gl) {
        gl::Texture texture(gl);
        gl.BindTexture(GL_TEXTURE_2D, texture.name());
        gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA16F, 2, 1);
        const float colours[] = {0.1f, 0.2f, 0.3f, 1, 3, 2, 1, 1};
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 2, 1, GL_RGBA, GL_FLOAT, colours);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        return texture;
    };
    gl::HeadlessContext clean_context;
    std::vector<std::uint8_t> clean;
    {
        const gl::Functions& gl = clean_context.functions();
        const gl::Texture texture = texture_of(gl);
        const Target target(gl);
        clean = preview_of(gl, {texture.name(), 2, 1, 2, 1}, [](const char*) {});
    }
    EXPECT_GT(std::set(clean.begin(), clean.end()).size(), 5u);

    gl::HeadlessContext context;
    const gl::Functions& gl = context.functions();
    const gl::Texture texture = texture_of(gl);
    const Target target(gl);
    const NastyApplication application(gl);
    const auto before = state_of(gl);
    const auto nasty = preview_of(gl, {texture.name(), 2, 1, 2, 1}, [&](const char* call) {
        const auto after = state_of(gl);
        for (const auto& [name, values] : before) EXPECT_EQ(after.at(name), values) << name << " after " << call;
    });
    EXPECT_EQ(nasty, clean);
    application.set_switches(false);
}

INSTANTIATE_TEST_SUITE_P(Modes, GlState,
                         testing::Values(Look{"shaded", gl::DrawMode::shaded},
                                         Look{"wireframe", gl::DrawMode::wireframe},
                                         Look{"lens_in_the_water", gl::DrawMode::shaded, gl::CameraWaterPlane{10}},
                                         Look{"mirrored_rock", gl::DrawMode::shaded, {}, true}),
                         [](const auto& look) { return look.param.name; });

}  // namespace
}  // namespace pelagic
