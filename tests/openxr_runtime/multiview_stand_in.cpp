// Emulates OVR_multiview2 for tests, on a driver that lacks it. Preloaded (LD_PRELOAD), it replaces
// each draw and each clear by two: layer 0 with gl_ViewID_OVR 0, then layer 1 with 1, which gives
// the result that the extension defines for one pass. Tests can check that a program attaches,
// clears and shades both views correctly, but not its speed.
#include <EGL/egl.h>
#include <GLES3/gl3.h>
#include <dlfcn.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#define PELAGIC_BEFORE_DRIVER extern "C" __attribute__((visibility("default")))

namespace {

constexpr const char* view_uniform = "view_of_stand_in";
constexpr GLint views = 2;

template <class Function>
Function* drivers(const char* name, Function*) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}
#define PELAGIC_DRIVERS(name) drivers(#name, &name)

struct Attachment {
    GLenum where;
    GLuint texture;
    GLint level, first_layer;
};
/// The attachments of framebuffers with several views, by name.
std::map<GLuint, std::vector<Attachment>>& framebuffers() {
    static std::map<GLuint, std::vector<Attachment>> all;
    return all;
}

GLint asked(GLenum what) {
    GLint value = 0;
    PELAGIC_DRIVERS(glGetIntegerv)(what, &value);
    return value;
}

/// Calls draw() once for each view if the bound framebuffer has several, else once.
template <class Draw>
void for_each_view(const Draw& draw) {
    const auto bound = framebuffers().find(static_cast<GLuint>(asked(GL_DRAW_FRAMEBUFFER_BINDING)));
    if (bound == framebuffers().end()) return draw();
    const auto program = static_cast<GLuint>(asked(GL_CURRENT_PROGRAM));
    const GLint place = program == 0 ? -1 : glGetUniformLocation(program, view_uniform);
    for (GLint view = 0; view < views; ++view) {
        for (const Attachment& a : bound->second)
            glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, a.where, a.texture, a.level, a.first_layer + view);
        if (place >= 0) glUniform1i(place, view);
        draw();
    }
}

void attach(GLenum target, GLenum where, GLuint texture, GLint level, GLint first_layer, GLsizei) {
    const bool is_read = target == GL_READ_FRAMEBUFFER;
    std::vector<Attachment>& all = framebuffers()[static_cast<GLuint>(
        asked(is_read ? GL_READ_FRAMEBUFFER_BINDING : GL_DRAW_FRAMEBUFFER_BINDING))];
    all.push_back({where, texture, level, first_layer});
    glFramebufferTextureLayer(target, where, texture, level, first_layer);
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

}  // namespace

PELAGIC_BEFORE_DRIVER void glClear(GLbitfield mask) {
    for_each_view([&] { PELAGIC_DRIVERS(glClear)(mask); });
}
PELAGIC_BEFORE_DRIVER void glDrawArrays(GLenum mode, GLint first, GLsizei count) {
    for_each_view([&] { PELAGIC_DRIVERS(glDrawArrays)(mode, first, count); });
}
PELAGIC_BEFORE_DRIVER void glDrawArraysInstanced(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
    for_each_view([&] { PELAGIC_DRIVERS(glDrawArraysInstanced)(mode, first, count, instances); });
}
PELAGIC_BEFORE_DRIVER void glDrawElementsInstanced(GLenum mode, GLsizei count, GLenum type, const void* indices,
                                                   GLsizei instances) {
    for_each_view([&] { PELAGIC_DRIVERS(glDrawElementsInstanced)(mode, count, type, indices, instances); });
}

PELAGIC_BEFORE_DRIVER void glShaderSource(GLuint shader, GLsizei count, const GLchar* const* texts,
                                          const GLint* lengths) {
    std::string all;
    for (GLsizei i = 0; i < count; ++i)
        all += lengths && lengths[i] >= 0 ? std::string(texts[i], static_cast<std::size_t>(lengths[i])) : texts[i];
    replace_all(all, "#extension GL_OVR_multiview2 : require",
                std::string("uniform highp int ") + view_uniform + ";");
    replace_all(all, "layout(num_views = 2) in;", "");
    replace_all(all, "gl_ViewID_OVR", view_uniform);
    const GLchar* const text = all.c_str();
    PELAGIC_DRIVERS(glShaderSource)(shader, 1, &text, nullptr);
}

PELAGIC_BEFORE_DRIVER void glGetIntegerv(GLenum what, GLint* value) {
    PELAGIC_DRIVERS(glGetIntegerv)(what, value);
    if (what == GL_NUM_EXTENSIONS) ++*value;
}
PELAGIC_BEFORE_DRIVER const GLubyte* glGetStringi(GLenum what, GLuint index) {
    if (what == GL_EXTENSIONS && static_cast<GLint>(index) == asked(GL_NUM_EXTENSIONS))
        return reinterpret_cast<const GLubyte*>("GL_OVR_multiview2");
    return PELAGIC_DRIVERS(glGetStringi)(what, index);
}

PELAGIC_BEFORE_DRIVER __eglMustCastToProperFunctionPointerType eglGetProcAddress(const char* name) {
    using Any = __eglMustCastToProperFunctionPointerType;
    const std::map<std::string_view, Any> own = {
        {"glClear", reinterpret_cast<Any>(&glClear)},
        {"glDrawArrays", reinterpret_cast<Any>(&glDrawArrays)},
        {"glDrawArraysInstanced", reinterpret_cast<Any>(&glDrawArraysInstanced)},
        {"glDrawElementsInstanced", reinterpret_cast<Any>(&glDrawElementsInstanced)},
        {"glShaderSource", reinterpret_cast<Any>(&glShaderSource)},
        {"glGetIntegerv", reinterpret_cast<Any>(&glGetIntegerv)},
        {"glGetStringi", reinterpret_cast<Any>(&glGetStringi)},
        {"glFramebufferTextureMultiviewOVR", reinterpret_cast<Any>(&attach)},
    };
    const auto found = own.find(name);
    return found != own.end() ? found->second : PELAGIC_DRIVERS(eglGetProcAddress)(name);
}
