// An image without a window: colour and depth in memory, smoothed edges, and reading it back.
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/gl/objects.hpp"

namespace pelagic::gl {

/// What a pixel holds: a colour for the screen in bytes, or radiance in half floats.
enum class PixelKind { screen, radiance };

/// An image in the lower left part of a texture.
struct TexturePart {
    GLuint texture = 0;
    int width = 0, height = 0;  ///< of the image
    int texture_width = 0, texture_height = 0;
};

class RenderTarget {
   public:
    /// \param samples  for each pixel; less where the driver has fewer. Throws GlError if the size is too large for it, or if
    /// it can't draw half floats.
    RenderTarget(const Functions& gl, int width, int height, int samples, PixelKind kind = PixelKind::screen);

    /// Draws go here from now on.
    void bind();
    /// What was drawn into the lower left part, samples averaged, as a texture with linear filtering, until the next call. Draws go
    /// here again afterwards.
    TexturePart resolved(int width, int height);
    TexturePart resolved() { return resolved(width_, height_); }
    /// Copies the lower left part of a target of bytes into the window's framebuffer, enlarged smoothly to its lower left
    /// part of that size. Draws go to the window afterwards.
    void show(int width, int height, int window_width, int window_height);
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
    Renderbuffer colour_, depth_;
    Texture resolved_colour_;
    Framebuffer framebuffer_, resolved_;
};

}  // namespace pelagic::gl
