#include "pelagic/gl/pixel_ring.hpp"

#include "pelagic/gl/errors.hpp"
#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/sim/texture_targets.hpp"

namespace pelagic::gl {

PixelRing::PixelRing(const Functions& gl, std::size_t bytes) : gl_(gl), bytes_(bytes + TextureTargets::alignment) {
    if (!gl.maps_buffers) {
        memory_.resize(bytes_);
        return;
    }
    const GlStateGuard keep(gl);
    for (PixelBuffer& pixels : ring_) {
        pixels.buffer = Buffer(gl);
        gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, pixels.buffer.name());
        gl.BufferData(GL_PIXEL_UNPACK_BUFFER, static_cast<GLsizeiptr>(bytes_), nullptr, GL_STREAM_DRAW);
    }
}

PixelRing::~PixelRing() {
    for (PixelBuffer& pixels : ring_)
        if (pixels.done) gl_.DeleteSync(pixels.done);
}

std::byte* PixelRing::map_buffer(PixelBuffer& pixels) {
    if (pixels.done) {
        constexpr GLuint64 a_second_ns = 1'000'000'000;
        if (gl_.ClientWaitSync(pixels.done, GL_SYNC_FLUSH_COMMANDS_BIT, a_second_ns) == GL_WAIT_FAILED)
            check_context(gl_);
        gl_.DeleteSync(pixels.done);
        pixels.done = nullptr;
    }
    gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, pixels.buffer.name());
    // The fence has been signalled, so the GPU no longer reads the buffer.
    void* const start =
        gl_.MapBufferRange(GL_PIXEL_UNPACK_BUFFER, 0, static_cast<GLsizeiptr>(bytes_),
                           GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT | GL_MAP_UNSYNCHRONIZED_BIT);
    if (!start) {
        check_context(gl_);
        throw GlError("the driver maps no pixel buffer; is it out of memory?");
    }
    return static_cast<std::byte*>(start);
}

std::byte* PixelRing::map() {
    if (mapped_) return mapped_;
    std::byte* const start = gl_.maps_buffers ? map_buffer(ring_[next_]) : memory_.data();
    const std::size_t beyond = reinterpret_cast<std::uintptr_t>(start) % TextureTargets::alignment;
    offset_ = beyond == 0 ? 0 : TextureTargets::alignment - beyond;
    mapped_ = start + offset_;
    return mapped_;
}

std::uintptr_t PixelRing::hand_over() {
    const auto address = reinterpret_cast<std::uintptr_t>(mapped_);
    mapped_ = nullptr;
    if (!gl_.maps_buffers) return address;
    gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, ring_[next_].buffer.name());
    gl_.UnmapBuffer(GL_PIXEL_UNPACK_BUFFER);
    return offset_;
}

void PixelRing::release() {
    if (!gl_.maps_buffers) return;
    ring_[next_].done = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    next_ = (next_ + 1) % ring_.size();
}

}  // namespace pelagic::gl
