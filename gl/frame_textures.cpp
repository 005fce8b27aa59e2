#include "pelagic/gl/frame_textures.hpp"

#include <cassert>
#include <cstring>

#include "pelagic/gl/errors.hpp"
#include "pelagic/gl/kept_state.hpp"
#include "pelagic/gl/stopwatch.hpp"

namespace pelagic::gl {
namespace {

const void* buffer_offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

Texture make_texture(const Functions& gl, GLenum format, int side, int levels) {
    Texture texture(gl);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    gl.TexStorage2D(GL_TEXTURE_2D, levels, format, side, side);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    return texture;
}

}  // namespace

FrameTextures::FrameTextures(const Functions& gl, int resolution) : gl_(gl), resolution_(resolution) {
    const KeptState keep(gl);
    const int levels = mip_levels(resolution);
    for (Pair& pair : pairs_) {
        pair.displacement = make_texture(gl, GL_RGBA16F, resolution, has_displacement_mips() ? levels : 1);
        pair.gradient = make_texture(gl, GL_RGBA8, resolution, levels);
    }
    for (PixelBuffer& pixels : ring_) {
        pixels.buffer = Buffer(gl);
        gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, pixels.buffer.name());
        gl.BufferData(GL_PIXEL_UNPACK_BUFFER, static_cast<GLsizeiptr>(bytes_per_frame()), nullptr, GL_STREAM_DRAW);
    }
}

FrameTextures::~FrameTextures() {
    for (PixelBuffer& pixels : ring_)
        if (pixels.done) gl_.DeleteSync(pixels.done);
}

std::size_t FrameTextures::gradient_bytes() const {
    return sizeof(std::uint32_t) * mip_offset(resolution_, mip_levels(resolution_));
}

void FrameTextures::upload(const Frame& frame) {
    assert(frame.tiles[0].resolution() == resolution_ && "the textures were made for another resolution");
    const KeptState keep(gl_);
    PixelBuffer& pixels = ring_[next_buffer_];
    next_buffer_ = (next_buffer_ + 1) % ring_.size();
    pair_ = 1 - pair_;

    if (pixels.done) {
        constexpr GLuint64 a_second_ns = 1'000'000'000;
        if (gl_.ClientWaitSync(pixels.done, GL_SYNC_FLUSH_COMMANDS_BIT, a_second_ns) == GL_WAIT_FAILED)
            check_context(gl_);
        gl_.DeleteSync(pixels.done);
        pixels.done = nullptr;
    }
    gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, pixels.buffer.name());
    // The fence has said that nobody reads it.
    auto* to = static_cast<std::byte*>(
        gl_.MapBufferRange(GL_PIXEL_UNPACK_BUFFER, 0, static_cast<GLsizeiptr>(bytes_per_frame()),
                           GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT | GL_MAP_UNSYNCHRONIZED_BIT));
    if (!to) {
        check_context(gl_);
        throw GlError("the driver maps no pixel buffer; is it out of memory?");
    }
    std::memcpy(to, frame.tiles[0].displacement_rgba16f.data(), displacement_bytes());
    std::memcpy(to + displacement_bytes(), frame.tiles[0].gradient_rgba8.data(), gradient_bytes());
    gl_.UnmapBuffer(GL_PIXEL_UNPACK_BUFFER);

    const Stopwatch driver;
    gl_.BindTexture(GL_TEXTURE_2D, displacement());
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, resolution_, resolution_, GL_RGBA, GL_HALF_FLOAT, nullptr);
    if (has_displacement_mips()) gl_.GenerateMipmap(GL_TEXTURE_2D);
    gl_.BindTexture(GL_TEXTURE_2D, gradient());
    for (int level = 0; level < mip_levels(resolution_); ++level) {
        const std::size_t offset = displacement_bytes() + sizeof(std::uint32_t) * mip_offset(resolution_, level);
        gl_.TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, resolution_ >> level, resolution_ >> level, GL_RGBA,
                          GL_UNSIGNED_BYTE, buffer_offset(offset));
    }
    pixels.done = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    driver_ms_ = driver.milliseconds();
}

}  // namespace pelagic::gl
