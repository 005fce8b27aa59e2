#include "openxr.hpp"

#include <openxr/openxr_reflection.h>

namespace openxr_application {
namespace {

std::string name_of(XrResult result) {
    switch (result) {
#define OPENXR_HOST_NAME(name, number) \
    case name: return #name;
        XR_LIST_ENUM_XrResult(OPENXR_HOST_NAME)
#undef OPENXR_HOST_NAME
    }
    return "result " + std::to_string(result);
}

/// Returns advice for the user about an error.
const char* remedy_for(XrResult result) {
    switch (result) {
        case XR_ERROR_RUNTIME_UNAVAILABLE:
        case XR_ERROR_RUNTIME_FAILURE:
            return " (is an OpenXR runtime installed and running? XR_RUNTIME_JSON names one)";
        case XR_ERROR_EXTENSION_NOT_PRESENT: return " (this runtime does not take an OpenGL ES context of EGL's)";
        case XR_ERROR_FORM_FACTOR_UNAVAILABLE: return " (is the headset connected?)";
        default: return "";
    }
}

}  // namespace

XrError::XrError(const char* call, XrResult result)
    : std::runtime_error(std::string(call) + ": " + name_of(result) + remedy_for(result)) {}

XrResult check(const char* call, XrResult result) {
    if (XR_FAILED(result)) throw XrError(call, result);
    return result;
}

}  // namespace openxr_application
