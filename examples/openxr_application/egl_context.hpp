// The OpenGL ES context of this program, which the OpenXR runtime shares. An engine has its own
// context.
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
    /// Creates a context without a window and makes it current on the calling thread.
    /// \throws std::runtime_error  if there is no suitable context
    EglContext();
    ~EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    /// Returns the structure for XrSessionCreateInfo::next, valid as long as this object.
    const GraphicsBinding& binding() const { return binding_; }

   private:
    GraphicsBinding binding_{};
};

}  // namespace openxr_application
