// The codec with libpng and OpenEXR, as in builds for Windows, beside the codec with OpenImageIO: equal
// files, equal values.
#include "pelagic/tools/encode/image_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/simd/half_float.hpp"

// of image_codec_libpng.cpp, which this program contains
extern "C" const pelagic::tools::ImageCodec pelagic_image_codec;

namespace pelagic::tools {
namespace {

const ImageCodec& codec_under_test() { return pelagic_image_codec; }

enum class Content { constant, smooth, noise };

/// Returns pixels of waves, or noise; without infinities and NaN. The fourth channel of integers is
/// opaque if `is_opaque`.
std::vector<unsigned char> pixels_of(const ImageDescription& image, Content content, bool is_opaque) {
    std::mt19937 random(static_cast<unsigned>(image.width * 31 + image.channels));
    std::vector<unsigned char> bytes;
    const auto append = [&](const auto& value) {
        const auto* first = reinterpret_cast<const unsigned char*>(&value);
        bytes.insert(bytes.end(), first, first + sizeof value);
    };
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int channel = 0; channel < image.channels; ++channel) {
                double value = 0.25;
                if (content == Content::smooth) value = 0.5 + 0.4 * std::sin(0.2 * x + 0.1 * y + channel);
                if (content == Content::noise) value = std::uniform_real_distribution(0.0, 1.0)(random);
                if (is_opaque && (image.channels == 2 || image.channels == 4) && channel == image.channels - 1)
                    value = 1;
                switch (image.sample) {
                    case Sample::uint8: append(static_cast<std::uint8_t>(value * 255)); break;
                    case Sample::uint16: append(static_cast<std::uint16_t>(value * 65535)); break;
                    case Sample::half: append(static_cast<std::uint16_t>(half_of(static_cast<float>(value)))); break;
                    case Sample::float32: append(static_cast<float>(value)); break;
                }
            }
    return bytes;
}

std::string text_of(const ImageDescription& image) {
    return std::string(image.extension) + " " + std::to_string(image.width) + " x " + std::to_string(image.height) +
           " x " + std::to_string(image.channels) + ", " + std::to_string(bytes_of(image.sample)) + " bytes, " +
           image.colour_space + ", " + (image.compression ? image.compression : "-") + ", level " +
           std::to_string(image.png_level.value_or(-1));
}

/// Calls `take` with each image that an export can contain, in several sizes.
template <class Take>
void for_each_image(const Take& take) {
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {33, 70}, {256, 64}})
        for (int channels = 1; channels <= 4; ++channels) {
            ImageDescription image{.extension = "png",
                                   .width = width,
                                   .height = height,
                                   .channels = channels,
                                   .sample = Sample::uint8,
                                   .colour_space = "Raw",
                                   .compression = nullptr,
                                   .has_unassociated_alpha = channels == 4};
            // no map has two integers
            for (const Sample sample : {Sample::uint8, Sample::uint16})
                for (const auto& [space, level] : {std::pair{"Raw", std::optional(2)}, {"sRGB", std::nullopt}}) {
                    image.sample = sample;
                    image.colour_space = space;
                    image.png_level = level;
                    if (channels != 2) take(image);
                }
            image.extension = "exr";
            image.colour_space = "Linear";
            image.png_level = {};
            image.has_unassociated_alpha = false;
            for (const Sample sample : {Sample::half, Sample::float32})
                for (const char* compression : {"zip", "zips", "piz", "dwaa", "none"}) {
                    image.sample = sample;
                    image.compression = compression;
                    take(image);
                }
        }
}

TEST(ImageCodec, WritesTheBytesOfOpenImageIO) {
    for_each_image([](const ImageDescription& image) {
        for (const Content content : {Content::constant, Content::smooth, Content::noise}) {
            const auto pixels = pixels_of(image, content, false);
            ASSERT_EQ(codec_under_test().encode(image, pixels.data()), image_codec().encode(image, pixels.data()))
                << text_of(image);
        }
    });
}

TEST(ImageCodec, ReadsTheValuesOfOpenImageIO) {
    for_each_image([](ImageDescription image) {
        const auto file = image_codec().encode(image, pixels_of(image, Content::noise, true).data());
        ImageDescription measured = image;
        measured.width = measured.height = measured.channels = 0;
        codec_under_test().measure(measured, file);
        EXPECT_EQ(text_of(measured), text_of(image));
        ASSERT_EQ(codec_under_test().decode(image, file), image_codec().decode(image, file)) << text_of(image);
        if (image.extension == std::string("exr") && image.channels >= 3) {
            for (const char* channel : {"R", "G", "B"})
                ASSERT_EQ(codec_under_test().decode_channel(image, file, channel),
                          image_codec().decode_channel(image, file, channel));
        }
    });
}

std::string reason_to_reject(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(ImageCodec, ReportsWhatItLacks) {
    ImageDescription image{.extension = "tif",
                           .width = 4,
                           .height = 4,
                           .channels = 1,
                           .sample = Sample::uint8,
                           .colour_space = "Raw",
                           .compression = nullptr};
    const std::vector<unsigned char> pixels(16);
    EXPECT_EQ(reason_to_reject([&] { codec_under_test().encode(image, pixels.data()); }),
              "this pelagic was built without OpenImageIO, which writes and reads tif");
    image.extension = "png";
    image.channels = 4;
    image.has_unassociated_alpha = true;
    const auto transparent = codec_under_test().encode(image, std::vector<unsigned char>(64, 128).data());
    EXPECT_EQ(reason_to_reject([&] { codec_under_test().decode(image, transparent); }), "it has transparent pixels");
    image.width = 5;
    EXPECT_EQ(reason_to_reject([&] { codec_under_test().decode(image, transparent); }),
              "it has 4 x 4 pixels, expected 5 x 4");
}

/// Truncated files and files with a changed byte are read or rejected, within the memory limit of
/// tests.
TEST(ImageCodec, RejectsDamagedFilesWithAReason) {
    std::mt19937 random(1);
    for (const auto& [extension, sample] : {std::pair{"png", Sample::uint16}, {"exr", Sample::float32}}) {
        const ImageDescription image{.extension = extension,
                                     .width = 24,
                                     .height = 20,
                                     .channels = 3,
                                     .sample = sample,
                                     .colour_space = "Raw",
                                     .compression = "zip"};
        const auto file = codec_under_test().encode(image, pixels_of(image, Content::smooth, true).data());
        const auto expect_reason_or_pixels = [&](const std::vector<unsigned char>& damaged) {
            try {
                ImageDescription measured = image;
                codec_under_test().measure(measured, damaged);
                EXPECT_EQ(codec_under_test().decode(image, damaged).size(), 24u * 20u * 3u);
                EXPECT_EQ(measured.width, 24);
            } catch (const std::runtime_error& error) {
                EXPECT_NE(std::string(error.what()), "");
            }
        };
        for (std::size_t size = 0; size < file.size(); size += 1 + file.size() / 100) {
            const std::vector<unsigned char> cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
            EXPECT_NE(reason_to_reject([&] { codec_under_test().decode(image, cut); }), "") << extension << size;
        }
        for (int i = 0; i < 1000; ++i) {
            std::vector<unsigned char> changed = file;
            // two of three in the header
            const std::size_t range = i % 3 == 0 ? file.size() : std::min<std::size_t>(file.size(), 400);
            changed[random() % range] = static_cast<unsigned char>(random());
            expect_reason_or_pixels(changed);
        }
    }
}

}  // namespace
}  // namespace pelagic::tools
