// An OpenXR runtime that replaces a headset in tests only: it displays nothing and never waits. Two
// eyes with a Quest's fields of view move along a fixed path, and time advances by 1/72 s a frame,
// however long a frame takes. It follows the specification (OpenXR 1.0), returns its error codes
// for invalid calls, and records what it receives.
//
// Environment variables:
//
//   PELAGIC_STAND_IN_FOLDER  folder of record.json, left.ppm and right.ppm, written when the
//                            instance is destroyed; if unset, nothing is written
//   PELAGIC_STAND_IN_EYE     side of an eye's image in pixels; 96
//   PELAGIC_STAND_IN_EVENTS  events after frames: "10:hide 20:show 30:stop 40:exit" (session.cpp)
//   PELAGIC_STAND_IN_REFUSES a call that fails, with its code: "xrGetSystem:-35"
//
// An application's context renders. Only the functions that Pelagic's application and the
// validation layer call exist; there is one instance and one session at a time.
#pragma once

#include <EGL/egl.h>
#include <GLES3/gl3.h>
#define XR_USE_GRAPHICS_API_OPENGL_ES
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "pelagic/tests/openxr_runtime/graphics.hpp"
#include "pelagic/tests/openxr_runtime/poses.hpp"
#include "pelagic/tests/openxr_runtime/record.hpp"

namespace pelagic::openxr_stand_in {

// clang-format off
#define PELAGIC_STAND_IN_FUNCTIONS(X)                                                                           \
    X(EnumerateInstanceExtensionProperties) X(CreateInstance) X(DestroyInstance) X(GetInstanceProperties)       \
    X(ResultToString) X(StructureTypeToString) X(PollEvent) X(GetSystem) X(GetSystemProperties)                 \
    X(EnumerateEnvironmentBlendModes) X(EnumerateViewConfigurations) X(GetViewConfigurationProperties)          \
    X(EnumerateViewConfigurationViews) X(GetOpenGLESGraphicsRequirementsKHR)                                    \
    X(CreateSession) X(DestroySession) X(BeginSession) X(EndSession) X(RequestExitSession)                      \
    X(EnumerateReferenceSpaces) X(CreateReferenceSpace) X(DestroySpace) X(LocateViews)                          \
    X(EnumerateSwapchainFormats) X(CreateSwapchain) X(DestroySwapchain) X(EnumerateSwapchainImages)             \
    X(AcquireSwapchainImage) X(WaitSwapchainImage) X(ReleaseSwapchainImage)                                     \
    X(WaitFrame) X(BeginFrame) X(EndFrame)
// clang-format on

// The functions behind xrCreateInstance() and so on, with the API's own types.
#define PELAGIC_STAND_IN_DECLARE(name) std::remove_pointer_t<PFN_xr##name> name;
PELAGIC_STAND_IN_FUNCTIONS(PELAGIC_STAND_IN_DECLARE)
#undef PELAGIC_STAND_IN_DECLARE

constexpr XrSystemId the_system = 1;
constexpr int views = 2;
constexpr std::uint32_t largest_side = 4096;

struct Space {
    bool moves_with_head = false;  ///< VIEW; else LOCAL, whose origin is the head's first position
    Pose pose;                     ///< pose of this space in VIEW or LOCAL
};

struct Swapchain {
    int width = 0, height = 0, layers = 0;
    std::vector<GLuint> textures;
    std::deque<std::uint32_t>
        /// in the order of xrAcquireSwapchainImage(); the first is waited for, or is next to be
        acquired;
    bool first_is_waited_for = false;
    std::uint32_t next = 0;
    int last_released = -1;  ///< the image that a layer shows
};

struct Session {
    Graphics graphics;
    XrSessionState state = XR_SESSION_STATE_UNKNOWN;
    bool is_running = false;
    bool ends_for_good = false;  ///< after STOPPING comes EXITING; else READY again
    std::uint32_t frames_waited = 0, frames_begun = 0, frames_ended = 0;
    bool is_in_frame = false;
    bool knows_head = true;
    std::vector<std::unique_ptr<Space>> spaces;
    std::vector<std::unique_ptr<Swapchain>> swapchains;
};

struct Instance {
    std::vector<std::string> extensions;
    std::deque<XrEventDataBuffer> events;
    bool told_graphics_requirements = false;
    std::unique_ptr<Session> session;
    Record record;
};

/// Every function locks it while it runs.
std::mutex& mutex();

/// Returns the live instance, owned here; empty if there is none. Each find() returns null for an
/// unknown handle.
std::unique_ptr<Instance>& the_instance();
Instance* find(XrInstance handle);
Session* find(XrSession handle);
Space* find(XrSpace handle);
Swapchain* find(XrSwapchain handle);

/// Records the error, so that a test sees it even if the application continues.
XrResult reject(const char* call, XrResult why);
/// Returns the code that PELAGIC_STAND_IN_REFUSES sets for this call, or XR_SUCCESS.
XrResult wanted_message(const char* call);

/// Changes the session's state to `state` and queues an event for the application.
void enter(Session& session, XrSessionState state);
/// Applies the events of PELAGIC_STAND_IN_EVENTS for the frame that ended last.
void let_events_happen(Session& session);

/// Returns the display time of frame n, counted from 0. Far from 0, like a real clock.
XrTime display_time(std::uint32_t n);
constexpr XrDuration display_period_ns = 1'000'000'000 / 72;

/// Returns a list in OpenXR's way: with a capacity of 0, only the count.
template <class T>
XrResult hand_out(const char* call, std::span<const T> values, std::uint32_t capacity, std::uint32_t* count, T* to) {
    if (!count) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    *count = static_cast<std::uint32_t>(values.size());
    if (capacity == 0) return XR_SUCCESS;
    if (!to) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (capacity < values.size()) return reject(call, XR_ERROR_SIZE_INSUFFICIENT);
    for (const T& value : values) *to++ = value;
    return XR_SUCCESS;
}

template <class Structure>
bool is(const Structure* structure, XrStructureType type) {
    return structure && structure->type == type;
}

}  // namespace pelagic::openxr_stand_in
