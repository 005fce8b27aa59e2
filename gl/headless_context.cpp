#include "pelagic/gl/headless_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <string_view>

#include "pelagic/gl/errors.hpp"

namespace pelagic::gl {

// Functions of libEGL, which is loaded at run time: exports run on a server without libEGL.
struct Egl {
    void* library = nullptr;
    decltype(&eglGetProcAddress) get_proc_address = nullptr;
    decltype(&eglQueryString) query_string = nullptr;
    decltype(&eglGetDisplay) get_display = nullptr;
    decltype(&eglInitialize) initialize = nullptr;
    decltype(&eglTerminate) terminate = nullptr;
    decltype(&eglBindAPI) bind_api = nullptr;
    decltype(&eglChooseConfig) choose_config = nullptr;
    decltype(&eglCreateContext) create_context = nullptr;
    decltype(&eglDestroyContext) destroy_context = nullptr;
    decltype(&eglMakeCurrent) make_current = nullptr;
    decltype(&eglGetError) get_error = nullptr;

    static const Egl& get() {
        static const Egl egl = load();
        return egl;
    }

   private:
    static Egl load() {
        Egl egl;
        egl.library = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
        if (!egl.library) throw GlError("libEGL.so.1 is missing; Debian: apt install libegl1 libgl1-mesa-dri");
        const auto find = [&](const char* name, auto& function) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(::dlsym(egl.library, name));
            if (!function) throw GlError(std::string("libEGL.so.1 has no ") + name + "; Debian: apt install libegl1");
        };
        find("eglGetProcAddress", egl.get_proc_address);
        find("eglQueryString", egl.query_string);
        find("eglGetDisplay", egl.get_display);
        find("eglInitialize", egl.initialize);
        find("eglTerminate", egl.terminate);
        find("eglBindAPI", egl.bind_api);
        find("eglChooseConfig", egl.choose_config);
        find("eglCreateContext", egl.create_context);
        find("eglDestroyContext", egl.destroy_context);
        find("eglMakeCurrent", egl.make_current);
        find("eglGetError", egl.get_error);
        return egl;
    }
};

namespace {

bool lists(const char* extensions, std::string_view name) {
    std::string_view remaining = extensions ? extensions : "";
    while (!remaining.empty()) {
        const std::size_t end = std::min(remaining.find(' '), remaining.size());
        if (remaining.substr(0, end) == name) return true;
        remaining.remove_prefix(std::min(end + 1, remaining.size()));
    }
    return false;
}

[[noreturn]] void fail(const Egl& egl, const std::string& what, const char* remedy) {
    std::array<char, 16> code;
    std::snprintf(code.data(), code.size(), "0x%04x", static_cast<unsigned>(egl.get_error()));
    throw GlError(what + " (EGL error " + code.data() + "); " + remedy);
}

constexpr const char* driver_package = "Debian: apt install libgl1-mesa-dri, Mesa's drivers with a software one";

EGLDisplay open_display(const Egl& egl) {
    const char* client = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    EGLint major = 0, minor = 0;
    if (lists(client, "EGL_MESA_platform_surfaceless") && lists(client, "EGL_EXT_platform_base")) {
        const auto get_platform_display =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.get_proc_address("eglGetPlatformDisplayEXT"));
        EGLDisplay display = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        if (display != EGL_NO_DISPLAY && egl.initialize(display, &major, &minor)) return display;
    }
    EGLDisplay display = egl.get_display(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY || !egl.initialize(display, &major, &minor))
        fail(egl, "EGL finds no driver that draws without a window", driver_package);
    return display;
}

void GL_APIENTRY take_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                              const void* messages) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION_KHR || type == GL_DEBUG_TYPE_PUSH_GROUP_KHR ||
        type == GL_DEBUG_TYPE_POP_GROUP_KHR)
        return;
    auto& list = *static_cast<std::vector<std::string>*>(const_cast<void*>(messages));
    list.emplace_back(text, static_cast<std::size_t>(length));
}

}  // namespace

struct HeadlessContext::State {
    const Egl& egl = Egl::get();
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    Functions functions;
    std::vector<std::string> messages;

    // The display is not terminated, because the process shares one display and other code may use
    // it.
    ~State() {
        if (context == EGL_NO_CONTEXT) return;
        egl.make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        egl.destroy_context(display, context);
    }
};

HeadlessContext::HeadlessContext(HeadlessOptions options) : state_(new State) {
    const Egl& egl = state_->egl;
    state_->display = open_display(egl);
    const char* extensions = egl.query_string(state_->display, EGL_EXTENSIONS);
    if (!lists(extensions, "EGL_KHR_surfaceless_context"))
        throw GlError(std::string("the EGL driver can't draw without a surface; ") + driver_package);
    egl.bind_api(EGL_OPENGL_ES_API);

    const EGLint config_attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    if (!egl.choose_config(state_->display, config_attributes, &config, 1, &configs) || configs == 0)
        fail(egl, "the EGL driver has no OpenGL ES 3", driver_package);

    std::vector<EGLint> attributes = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0};
    if (options.debug) attributes.insert(attributes.end(), {EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR});
    // Requests reset notification, so that check_context() can detect a reset.
    if (lists(extensions, "EGL_EXT_create_context_robustness"))
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT, EGL_LOSE_CONTEXT_ON_RESET_EXT});
    attributes.push_back(EGL_NONE);
    state_->context = egl.create_context(state_->display, config, EGL_NO_CONTEXT, attributes.data());
    if (state_->context == EGL_NO_CONTEXT) fail(egl, "the EGL driver makes no OpenGL ES 3.0 context", driver_package);
    make_current();

    const auto get = [](const char* name) { return reinterpret_cast<void*>(Egl::get().get_proc_address(name)); };
    state_->functions = load_functions(get);
    if (options.debug && has_debug()) {
        const Functions& gl = state_->functions;
        gl.Enable(GL_DEBUG_OUTPUT_KHR);
        gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS_KHR);
        gl.DebugMessageCallbackKHR(take_message, &state_->messages);
    }
}

HeadlessContext::~HeadlessContext() = default;

void HeadlessContext::make_current() {
    if (!state_->egl.make_current(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context))
        fail(state_->egl, "the EGL context can't be made current", "another thread may be using it");
}
const Functions& HeadlessContext::functions() const { return state_->functions; }
std::string HeadlessContext::renderer_name() const {
    return reinterpret_cast<const char*>(state_->functions.GetString(GL_RENDERER));
}
const std::vector<std::string>& HeadlessContext::messages() const { return state_->messages; }
bool HeadlessContext::has_debug() const { return state_->functions.DebugMessageCallbackKHR != nullptr; }

}  // namespace pelagic::gl
