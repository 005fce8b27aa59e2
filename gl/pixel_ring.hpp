// Staging memory for texture uploads: a ring of mapped pixel buffers. With a ring, neither the
// application nor the GPU waits for the other. If buffers cannot be mapped (WebGL), the staging
// memory is plain CPU memory, which GL copies during the upload call.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/gl/objects.hpp"

namespace pelagic::gl {

class PixelRing {
   public:
    /// \param bytes  size of the memory that map() returns
    PixelRing(const Functions& gl, std::size_t bytes);
    ~PixelRing();
    PixelRing(const PixelRing&) = delete;
    PixelRing& operator=(const PixelRing&) = delete;

    /// Maps the next buffer and returns its address, aligned to TextureTargets::alignment. Returns
    /// the same address until hand_over(). Waits, for at most 1 s, only if the GPU is three frames
    /// behind.
    /// \pre a GlStateGuard exists in an enclosing scope; also for hand_over() and release()
    /// \throws GlError if the driver does not map the buffer
    std::byte* map();
    /// Returns whether a buffer is mapped.
    bool is_mapped() const { return mapped_ != nullptr; }
    /// Ends writing and unmaps the buffer. Returns the data address for GL's upload calls, valid
    /// until release(): an offset in the bound GL_PIXEL_UNPACK_BUFFER, or a pointer to CPU memory.
    std::uintptr_t hand_over();
    /// Advances to the next buffer, after the last upload call that reads this one.
    void release();

   private:
    struct PixelBuffer {
        Buffer buffer;
        GLsync done = nullptr;  ///< signalled when the GPU has read the buffer
    };
    std::byte* map_buffer(PixelBuffer& pixels);

    const Functions& gl_;
    /// Size of a buffer with padding: GL ES does not guarantee the alignment of mapped memory.
    std::size_t bytes_;
    std::array<PixelBuffer, 3> ring_;  ///< three buffers, for a GPU that is two frames behind
    std::vector<std::byte> memory_;    ///< replaces the ring if buffers cannot be mapped
    std::byte* mapped_ = nullptr;      ///< aligned
    std::size_t offset_ = 0;           ///< offset of mapped_ in its buffer
    std::size_t next_ = 0;
};

}  // namespace pelagic::gl
