// Bytes of KTX2 and DDS, compared with the values that Khronos and Microsoft publish. Independent
// readers check whole exports at night.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "pelagic/tools/encode/texture.hpp"
#include "pelagic/tools/files/byte_order.hpp"
#include "pelagic/tools/files/zstd.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

std::uint64_t number_at(const Bytes& file, std::size_t offset, std::size_t bytes) {
    EXPECT_LE(offset + bytes, file.size());
    std::uint64_t number = 0;
    for (std::size_t i = bytes; i-- > 0;) number = number << 8 | file.at(offset + i);
    return number;
}

std::vector<std::uint32_t> words_at(const Bytes& file, std::size_t offset, std::size_t count) {
    std::vector<std::uint32_t> words;
    for (std::size_t i = 0; i < count; ++i)
        words.push_back(static_cast<std::uint32_t>(number_at(file, offset + 4 * i, 4)));
    return words;
}

/// A texture with `count` levels, in which neighbouring bytes differ.
class Pixels {
   public:
    Pixels(int width, int height, int channels, Sample sample, int count) {
        texture_ = {.width = width, .height = height, .channels = channels, .sample = sample, .levels = {}};
        for (int level = 0; level < count; ++level) {
            Bytes bytes(bytes_of_level(texture_, level));
            for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(7 * i + 31 * level);
            levels_.push_back(bytes);
        }
        for (const Bytes& level : levels_) texture_.levels.emplace_back(level);
    }
    const Texture& texture() const { return texture_; }
    const Bytes& level(std::size_t number) const { return levels_[number]; }

   private:
    Texture texture_{};
    std::vector<Bytes> levels_;
};

// KTX File Format Specification 2.0, "File Structure"; format numbers from the Vulkan
// specification.
TEST(Ktx2File, HeaderMatchesTheSpecification) {
    const Pixels pixels(8, 4, 4, Sample::half, 4);
    const Bytes file = ktx2_file(pixels.texture(), Supercompression::none);
    const std::array<unsigned char, 12> identifier = {0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32,
                                                      0x30, 0xBB, 0x0D, 0x0A, 0x1A, 0x0A};
    ASSERT_GT(file.size(), 80u);
    EXPECT_EQ(std::memcmp(file.data(), identifier.data(), 12), 0);
    constexpr std::uint32_t r16g16b16a16_sfloat = 97, type_size = 2, descriptor_offset = 80 + 4 * 24,
                            descriptor_size = 92;
    // Orientation: 4 + 15 + 3 bytes and 2 of padding. Writer: 4 + 10 + 14 and no padding.
    constexpr std::uint32_t pairs_size = 24 + 28;
    EXPECT_EQ(words_at(file, 12, 9),
              (std::vector<std::uint32_t>{r16g16b16a16_sfloat, type_size, 8, 4, 0, 0, 1, 4, 0}));
    EXPECT_EQ(words_at(file, 48, 8),
              (std::vector<std::uint32_t>{descriptor_offset, descriptor_size, descriptor_offset + descriptor_size,
                                          pairs_size, 0, 0, 0, 0}));
}

// Khronos Data Format Specification 1.4, "Four co-sited 8-bit sRGB channels", but linear, with
// straight alpha and unspecified primaries, so alpha needs no linear flag.
TEST(Ktx2File, DescribesBytesAsInTheSpecificationsExample) {
    const Bytes file = ktx2_file(Pixels(1, 1, 4, Sample::uint8, 1).texture(), Supercompression::none);
    EXPECT_EQ(words_at(file, 80 + 24, 23), (std::vector<std::uint32_t>{92,
                                                                       0,
                                                                       88 << 16 | 2,
                                                                       0x00'01'00'01,
                                                                       0,
                                                                       4,
                                                                       0,  //
                                                                       0x00'07'0000,
                                                                       0,
                                                                       0,
                                                                       255,
                                                                       0x01'07'0008,
                                                                       0,
                                                                       0,
                                                                       255,
                                                                       0x02'07'0010,
                                                                       0,
                                                                       0,
                                                                       255,
                                                                       0x0F'07'0018,
                                                                       0,
                                                                       0,
                                                                       255}));
}

// As above, "16-bit floating-point": signed and float are bits 30 and 31; the limits are -1 and 1
// as 32-bit floats.
TEST(Ktx2File, DescribesHalvesAsSignedFloats) {
    const Bytes file = ktx2_file(Pixels(1, 1, 1, Sample::half, 1).texture(), Supercompression::none);
    EXPECT_EQ(words_at(file, 80 + 24, 11),
              (std::vector<std::uint32_t>{44, 0, 40 << 16 | 2, 0x00'01'00'01, 0, 2, 0,  //
                                          0xC0'0F'0000, 0, 0xBF800000, 0x3F800000}));
}

