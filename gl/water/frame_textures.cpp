#include "pelagic/gl/water/frame_textures.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "pelagic/gl/errors.hpp"
#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/message/require.hpp"

namespace pelagic::gl {
namespace {

const void* texels_at(std::uintptr_t address) { return reinterpret_cast<const void*>(address); }

Texture make_texture_array(const Functions& gl, GLenum format, int side, GLsizei layers, int levels) {
    Texture texture(gl);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
    gl.TexStorage3D(GL_TEXTURE_2D_ARRAY, levels, format, side, side, layers);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_REPEAT);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    return texture;
}

bool shows_foam(const Frame& frame) {
    return std::any_of(frame.cascades.begin(), frame.cascades.end(),
                       [](const Cascade& cascade) { return !cascade.snapshots_rgba8[0].empty(); });
}

/// Returns an empty string if the frame can be uploaded, else the reason.
std::string invalid_value_of(const Frame& frame, int resolution, std::size_t cascades, bool is_mapped) {
    if (frame.cascades.size() != cascades)
        return "the frame has " + std::to_string(frame.cascades.size()) + " cascades, the renderer was made for " +
               std::to_string(cascades) + " (RendererOptions::cascades)";
    for (const Cascade& cascade : frame.cascades) {
        if (cascade.resolution() != resolution)
            return "the frame has cascades of " + std::to_string(cascade.resolution()) +
                   " texels, the renderer was made for " + std::to_string(resolution) +
                   " (RendererOptions::resolution)";
        const bool is_elsewhere = cascade.displacement_rgba16f.empty();
        const bool is_torn = is_elsewhere && !(cascade.slopes_rgba8.empty() && cascade.moments_rgba8.empty());
        if (is_elsewhere && (!is_mapped || is_torn))
            return "the frame's textures are in memory that FrameTextures::map() did not return";
        if (cascade.slopes_rgba8.empty() && !is_elsewhere)
            return "the frame has no slopes; drawing needs an ocean with OceanOptions::slopes";
    }
    return {};
}

}  // namespace

FrameTextures::FrameTextures(const Functions& gl, int resolution, std::size_t cascades)
    : gl_(gl),
      resolution_(resolution),
      cascades_(cascades),
      pixels_(gl, foam_offset() + SnapshotFoam::images * image_bytes()) {
    const GlStateGuard keep(gl);
    const int levels = mip_levels(resolution);
    for (Set& set : sets_) {
        set.displacement =
            make_texture_array(gl, GL_RGBA16F, resolution, layers(), has_displacement_mips() ? levels : 1);
        set.slopes = make_texture_array(gl, GL_RGBA8, resolution, layers(), levels);
        set.moments = make_texture_array(gl, GL_RGBA8, resolution, layers(), levels);
        set.snapshots = make_texture_array(gl, GL_RGBA8, resolution,
                                           static_cast<GLsizei>(SnapshotFoam::images * foam_cascades()), levels);
    }
}

std::size_t FrameTextures::displacement_bytes() const {
    return std::size_t{8} * resolution_ * resolution_ * cascades_;
}

std::size_t FrameTextures::chain_bytes() const {
    return sizeof(std::uint32_t) * mip_offset(resolution_, mip_levels(resolution_)) * cascades_;
}

/// Copies chains level by level, so that one GL call uploads a level of all cascades. A cascade
/// without the chain leaves its layer unchanged in memory. Returns the end of the copies.
/// \param chain  function from a cascade to its chain
template <class Chain>
std::byte* FrameTextures::fill_chains(std::byte* to, std::span<const Cascade> cascades, Chain chain) const {
    for (int level = 0; level < mip_levels(resolution_); ++level)
        for (const Cascade& cascade : cascades) {
            const std::span<const std::uint32_t> texels = chain(cascade);
            const auto side = static_cast<std::size_t>(resolution_ >> level);
            if (!texels.empty())
                std::memcpy(to, cascade.level_of(texels, level).data(), side * side * sizeof(std::uint32_t));
            to += side * side * sizeof(std::uint32_t);
        }
    return to;
}

/// Copies the displacement of all cascades, then their slopes, then their moments.
void FrameTextures::fill(std::byte* to, const Frame& frame) const {
    fill_chains(to + displacement_bytes(), frame.cascades, [](const Cascade& of) { return of.slopes_rgba8; });
    fill_chains(to + displacement_bytes() + chain_bytes(), frame.cascades,
                [](const Cascade& of) { return of.moments_rgba8; });
    for (const Cascade& cascade : frame.cascades) {
        std::memcpy(to, cascade.displacement_rgba16f.data(), cascade.displacement_rgba16f.size_bytes());
        to += cascade.displacement_rgba16f.size_bytes();
    }
}

