// A picture without a window: colour and depth in memory, smoothed edges, and reading it back.
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/gl/objects.hpp"

namespace pelagic::gl {

class RenderTarget {
   public:
    /// \param samples  for each pixel; less where the driver has fewer. Throws GlError if the size is too large for it.
    RenderTarget(const Functions& gl, int width, int height, int samples);

    /// Draws go here from now on.
    void bind();
    /// RGBA8, the upper row first. Waits for the GPU.
    std::vector<std::uint8_t> read();

    int width() const { return width_; }
    int height() const { return height_; }

   private:
    const Functions& gl_;
    int width_, height_;
    Renderbuffer colour_, depth_, resolved_colour_;
    Framebuffer framebuffer_, resolved_;
};

}  // namespace pelagic::gl
