// The frame loop: the display time of a frame, the order of its calls, and its submitted layers.
#include <chrono>
#include <cmath>
#include <condition_variable>

#include "pelagic/tests/openxr_runtime/runtime.hpp"

namespace pelagic::openxr_stand_in {
namespace {

std::condition_variable& frame_was_begun() {
    static std::condition_variable one;
    return one;
}

bool is_seen(const Session& session) {
    return session.state == XR_SESSION_STATE_VISIBLE || session.state == XR_SESSION_STATE_FOCUSED;
}

/// Returns XR_SUCCESS for a layer that can be shown. \param swapchains set to the swapchains of its
/// images
XrResult check_layer(const XrCompositionLayerBaseHeader* header, std::array<const Swapchain*, views>& swapchains) {
    const auto* layer = reinterpret_cast<const XrCompositionLayerProjection*>(header);
    if (!is(layer, XR_TYPE_COMPOSITION_LAYER_PROJECTION)) return XR_ERROR_LAYER_INVALID;
    if (layer->viewCount != views || !layer->views) return XR_ERROR_VALIDATION_FAILURE;
    if (!find(layer->space)) return XR_ERROR_HANDLE_INVALID;
    for (std::size_t eye = 0; eye < views; ++eye) {
        const XrCompositionLayerProjectionView& view = layer->views[eye];
        const XrQuaternionf& q = view.pose.orientation;
        if (!is(&view, XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW)) return XR_ERROR_VALIDATION_FAILURE;
        if (std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) > 0.01f) return XR_ERROR_POSE_INVALID;
        const Swapchain* swapchain = find(view.subImage.swapchain);
        if (!swapchain) return XR_ERROR_HANDLE_INVALID;
        if (swapchain->last_released < 0) return XR_ERROR_LAYER_INVALID;
        if (static_cast<int>(view.subImage.imageArrayIndex) >= swapchain->layers) return XR_ERROR_VALIDATION_FAILURE;
        const XrRect2Di& part = view.subImage.imageRect;
        if (part.offset.x < 0 || part.offset.y < 0 || part.extent.width <= 0 || part.extent.height <= 0 ||
            part.offset.x + part.extent.width > swapchain->width ||
            part.offset.y + part.extent.height > swapchain->height)
            return XR_ERROR_SWAPCHAIN_RECT_INVALID;
        swapchains[eye] = swapchain;
    }
    return XR_SUCCESS;
}

/// Copies the images at this moment, as a compositor would.
void record_layer(const Session& session, const XrCompositionLayerProjection& layer,
                  const std::array<const Swapchain*, views>& swapchains, XrTime display_time) {
    Record& record = the_instance()->record;
    const Space& space = *find(layer.space);
    const Pose head = head_at(display_time);
    record.last_display_time_ns = display_time;
    for (std::size_t eye = 0; eye < views; ++eye) {
        const XrCompositionLayerProjectionView& view = layer.views[eye];
        const EyeOfHead& of_head = eyes_of_head()[eye];
        const Pose in_local = (space.moves_with_head ? head * space.pose : space.pose) * pose_of(view.pose);
        const XrRect2Di& part = view.subImage.imageRect;
        const Swapchain& swapchain = *swapchains[eye];
        record.eyes[eye] = {.pose = xr_pose_of(head * of_head.pose),
                            .submitted_pose = xr_pose_of(in_local),
                            .fov = of_head.fov,
                            .submitted_fov = view.fov,
                            .width = part.extent.width,
                            .height = part.extent.height,
                            .rgb = session.graphics.read(
                                swapchain.textures[static_cast<std::size_t>(swapchain.last_released)],
                                swapchain.layers > 1, static_cast<int>(view.subImage.imageArrayIndex), part)};
    }
}

}  // namespace

XrTime display_time(std::uint32_t n) {
    constexpr XrTime start = 5'000'000'000'000, steps_per_second = 72, second = 1'000'000'000;
    return start + static_cast<XrTime>(n) * second / steps_per_second;
}

