#include "pelagic/gl/water/dynamic_wave_textures.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/cascade.hpp"
#include "pelagic/simd/half_float.hpp"

namespace pelagic::gl {
namespace {

constexpr std::size_t texel_bytes = 2 * sizeof(std::uint32_t);

/// A row of the grid with its neighbours.
struct Rows {
    const float *before, *here, *after;
    const std::uint8_t* foam;
};

/// Packs a texel into two words. Compilers vectorise loops over this function.
void pack_texel(const Rows& rows, std::size_t i, std::size_t left, std::size_t right, float half_a_texel,
                std::uint32_t* to) {
    to[2 * i] = half_of(rows.here[i]) | half_of((rows.here[right] - rows.here[left]) * half_a_texel) << 16;
    to[2 * i + 1] = half_of((rows.after[i] - rows.before[i]) * half_a_texel) |
                    half_of(static_cast<float>(rows.foam[i]) * (1.f / 255)) << 16;
}

}  // namespace

std::string check(const DynamicWavesView& water, int largest_side) {
    const auto invalid = [](const char* what, auto value, const std::string& needs) {
        return invalid_value_message("Frame::dynamic_waves." + std::string(what), value, needs);
    };
    if (!water) return {};
    if (water.resolution > largest_side || std::popcount(static_cast<unsigned>(water.resolution)) != 1)
        return invalid("resolution", water.resolution,
                       "a power of two up to the driver's " + std::to_string(largest_side));
    if (!(water.texel_m > 0) || !std::isfinite(water.texel_m)) return invalid("texel_m", water.texel_m, "(0, inf)");
    const std::size_t texels =
        static_cast<std::size_t>(water.resolution) * static_cast<std::size_t>(water.resolution);
    const std::string all = "resolution^2, " + std::to_string(texels);
    if (water.height_m.size() != texels) return invalid("height_m.size()", water.height_m.size(), all);
    if (water.foam.size() != texels) return invalid("foam.size()", water.foam.size(), all);
    return {};
}

void pack(const DynamicWavesView& water, std::span<std::uint32_t> words) {
    const auto n = static_cast<std::size_t>(water.resolution);
    const auto half_a_texel = static_cast<float>(0.5 / water.texel_m);
    const auto row_at = [&](std::size_t row) { return water.height_m.data() + (row & (n - 1)) * n; };
    for (std::size_t row = 0; row < n; ++row) {
        const Rows rows{row_at(row + n - 1), row_at(row), row_at(row + 1), water.foam.data() + row * n};
        std::uint32_t* const to = words.data() + 2 * n * row;
        for (std::size_t i = 1; i + 1 < n; ++i) pack_texel(rows, i, i - 1, i + 1, half_a_texel, to);
        for (const std::size_t i : {std::size_t{0}, n - 1})
            pack_texel(rows, i, (i + n - 1) & (n - 1), (i + 1) & (n - 1), half_a_texel, to);
    }
}

DynamicWaveTextures::DynamicWaveTextures(const Functions& gl) : gl_(gl) {
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_side_);
}

void DynamicWaveTextures::make_textures(int resolution) {
    resolution_ = resolution;
    const auto side = static_cast<std::size_t>(resolution);
    pixels_.emplace(gl_, texel_bytes * side * side);
    for (Texture& texture : sets_) {
        texture = Texture(gl_);
        gl_.BindTexture(GL_TEXTURE_2D, texture.name());
        gl_.TexStorage2D(GL_TEXTURE_2D, gl_.renders_to_half_floats ? mip_levels(resolution) : 1, GL_RGBA16F,
                         resolution, resolution);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                          gl_.renders_to_half_floats ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    }
}

void DynamicWaveTextures::upload(const DynamicWavesView& water) {
    uploaded_bytes_ = 0;
    driver_ms_ = 0;
    if (!water) return;
    const GlStateGuard keep(gl_);
    if (water.resolution != resolution_) make_textures(water.resolution);
    const auto words = std::size_t{2} * static_cast<std::size_t>(resolution_) * static_cast<std::size_t>(resolution_);
    // Mapped GL buffers have the alignment that TextureTargets require.
    pack(water, {reinterpret_cast<std::uint32_t*>(pixels_->map()), words});
    const std::uintptr_t texels = pixels_->hand_over();
    set_ = 1 - set_;

    const Stopwatch driver;
    gl_.BindTexture(GL_TEXTURE_2D, sets_[set_].name());
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, resolution_, resolution_, GL_RGBA, GL_HALF_FLOAT,
                      reinterpret_cast<const void*>(texels));
    if (gl_.renders_to_half_floats) gl_.GenerateMipmap(GL_TEXTURE_2D);
    pixels_->release();
    driver_ms_ = driver.milliseconds();
    uploaded_bytes_ = sizeof(std::uint32_t) * words;
}

}  // namespace pelagic::gl
