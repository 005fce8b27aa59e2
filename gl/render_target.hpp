// An offscreen image: multisampled colour and depth, resolve, and readback.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/gl/objects.hpp"

namespace pelagic::gl {

/// Content of a pixel: a display colour in bytes (RGBA8), radiance in half floats (RGBA16F), or values
/// of DrawMode::surface_data in floats (RGBA32F).
enum class PixelKind { screen, radiance, data };

/// An image in the lower left corner of a texture. Sizes are in texels.
struct TexturePart {
    GLuint texture = 0;
    int width = 0, height = 0;  ///< size of the image
    int texture_width = 0, texture_height = 0;
};

class RenderTarget {
   public:
    /// \param samples  samples per pixel, limited to the driver's maximum
    /// \throws GlError if the size exceeds the driver's limit, the driver cannot render to half
    /// floats (radiance) or floats (data), or the driver is out of memory
    RenderTarget(const Functions& gl, int width, int height, int samples, PixelKind kind = PixelKind::screen);

    /// Binds the framebuffer and sets the viewport to the whole target.
    void bind();
    /// Binds the target, and clears its depth to 1 and its colour.
    void clear(const glm::vec3& colour = {0, 0, 0});
    /// Averages the samples of the lower left width x height pixels into a texture with linear
    /// filtering. The texture is valid until the next call. Binds this target again.
    TexturePart resolved(int width, int height);
    /// As above, with the size of the target.
    TexturePart resolved() { return resolved(width_, height_); }
    /// Copies the lower left width x height pixels to the lower left window_width x window_height
    /// pixels of framebuffer 0, with linear filtering. Binds framebuffer 0.
    /// \pre the target's PixelKind is screen
    void show(int width, int height, int window_width, int window_height);
    /// Reads all pixels, RGBA8, top row first. Waits for the GPU. \pre the PixelKind is screen
    std::vector<std::uint8_t> read();
    /// Reads all pixels, linear RGBA, top row first. Waits for the GPU. \pre the PixelKind is
    /// radiance or data
    std::vector<float> read_radiance();

    /// Returns the width in pixels.
    int width() const { return width_; }
    /// Returns the height in pixels.
    int height() const { return height_; }

   private:
    void read_rows(GLenum type, void* pixels, std::size_t bytes_per_row);

    const Functions& gl_;
    int width_, height_;
    Renderbuffer colour_, depth_;
    Texture resolved_colour_;
    Framebuffer framebuffer_, resolved_;
};

}  // namespace pelagic::gl