XrResult WaitFrame(XrSession handle, const XrFrameWaitInfo*, XrFrameState* state) {
    constexpr const char* call = "xrWaitFrame";
    std::unique_lock lock(mutex());
    if (const XrResult wanted = wanted_message(call); wanted != XR_SUCCESS) return reject(call, wanted);
    Session* session = find(handle);
    if (!session) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(state, XR_TYPE_FRAME_STATE)) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (!session->is_running) return reject(call, XR_ERROR_SESSION_NOT_RUNNING);
    // Blocks until the previous frame was begun. The limit avoids a hanging test if a frame is
    // never begun.
    if (!frame_was_begun().wait_for(lock, std::chrono::seconds(20),
                                    [&] { return session->frames_waited == session->frames_begun; }))
        return reject(call, XR_ERROR_RUNTIME_FAILURE);
    state->predictedDisplayTime = display_time(session->frames_waited++);
    state->predictedDisplayPeriod = display_period_ns;
    state->shouldRender = is_seen(*session) ? XR_TRUE : XR_FALSE;
    the_instance()->record.frames.push_back({state->predictedDisplayTime, state->shouldRender == XR_TRUE, 0});
    return session->state == XR_SESSION_STATE_LOSS_PENDING ? XR_SESSION_LOSS_PENDING : XR_SUCCESS;
}

XrResult BeginFrame(XrSession handle, const XrFrameBeginInfo*) {
    constexpr const char* call = "xrBeginFrame";
    const std::lock_guard lock(mutex());
    Session* session = find(handle);
    if (!session) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!session->is_running) return reject(call, XR_ERROR_SESSION_NOT_RUNNING);
    if (session->frames_begun == session->frames_waited) return reject(call, XR_ERROR_CALL_ORDER_INVALID);
    ++session->frames_begun;
    frame_was_begun().notify_all();
    const bool discards_one = session->is_in_frame;
    session->is_in_frame = true;
    return discards_one ? reject(call, XR_FRAME_DISCARDED) : XR_SUCCESS;
}

XrResult EndFrame(XrSession handle, const XrFrameEndInfo* info) {
    constexpr const char* call = "xrEndFrame";
    const std::lock_guard lock(mutex());
    Session* session = find(handle);
    if (!session) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(info, XR_TYPE_FRAME_END_INFO)) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (!session->is_running) return reject(call, XR_ERROR_SESSION_NOT_RUNNING);
    if (!session->is_in_frame) return reject(call, XR_ERROR_CALL_ORDER_INVALID);
    if (info->displayTime <= 0) return reject(call, XR_ERROR_TIME_INVALID);
    if (info->environmentBlendMode != XR_ENVIRONMENT_BLEND_MODE_OPAQUE)
        return reject(call, XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
    if (info->layerCount > XR_MIN_COMPOSITION_LAYERS_SUPPORTED) return reject(call, XR_ERROR_LAYER_LIMIT_EXCEEDED);
    if (info->layerCount > 0 && !info->layers) return reject(call, XR_ERROR_LAYER_INVALID);
    std::array<const Swapchain*, views> swapchains{};
    for (std::uint32_t i = 0; i < info->layerCount; ++i) {
        if (!info->layers[i]) return reject(call, XR_ERROR_LAYER_INVALID);
        if (const XrResult result = check_layer(info->layers[i], swapchains); result != XR_SUCCESS)
            return reject(call, result);
    }
    if (info->layerCount > 0)
        record_layer(*session,
                     *reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[info->layerCount - 1]),
                     swapchains, info->displayTime);
    if (const GLenum error = session->graphics.error(); error != GL_NO_ERROR)
        the_instance()->record.refusals.push_back("OpenGL ES: " + std::to_string(error));
    Record::Frame& frame = the_instance()->record.frames[session->frames_begun - 1];
    frame.display_time_ns = info->displayTime;
    frame.layers = info->layerCount;
    session->is_in_frame = false;
    ++session->frames_ended;
    let_events_happen(*session);
    return XR_SUCCESS;
}

}  // namespace pelagic::openxr_stand_in