void FrameTextures::upload_chain(GLuint texture, std::size_t first_layer, std::size_t layers,
                                 std::uintptr_t address) const {
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, texture);
    for (int level = 0; level < mip_levels(resolution_); ++level) {
        const int side = resolution_ >> level;
        gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, static_cast<GLint>(first_layer), side, side,
                          static_cast<GLsizei>(layers), GL_RGBA, GL_UNSIGNED_BYTE, texels_at(address));
        address += sizeof(std::uint32_t) * static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * layers;
    }
}

bool FrameTextures::has_changed(const Set& set, const Frame& frame, std::size_t image) const {
    for (std::size_t cascade = 0; cascade < foam_cascades(); ++cascade)
        if (set.versions[cascade][image] != frame.cascades[cascade].snapshots_version[image]) return true;
    return false;
}

std::span<const TextureTargets> FrameTextures::map() {
    if (pixels_.is_mapped()) return targets_;
    const GlStateGuard keep(gl_);
    std::byte* const start = pixels_.map();
    targets_.assign(cascades_, {});
    const std::size_t halves = displacement_bytes() / sizeof(std::uint16_t) / cascades_;
    for (std::size_t cascade = 0; cascade < cascades_; ++cascade) {
        TextureTargets& to = targets_[cascade];
        to.displacement_rgba16f = reinterpret_cast<std::uint16_t*>(start) + cascade * halves;
        auto* texels = reinterpret_cast<std::uint32_t*>(start + displacement_bytes());
        for (auto chain : {&TextureTargets::slopes_rgba8, &TextureTargets::moments_rgba8})
            for (std::size_t level = 0; level < static_cast<std::size_t>(mip_levels(resolution_)); ++level) {
                const std::size_t layer = std::size_t{1}
                                          << 2 * (mip_levels(resolution_) - 1 - static_cast<int>(level));
                (to.*chain)[level] = texels + cascade * layer;
                texels += cascades_ * layer;
            }
    }
    return targets_;
}

void FrameTextures::upload(const Frame& frame) {
    require(invalid_value_of(frame, resolution_, cascades_, pixels_.is_mapped()));
    const GlStateGuard keep(gl_);
    const bool is_there = frame.cascades.front().displacement_rgba16f.empty();
    std::byte* const start = pixels_.map();
    if (!is_there) fill(start, frame);
    has_foam_ = shows_foam(frame);
    set_ = 1 - set_;
    Set& set = sets_[set_];
    std::array<bool, SnapshotFoam::images> is_new{};
    std::byte* end = start + foam_offset();
    for (std::size_t image = 0; has_foam_ && image < SnapshotFoam::images; ++image)
        if ((is_new[image] = has_changed(set, frame, image)))
            end = fill_chains(end, frame.cascades.first(foam_cascades()),
                              [image](const Cascade& of) { return of.snapshots_rgba8[image]; });
    uploaded_bytes_ = static_cast<std::size_t>(end - start);
    const std::uintptr_t texels = pixels_.hand_over();

    const Stopwatch driver;
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, displacement());
    gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, resolution_, resolution_, layers(), GL_RGBA, GL_HALF_FLOAT,
                      texels_at(texels));
    if (has_displacement_mips()) gl_.GenerateMipmap(GL_TEXTURE_2D_ARRAY);
    upload_chain(slopes(), 0, cascades_, texels + displacement_bytes());
    upload_chain(moments(), 0, cascades_, texels + displacement_bytes() + chain_bytes());
    std::uintptr_t snapshots_at = texels + foam_offset();
    for (std::size_t image = 0; image < SnapshotFoam::images; ++image) {
        if (!is_new[image]) continue;
        upload_chain(snapshots(), image * foam_cascades(), foam_cascades(), snapshots_at);
        snapshots_at += image_bytes();
        for (std::size_t cascade = 0; cascade < foam_cascades(); ++cascade)
            set.versions[cascade][image] = frame.cascades[cascade].snapshots_version[image];
    }
    pixels_.release();
    driver_ms_ = driver.milliseconds();
}

}  // namespace pelagic::gl
