#include "pelagic/gl/frame_textures.hpp"

#include <cstring>
#include <stdexcept>
#include <string>

#include "pelagic/gl/errors.hpp"
#include "pelagic/gl/kept_state.hpp"
#include "pelagic/gl/stopwatch.hpp"

namespace pelagic::gl {
namespace {

const void* buffer_offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

Texture make_texture(const Functions& gl, GLenum format, int side, GLsizei tiles, int levels) {
    Texture texture(gl);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
    gl.TexStorage3D(GL_TEXTURE_2D_ARRAY, levels, format, side, side, tiles);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_REPEAT);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    return texture;
}

/// Why the textures can't take the frame; empty if they can.
std::string refusal_of(const Frame& frame, int resolution, std::size_t tiles) {
    if (frame.tiles.size() != tiles)
        return "the frame has " + std::to_string(frame.tiles.size()) + " tiles, the renderer was made for " +
               std::to_string(tiles) + " (RendererOptions::tiles)";
    for (const Tile& tile : frame.tiles) {
        if (tile.resolution() != resolution)
            return "the frame has tiles of " + std::to_string(tile.resolution()) +
                   " texels, the renderer was made for " + std::to_string(resolution) +
                   " (RendererOptions::resolution)";
        if (tile.slopes_rgba8.empty())
            return "the frame has no slopes; drawing needs an ocean with OceanOptions::slopes";
    }
    return {};
}

}  // namespace

FrameTextures::FrameTextures(const Functions& gl, int resolution, std::size_t tiles)
    : gl_(gl), resolution_(resolution), tiles_(tiles) {
    const KeptState keep(gl);
    const int levels = mip_levels(resolution);
    for (Set& set : sets_) {
        set.displacement = make_texture(gl, GL_RGBA16F, resolution, layers(), has_displacement_mips() ? levels : 1);
        set.slopes = make_texture(gl, GL_RGBA8, resolution, layers(), levels);
        set.moments = make_texture(gl, GL_RGBA8, resolution, layers(), levels);
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

std::size_t FrameTextures::displacement_bytes() const { return std::size_t{8} * resolution_ * resolution_ * tiles_; }

std::size_t FrameTextures::chain_bytes() const {
    return sizeof(std::uint32_t) * mip_offset(resolution_, mip_levels(resolution_)) * tiles_;
}

/// All tiles' displacement, then their slopes, then their moments: level by level, so that one call takes a level of all.
void FrameTextures::fill(std::byte* to, const Frame& frame) const {
    const auto add = [&](const void* from, std::size_t bytes) {
        std::memcpy(to, from, bytes);
        to += bytes;
    };
    const auto add_chains = [&](std::span<const std::uint32_t> Tile::*map) {
        for (int level = 0; level < mip_levels(resolution_); ++level)
            for (const Tile& tile : frame.tiles) {
                const std::size_t texels = std::size_t{1} << 2 * (mip_levels(resolution_) - 1 - level);
                add((tile.*map).data() + mip_offset(resolution_, level), texels * sizeof(std::uint32_t));
            }
    };
    for (const Tile& tile : frame.tiles)
        add(tile.displacement_rgba16f.data(), tile.displacement_rgba16f.size() * sizeof(std::uint16_t));
    add_chains(&Tile::slopes_rgba8);
    add_chains(&Tile::moments_rgba8);
}

void FrameTextures::upload_chain(GLuint texture, std::size_t offset) const {
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, texture);
    for (int level = 0; level < mip_levels(resolution_); ++level) {
        const int side = resolution_ >> level;
        gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, 0, side, side, layers(), GL_RGBA, GL_UNSIGNED_BYTE,
                          buffer_offset(offset));
        offset += sizeof(std::uint32_t) * static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * tiles_;
    }
}

void FrameTextures::upload(const Frame& frame) {
    if (const std::string reason = refusal_of(frame, resolution_, tiles_); !reason.empty())
        throw std::invalid_argument(reason);
    const KeptState keep(gl_);
    PixelBuffer& pixels = ring_[next_buffer_];
    next_buffer_ = (next_buffer_ + 1) % ring_.size();
    set_ = 1 - set_;

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
    fill(to, frame);
    gl_.UnmapBuffer(GL_PIXEL_UNPACK_BUFFER);

    const Stopwatch driver;
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, displacement());
    gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, resolution_, resolution_, layers(), GL_RGBA, GL_HALF_FLOAT,
                      nullptr);
    if (has_displacement_mips()) gl_.GenerateMipmap(GL_TEXTURE_2D_ARRAY);
    upload_chain(slopes(), displacement_bytes());
    upload_chain(moments(), displacement_bytes() + chain_bytes());
    pixels.done = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    driver_ms_ = driver.milliseconds();
}

}  // namespace pelagic::gl
