// How OpenGL ES passes Debian's validation layer. That was built without EGL and OpenGL ES, and refuses XrGraphicsBindingEGLMNDX
// and XrSwapchainImageOpenGLESKHR as structures that no call takes. gles_past_validation.cpp, preloaded into the application,
// puts the binding into one of GLX, which the layer knows, and calls the images OpenGL's, whose structure is the same; the
// stand-in understands both. Everything else reaches the layer as it is.
#pragma once

#include <openxr/openxr.h>

#include <cstdint>

namespace pelagic::openxr_stand_in {

/// XrGraphicsBindingOpenGLXlibKHR without its headers of X and GLX.
struct WrappedBinding {
    XrStructureType type = XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR;
    const void* next = nullptr;
    const void* binding = nullptr;  ///< the XrGraphicsBindingEGLMNDX, in the place of the Display
    std::uint32_t visual = 0;
    void* framebuffer_config = nullptr;
    unsigned long drawable = 0;
    void* context = nullptr;
};
constexpr XrStructureType image_for_layer = XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR;
/// The layer wants it to be enabled for those two.
constexpr const char* extension_for_layer = "XR_KHR_opengl_enable";

}  // namespace pelagic::openxr_stand_in
