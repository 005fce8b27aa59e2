// The module `pelagic_view` for JavaScript: SeaView, on one thread, with WebGL 2.
//
//   const module = await createPelagicView({canvas});  // an element, OffscreenCanvas or selector
//   const view = new module.SeaView({windSpeedMps: 9, quality: 'medium'});
//   view.setLight({preset: 'noon'});
//   each frame:
//     view.simulate(seconds);
//     view.draw({eyes: [{viewport: [0, 0, width, height], view, projection}]});
//   between frames, until it returns true:
//     view.continueBaking(10);
//
// Options of SeaView are those of a sea (sim/sea_state.hpp) in camelCase, with `preset`, `waves`,
// `spectrum` and `spreading` by name, and of the image: `quality` ('low', 'medium', 'high' or
// 'ultra'), `sizeM`, `shading` ('headset', 'medium' or 'high'), `skyFaceSize`, `foam`; and a `hull`.
// A hull has `vertices` (x, y, z, ...) and `triangles` (three indices each) of a closed mesh, `massKg`,
// `centreOfMassM` [x, y, z] and other numbers of floating/hull.hpp in camelCase, and its anchor: `xM`,
// `zM`, `headingRad` and `mooringPeriodS`, the period of its motion at anchor, 0 for a hull that drifts.
//
//   setSea(options)        replaces the sea; absent options are those of the preset or the defaults
//   setHull(hull)          lets a hull float by forces from the next simulate() on; null removes it
//   hullMatrix()           returns the column-major matrix from the hull's mesh to the world: 16
//                          numbers, or null. Frames at most 1 s apart move the hull; otherwise, and at
//                          first, it is put on the frame's surface
//   setDetail(options)     sets `quality` and `shading`, without compiling shaders again
//   setLight(options)      sets the light: `preset` (noon, golden-hour, overcast, storm,
//                          moonlight), options of gl/sky/sky.hpp in camelCase, and `stops`, above
//                          the exposure of the sky. Until the first sky is baked, a clear sky is
//                          drawn
//   continueBaking(ms)     bakes the sky for about that time; returns whether it is complete
//   hasSky()               returns whether the sky of the last setLight() is drawn
//   simulate(timeS)        computes the frame of a time and uploads it
//   hash()                 returns the frame's hash: 16 hexadecimal digits, as `pelagic export` has
//                          it
//   simulateMs(), drawMs() return milliseconds of script in the last calls, without upload and GPU
//   seaInfo()              returns {significantHeightM, cascades, resolution, memoryBytes,
//                          triangles, allocatedBytes}: memory of the ocean, and of the whole module
//   draw(request)          clears a framebuffer and draws into it: {framebuffer, eyes, origin,
//                          exposure}. `framebuffer` is a WebGLFramebuffer of the page or of an
//                          XRWebGLLayer; null or undefined is the canvas. One or two eyes; `view`
//                          and `projection` are column-major, as in WebXR and OpenGL; the far plane
//                          is replaced by infinity. `origin` [x, y, z] is the position of the
//                          views' origin in the world, metres
//   lightInfo()            returns the drawn sky's light for other objects: {direction,
//                          sunIrradiance, skyIrradiance} of three numbers, towards sun or moon, in
//                          the sky's unit, and `exposure`, the factor of radiance
//   heights(xz)            samples the last frame at a Float64Array of x, z, x, z, ...; returns
//                          {heights, normals}, Float32Arrays of 1 and 3 numbers per point
//   glError()              returns the first GL error since the last call, 0 for none
//   delete()               frees all memory; context and canvas remain those of the page
//   context                the WebGL2RenderingContext
//
// Each call restores the GL state, except that it unbinds objects that the page had bound.
#include <emscripten/bind.h>
#include <emscripten/html5.h>
#include <emscripten/val.h>
#include <malloc.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/gl/errors.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/web/bindings/errors.hpp"
#include "pelagic/web/bindings/hull_options.hpp"
#include "pelagic/web/bindings/light_options.hpp"
#include "pelagic/web/bindings/named_options.hpp"
#include "pelagic/web/bindings/sea_view.hpp"

using emscripten::val;

