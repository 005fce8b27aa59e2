#include "pelagic/tools/ktx2_file.hpp"

#include <array>
#include <cassert>
#include <numeric>
#include <string_view>

#include "pelagic/tools/little_endian.hpp"
#include "pelagic/tools/zstd.hpp"

namespace pelagic::tools {
namespace {

constexpr std::array<unsigned char, 12> identifier = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                      '0',  0xBB, '\r', '\n', 0x1A, '\n'};

// Lengths of the parts in front of the data.
constexpr std::size_t header_bytes = 80, level_index_entry_bytes = 24;

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

/// What a channel's lowest and highest number stand for, 0 and 1 or -1 and 1 (Khronos Data Format 1.4, sampleLower).
struct SampleRange {
    std::uint32_t lower, upper;
};

SampleRange range_of(TexelSample sample) {
    switch (sample) {
        case TexelSample::unorm8: return {0, 0xFF};
        case TexelSample::unorm16: return {0, 0xFFFF};
        case TexelSample::half:
        case TexelSample::float32: return {0xBF800000, 0x3F800000};  // -1 and 1 as binary32, for halves too
    }
    return {};
}

/// The texel's layout in words of its own (Khronos Data Format 1.4, basic descriptor block).
std::vector<unsigned char> data_format_descriptor(const Texture& texture) {
    constexpr std::uint32_t version = 2, model_rgbsda = 1, transfer_linear = 1;
    constexpr std::uint32_t qualifier_signed = 0x40, qualifier_float = 0x80;
    const auto channels = static_cast<std::uint32_t>(texture.channels);
    const auto sample_bytes = static_cast<std::uint32_t>(size_of(texture.sample));
    const std::uint32_t block_bytes = 24 + 16 * channels;
    const bool is_float = texture.sample == TexelSample::half || texture.sample == TexelSample::float32;
    const SampleRange range = range_of(texture.sample);

    LittleEndianBytes words;
    words.add_u32(4 + block_bytes);
    words.add_u32(0);  // Khronos' own basic descriptor
    words.add_u32(version | block_bytes << 16);
    words.add_u32(model_rgbsda | transfer_linear << 16);
    words.add_u32(0);  // blocks of one texel
    words.add_u32(channels * sample_bytes);
    words.add_u32(0);
    for (std::uint32_t channel = 0; channel < channels; ++channel) {
        constexpr std::uint32_t alpha = 15;
        const std::uint32_t type =
            (channel == 3 ? alpha : channel) | (is_float ? qualifier_signed | qualifier_float : 0);
        const std::uint32_t bits = 8 * sample_bytes;
        words.add_u32(channel * bits | (bits - 1) << 16 | type << 24);
        words.add_u32(0);  // at the texel's own place
        words.add_u32(range.lower);
        words.add_u32(range.upper);
    }
    return words.take();
}

void add_pair(LittleEndianBytes& pairs, std::string_view key, std::string_view value) {
    pairs.add_u32(static_cast<std::uint32_t>(key.size() + value.size() + 2));
    pairs.add_text(key);
    pairs.add_text(value);
    pairs.pad_to(4);
}

/// In the order of their keys, as the format wants them.
std::vector<unsigned char> key_value_data() {
    LittleEndianBytes pairs;
    add_pair(pairs, "KTXorientation", "rd");
    add_pair(pairs, "KTXwriter", "pelagic " PELAGIC_VERSION);
    return pairs.take();
}

struct StoredLevel {
    std::span<const unsigned char> bytes;
    std::size_t offset = 0;
};

}  // namespace

std::vector<unsigned char> ktx2_file(const Texture& texture, Supercompression supercompression) {
    assert(check(texture).empty());
    std::vector<std::vector<unsigned char>> frames;
    std::vector<StoredLevel> levels;
    for (const std::span<const unsigned char> level : texture.levels) {
        if (supercompression == Supercompression::zstd) frames.push_back(zstd_frame(level));
        levels.push_back({supercompression == Supercompression::zstd ? frames.back() : level});
    }

    const std::vector<unsigned char> descriptor = data_format_descriptor(texture), pairs = key_value_data();
    const std::size_t descriptor_offset = header_bytes + level_index_entry_bytes * levels.size();
    const std::size_t pairs_offset = descriptor_offset + descriptor.size();
    // Levels as they are can be handed to a graphics interface where they lie, so they are aligned to texels and words.
    const auto texel_bytes = static_cast<std::size_t>(texture.channels * size_of(texture.sample));
    const std::size_t alignment =
        supercompression == Supercompression::none ? std::lcm(texel_bytes, std::size_t{4}) : 1;
    std::size_t end = pairs_offset + pairs.size();
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
        level->offset = (end + alignment - 1) / alignment * alignment;
        end = level->offset + level->bytes.size();
    }

    LittleEndianBytes file;
    file.add(identifier);
    file.add_u32(vulkan_format(texture));
    file.add_u32(static_cast<std::uint32_t>(size_of(texture.sample)));
    file.add_u32(static_cast<std::uint32_t>(texture.width));
    file.add_u32(static_cast<std::uint32_t>(texture.height));
    file.add_u32(0);  // no depth: two dimensions
    file.add_u32(0);  // no array
    file.add_u32(1);  // no cube
    file.add_u32(static_cast<std::uint32_t>(levels.size()));
    file.add_u32(supercompression == Supercompression::zstd ? 2 : 0);
    file.add_u32(static_cast<std::uint32_t>(descriptor_offset));
    file.add_u32(static_cast<std::uint32_t>(descriptor.size()));
    file.add_u32(static_cast<std::uint32_t>(pairs_offset));
    file.add_u32(static_cast<std::uint32_t>(pairs.size()));
    file.add_u64(0);  // no data that all levels share
    file.add_u64(0);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        file.add_u64(levels[level].offset);
        file.add_u64(levels[level].bytes.size());
        file.add_u64(texture.levels[level].size());
    }
    file.add(descriptor);
    file.add(pairs);
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
        file.pad_to(alignment);
        file.add(level->bytes);
    }
    return file.take();
}

}  // namespace pelagic::tools
