// Spaces, and the positions of the eyes in them.
#include <cmath>

#include "pelagic/tests/openxr_runtime/runtime.hpp"

namespace pelagic::openxr_stand_in {
namespace {

bool is_unit(const XrQuaternionf& q) {
    // the specification's 1 %
    return std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 0.01f;
}

}  // namespace

Space* find(XrSpace handle) {
    if (!the_instance() || !the_instance()->session) return nullptr;
    for (const auto& space : the_instance()->session->spaces)
        if (reinterpret_cast<Space*>(handle) == space.get()) return space.get();
    return nullptr;
}

XrResult EnumerateReferenceSpaces(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                  XrReferenceSpaceType* to) {
    constexpr const char* call = "xrEnumerateReferenceSpaces";
    const std::lock_guard lock(mutex());
    if (!find(session)) return reject(call, XR_ERROR_HANDLE_INVALID);
    const XrReferenceSpaceType types[] = {XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL};
    return hand_out<XrReferenceSpaceType>(call, types, capacity, count, to);
}

XrResult CreateReferenceSpace(XrSession handle, const XrReferenceSpaceCreateInfo* info, XrSpace* space) {
    constexpr const char* call = "xrCreateReferenceSpace";
    const std::lock_guard lock(mutex());
    Session* session = find(handle);
    if (!session) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(info, XR_TYPE_REFERENCE_SPACE_CREATE_INFO) || !space) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    const bool is_view = info->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_VIEW;
    if (!is_view && info->referenceSpaceType != XR_REFERENCE_SPACE_TYPE_LOCAL)
        return reject(call, XR_ERROR_REFERENCE_SPACE_UNSUPPORTED);
    if (!is_unit(info->poseInReferenceSpace.orientation)) return reject(call, XR_ERROR_POSE_INVALID);
    session->spaces.push_back(std::make_unique<Space>(Space{is_view, pose_of(info->poseInReferenceSpace)}));
    *space = reinterpret_cast<XrSpace>(session->spaces.back().get());
    return XR_SUCCESS;
}

XrResult DestroySpace(XrSpace handle) {
    const std::lock_guard lock(mutex());
    const Space* space = find(handle);
    if (!space) return reject("xrDestroySpace", XR_ERROR_HANDLE_INVALID);
    std::erase_if(the_instance()->session->spaces, [&](const auto& owned) { return owned.get() == space; });
    return XR_SUCCESS;
}

XrResult LocateViews(XrSession session, const XrViewLocateInfo* info, XrViewState* state, std::uint32_t capacity,
                     std::uint32_t* count, XrView* to) {
    constexpr const char* call = "xrLocateViews";
    const std::lock_guard lock(mutex());
    if (!find(session)) return reject(call, XR_ERROR_HANDLE_INVALID);
    const bool knows_head = find(session)->knows_head;
    if (!is(info, XR_TYPE_VIEW_LOCATE_INFO) || !is(state, XR_TYPE_VIEW_STATE))
        return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (info->viewConfigurationType != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)
        return reject(call, XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
    if (info->displayTime <= 0) return reject(call, XR_ERROR_TIME_INVALID);
    const Space* space = find(info->space);
    if (!space) return reject(call, XR_ERROR_HANDLE_INVALID);

    const Pose head = head_at(info->displayTime);
    const Pose space_in_local = space->moves_with_head ? head * space->pose : space->pose;
    std::array<XrView, views> located;
    for (std::size_t eye = 0; eye < views; ++eye) {
        const EyeOfHead& of_head = eyes_of_head()[eye];
        located[eye] = {XR_TYPE_VIEW, nullptr, xr_pose_of(space_in_local.inverse() * head * of_head.pose),
                        of_head.fov};
    }
    if (!knows_head)
        for (XrView& view : located) view.pose = {};
    state->viewStateFlags = !knows_head
                                ? 0
                                : XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT |
                                      XR_VIEW_STATE_ORIENTATION_TRACKED_BIT | XR_VIEW_STATE_POSITION_TRACKED_BIT;
    return hand_out<XrView>(call, located, capacity, count, to);
}

}  // namespace pelagic::openxr_stand_in
