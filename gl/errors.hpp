// Exceptions of the OpenGL front end. The message is one line: what is missing, and a remedy.
#pragma once

#include <stdexcept>

namespace pelagic::gl {

/// Thrown if the GL library or the driver is missing, the driver lacks a feature, or the driver
/// rejects a shader. The simulation does not depend on OpenGL.
struct GlError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Thrown if the driver has reset the context. Destroy every object of that context, including the
/// renderer, and create them again in a new context.
struct ContextLost : GlError {
    using GlError::GlError;
};

}  // namespace pelagic::gl
