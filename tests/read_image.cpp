#include "pelagic/tests/read_image.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <memory>

namespace pelagic {
namespace {

ReadImage read_exr(const std::filesystem::path& file) {
    Imf::InputFile input(file.c_str());
    const auto window = input.header().dataWindow();
    const Imf::ChannelList& list = input.header().channels();
    ReadImage image{.width = window.max.x + 1, .height = window.max.y + 1, .channels = 0, .type = {}, .pixels = {}};
    std::vector<std::string> names;
    for (const char* name : {"R", "G", "B", "A", "Y"})
        if (list.findChannel(name)) names.emplace_back(name);
    image.channels = static_cast<int>(names.size());
    const auto texels = static_cast<std::size_t>(image.width * image.height), count = names.size();
    std::vector<float> floats(texels * count);  // A float represents every half exactly.
    Imf::FrameBuffer buffer;
    const std::size_t pixel_bytes = count * sizeof(float);
    for (std::size_t c = 0; c < count; ++c) {
        image.type = list.findChannel(names[c])->type == Imf::HALF ? "half" : "float";
        buffer.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(floats.data() + c), pixel_bytes,
                                           pixel_bytes * static_cast<std::size_t>(image.width)));
    }
    input.setFrameBuffer(buffer);
    input.readPixels(window.min.y, window.max.y);
    image.pixels.assign(floats.begin(), floats.end());
    return image;
}

ReadImage read_png(const std::filesystem::path& file) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
    EXPECT_TRUE(stream) << file;
    if (!stream) return {};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, stream.get());
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    const int bits = png_get_bit_depth(png, info);
    EXPECT_TRUE(bits == 8 || bits == 16) << bits;
    ReadImage image{.width = static_cast<int>(png_get_image_width(png, info)),
                    .height = static_cast<int>(png_get_image_height(png, info)),
                    .channels = png_get_channels(png, info),
                    .type = bits == 16 ? "uint16" : "uint8",
                    .pixels = {}};
    png_bytepp rows = png_get_rows(png, info);
    for (int row = 0; row < image.height; ++row)
        for (int i = 0; i < image.width * image.channels; ++i)
            image.pixels.push_back(bits == 16 ? (rows[row][2 * i] << 8 | rows[row][2 * i + 1]) / 65535.0
                                              : rows[row][i] / 255.0);
    png_destroy_read_struct(&png, &info, nullptr);
    return image;
}

ReadImage read_tiff(const std::filesystem::path& file) {
    OIIO::ImageSpec as_it_is;
    // Otherwise the reader multiplies normals by smoothness.
    as_it_is.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(file.string(), &as_it_is);
    EXPECT_TRUE(input) << file;
    if (!input) return {};
    const OIIO::ImageSpec& spec = input->spec();
    ReadImage image{.width = spec.width,
                    .height = spec.height,
                    .channels = spec.nchannels,
                    .type = spec.format.c_str(),
                    .pixels = {}};
    image.pixels.resize(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
    EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::DOUBLE, image.pixels.data()));
    return image;
}

}  // namespace

ReadImage read_image(const std::filesystem::path& file) {
    if (file.extension() == ".exr") return read_exr(file);
    return file.extension() == ".png" ? read_png(file) : read_tiff(file);
}

}  // namespace pelagic
