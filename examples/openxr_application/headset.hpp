// An OpenXR headset: connection to the runtime, session states, and the calls of a frame in their
// order.
//
//   Headset headset;                              // connects to the runtime
//   headset.start(egl_context.binding());
//   while (headset.is_wanted()) {
//       if (!headset.handle_events()) continue;   // no frame is needed now
//       const XrFrameState moment = headset.wait_frame();
//       headset.begin_frame();
//       if (moment.shouldRender) ... draw for headset.locate_eyes(moment.predictedDisplayTime) ...
//       headset.end_frame(moment.predictedDisplayTime, &layer);  // nullptr if nothing was drawn
//   }
#pragma once

#include <array>
#include <optional>

#include "egl_context.hpp"

namespace openxr_application {

class Headset {
   public:
    /// Connects to the runtime. All methods throw XrError if a call fails.
    Headset();
    Headset(const Headset&) = delete;
    Headset& operator=(const Headset&) = delete;

    /// Returns the recommended size of an eye's image, the larger one if the eyes differ.
    XrExtent2Di eye_size() const { return eye_size_; }

    /// Creates the session. \pre the binding's context is current on this thread, here and in all
    /// later calls
    void start(const GraphicsBinding& binding);
    XrSession session() const { return session_; }
    /// Returns the reference space, whose origin is the initial position of the head, with y up.
    XrSpace space() const { return space_; }

    /// Handles the runtime's events. If no frame is needed, because the headset is not worn or the
    /// session has ended, sleeps briefly and returns false.
    bool handle_events();
    /// Returns true until the user exits, or the headset or the runtime is lost.
    bool is_wanted() const { return is_wanted_; }
    /// Requests the end of the session. The runtime responds with events, so continue the loop
    /// until is_wanted() is false.
    void request_exit();

    /// Waits until the next frame starts and returns its state with the predicted display time.
    XrFrameState wait_frame();
    void begin_frame();
    /// Returns the left and right view at a time; empty while tracking is lost.
    std::optional<std::array<XrView, 2>> locate_eyes(XrTime time) const;
    void end_frame(XrTime display_time, const XrCompositionLayerProjection* layer);

   private:
    void change_state(XrSessionState state);

    Owned<XrInstance, xrDestroyInstance> instance_;
    XrSystemId system_ = XR_NULL_SYSTEM_ID;
    XrExtent2Di eye_size_{};
    XrEnvironmentBlendMode blend_mode_ = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
    Owned<XrSession, xrDestroySession> session_;
    Owned<XrSpace, xrDestroySpace> space_;
    bool is_running_ = false;  ///< between xrBeginSession() and xrEndSession()
    bool is_wanted_ = true;
};

}  // namespace openxr_application
