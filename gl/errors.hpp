// How the front end fails: one line that says what is missing and what would bring it.
#pragma once

#include <stdexcept>

namespace pelagic::gl {

/// No library, no driver, too small a driver, or a shader that it refuses. The sea itself does not need any of them.
struct GlError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The driver took the context away. Destroy every object of it, the renderer too, and build them in a new context.
struct ContextLost : GlError {
    using GlError::GlError;
};

}  // namespace pelagic::gl
