// OpenXR with OpenGL ES, for the platform that this is compiled for: each has its own way to hand a context over.
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

/// A call that failed, as one line: "xrGetSystem: XR_ERROR_FORM_FACTOR_UNAVAILABLE (...)".
struct XrError : std::runtime_error {
    XrError(const char* call, XrResult result);
};

/// Throws if the call failed; else what it returned, which may be more than XR_SUCCESS.
XrResult check(const char* call, XrResult result);

/// Destroys what it holds.
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
    Object* receive() { return &object_; }  ///< for the call that makes it

   private:
    Object object_ = XR_NULL_HANDLE;
};

}  // namespace openxr_application