// clang-format off
// Returns Emscripten's handle of the context; 0: no WebGL 2, -1: no such canvas.
EM_JS(int, pelagic_make_context, (), {
    let canvas = Module['canvas'];
    if (typeof canvas === 'string') canvas = document.querySelector(canvas);
    if (!canvas || !canvas.getContext) return -1;
    const attributes =
        {alpha: false, antialias: true, depth: true, powerPreference: 'high-performance', xrCompatible: true};
    const context = canvas.getContext('webgl2', attributes);
    if (!context) return 0;
    return GL.registerContext(context, {majorVersion: 2, minorVersion: 0, enableExtensionsByDefault: true});
});
EM_JS(emscripten::EM_VAL, pelagic_context, (), {
    return Emval.toHandle(GLctx);
});
// Returns the name for GL functions of a framebuffer that the page or the headset made.
EM_JS(int, pelagic_framebuffer_name, (emscripten::EM_VAL handle), {
    const framebuffer = Emval.toValue(handle);
    if (!framebuffer) return 0;
    if (GL.framebuffers[framebuffer.name] !== framebuffer) {
        framebuffer.name = GL.getNewId(GL.framebuffers);
        GL.framebuffers[framebuffer.name] = framebuffer;
    }
    return framebuffer.name;
});
// clang-format on

namespace pelagic::web {
namespace {

glm::dmat4 matrix_of(const char* name, const val& numbers) {
    if (numbers.isUndefined() || numbers.isNull() || numbers["length"].as<int>() != 16)
        throw std::invalid_argument(std::string("an eye's ") + name + " needs 16 numbers");
    const std::vector<double> values = emscripten::convertJSArrayToNumberVector<double>(numbers);
    return glm::make_mat4(values.data());
}

/// Moves the far plane to infinity, because the sea extends to the horizon.
glm::dmat4 without_far_plane(glm::dmat4 projection) {
    if (projection[2][3] != -1) return projection;  // parallel rays
    const double near = projection[3][2] / (projection[2][2] - 1);
    projection[2][2] = -1;
    projection[3][2] = -2 * near;
    return projection;
}

gl::Eye eye_of(const val& eye, glm::dvec3 origin) {
    const glm::dmat4 world_from_eye = glm::inverse(matrix_of("view", eye["view"]));
    gl::Eye seen;
    seen.position_m = glm::dvec3(world_from_eye[3]) + origin;
    glm::dmat4 placed = world_from_eye;
    placed[3] = glm::dvec4(seen.position_m, 1);
    seen.clip_from_world = without_far_plane(matrix_of("projection", eye["projection"])) * glm::inverse(placed);
    const val viewport = eye["viewport"];
    seen.viewport = {viewport[0].as<int>(), viewport[1].as<int>(), viewport[2].as<int>(), viewport[3].as<int>()};
    return seen;
}

bool is_given(const val& options, const char* name) { return !options[name].isUndefined(); }

/// Options of SeaView that are not a sea's.
constexpr std::array<std::string_view, 6> view_names = {"quality", "sizeM", "shading", "skyFaceSize", "foam", "hull"};

std::string quality_of(const val& name) {
    std::vector<std::string> names;
    for (const QuadtreePreset& preset : quadtree_presets()) names.emplace_back(preset.name);
    return word_of("quality", name, names);
}

gl::Shading shading_of(const val& name) {
    const auto& names = names_of<gl::Shading>();
    return *value_named<gl::Shading>(word_of("shading", name, {names.begin(), names.end()}));
}

ViewOptions view_options_of(const val& options) {
    ViewOptions view;
    if (options.isUndefined()) return view;
    if (is_given(options, "quality")) view.quality = quality_of(options["quality"]);
    if (is_given(options, "shading")) view.shading = shading_of(options["shading"]);
    if (is_given(options, "sizeM"))
        view.size_m = number_of(
            "sizeM", options["sizeM"], [](double side) { return side >= 256 && side <= 8192; }, "[256, 8192]");
    if (is_given(options, "skyFaceSize"))
        view.sky_face_size = static_cast<int>(number_of(
            "skyFaceSize", options["skyFaceSize"],
            [](double side) { return side >= 16 && side <= 2048 && std::exp2(std::round(std::log2(side))) == side; },
            "a power of two from 16 to 2048"));
    if (is_given(options, "foam")) view.foam = flag_of("foam", options["foam"]);
    if (is_given(options, "hull")) view.hull = hull_with(options["hull"]);
    return view;
}

/// The WebGL context of a canvas.
class CanvasContext {
   public:
    CanvasContext() : context_(pelagic_make_context()) {
        if (context_ < 0)
            throw gl::GlError(
                "there is no canvas to draw into: createPelagicView({canvas}) takes an element or a selector");
        if (context_ == 0) throw gl::GlError("the browser gives the canvas no WebGL 2");
        make_current();
        functions_ = gl::load_functions([](const char* name) { return emscripten_webgl_get_proc_address(name); });
    }
    void make_current() const {
        emscripten_webgl_make_context_current(context_);
        if (emscripten_is_webgl_context_lost(context_))
            throw gl::ContextLost(
                "the browser took the canvas's WebGL context away; delete this SeaView and make another one");
    }
    const gl::Functions& functions() const { return functions_; }

