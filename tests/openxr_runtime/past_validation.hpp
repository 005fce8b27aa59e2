// Makes OpenGL ES work with Debian's validation layer, which was built without EGL and OpenGL ES
// and rejects XrGraphicsBindingEGLMNDX and XrSwapchainImageOpenGLESKHR as unknown structures.
// gles_past_validation.cpp, preloaded into the application, wraps the binding in one for GLX, which
// the layer knows, and labels the images as OpenGL images, which have the same structure. The
// stand-in runtime understands both. Everything else reaches the layer unchanged.
#pragma once

#include <openxr/openxr.h>

#include <cstdint>

namespace pelagic::openxr_stand_in {

/// XrGraphicsBindingOpenGLXlibKHR without the headers of X and GLX.
struct WrappedBinding {
    XrStructureType type = XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR;
    const void* next = nullptr;
    const void* binding = nullptr;  ///< the XrGraphicsBindingEGLMNDX, instead of the Display
    std::uint32_t visual = 0;
    void* framebuffer_config = nullptr;
    unsigned long drawable = 0;
    void* context = nullptr;
};
constexpr XrStructureType image_for_layer = XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR;
/// The layer requires this extension for these two structures.
constexpr const char* extension_for_layer = "XR_KHR_opengl_enable";

}  // namespace pelagic::openxr_stand_in
