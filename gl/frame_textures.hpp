// A frame of sea as textures: displacement as RGBA16F, the gradient chain as RGBA8 with our own mips, through a ring of
// pixel buffers, so that neither the host nor the GPU waits for the other.
#pragma once

#include <array>
#include <cstddef>

#include "pelagic/gl/objects.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::gl {

class FrameTextures {
   public:
    /// Immutable storage for frames of resolution^2 texels.
    FrameTextures(const Functions& gl, int resolution);
    ~FrameTextures();
    FrameTextures(const FrameTextures&) = delete;
    FrameTextures& operator=(const FrameTextures&) = delete;

    /// Copies the frame into the next pixel buffer and starts its way into the next pair of textures; the frame's
    /// views may go stale afterwards. Call it at the start of a host's frame, with the frame that complete() gave.
    /// Waits only if the GPU is three frames behind. GL state ends as it was.
    /// Mips of the displacement are the driver's (box filter), those of the gradients are the frame's.
    /// \pre frame.tiles[0].resolution() is the one given above
    void upload(const Frame& frame);

    GLuint displacement() const { return pairs_[pair_].displacement.name(); }
    GLuint gradient() const { return pairs_[pair_].gradient.name(); }
    int resolution() const { return resolution_; }
    /// The driver made the displacement's mips, and vertices may take them.
    bool has_displacement_mips() const { return gl_.renders_to_half_floats; }
    double last_driver_ms() const { return driver_ms_; }  ///< of the last upload(): the calls that move texels
    std::size_t bytes_per_frame() const { return displacement_bytes() + gradient_bytes(); }

   private:
    std::size_t displacement_bytes() const { return std::size_t{8} * resolution_ * resolution_; }
    std::size_t gradient_bytes() const;

    // A texture is written while the other pair may still be drawn from, and a pixel buffer is read by the GPU some
    // time later; three of them cover a GPU two frames behind.
    struct Pair {
        Texture displacement, gradient;
    };
    struct PixelBuffer {
        Buffer buffer;
        GLsync done = nullptr;
    };

    const Functions& gl_;
    int resolution_;
    std::array<Pair, 2> pairs_;
    std::array<PixelBuffer, 3> ring_;
    std::size_t pair_ = 0, next_buffer_ = 0;
    double driver_ms_ = 0;
};

}  // namespace pelagic::gl
