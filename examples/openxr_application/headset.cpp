#include "headset.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>
#include <vector>

namespace openxr_application {
namespace {

constexpr XrViewConfigurationType stereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

constexpr const char* extensions[] = {
    XR_KHR_OPENGL_ES_ENABLE_EXTENSION_NAME,
#ifdef XR_USE_PLATFORM_EGL
    XR_MNDX_EGL_ENABLE_EXTENSION_NAME,
#endif
};

XrExtent2Di recommended_size(XrInstance instance, XrSystemId system) {
    std::array<XrViewConfigurationView, 2> views;
    views.fill({.type = XR_TYPE_VIEW_CONFIGURATION_VIEW});
    std::uint32_t count = 0;
    check("xrEnumerateViewConfigurationViews",
          xrEnumerateViewConfigurationViews(instance, system, stereo, 2, &count, views.data()));
    return {
        static_cast<std::int32_t>(std::max(views[0].recommendedImageRectWidth, views[1].recommendedImageRectWidth)),
        static_cast<std::int32_t>(
            std::max(views[0].recommendedImageRectHeight, views[1].recommendedImageRectHeight))};
}

/// Returns the blend mode that the runtime prefers.
XrEnvironmentBlendMode first_blend_mode(XrInstance instance, XrSystemId system) {
    std::uint32_t count = 0;
    check("xrEnumerateEnvironmentBlendModes",
          xrEnumerateEnvironmentBlendModes(instance, system, stereo, 0, &count, nullptr));
    std::vector<XrEnvironmentBlendMode> modes(count);
    check("xrEnumerateEnvironmentBlendModes",
          xrEnumerateEnvironmentBlendModes(instance, system, stereo, count, &count, modes.data()));
    return modes.at(0);
}

/// Queries the graphics requirements, which OpenXR demands before a session is created.
void check_graphics_version(XrInstance instance, XrSystemId system) {
    PFN_xrGetOpenGLESGraphicsRequirementsKHR get_requirements = nullptr;
    check("xrGetInstanceProcAddr", xrGetInstanceProcAddr(instance, "xrGetOpenGLESGraphicsRequirementsKHR",
                                                         reinterpret_cast<PFN_xrVoidFunction*>(&get_requirements)));
    XrGraphicsRequirementsOpenGLESKHR requirements{.type = XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_ES_KHR};
    check("xrGetOpenGLESGraphicsRequirementsKHR", get_requirements(instance, system, &requirements));
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    const XrVersion wanted = requirements.minApiVersionSupported;
    if (XR_MAKE_VERSION(major, minor, 0) < wanted)
        throw std::runtime_error("the driver has OpenGL ES " + std::to_string(major) + "." + std::to_string(minor) +
                                 ", and the headset's runtime needs " + std::to_string(XR_VERSION_MAJOR(wanted)) +
                                 "." + std::to_string(XR_VERSION_MINOR(wanted)));
}

}  // namespace

Headset::Headset() {
    XrInstanceCreateInfo info{.type = XR_TYPE_INSTANCE_CREATE_INFO};
    std::strcpy(info.applicationInfo.applicationName, "openxr_application");
    std::strcpy(info.applicationInfo.engineName, "Pelagic");
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    info.enabledExtensionCount = std::size(extensions);
    info.enabledExtensionNames = extensions;
    check("xrCreateInstance", xrCreateInstance(&info, instance_.receive()));

    const XrSystemGetInfo worn{.type = XR_TYPE_SYSTEM_GET_INFO, .formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    check("xrGetSystem", xrGetSystem(instance_, &worn, &system_));
    eye_size_ = recommended_size(instance_, system_);
    blend_mode_ = first_blend_mode(instance_, system_);
}

void Headset::start(const GraphicsBinding& binding) {
    check_graphics_version(instance_, system_);
    const XrSessionCreateInfo info{.type = XR_TYPE_SESSION_CREATE_INFO, .next = &binding, .systemId = system_};
    check("xrCreateSession", xrCreateSession(instance_, &info, session_.receive()));
    const XrReferenceSpaceCreateInfo local{.type = XR_TYPE_REFERENCE_SPACE_CREATE_INFO,
                                           .referenceSpaceType = XR_REFERENCE_SPACE_TYPE_LOCAL,
                                           .poseInReferenceSpace = {.orientation = {0, 0, 0, 1}}};
    check("xrCreateReferenceSpace", xrCreateReferenceSpace(session_, &local, space_.receive()));
}

bool Headset::handle_events() {
    XrEventDataBuffer event{.type = XR_TYPE_EVENT_DATA_BUFFER};
    while (is_wanted_ && check("xrPollEvent", xrPollEvent(instance_, &event)) == XR_SUCCESS) {
        if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED)
            change_state(reinterpret_cast<const XrEventDataSessionStateChanged&>(event).state);
        if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) is_wanted_ = false;
        event = {.type = XR_TYPE_EVENT_DATA_BUFFER};
    }
    const bool wants_frame = is_wanted_ && is_running_;
    if (is_wanted_ && !is_running_) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return wants_frame;
}

void Headset::change_state(XrSessionState state) {
    switch (state) {
        case XR_SESSION_STATE_READY: {
            const XrSessionBeginInfo info{.type = XR_TYPE_SESSION_BEGIN_INFO, .primaryViewConfigurationType = stereo};
            check("xrBeginSession", xrBeginSession(session_, &info));
            is_running_ = true;
            break;
        }
        case XR_SESSION_STATE_STOPPING:
            check("xrEndSession", xrEndSession(session_));
            is_running_ = false;
            break;
        case XR_SESSION_STATE_EXITING:
        case XR_SESSION_STATE_LOSS_PENDING: is_wanted_ = false; break;
        default:  // SYNCHRONIZED, VISIBLE, FOCUSED: no action, see XrFrameState::shouldRender
            break;
    }
}

void Headset::request_exit() { check("xrRequestExitSession", xrRequestExitSession(session_)); }

XrFrameState Headset::wait_frame() {
    XrFrameState state{.type = XR_TYPE_FRAME_STATE};
    check("xrWaitFrame", xrWaitFrame(session_, nullptr, &state));
    return state;
}

void Headset::begin_frame() { check("xrBeginFrame", xrBeginFrame(session_, nullptr)); }

std::optional<std::array<XrView, 2>> Headset::locate_eyes(XrTime time) const {
    const XrViewLocateInfo info{
        .type = XR_TYPE_VIEW_LOCATE_INFO, .viewConfigurationType = stereo, .displayTime = time, .space = space_};
    XrViewState state{.type = XR_TYPE_VIEW_STATE};
    std::array<XrView, 2> eyes;
    eyes.fill({.type = XR_TYPE_VIEW});
    std::uint32_t count = 0;
    check("xrLocateViews", xrLocateViews(session_, &info, &state, 2, &count, eyes.data()));
    constexpr XrViewStateFlags known = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;
    if ((state.viewStateFlags & known) != known) return std::nullopt;
    return eyes;
}

void Headset::end_frame(XrTime display_time, const XrCompositionLayerProjection* layer) {
    const auto* const header = reinterpret_cast<const XrCompositionLayerBaseHeader*>(layer);
    const XrFrameEndInfo info{.type = XR_TYPE_FRAME_END_INFO,
                              .displayTime = display_time,
                              .environmentBlendMode = blend_mode_,
                              .layerCount = layer ? 1u : 0u,
                              .layers = layer ? &header : nullptr};
    check("xrEndFrame", xrEndFrame(session_, &info));
}

}  // namespace openxr_application
