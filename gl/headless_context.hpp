// An OpenGL ES 3.0 context without a window, created through EGL, for rendered images and tests.
// An application that draws into a window has its own context and does not need this class.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

struct HeadlessOptions {
    bool debug = false;  ///< collects the driver's messages (KHR_debug); drawing is slower
};

class HeadlessContext {
   public:
    /// Creates a context and makes it current on this thread. Tries EGL surfaceless first, which
    /// Mesa's software driver supports on any machine, then the default display.
    /// \throws GlError with the missing component and its Debian package
    explicit HeadlessContext(HeadlessOptions options = {});
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    /// Makes the context current on this thread. \throws GlError if EGL refuses
    void make_current();
    /// Returns the loaded OpenGL ES functions.
    const Functions& functions() const;
    std::string renderer_name() const;  ///< GL_RENDERER

    /// Returns the driver's errors, warnings and performance messages since construction. Empty
    /// without HeadlessOptions::debug.
    const std::vector<std::string>& messages() const;
    bool has_debug() const;  ///< true if the driver supports KHR_debug

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