   private:
    EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context_;
    gl::Functions functions_;
};

/// The class SeaView of JavaScript.
class BoundView {
   public:
    explicit BoundView(const val& options) {
        const SeaState sea = sea_with({}, options, view_names);
        view_.emplace(context_.functions(), sea, view_options_of(options));
    }

    void set_sea(const val& options) {
        context_.make_current();
        view_->set_sea(sea_with({}, options));
    }
    void set_hull(const val& hull) {
        context_.make_current();
        view_->set_hull(hull_with(hull));
    }
    val hull_matrix() {
        if (!view_->hull() || !view_->frame()) return val::null();
        const glm::dmat4 matrix = view_->hull()->world_from_mesh();
        return val::global("Float64Array").new_(emscripten::typed_memory_view(16, glm::value_ptr(matrix)));  // copies
    }
    void set_detail(const val& options) {
        view_->set_detail(quality_of(options["quality"]), shading_of(options["shading"]));
    }
    void set_light(const val& options) {
        context_.make_current();
        const Light light = light_with(options);
        view_->set_light(light.sky, light.stops);
    }
    bool continue_baking(double budget_ms) {
        context_.make_current();
        return view_->continue_baking(budget_ms);
    }
    bool has_sky() { return view_->has_sky(); }
    void simulate(double time_s) {
        if (!std::isfinite(time_s))
            throw std::invalid_argument(invalid_value_message("timeS", time_s, "a finite number"));
        context_.make_current();
        view_->simulate(time_s);
    }
    double simulate_ms() { return view_->simulate_ms(); }
    double draw_ms() { return view_->statistics().draw_ms; }
    std::string hash() {
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_of(frame())));
        return text;
    }
    val sea_info() {
        val info = val::object();
        info.set("significantHeightM", frame().statistics.significant_wave_height_m);
        info.set("cascades", static_cast<int>(view_->ocean().cascade_count()));
        info.set("resolution", view_->ocean().resolution());
        info.set("memoryBytes", static_cast<double>(view_->ocean().memory_bytes()));
        info.set("triangles", static_cast<double>(view_->statistics().triangles));
        info.set("allocatedBytes", static_cast<double>(mallinfo().uordblks));
        return info;
    }
    void draw(const val& request) {
        frame();
        context_.make_current();
        const val eyes = request["eyes"];
        const int count = eyes.isUndefined() ? 0 : eyes["length"].as<int>();
        if (count < 1 || count > 2) throw std::invalid_argument(invalid_value_message("eyes", count, "one or two"));
        const glm::dvec3 origin = request["origin"].isUndefined() ? glm::dvec3(0) : vector_of(request["origin"]);
        std::vector<gl::Eye> seen;
        for (int i = 0; i < count; ++i) seen.push_back(eye_of(eyes[i], origin));
        std::optional<float> exposure;
        if (!request["exposure"].isUndefined())
            exposure = static_cast<float>(number_of(
                "exposure", request["exposure"], [](double factor) { return factor > 0 && factor < 1e30; },
                "(0, 1e30)"));
        context_.functions().BindFramebuffer(
            GL_FRAMEBUFFER, static_cast<GLuint>(pelagic_framebuffer_name(request["framebuffer"].as_handle())));
        view_->draw(seen, exposure);
    }
    val light_info() {
        const auto array_of = [](glm::vec3 v) {
            val array = val::array();
            for (int i = 0; i < 3; ++i) array.call<void>("push", v[i]);
            return array;
        };
        const gl::SkyLight& light = view_->light();
        val info = val::object();
        info.set("direction", array_of(light.sun_direction));
        info.set("sunIrradiance", array_of(view_->sunlit() * light.sun_irradiance));
        info.set("skyIrradiance", array_of(light.sky_irradiance));
        info.set("exposure", view_->exposure());
        return info;
    }
    val heights(const val& xz) {
        const std::vector<double> places = emscripten::convertJSArrayToNumberVector<double>(xz);
        const std::size_t count = places.size() / 2;
        std::vector<double> x(count), z(count);
        for (std::size_t i = 0; i < count; ++i) x[i] = places[2 * i], z[i] = places[2 * i + 1];
        std::vector<float> height(count), normal_x(count), normal_y(count), normal_z(count), normals(3 * count);
        SurfaceQuery(frame()).sample(
            {x, z}, {.height_m = height, .normal_x = normal_x, .normal_y = normal_y, .normal_z = normal_z});
        for (std::size_t i = 0; i < count; ++i) {
            normals[3 * i] = normal_x[i];
            normals[3 * i + 1] = normal_y[i];
            normals[3 * i + 2] = normal_z[i];
        }
        const val array = val::global("Float32Array");
        val answer = val::object();  // copies, because growing memory empties views
        answer.set("heights", array.new_(val(emscripten::typed_memory_view(height.size(), height.data()))));
        answer.set("normals", array.new_(val(emscripten::typed_memory_view(normals.size(), normals.data()))));
        return answer;
    }
    unsigned gl_error() {
        context_.make_current();
        return context_.functions().GetError();
    }
    val context() const {
        context_.make_current();
        return val::take_ownership(pelagic_context());
    }

