#include "pelagic/gl/functions.hpp"

#include <string>

#include "pelagic/gl/errors.hpp"

namespace pelagic::gl {
namespace {

template <class Function>
void load(GetProcAddress get, const char* name, Function& function) {
    function = reinterpret_cast<Function>(get(name));
}

}  // namespace

Functions load_functions(GetProcAddress get) {
    Functions gl;
#define PELAGIC_GL_LOAD(name)       \
    load(get, "gl" #name, gl.name); \
    if (!gl.name)                   \
        throw GlError("the OpenGL ES driver has no gl" #name ", expected OpenGL ES 3.0; Debian: libgl1-mesa-dri");
    PELAGIC_GL_FUNCTIONS(PELAGIC_GL_LOAD)
#undef PELAGIC_GL_LOAD

    const auto* version = reinterpret_cast<const char*>(gl.GetString(GL_VERSION));
    if (!version) throw GlError("no OpenGL ES context is current on this thread, expected one");
    const std::string text = version;
    if (!text.starts_with("OpenGL ES ") || text.size() < 11 || text[10] < '3')
        throw GlError("the context is \"" + text + "\", expected OpenGL ES 3.0 or later");

    if (has_extension(gl, "GL_KHR_debug")) load(get, "glDebugMessageCallbackKHR", gl.DebugMessageCallbackKHR);
    if (has_extension(gl, "GL_KHR_robustness"))
        load(get, "glGetGraphicsResetStatusKHR", gl.GetGraphicsResetStatus);
    else if (has_extension(gl, "GL_EXT_robustness"))
        load(get, "glGetGraphicsResetStatusEXT", gl.GetGraphicsResetStatus);
    if (has_extension(gl, "GL_OVR_multiview2"))
        load(get, "glFramebufferTextureMultiviewOVR", gl.FramebufferTextureMultiviewOVR);
    // Emscripten's version text is "OpenGL ES 3.0 (WebGL 2.0 (...))".
    const bool is_webgl = text.find("WebGL") != std::string::npos;
    if (!is_webgl) {
        load(get, "glMapBufferRange", gl.MapBufferRange);
        load(get, "glUnmapBuffer", gl.UnmapBuffer);
    }
    gl.maps_buffers = gl.MapBufferRange && gl.UnmapBuffer;
    gl.can_disable_primitive_restart = !is_webgl;
    // ES 3.2 needs no extension for this feature, but its drivers list the extension nevertheless.
    gl.renders_to_floats = has_extension(gl, "GL_EXT_color_buffer_float");
    gl.renders_to_half_floats = gl.renders_to_floats || has_extension(gl, "GL_EXT_color_buffer_half_float");
    return gl;
}

bool has_extension(const Functions& gl, std::string_view name) {
    GLint count = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (name == reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)))) return true;
    return false;
}

void check_context(const Functions& gl) {
    if (gl.GetGraphicsResetStatus && gl.GetGraphicsResetStatus() != GL_NO_ERROR)
        throw ContextLost("the graphics driver reset its context; build a new one and the renderer in it");
}

}  // namespace pelagic::gl
