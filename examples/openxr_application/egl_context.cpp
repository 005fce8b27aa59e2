#include "egl_context.hpp"

#include <EGL/eglext.h>

namespace openxr_application {
namespace {

[[noreturn]] void fail(const char* what) {
    throw std::runtime_error(std::string(what) + "; Debian: apt install libegl1 libgl1-mesa-dri");
}

EGLDisplay find_display() {
#ifndef XR_USE_PLATFORM_ANDROID
    const auto get_platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_platform_display) return get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
#endif
    return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

}  // namespace

EglContext::EglContext() {
    const EGLDisplay display = find_display();
    if (!eglInitialize(display, nullptr, nullptr)) fail("no EGL display");
    eglBindAPI(EGL_OPENGL_ES_API);
    const EGLint wishes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, wishes, &config, 1, &count) || count == 0) fail("no OpenGL ES 3");
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) fail("no OpenGL ES context");

    binding_.display = display;
    binding_.config = config;
    binding_.context = context;
#ifdef XR_USE_PLATFORM_ANDROID
    binding_.type = XR_TYPE_GRAPHICS_BINDING_OPENGL_ES_ANDROID_KHR;
#else
    binding_.type = XR_TYPE_GRAPHICS_BINDING_EGL_MNDX;
    binding_.getProcAddress = eglGetProcAddress;
#endif
}

EglContext::~EglContext() {
    eglMakeCurrent(binding_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(binding_.display, binding_.context);
    eglTerminate(binding_.display);
}

}  // namespace openxr_application
