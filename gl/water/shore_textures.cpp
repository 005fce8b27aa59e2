#include "pelagic/gl/water/shore_textures.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/simd/half_float.hpp"

namespace pelagic::gl {
namespace {

constexpr std::size_t water_bytes = 4 * sizeof(std::uint16_t), reach_bytes = sizeof(std::uint16_t),
                      weight_bytes = sizeof(std::uint32_t);

/// Fills height, slopes and foam. Slopes are central differences. The height is 0 on the edges of
/// the rectangle and beyond.
void fill_water(std::uint16_t* to, const ShoreSurface& shore) {
    const float per_m = static_cast<float>(0.5 / shore.texel_m);
    const std::size_t columns = static_cast<std::size_t>(shore.columns), rows = static_cast<std::size_t>(shore.rows);
    for (std::size_t j = 0; j < rows; ++j) {
        const float* const h = shore.height_m.data() + j * columns;
        const auto from_row = [&](bool is_there, std::ptrdiff_t offset, std::size_t i) {
            return is_there ? h[static_cast<std::ptrdiff_t>(i) + offset * static_cast<std::ptrdiff_t>(columns)] : 0.f;
        };
        for (std::size_t i = 0; i < columns; ++i, to += 4) {
            const float before_x = i > 0 ? h[i - 1] : 0, after_x = i + 1 < columns ? h[i + 1] : 0;
            to[0] = static_cast<std::uint16_t>(half_of(h[i]));
            to[1] = static_cast<std::uint16_t>(half_of((after_x - before_x) * per_m));
            to[2] =
                static_cast<std::uint16_t>(half_of((from_row(j + 1 < rows, 1, i) - from_row(j > 0, -1, i)) * per_m));
            to[3] = static_cast<std::uint16_t>(half_of(static_cast<float>(shore.foam[j * columns + i]) / 255));
        }
    }
}

void make_texture(const Functions& gl, Texture& texture, GLenum format, int columns, int rows, int levels) {
    texture = Texture(gl);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    gl.TexStorage2D(GL_TEXTURE_2D, levels, format, columns, rows);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
}

}  // namespace

void ShoreTextures::make_textures(int columns, int rows) {
    const int levels = has_mips() ? std::bit_width(static_cast<unsigned>(std::max(columns, rows))) : 1;
    make_texture(gl_, weights_, GL_RGBA8, columns, rows, 1);
    for (Set& set : sets_) {
        make_texture(gl_, set.water, GL_RGBA16F, columns, rows, levels);
        make_texture(gl_, set.reach, GL_R16F, columns, rows, 1);
    }
    const std::size_t texels = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    pixels_.emplace(gl_, texels * (weight_bytes + water_bytes + reach_bytes));
    weights_rgba8_.clear();
    columns_ = columns;
    rows_ = rows;
}

void ShoreTextures::upload(const ShoreSurface& shore) {
    driver_ms_ = 0;
    uploaded_bytes_ = 0;
    if (!shore) return;
    const GlStateGuard keep(gl_);
    if (shore.columns != columns_ || shore.rows != rows_) make_textures(shore.columns, shore.rows);

    const std::size_t texels = shore.height_m.size();
    std::byte* const start = pixels_->map();
    // Contents are compared, because another ocean may have other weights at the same address.
    const bool has_new_weights = !std::equal(weights_rgba8_.begin(), weights_rgba8_.end(),
                                             shore.weights_rgba8.begin(), shore.weights_rgba8.end());
    if (has_new_weights) {
        weights_rgba8_.assign(shore.weights_rgba8.begin(), shore.weights_rgba8.end());
        std::memcpy(start, shore.weights_rgba8.data(), shore.weights_rgba8.size_bytes());
    }
    const std::size_t water_at = texels * weight_bytes, reach_at = water_at + texels * water_bytes;
    fill_water(reinterpret_cast<std::uint16_t*>(start + water_at), shore);
    auto* const reaches = reinterpret_cast<std::uint16_t*>(start + reach_at);
    for (std::size_t i = 0; i < texels; ++i) reaches[i] = static_cast<std::uint16_t>(half_of(shore.reach_m[i]));
    const std::uintptr_t address = pixels_->hand_over();
    set_ = 1 - set_;
    uploaded_bytes_ = texels * (water_bytes + reach_bytes + (has_new_weights ? weight_bytes : 0));

    const Stopwatch driver;
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 2);
    const auto send = [&](GLuint texture, GLenum format, GLenum type, std::size_t from) {
        gl_.BindTexture(GL_TEXTURE_2D, texture);
        gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns_, rows_, format, type,
                          reinterpret_cast<const void*>(address + from));
    };
    if (has_new_weights) send(weights(), GL_RGBA, GL_UNSIGNED_BYTE, 0);
    send(reach(), GL_RED, GL_HALF_FLOAT, reach_at);
    send(water(), GL_RGBA, GL_HALF_FLOAT, water_at);
    if (has_mips()) gl_.GenerateMipmap(GL_TEXTURE_2D);
    pixels_->release();
    driver_ms_ = driver.milliseconds();
}

}  // namespace pelagic::gl
