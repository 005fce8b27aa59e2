#include "pelagic/tools/encode/texture.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <initializer_list>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>

#include "pelagic/simd/half_float.hpp"
#include "pelagic/tools/files/byte_order.hpp"
#include "pelagic/tools/files/zstd.hpp"

namespace pelagic::tools {
namespace {

constexpr std::array<unsigned char, 12> identifier = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                      '0',  0xBB, '\r', '\n', 0x1A, '\n'};

// Sizes of the sections before the data.
constexpr std::size_t header_bytes = 80, level_index_entry_bytes = 24;
constexpr std::uint32_t zstd_scheme = 2;

/// VkFormat of 1, 2 and 4 channels (Vulkan 1.0).
std::uint32_t vulkan_format(const Texture& texture) {
    constexpr std::array<std::array<std::uint32_t, 3>, 4> formats = {{
        {9, 16, 37},      // VK_FORMAT_R8_UNORM, R8G8_UNORM, R8G8B8A8_UNORM
        {70, 77, 91},     // VK_FORMAT_R16_UNORM, R16G16_UNORM, R16G16B16A16_UNORM
        {76, 83, 97},     // VK_FORMAT_R16_SFLOAT, R16G16_SFLOAT, R16G16B16A16_SFLOAT
        {100, 103, 109},  // VK_FORMAT_R32_SFLOAT, R32G32_SFLOAT, R32G32B32A32_SFLOAT
    }};
    return formats[static_cast<std::size_t>(texture.sample)][static_cast<std::size_t>(texture.channels) / 2];
}

/// Lowest and highest value of a channel, 0 and 1 or -1 and 1 (Khronos Data Format 1.4,
/// sampleLower).
struct SampleRange {
    std::uint32_t lower, upper;
};

SampleRange range_of(Sample sample) {
    switch (sample) {
        case Sample::uint8: return {0, 0xFF};
        case Sample::uint16: return {0, 0xFFFF};
        case Sample::half:
        // -1 and 1 as binary32, also for halves
        case Sample::float32: return {0xBF800000, 0x3F800000};
    }
    return {};
}

void append_long_words(Bytes& bytes, std::initializer_list<std::size_t> words) {
    for (const std::size_t word : words) append_little_endian(bytes, static_cast<std::uint64_t>(word));
}

/// Returns the description of the texel layout (Khronos Data Format 1.4, basic descriptor block).
Bytes data_format_descriptor(const Texture& texture) {
    constexpr std::size_t version = 2, model_rgbsda = 1, transfer_linear = 1;
    constexpr std::size_t qualifiers_of_floats = 0xC0;  // signed, float
    constexpr std::size_t alpha = 15;
    const auto channels = static_cast<std::size_t>(texture.channels);
    const std::size_t block_bytes = 24 + 16 * channels, bits = 8 * bytes_of(texture.sample);
    const SampleRange range = range_of(texture.sample);

    Bytes bytes;
    append_words(bytes, {4 + block_bytes});
    append_words(bytes, {0, version | block_bytes << 16});  // vendor Khronos, basic descriptor
    append_words(bytes, {model_rgbsda | transfer_linear << 16});
    append_words(bytes, {0, bytes_of_texel(texture), 0});  // blocks of one texel, in one plane
    for (std::size_t channel = 0; channel < channels; ++channel) {
        const std::size_t type =
            (channel == 3 ? alpha : channel) | (is_floating(texture.sample) ? qualifiers_of_floats : 0);
        append_words(bytes, {channel * bits | (bits - 1) << 16 | type << 24});
        append_words(bytes, {0, range.lower, range.upper});  // sample position: the texel itself
    }
    return bytes;
}

std::size_t padded(std::size_t size, std::size_t alignment) { return (size + alignment - 1) / alignment * alignment; }

void append_pair(Bytes& pairs, std::string_view key, std::string_view value) {
    append_words(pairs, {key.size() + value.size() + 2});
    for (const std::string_view text : {key, value}) {
        pairs.insert(pairs.end(), text.begin(), text.end());
        pairs.push_back(0);
    }
    pairs.resize(padded(pairs.size(), 4));
}

/// Returns the key/value pairs, sorted by key as the format requires.
Bytes key_value_data() {
    Bytes pairs;
    append_pair(pairs, "KTXorientation", "rd");
    append_pair(pairs, "KTXwriter", "pelagic " PELAGIC_VERSION);
    return pairs;
}

struct StoredLevel {
    std::span<const unsigned char> bytes;
    std::size_t offset = 0;
};

}  // namespace

