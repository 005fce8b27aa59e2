// Swapchains: three textures in turn; images are acquired, waited for and released in this order.
#include <algorithm>

#include "pelagic/tests/openxr_runtime/past_validation.hpp"
#include "pelagic/tests/openxr_runtime/runtime.hpp"

namespace pelagic::openxr_stand_in {
namespace {

constexpr int images = 3;
constexpr std::int64_t formats[] = {GL_SRGB8_ALPHA8, GL_RGBA8};

}  // namespace

Swapchain* find(XrSwapchain handle) {
    if (!the_instance() || !the_instance()->session) return nullptr;
    for (const auto& swapchain : the_instance()->session->swapchains)
        if (reinterpret_cast<Swapchain*>(handle) == swapchain.get()) return swapchain.get();
    return nullptr;
}

XrResult EnumerateSwapchainFormats(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                   std::int64_t* to) {
    constexpr const char* call = "xrEnumerateSwapchainFormats";
    const std::lock_guard lock(mutex());
    if (!find(session)) return reject(call, XR_ERROR_HANDLE_INVALID);
    return hand_out<std::int64_t>(call, formats, capacity, count, to);
}

XrResult CreateSwapchain(XrSession handle, const XrSwapchainCreateInfo* info, XrSwapchain* swapchain) {
    constexpr const char* call = "xrCreateSwapchain";
    const std::lock_guard lock(mutex());
    if (const XrResult wanted = wanted_message(call); wanted != XR_SUCCESS) return reject(call, wanted);
    Session* session = find(handle);
    if (!session) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(info, XR_TYPE_SWAPCHAIN_CREATE_INFO) || !swapchain) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (std::ranges::find(formats, info->format) == std::end(formats))
        return reject(call, XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
    if (info->createFlags != 0 || info->sampleCount != 1 || info->faceCount != 1 || info->mipCount != 1 ||
        info->arraySize > 2)
        return reject(call, XR_ERROR_FEATURE_UNSUPPORTED);
    if (info->width == 0 || info->height == 0 || info->width > largest_side || info->height > largest_side ||
        info->arraySize == 0)
        return reject(call, XR_ERROR_VALIDATION_FAILURE);
    auto made = std::make_unique<Swapchain>();
    made->width = static_cast<int>(info->width);
    made->height = static_cast<int>(info->height);
    made->layers = static_cast<int>(info->arraySize);
    made->textures = session->graphics.make_textures(images, static_cast<GLenum>(info->format), made->width,
                                                     made->height, made->layers);
    *swapchain = reinterpret_cast<XrSwapchain>(made.get());
    session->swapchains.push_back(std::move(made));
    return XR_SUCCESS;
}

XrResult DestroySwapchain(XrSwapchain handle) {
    const std::lock_guard lock(mutex());
    const Swapchain* swapchain = find(handle);
    if (!swapchain) return reject("xrDestroySwapchain", XR_ERROR_HANDLE_INVALID);
    Session& session = *the_instance()->session;
    session.graphics.delete_textures(swapchain->textures);
    std::erase_if(session.swapchains, [&](const auto& owned) { return owned.get() == swapchain; });
    return XR_SUCCESS;
}

XrResult EnumerateSwapchainImages(XrSwapchain handle, std::uint32_t capacity, std::uint32_t* count,
                                  XrSwapchainImageBaseHeader* to) {
    constexpr const char* call = "xrEnumerateSwapchainImages";
    const std::lock_guard lock(mutex());
    const Swapchain* swapchain = find(handle);
    if (!swapchain) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (capacity > 0 && !is(to, XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_ES_KHR) && !is(to, image_for_layer))
        return reject(call, XR_ERROR_VALIDATION_FAILURE);
    const XrStructureType type = capacity > 0 ? to->type : XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_ES_KHR;
    std::vector<XrSwapchainImageOpenGLESKHR> list;
    for (const GLuint texture : swapchain->textures) list.push_back({type, nullptr, texture});
    return hand_out<XrSwapchainImageOpenGLESKHR>(call, list, capacity, count,
                                                 reinterpret_cast<XrSwapchainImageOpenGLESKHR*>(to));
}

XrResult AcquireSwapchainImage(XrSwapchain handle, const XrSwapchainImageAcquireInfo*, std::uint32_t* index) {
    constexpr const char* call = "xrAcquireSwapchainImage";
    const std::lock_guard lock(mutex());
    Swapchain* swapchain = find(handle);
    if (!swapchain) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!index) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (swapchain->acquired.size() == images) return reject(call, XR_ERROR_CALL_ORDER_INVALID);
    *index = swapchain->next;
    swapchain->acquired.push_back(*index);
    swapchain->next = (swapchain->next + 1) % images;
    return XR_SUCCESS;
}

XrResult WaitSwapchainImage(XrSwapchain handle, const XrSwapchainImageWaitInfo* info) {
    constexpr const char* call = "xrWaitSwapchainImage";
    const std::lock_guard lock(mutex());
    Swapchain* swapchain = find(handle);
    if (!swapchain) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(info, XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO)) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (swapchain->acquired.empty() || swapchain->first_is_waited_for)
        return reject(call, XR_ERROR_CALL_ORDER_INVALID);
    swapchain->first_is_waited_for = true;
    return XR_SUCCESS;
}

XrResult ReleaseSwapchainImage(XrSwapchain handle, const XrSwapchainImageReleaseInfo*) {
    constexpr const char* call = "xrReleaseSwapchainImage";
    const std::lock_guard lock(mutex());
    Swapchain* swapchain = find(handle);
    if (!swapchain) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!swapchain->first_is_waited_for) return reject(call, XR_ERROR_CALL_ORDER_INVALID);
    swapchain->last_released = static_cast<int>(swapchain->acquired.front());
    swapchain->acquired.pop_front();
    swapchain->first_is_waited_for = false;
    return XR_SUCCESS;
}

}  // namespace pelagic::openxr_stand_in
