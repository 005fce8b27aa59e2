// Where texels wait for their way into textures: a ring of pixel buffers that the driver maps, so that neither the application nor the
// GPU waits for the other. Where buffers can't be mapped (WebGL) it is plain memory, of which GL takes a copy at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/gl/objects.hpp"

namespace pelagic::gl {

class PixelRing {
   public:
    /// \param bytes  that map() gives
    PixelRing(const Functions& gl, std::size_t bytes);
    ~PixelRing();
    PixelRing(const PixelRing&) = delete;
    PixelRing& operator=(const PixelRing&) = delete;

    /// The next bytes to write, as aligned as TextureTargets have to be; the same ones until hand_over(). Waits only if the GPU is three
    /// frames behind. Throws GlError. \pre a GlStateGuard stands around this call and those below
    std::byte* map();
    bool is_mapped() const { return mapped_ != nullptr; }
    /// What was written is whole. Returns what GL's calls take for the address of its first byte until release(), a pointer or an
    /// offset in the buffer that is bound as GL_PIXEL_UNPACK_BUFFER.
    std::uintptr_t hand_over();
    /// All calls that read it have been made.
    void release();

   private:
    struct PixelBuffer {
        Buffer buffer;
        GLsync done = nullptr;  ///< the GPU has read it
    };
    std::byte* map_buffer(PixelBuffer& pixels);

    const Functions& gl_;
    std::size_t bytes_;                ///< with room to align them: GL ES promises no alignment of what it maps
    std::array<PixelBuffer, 3> ring_;  ///< read by the GPU some time later; three cover a GPU two frames behind
    std::vector<std::byte> memory_;    ///< instead of the ring
    std::byte* mapped_ = nullptr;      ///< aligned
    std::size_t offset_ = 0;           ///< of mapped_, in its buffer
    std::size_t next_ = 0;
};

}  // namespace pelagic::gl
