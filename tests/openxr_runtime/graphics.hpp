// The application's OpenGL ES context, used by the runtime.
#pragma once

#include <EGL/egl.h>
#include <GLES3/gl3.h>
#define XR_USE_GRAPHICS_API_OPENGL_ES
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <cstdint>
#include <vector>

namespace pelagic::openxr_stand_in {

class Graphics {
   public:
    /// Returns false if the binding is invalid: no function to load others, or no context that can
    /// be made current.
    bool take(const XrGraphicsBindingEGLMNDX& binding);

    /// Returns true if the application's context can still be made current.
    bool is_there() const;
    /// Creates the textures of a swapchain; arrays if there is more than one layer.
    std::vector<GLuint> make_textures(int count, GLenum format, int width, int height, int layers) const;
    void delete_textures(const std::vector<GLuint>& textures) const;
    /// Returns the application's GL error since the last call, or GL_NO_ERROR.
    GLenum error() const;
    /// Returns RGB of a rectangle of a layer, the upper row first.
    std::vector<std::uint8_t> read(GLuint texture, bool is_array, int layer, const XrRect2Di& part) const;

   private:
    // clang-format off
#define PELAGIC_STAND_IN_GL(X)                                                                                  \
    X(BindBuffer) X(BindFramebuffer) X(BindTexture) X(DeleteFramebuffers) X(DeleteTextures)                     \
    X(FramebufferTexture2D) X(FramebufferTextureLayer) X(GenFramebuffers) X(GenTextures) X(GetError)            \
    X(GetIntegerv) X(PixelStorei) X(ReadPixels) X(TexStorage2D) X(TexStorage3D)
    // clang-format on
#define PELAGIC_STAND_IN_POINTER(name) decltype(&gl##name) name = nullptr;
    PELAGIC_STAND_IN_GL(PELAGIC_STAND_IN_POINTER)
#undef PELAGIC_STAND_IN_POINTER
    friend class BorrowedContext;

    XrGraphicsBindingEGLMNDX binding_{};
    decltype(&eglGetCurrentContext) current_context_ = nullptr;
    decltype(&eglGetCurrentDisplay) current_display_ = nullptr;
    decltype(&eglGetCurrentSurface) current_surface_ = nullptr;
    decltype(&eglMakeCurrent) make_current_ = nullptr;
};

}  // namespace pelagic::openxr_stand_in
