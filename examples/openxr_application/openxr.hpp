// OpenXR with OpenGL ES. Each platform has its own structure for the graphics context.
#pragma once

#include <EGL/egl.h>
#include <GLES3/gl3.h>

#define XR_USE_GRAPHICS_API_OPENGL_ES
#ifdef __ANDROID__
#include <jni.h>
#define XR_USE_PLATFORM_ANDROID
#else
#define XR_USE_PLATFORM_EGL
#endif
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <stdexcept>
#include <string>

namespace openxr_application {

/// A failed call. The message is one line: "xrGetSystem: XR_ERROR_FORM_FACTOR_UNAVAILABLE (...)".
struct XrError : std::runtime_error {
    XrError(const char* call, XrResult result);
};

/// Returns the result of a call that succeeded, which may differ from XR_SUCCESS.
/// \throws XrError  if the call failed
XrResult check(const char* call, XrResult result);

/// Owner of an OpenXR object, which the destructor destroys.
template <class Object, XrResult (*destroy)(Object)>
class Owned {
   public:
    Owned() = default;
    ~Owned() {
        if (object_ != XR_NULL_HANDLE) destroy(object_);
    }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    operator Object() const { return object_; }
    Object* receive() { return &object_; }  ///< output parameter for the call that creates it

   private:
    Object object_ = XR_NULL_HANDLE;
};

}  // namespace openxr_application
