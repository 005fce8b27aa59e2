#include "pelagic/tools/encode/texture.hpp"

#include <array>
#include <cassert>
#include <initializer_list>

#include "pelagic/tools/files/byte_order.hpp"

namespace pelagic::tools {
namespace {

constexpr std::array<unsigned char, 4> dds_magic = {'D', 'D', 'S', ' '}, dx10 = {'D', 'X', '1', '0'};

// DDS_HEADER.dwFlags and dwCaps, DDS_PIXELFORMAT.dwFlags.
constexpr std::uint32_t has_caps = 0x1, has_height = 0x2, has_width = 0x4, has_pitch = 0x8, has_pixel_format = 0x1000,
                        has_level_count = 0x20000;
constexpr std::uint32_t caps_complex = 0x8, caps_texture = 0x1000, caps_mipmapped = 0x400000;
constexpr std::uint32_t has_four_letters = 0x4;
// DDS_HEADER_DXT10.
constexpr std::uint32_t two_dimensions = 3, alpha_is_custom = 4, alpha_is_absent = 0;

/// DXGI_FORMAT of 1, 2 and 4 channels.
std::uint32_t dxgi_format(const Texture& texture) {
    constexpr std::array<std::array<std::uint32_t, 3>, 4> formats = {{
        {61, 49, 28},  // DXGI_FORMAT_R8_UNORM, R8G8_UNORM, R8G8B8A8_UNORM
        {56, 35, 11},  // DXGI_FORMAT_R16_UNORM, R16G16_UNORM, R16G16B16A16_UNORM
        {54, 34, 10},  // DXGI_FORMAT_R16_FLOAT, R16G16_FLOAT, R16G16B16A16_FLOAT
        {41, 16, 2},   // DXGI_FORMAT_R32_FLOAT, R32G32_FLOAT, R32G32B32A32_FLOAT
    }};
    return formats[static_cast<std::size_t>(texture.sample)][static_cast<std::size_t>(texture.channels) / 2];
}

void append_zeros(Bytes& bytes, std::size_t words) { bytes.resize(bytes.size() + 4 * words); }

}  // namespace

Bytes dds_file(const Texture& texture) {
    assert(check(texture).empty());
    const bool has_levels = texture.levels.size() > 1;
    const auto width = static_cast<std::size_t>(texture.width), height = static_cast<std::size_t>(texture.height);
    Bytes file(dds_magic.begin(), dds_magic.end());
    // DDS_HEADER, 124 bytes
    append_words(file, {124, has_caps | has_height | has_width | has_pitch | has_pixel_format |
                                 (has_levels ? has_level_count : 0)});
    append_words(file, {height, width, width * bytes_of_texel(texture), 0, texture.levels.size()});
    append_zeros(file, 11);
    // DDS_PIXELFORMAT, 32 bytes: "DX10" refers to the next header
    append_words(file, {32, has_four_letters});
    file.insert(file.end(), dx10.begin(), dx10.end());
    append_zeros(file, 5);
    append_words(file, {caps_texture | (has_levels ? caps_complex | caps_mipmapped : 0)});
    append_zeros(file, 4);
    // DDS_HEADER_DXT10: not a cube map, array size 1
    append_words(file, {dxgi_format(texture), two_dimensions, 0, 1});
    append_words(file, {texture.channels == 4 ? alpha_is_custom : alpha_is_absent});
    for (const std::span<const unsigned char> level : texture.levels)
        file.insert(file.end(), level.begin(), level.end());
    return file;
}

}  // namespace pelagic::tools
