// An OpenXR runtime that stands in for a headset in tests, and nowhere else: it shows nothing and waits for nobody. Two eyes
// with a Quest's fields of view move along a fixed path, and time passes by 1/72 s a frame, however long one takes. It answers
// as the specification (OpenXR 1.0) says, wrong calls with the codes that it names, and writes down what it was given.
//
// The environment tells it what to do:
//
//   PELAGIC_STAND_IN_FOLDER  where record.json, left.ppm and right.ppm go when the instance is destroyed; none: nowhere
//   PELAGIC_STAND_IN_EYE     side of an eye's image in pixels; 96
//   PELAGIC_STAND_IN_EVENTS  what happens after which frame: "10:hide 20:show 30:stop 40:exit" (session.cpp)
//   PELAGIC_STAND_IN_REFUSES a call that fails, and how: "xrGetSystem:-35"
//
// An application's context does the drawing. Only what pelagic's application and the validation layer call is there; one instance
// and one session at a time.
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
#define PELAGIC_STAND_IN_FUNCTIONS(X)                                                                                    \
    X(EnumerateInstanceExtensionProperties) X(CreateInstance) X(DestroyInstance) X(GetInstanceProperties)                \
    X(ResultToString) X(StructureTypeToString) X(PollEvent) X(GetSystem) X(GetSystemProperties)                          \
    X(EnumerateEnvironmentBlendModes) X(EnumerateViewConfigurations) X(GetViewConfigurationProperties)                   \
    X(EnumerateViewConfigurationViews) X(GetOpenGLESGraphicsRequirementsKHR)                                             \
    X(CreateSession) X(DestroySession) X(BeginSession) X(EndSession) X(RequestExitSession)                               \
    X(EnumerateReferenceSpaces) X(CreateReferenceSpace) X(DestroySpace) X(LocateViews)                                   \
    X(EnumerateSwapchainFormats) X(CreateSwapchain) X(DestroySwapchain) X(EnumerateSwapchainImages)                      \
    X(AcquireSwapchainImage) X(WaitSwapchainImage) X(ReleaseSwapchainImage)                                              \
    X(WaitFrame) X(BeginFrame) X(EndFrame)
// clang-format on

// The functions behind xrCreateInstance() and so on, by the API's own types.
#define PELAGIC_STAND_IN_DECLARE(name) std::remove_pointer_t<PFN_xr##name> name;
PELAGIC_STAND_IN_FUNCTIONS(PELAGIC_STAND_IN_DECLARE)
#undef PELAGIC_STAND_IN_DECLARE

constexpr XrSystemId the_system = 1;
constexpr int views = 2;
constexpr std::uint32_t largest_side = 4096;

struct Space {
    bool moves_with_head = false;  ///< VIEW; else LOCAL, whose origin is where the head starts
    Pose pose;                     ///< of this space in that one
};

struct Swapchain {
    int width = 0, height = 0, layers = 0;
    std::vector<GLuint> textures;
    std::deque<std::uint32_t>
        acquired;  ///< in the order of xrAcquireSwapchainImage(), the first one waited for or next to be
    bool first_is_waited_for = false;
    std::uint32_t next = 0;
    int last_released = -1;  ///< what a layer shows
};

struct Session {
    Graphics graphics;
    XrSessionState state = XR_SESSION_STATE_UNKNOWN;
    bool is_running = false;
    bool ends_for_good = false;  ///< after STOPPING comes EXITING; else READY once more
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

/// Every function holds it while it runs.
std::mutex& mutex();

/// The live one, owned here; empty or another: null, or what a handle that is none of ours becomes.
std::unique_ptr<Instance>& the_instance();
Instance* find(XrInstance handle);
Session* find(XrSession handle);
Space* find(XrSpace handle);
Swapchain* find(XrSwapchain handle);

/// Records the error message, so that a test sees it even where the application goes on.
XrResult reject(const char* call, XrResult why);
/// What PELAGIC_STAND_IN_REFUSES says about this call, or XR_SUCCESS.
XrResult wanted_message(const char* call);

/// The session goes on to `state`, and the application is told.
void enter(Session& session, XrSessionState state);
/// What PELAGIC_STAND_IN_EVENTS has for the frame that was ended last.
void let_events_happen(Session& session);

/// When frame n, counted from 0, will be seen. Far from 0, as a real clock is.
XrTime display_time(std::uint32_t n);
constexpr XrDuration display_period_ns = 1'000'000'000 / 72;

/// The way in which OpenXR hands out lists: a capacity of 0 asks for the count.
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
