// Preloaded (LD_PRELOAD), this library intercepts three calls before the loader: see
// past_validation.hpp.
#include "pelagic/tests/openxr_runtime/past_validation.hpp"

#include <EGL/egl.h>
#include <GLES3/gl3.h>
#include <dlfcn.h>
#define XR_USE_GRAPHICS_API_OPENGL_ES
#include <openxr/openxr_platform.h>

#include <vector>

#define PELAGIC_BEFORE_LOADER extern "C" __attribute__((visibility("default"))) XrResult

namespace {

template <class Function>
Function* loaders(const char* name, Function*) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

PELAGIC_BEFORE_LOADER xrCreateInstance(const XrInstanceCreateInfo* info, XrInstance* instance) {
    std::vector<const char*> extensions(info->enabledExtensionNames,
                                        info->enabledExtensionNames + info->enabledExtensionCount);
    extensions.push_back(pelagic::openxr_stand_in::extension_for_layer);
    XrInstanceCreateInfo with_one_more = *info;
    with_one_more.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    with_one_more.enabledExtensionNames = extensions.data();
    return loaders("xrCreateInstance", &xrCreateInstance)(&with_one_more, instance);
}

PELAGIC_BEFORE_LOADER xrCreateSession(XrInstance instance, const XrSessionCreateInfo* info, XrSession* session) {
    pelagic::openxr_stand_in::WrappedBinding wrapped;
    wrapped.binding = info->next;
    XrSessionCreateInfo hidden = *info;
    hidden.next = &wrapped;
    return loaders("xrCreateSession", &xrCreateSession)(instance, &hidden, session);
}

PELAGIC_BEFORE_LOADER xrEnumerateSwapchainImages(XrSwapchain swapchain, std::uint32_t capacity, std::uint32_t* count,
                                                 XrSwapchainImageBaseHeader* images) {
    auto* const es_images = reinterpret_cast<XrSwapchainImageOpenGLESKHR*>(images);
    const auto rename = [&](XrStructureType from, XrStructureType to) {
        for (std::uint32_t i = 0; i < capacity; ++i)
            if (es_images[i].type == from) es_images[i].type = to;
    };
    rename(XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_ES_KHR, pelagic::openxr_stand_in::image_for_layer);
    const XrResult result =
        loaders("xrEnumerateSwapchainImages", &xrEnumerateSwapchainImages)(swapchain, capacity, count, images);
    rename(pelagic::openxr_stand_in::image_for_layer, XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_ES_KHR);
    return result;
}
