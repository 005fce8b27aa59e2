#include "pelagic/tools/image_writer.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace pelagic::tools {
namespace {

using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// OpenImageIO's defaults: OpenEXR takes a thread for every core, whatever --threads says, and TIFF turns halves into
/// floats in silence.
void set_up_open_image_io() {
    static const bool done = OIIO::attribute("exr_threads", -1) && OIIO::attribute("tiff:half", 1);
    if (!done) throw std::runtime_error("OpenImageIO knows neither exr_threads nor tiff:half");
}

std::vector<unsigned char> encode(const std::string& extension, ImageSpec spec, const void* pixels) {
    set_up_open_image_io();
    // EXR and TIFF would note the moment of writing, and no two exports of a sea would be the same.
    if (extension != "png") spec.attribute("DateTime", "1970:01:01 00:00:00");
    const std::string name = "sea." + extension;  // OpenImageIO chooses the format by the name
    const auto output = ImageOutput::create(name);
    if (!output) throw std::runtime_error("OpenImageIO has no writer for " + extension + ": " + OIIO::geterror());
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    if (!output->set_ioproxy(&memory) || !output->open(name, spec) || !output->write_image(spec.format, pixels) ||
        !output->close())
        throw std::runtime_error("OpenImageIO can't encode " + extension + ": " + output->geterror());
    return bytes;
}

/// `channels` interleaved values a texel, from the frame's float planes.
std::vector<float> interleaved_floats(const Frame& frame) {
    std::vector<float> pixels;
    pixels.reserve(3 * static_cast<std::size_t>(frame.resolution()) * frame.resolution());
    for (int j = 0; j < frame.resolution(); ++j) {
        for (int i = 0; i < frame.resolution(); ++i)
            pixels.insert(pixels.end(), {frame.dx.at(i, j), frame.height.at(i, j), frame.dz.at(i, j)});
    }
    return pixels;
}

/// The first three of the frame's four halves a texel: the fourth is foam.
std::vector<std::uint16_t> three_halves(const Frame& frame) {
    std::vector<std::uint16_t> pixels;
    pixels.reserve(frame.displacement_rgba16f.size() / 4 * 3);
    for (std::size_t texel = 0; texel < frame.displacement_rgba16f.size(); texel += 4) {
        const std::uint16_t* halves = frame.displacement_rgba16f.data() + texel;
        pixels.insert(pixels.end(), halves, halves + 3);
    }
    return pixels;
}

}  // namespace

std::vector<unsigned char> encode_displacement(const Frame& frame, ImageFormat format, bool half) {
    const int n = frame.resolution();
    ImageSpec spec(n, n, 3, half ? TypeDesc::HALF : TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    if (half) return encode(displacement_extension(format), spec, three_halves(frame).data());
    return encode(displacement_extension(format), spec, interleaved_floats(frame).data());
}

std::vector<unsigned char> encode_gradient(const Frame& frame, int level, ImageFormat format) {
    const int side = frame.resolution() >> level;
    ImageSpec spec(side, side, 4, TypeDesc::UINT8);
    spec.alpha_channel = 3;
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("oiio:ColorSpace", "Raw");
    if (format == ImageFormat::tiff) spec.attribute("compression", "zip");
    // zlib's default, 6, takes four times as long for files 6 % smaller (512 x 512, jonswap).
    if (format == ImageFormat::exr_and_png) spec.attribute("png:compressionLevel", 2);
    // A texel's lowest byte is its red one, in memory the first.
    return encode(gradient_extension(format), spec, frame.gradient_level(level).data());
}

std::vector<unsigned char> encode_picture(std::span<const std::uint8_t> rgba, int width, int height) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    ImageSpec spec(width, height, 3, TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return encode("png", spec, rgb.data());
}

const char* displacement_extension(ImageFormat format) { return format == ImageFormat::tiff ? "tif" : "exr"; }
const char* gradient_extension(ImageFormat format) { return format == ImageFormat::tiff ? "tif" : "png"; }

}  // namespace pelagic::tools
