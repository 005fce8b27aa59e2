// A picture without a window: colour and depth in memory, smoothed edges, and reading it back.
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/gl/objects.hpp"

namespace pelagic::gl {

/// What a pixel holds: a colour for the screen in bytes, or radiance in half floats.
enum class PixelKind { screen, radiance };

class RenderTarget {
   public:
    /// \param samples  for each pixel; less where the driver has fewer. Throws GlError if the size is too large for it, or if
    /// it can't draw half floats.
    RenderTarget(const Functions& gl, int width, int height, int samples, PixelKind kind = PixelKind::screen);

    /// Draws go here from now on.
    void bind();
    /// RGBA8, the upper row first. Waits for the GPU.
    std::vector<std::uint8_t> read();
    /// RGBA, linear, the upper row first, of a target that holds radiance. Waits for the GPU.
    std::vector<float> read_radiance();

    int width() const { return width_; }
    int height() const { return height_; }

   private:
    void read_rows(GLenum type, void* pixels, std::size_t bytes_a_row);

    const Functions& gl_;
    int width_, height_;
    Renderbuffer colour_, depth_, resolved_colour_;
    Framebuffer framebuffer_, resolved_;
};

}  // namespace pelagic::gl
