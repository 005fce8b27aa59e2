// The session and its states, by the chapter "Session Lifecycle" of the specification.
#include <openxr/openxr_reflection.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "pelagic/tests/openxr_runtime/past_validation.hpp"
#include "pelagic/tests/openxr_runtime/runtime.hpp"

namespace pelagic::openxr_stand_in {
namespace {

std::string name_of(XrSessionState state) {
    switch (state) {
#define PELAGIC_STAND_IN_NAME(name, number) \
    case name: return #name;
        XR_LIST_ENUM_XrSessionState(PELAGIC_STAND_IN_NAME)
#undef PELAGIC_STAND_IN_NAME
    }
    return "?";
}

const XrGraphicsBindingEGLMNDX* binding_of(const XrSessionCreateInfo& info) {
    const auto* binding = static_cast<const XrGraphicsBindingEGLMNDX*>(info.next);
    if (!is(binding, WrappedBinding().type)) return binding;
    return static_cast<const XrGraphicsBindingEGLMNDX*>(static_cast<const WrappedBinding*>(info.next)->binding);
}

void stop(Session& session, bool for_good) {
    session.ends_for_good = for_good;
    if (session.state == XR_SESSION_STATE_FOCUSED) enter(session, XR_SESSION_STATE_VISIBLE);
    if (session.state == XR_SESSION_STATE_VISIBLE) enter(session, XR_SESSION_STATE_SYNCHRONIZED);
    enter(session, XR_SESSION_STATE_STOPPING);
}

void happen(Session& session, const std::string& event) {
    if (event == "hide") {
        if (session.state == XR_SESSION_STATE_FOCUSED) enter(session, XR_SESSION_STATE_VISIBLE);
        enter(session, XR_SESSION_STATE_SYNCHRONIZED);
    } else if (event == "show") {
        enter(session, XR_SESSION_STATE_VISIBLE);
    } else if (event == "blind") {  // covered: the pose of the head is unknown
        session.knows_head = false;
    } else if (event == "see") {
        session.knows_head = true;
    } else if (event == "stop") {  // taken off: the session continues later
        stop(session, false);
    } else if (event == "exit") {  // closed by its user
        stop(session, true);
    } else if (event == "lose") {  // the headset was unplugged
        enter(session, XR_SESSION_STATE_LOSS_PENDING);
    } else if (event == "lose-instance") {  // the runtime is being updated
        XrEventDataBuffer buffer{XR_TYPE_EVENT_DATA_BUFFER, nullptr, {}};
        reinterpret_cast<XrEventDataInstanceLossPending&>(buffer) = {XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING,
                                                                     nullptr, display_time(session.frames_ended)};
        the_instance()->events.push_back(buffer);
    } else {
        std::fprintf(stderr, "PELAGIC_STAND_IN_EVENTS: no event is named %s\n", event.c_str());
        std::abort();
    }
}

}  // namespace

Session* find(XrSession handle) {
    Instance* instance = the_instance().get();
    return instance && instance->session && reinterpret_cast<Session*>(handle) == instance->session.get()
               ? instance->session.get()
               : nullptr;
}

void enter(Session& session, XrSessionState state) {
    session.state = state;
    XrEventDataBuffer buffer{XR_TYPE_EVENT_DATA_BUFFER, nullptr, {}};
    reinterpret_cast<XrEventDataSessionStateChanged&>(buffer) = {XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED, nullptr,
                                                                 reinterpret_cast<XrSession>(&session), state,
                                                                 display_time(session.frames_ended)};
    the_instance()->events.push_back(buffer);
    the_instance()->record.states.push_back(name_of(state));
}

void let_events_happen(Session& session) {
    // Once frames arrive, the headset shows them and nothing else.
    if (session.state == XR_SESSION_STATE_READY) {
        enter(session, XR_SESSION_STATE_SYNCHRONIZED);
        enter(session, XR_SESSION_STATE_VISIBLE);
        enter(session, XR_SESSION_STATE_FOCUSED);
    }
    const char* rest = std::getenv("PELAGIC_STAND_IN_EVENTS");
    unsigned frame = 0;
    char event[32];
    int read = 0;
    while (rest && std::sscanf(rest, "%u:%31s%n", &frame, event, &read) == 2) {
        if (frame == session.frames_ended) happen(session, event);
        rest += read;
    }
}

XrResult CreateSession(XrInstance handle, const XrSessionCreateInfo* info, XrSession* session) {
    constexpr const char* call = "xrCreateSession";
    const std::lock_guard lock(mutex());
    if (const XrResult wanted = wanted_message(call); wanted != XR_SUCCESS) return reject(call, wanted);
    Instance* instance = find(handle);
    if (!instance) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(info, XR_TYPE_SESSION_CREATE_INFO) || !session || info->createFlags != 0)
        return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (info->systemId != the_system) return reject(call, XR_ERROR_SYSTEM_INVALID);
    if (instance->session) return reject(call, XR_ERROR_LIMIT_REACHED);
    if (!instance->told_graphics_requirements) return reject(call, XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
    const auto* binding = binding_of(*info);
    auto made = std::make_unique<Session>();
    if (!is(binding, XR_TYPE_GRAPHICS_BINDING_EGL_MNDX) ||
        std::ranges::count(instance->extensions, XR_MNDX_EGL_ENABLE_EXTENSION_NAME) == 0 ||
        std::ranges::count(instance->extensions, XR_KHR_OPENGL_ES_ENABLE_EXTENSION_NAME) == 0 ||
        !made->graphics.take(*binding))
        return reject(call, XR_ERROR_GRAPHICS_DEVICE_INVALID);
    *session = reinterpret_cast<XrSession>(made.get());
    instance->session = std::move(made);
    enter(*instance->session, XR_SESSION_STATE_IDLE);
    enter(*instance->session, XR_SESSION_STATE_READY);
    return XR_SUCCESS;
}

XrResult DestroySession(XrSession handle) {
    const std::lock_guard lock(mutex());
    Session* session = find(handle);
    if (!session) return reject("xrDestroySession", XR_ERROR_HANDLE_INVALID);
    // Not a code of this call: an application that destroyed its context first is wrong, but gets
    // no error.
    if (!session->graphics.is_there()) reject("xrDestroySession", XR_ERROR_GRAPHICS_DEVICE_INVALID);
    for (const auto& swapchain : session->swapchains) session->graphics.delete_textures(swapchain->textures);
    std::erase_if(the_instance()->events, [](const XrEventDataBuffer& event) {
        return event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED;
    });
    the_instance()->session.reset();
    return XR_SUCCESS;
}

XrResult BeginSession(XrSession handle, const XrSessionBeginInfo* info) {
    constexpr const char* call = "xrBeginSession";
    const std::lock_guard lock(mutex());
    Session* session = find(handle);
    if (!session) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(info, XR_TYPE_SESSION_BEGIN_INFO)) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (session->is_running) return reject(call, XR_ERROR_SESSION_RUNNING);
    if (session->state != XR_SESSION_STATE_READY) return reject(call, XR_ERROR_SESSION_NOT_READY);
    if (info->primaryViewConfigurationType != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)
        return reject(call, XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
    session->is_running = true;
    return XR_SUCCESS;
}

XrResult EndSession(XrSession handle) {
    constexpr const char* call = "xrEndSession";
    const std::lock_guard lock(mutex());
    Session* session = find(handle);
    if (!session) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!session->is_running) return reject(call, XR_ERROR_SESSION_NOT_RUNNING);
    if (session->state != XR_SESSION_STATE_STOPPING) return reject(call, XR_ERROR_SESSION_NOT_STOPPING);
    session->is_running = false;
    session->is_in_frame = false;
    session->frames_begun = session->frames_waited;
    enter(*session, XR_SESSION_STATE_IDLE);
    enter(*session, session->ends_for_good ? XR_SESSION_STATE_EXITING : XR_SESSION_STATE_READY);
    return XR_SUCCESS;
}

XrResult RequestExitSession(XrSession handle) {
    constexpr const char* call = "xrRequestExitSession";
    const std::lock_guard lock(mutex());
    Session* session = find(handle);
    if (!session) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!session->is_running) return reject(call, XR_ERROR_SESSION_NOT_RUNNING);
    if (session->state != XR_SESSION_STATE_STOPPING) stop(*session, true);
    session->ends_for_good = true;
    return XR_SUCCESS;
}

}  // namespace pelagic::openxr_stand_in
