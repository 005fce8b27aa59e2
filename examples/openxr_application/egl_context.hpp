// The OpenGL ES context that this program draws with and lends to the runtime. An engine has one already.
#pragma once

#include "openxr.hpp"

namespace openxr_application {

#ifdef XR_USE_PLATFORM_ANDROID
using GraphicsBinding = XrGraphicsBindingOpenGLESAndroidKHR;
#else
using GraphicsBinding = XrGraphicsBindingEGLMNDX;
#endif

class EglContext {
   public:
    /// Makes it current on this thread. No window: what is drawn goes to the headset. Throws std::runtime_error.
    EglContext();
    ~EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    /// For XrSessionCreateInfo::next; valid as long as this.
    const GraphicsBinding& binding() const { return binding_; }

   private:
    GraphicsBinding binding_{};
};

}  // namespace openxr_application