// "Level Index", "mipPadding": the largest level is first in the index and last in the file. Each
// level is aligned to whole texels and 32-bit words.
TEST(Ktx2File, LevelsAreAlignedWithTheSmallestFirst) {
    for (const int channels : {1, 2, 4}) {
        for (const Sample sample : {Sample::uint8, Sample::uint16, Sample::half, Sample::float32}) {
            const Pixels pixels(5, 3, channels, sample, 3);
            const Bytes file = ktx2_file(pixels.texture(), Supercompression::none);
            const std::size_t texel = static_cast<std::size_t>(channels) * bytes_of(sample);
            // end of keys and values
            std::size_t end = number_at(file, 56, 4) + number_at(file, 60, 4);
            for (std::size_t level = 3; level-- > 0;) {
                const std::size_t entry = 80 + 24 * level;
                const std::size_t offset = number_at(file, entry, 8), size = number_at(file, entry + 8, 8);
                EXPECT_EQ(offset % texel, 0u);
                EXPECT_EQ(offset % 4, 0u);
                EXPECT_GE(offset, end);
                EXPECT_LT(offset - end, std::max<std::size_t>(texel, 4)) << "more padding than needed";
                EXPECT_EQ(size, number_at(file, entry + 16, 8));
                ASSERT_LE(offset + size, file.size());
                EXPECT_EQ(Bytes(file.begin() + static_cast<std::ptrdiff_t>(offset),
                                file.begin() + static_cast<std::ptrdiff_t>(offset + size)),
                          pixels.level(level));
                end = offset + size;
            }
            EXPECT_EQ(end, file.size());
        }
    }
}

// Scheme 2: each level is a Zstandard frame (RFC 8878: magic 0xFD2FB528), without padding.
TEST(Ktx2File, ZstandardFramesFollowEachOther) {
    const Pixels pixels(64, 64, 1, Sample::uint8, 7);
    if (!has_zstd()) {
        EXPECT_THROW(ktx2_file(pixels.texture(), Supercompression::zstd), FileError);
        return;
    }
    const Bytes file = ktx2_file(pixels.texture(), Supercompression::zstd);
    EXPECT_EQ(number_at(file, 44, 4), 2u);
    EXPECT_LT(file.size(), ktx2_file(pixels.texture(), Supercompression::none).size());
    std::size_t end = number_at(file, 56, 4) + number_at(file, 60, 4);
    for (std::size_t level = 7; level-- > 0;) {
        const std::size_t entry = 80 + 24 * level;
        EXPECT_EQ(number_at(file, entry, 8), end);
        EXPECT_EQ(number_at(file, entry + 16, 8), pixels.level(level).size());
        EXPECT_EQ(number_at(file, end, 4), 0xFD2FB528u);
        end += number_at(file, entry + 8, 8);
    }
    EXPECT_EQ(end, file.size());
}

// Microsoft, "Programming Guide for DDS": DDS_HEADER, DDS_PIXELFORMAT, DDS_HEADER_DXT10, and the
// values of DXGI_FORMAT.
TEST(DdsFile, HeaderMatchesTheGuide) {
    const Pixels pixels(8, 4, 4, Sample::half, 4);
    const Bytes file = dds_file(pixels.texture());
    EXPECT_EQ(std::string(file.begin(), file.begin() + 4), "DDS ");
    constexpr std::uint32_t required = 0x1 | 0x2 | 0x4 | 0x1000, pitch = 0x8, mipmap_count = 0x20000;
    EXPECT_EQ(words_at(file, 4, 7),
              (std::vector<std::uint32_t>{124, required | pitch | mipmap_count, 4, 8, 8 * 8, 0, 4}));
    EXPECT_EQ(words_at(file, 76, 2), (std::vector<std::uint32_t>{32, 0x4}));
    EXPECT_EQ(std::string(file.begin() + 84, file.begin() + 88), "DX10");
    constexpr std::uint32_t complex = 0x8, texture = 0x1000, mipmap = 0x400000;
    EXPECT_EQ(words_at(file, 108, 5), (std::vector<std::uint32_t>{complex | texture | mipmap, 0, 0, 0, 0}));
    constexpr std::uint32_t r16g16b16a16_float = 10, texture_2d = 3, alpha_custom = 4;
    EXPECT_EQ(words_at(file, 128, 5),
              (std::vector<std::uint32_t>{r16g16b16a16_float, texture_2d, 0, 1, alpha_custom}));
    Bytes data;
    for (std::size_t level = 0; level < 4; ++level)
        data.insert(data.end(), pixels.level(level).begin(), pixels.level(level).end());
    EXPECT_EQ(Bytes(file.begin() + 148, file.end()), data);
}

TEST(DdsFile, HeaderOmitsTheMipmapCountForOneLevel) {
    const Bytes file = dds_file(Pixels(8, 4, 1, Sample::uint8, 1).texture());
    EXPECT_EQ(number_at(file, 8, 4) & 0x20000, 0u);
    EXPECT_EQ(number_at(file, 108, 4), 0x1000u);
    EXPECT_EQ(number_at(file, 128, 4), 61u);  // DXGI_FORMAT_R8_UNORM
}

TEST(Texture, InvalidValuesAreNamed) {
    Texture texture = Pixels(4, 4, 4, Sample::uint8, 3).texture();
    EXPECT_EQ(check(texture), "");
    texture.channels = 3;
    EXPECT_EQ(check(texture), "channels are 3, expected 1, 2 or 4");
    texture = Pixels(4, 4, 4, Sample::uint8, 3).texture();
    texture.levels[1] = texture.levels[0];
    EXPECT_EQ(check(texture), "the bytes of level 1 are 64, expected 16");
    texture.levels.clear();
    EXPECT_EQ(check(texture), "levels are 0, expected 1 to 3");
}

}  // namespace
}  // namespace pelagic::tools