   private:
    const Frame& frame() const {
        if (!view_->frame()) throw std::logic_error("there is no frame of this sea yet: simulate() first");
        return *view_->frame();
    }

    CanvasContext context_;
    std::optional<SeaView> view_;
};

BoundView* make_view(val options) {
    return or_throw_error([&] { return new BoundView(options); });
}

val context_of(const BoundView& view) {
    return or_throw_error([&] { return view.context(); });
}

/// Makes a free function of a member, which throws JavaScript errors.
template <auto member>
struct Bound;
template <class Result, class... Arguments, Result (BoundView::*member)(Arguments...)>
struct Bound<member> {
    static Result call(BoundView& view, std::decay_t<Arguments>... arguments) {
        return or_throw_error([&] { return (view.*member)(arguments...); });
    }
};

}  // namespace

EMSCRIPTEN_BINDINGS(pelagic_view) {
    emscripten::class_<BoundView>("SeaView")
        .constructor(&make_view, emscripten::allow_raw_pointers())
        .function("setSea", &Bound<&BoundView::set_sea>::call)
        .function("setHull", &Bound<&BoundView::set_hull>::call)
        .function("hullMatrix", &Bound<&BoundView::hull_matrix>::call)
        .function("setDetail", &Bound<&BoundView::set_detail>::call)
        .function("setLight", &Bound<&BoundView::set_light>::call)
        .function("continueBaking", &Bound<&BoundView::continue_baking>::call)
        .function("hasSky", &Bound<&BoundView::has_sky>::call)
        .function("simulate", &Bound<&BoundView::simulate>::call)
        .function("simulateMs", &Bound<&BoundView::simulate_ms>::call)
        .function("drawMs", &Bound<&BoundView::draw_ms>::call)
        .function("hash", &Bound<&BoundView::hash>::call)
        .function("seaInfo", &Bound<&BoundView::sea_info>::call)
        .function("draw", &Bound<&BoundView::draw>::call)
        .function("lightInfo", &Bound<&BoundView::light_info>::call)
        .function("heights", &Bound<&BoundView::heights>::call)
        .function("glError", &Bound<&BoundView::gl_error>::call)
        .property("context", &context_of);
}

}  // namespace pelagic::web