Bytes ktx2_file(const Texture& texture, Supercompression supercompression) {
    assert(check(texture).empty());
    const bool is_compressed = supercompression == Supercompression::zstd;
    std::vector<Bytes> frames;
    std::vector<StoredLevel> levels;
    for (const std::span<const unsigned char> level : texture.levels) {
        if (is_compressed) frames.push_back(zstd_frame(level));
        levels.push_back({is_compressed ? frames.back() : level});
    }

    const Bytes descriptor = data_format_descriptor(texture), pairs = key_value_data();
    const std::size_t descriptor_offset = header_bytes + level_index_entry_bytes * levels.size();
    const std::size_t pairs_offset = descriptor_offset + descriptor.size();
    // Uncompressed levels can be uploaded to a graphics API directly from the file, so they are
    // aligned to texels and 32-bit words.
    const std::size_t alignment = is_compressed ? 1 : std::lcm(bytes_of_texel(texture), std::size_t{4});
    std::size_t end = pairs_offset + pairs.size();
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
        level->offset = padded(end, alignment);
        end = level->offset + level->bytes.size();
    }

    Bytes file(identifier.begin(), identifier.end());
    append_words(file, {vulkan_format(texture), bytes_of(texture.sample)});
    append_words(file, {static_cast<std::size_t>(texture.width), static_cast<std::size_t>(texture.height)});
    // two-dimensional: no depth, no array, no cube map
    append_words(file, {0, 0, 1, levels.size()});
    append_words(file, {is_compressed ? std::size_t{zstd_scheme} : 0});
    append_words(file, {descriptor_offset, descriptor.size(), pairs_offset, pairs.size()});
    append_long_words(file, {0, 0});  // no supercompression global data
    for (std::size_t level = 0; level < levels.size(); ++level)
        append_long_words(file, {levels[level].offset, levels[level].bytes.size(), texture.levels[level].size()});
    file.insert(file.end(), descriptor.begin(), descriptor.end());
    file.insert(file.end(), pairs.begin(), pairs.end());
    file.reserve(end);
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
        file.resize(level->offset);
        file.insert(file.end(), level->bytes.begin(), level->bytes.end());
    }
    return file;
}

std::vector<float> ktx2_channel(std::span<const unsigned char> file, int side, std::size_t channel) {
    const auto piece = [&](std::size_t offset, std::size_t size) {
        if (offset > file.size() || size > file.size() - offset)
            throw std::runtime_error("it ends before its texels");
        return file.subspan(offset, size);
    };
    const auto word_at = [&](std::size_t offset) { return little_endian<std::uint32_t>(piece(offset, 4)); };
    const auto long_word_at = [&](std::size_t offset) { return little_endian<std::uint64_t>(piece(offset, 8)); };
    constexpr std::size_t format_at = 12, width_at = 20, height_at = 24, scheme_at = 44;
    // VK_FORMAT_R16G16B16A16_SFLOAT, R32G32B32A32_SFLOAT
    constexpr std::uint32_t four_halves = 97, four_floats = 109;

    const auto start = piece(0, header_bytes + level_index_entry_bytes);
    if (!std::equal(identifier.begin(), identifier.end(), start.begin()))
        throw std::runtime_error("it is no KTX2 file");
    const std::uint32_t format = word_at(format_at), scheme = word_at(scheme_at);
    const std::uint32_t width = word_at(width_at), height = word_at(height_at);
    if (width != static_cast<std::uint32_t>(side) || height != width)
        throw std::runtime_error("it has " + std::to_string(width) + " x " + std::to_string(height) +
                                 " texels, expected " + std::to_string(side) + " x " + std::to_string(side));
    if (format != four_halves && format != four_floats)
        throw std::runtime_error("its Vulkan format is " + std::to_string(format) +
                                 ", expected four halves or floats");
    if (scheme != 0 && scheme != zstd_scheme)
        throw std::runtime_error("its supercompression scheme is " + std::to_string(scheme) +
                                 ", expected none or Zstandard");

    const std::size_t value_bytes = format == four_halves ? 2 : 4;
    const std::size_t texels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    auto level = piece(long_word_at(header_bytes), long_word_at(header_bytes + 8));
    Bytes content;
    if (scheme == zstd_scheme) level = content = zstd_content(level, texels * 4 * value_bytes);
    if (level.size() != texels * 4 * value_bytes) throw std::runtime_error("its largest level has another size");
    std::vector<float> values(texels);
    for (std::size_t i = 0; i < texels; ++i) {
        const auto value = level.subspan((4 * i + channel) * value_bytes, value_bytes);
        values[i] = format == four_halves ? float_of_half(little_endian<std::uint16_t>(value))
                                          : std::bit_cast<float>(little_endian<std::uint32_t>(value));
    }
    return values;
}

}  // namespace pelagic::tools
