// An OpenGL ES 3.0 context without a window, through EGL: what images and tests are made with. An application that draws into
// a window has a context of its own and does not need this.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

struct HeadlessOptions {
    bool debug = false;  ///< collects the driver's messages (KHR_debug), at some cost
};

class HeadlessContext {
   public:
    /// Makes a context and makes it current on this thread. EGL surfaceless first, which Mesa's software driver
    /// offers on any machine, then the default display. Throws GlError: what is missing, and the Debian package.
    explicit HeadlessContext(HeadlessOptions options = {});
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    void make_current();
    const Functions& functions() const;
    std::string renderer_name() const;  ///< as the driver calls itself

    /// With HeadlessOptions::debug: every error, warning and note about performance since the start.
    const std::vector<std::string>& messages() const;
    bool has_debug() const;  ///< the driver reports messages

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
