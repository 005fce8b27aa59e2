// A headset by OpenXR: the connection to the runtime, the session with its states, and the calls of one frame in their order.
//
//   Headset headset;                              // asks the runtime for one
//   headset.start(egl_context.binding());
//   while (headset.is_wanted()) {
//       if (!headset.handle_events()) continue;   // nothing to draw for now
//       const XrFrameState moment = headset.wait_frame();
//       headset.begin_frame();
//       if (moment.shouldRender) ... draw for headset.locate_eyes(moment.predictedDisplayTime) ...
//       headset.end_frame(moment.predictedDisplayTime, &layer);  // nullptr: nothing was drawn
//   }
#pragma once

#include <array>
#include <optional>

#include "egl_context.hpp"

namespace openxr_application {

class Headset {
   public:
    /// Connects to the runtime. All methods throw XrError.
    Headset();
    Headset(const Headset&) = delete;
    Headset& operator=(const Headset&) = delete;

    /// The size of an eye's image that the runtime recommends, the larger one if they differ.
    XrExtent2Di eye_size() const { return eye_size_; }

    /// Makes the session. The binding's context is current on this thread, here and in all later calls.
    void start(const GraphicsBinding& binding);
    XrSession session() const { return session_; }
    /// Where positions are counted from: the head as it was at first, upright.
    XrSpace space() const { return space_; }

    /// Takes in what the runtime has to say. False if no frame is wanted now, after a short sleep: the headset was taken off, or
    /// the session is over.
    bool handle_events();
    /// Until the user leaves, or headset or runtime go away.
    bool is_wanted() const { return is_wanted_; }
    /// Asks the runtime to end the session. It answers with events, so go on with the loop until is_wanted() says no.
    void request_exit();

    /// Sleeps until it is time for the next frame, and says when that will be seen.
    XrFrameState wait_frame();
    void begin_frame();
    /// Left and right at that time; none while the headset does not know where it is.
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
