// The library pelagic_images: the only source file that uses OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "pelagic/tools/encode/image_codec.hpp"

namespace pelagic::tools {
namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// Changes two defaults of OpenImageIO: OpenEXR would start a thread per core regardless of
/// --threads, and TIFF would convert halves to floats silently.
void set_up_open_image_io() {
    static const bool done = OIIO::attribute("exr_threads", -1) && OIIO::attribute("tiff:half", 1);
    if (!done) throw std::runtime_error("OpenImageIO knows neither exr_threads nor tiff:half");
}

TypeDesc type_of(Sample sample) {
    switch (sample) {
        case Sample::uint8: return TypeDesc::UINT8;
        case Sample::uint16: return TypeDesc::UINT16;
        case Sample::half: return TypeDesc::HALF;
        case Sample::float32: return TypeDesc::FLOAT;
    }
    return TypeDesc::UNKNOWN;
}

std::vector<unsigned char> encode(const ImageDescription& image, const void* pixels) {
    set_up_open_image_io();
    const std::string extension = image.extension;
    ImageSpec spec(image.width, image.height, image.channels, type_of(image.sample));
    spec.attribute("oiio:ColorSpace", image.colour_space);
    if (image.compression) spec.attribute("compression", image.compression);
    if (image.png_level) spec.attribute("png:compressionLevel", *image.png_level);
    if (!image.channel_names.empty()) {
        spec.channelnames = image.channel_names;
        spec.alpha_channel = spec.z_channel = -1;
    }
    if (image.has_unassociated_alpha) {
        spec.alpha_channel = 3;
        spec.attribute("oiio:UnassociatedAlpha", 1);
    }
    // EXR and TIFF would store the current time, and two exports of a sea would differ.
    if (extension != "png") spec.attribute("DateTime", "1970:01:01 00:00:00");

    const std::string name = "sea." + extension;  // OpenImageIO selects the format by the extension
    const auto output = ImageOutput::create(name);
    if (!output) throw std::runtime_error("OpenImageIO has no writer for " + extension + ": " + OIIO::geterror());
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    if (!output->set_ioproxy(&memory) || !output->open(name, spec) || !output->write_image(spec.format, pixels) ||
        !output->close())
        throw std::runtime_error("OpenImageIO can't encode " + extension + ": " + output->geterror());
    return bytes;
}

void check(ImageInput& input, bool is_well) {
    if (is_well) return;
    const std::string reason = input.geterror();
    throw std::runtime_error(reason.empty() ? "OpenImageIO can't decode it" : reason);
}

/// \param memory  must outlive the returned reader
std::unique_ptr<ImageInput> opened(const char* extension, OIIO::Filesystem::IOMemReader& memory, ImageSpec& spec) {
    set_up_open_image_io();
    // Select the reader by format only. With a file name OpenImageIO would open a file of that name
    // and try the readers of other formats.
    auto input = ImageInput::create(extension);
    if (!input)
        throw std::runtime_error(std::string("OpenImageIO has no reader for ") + extension + ": " + OIIO::geterror());
    check(*input, input->set_ioproxy(&memory) && input->open(std::string("sea.") + extension, spec));
    return input;
}

void measure(ImageDescription& image, std::span<const unsigned char> file) {
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(file.data()), file.size());
    ImageSpec spec;
    opened(image.extension, memory, spec);
    image.width = spec.width;
    image.height = spec.height;
    image.channels = spec.nchannels;
}

std::vector<float> decode(const ImageDescription& image, std::span<const unsigned char> file) {
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(file.data()), file.size());
    ImageSpec spec;
    const std::unique_ptr<ImageInput> input = opened(image.extension, memory, spec);
    if (spec.width != image.width || spec.height != image.height || spec.depth != 1 ||
        spec.nchannels != image.channels)
        throw std::runtime_error("it has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                                 " pixels of " + std::to_string(spec.nchannels) + " channels, expected " +
                                 std::to_string(image.width) + " x " + std::to_string(image.height) + " of " +
                                 std::to_string(image.channels));
    std::vector<float> pixels(static_cast<std::size_t>(image.width) * image.height * image.channels);
    check(*input, input->read_image(0, 0, 0, -1, TypeDesc::FLOAT, pixels.data()));
    return pixels;
}

std::vector<float> decode_channel(const ImageDescription& image, std::span<const unsigned char> file,
                                  const char* channel) {
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(file.data()), file.size());
    ImageSpec spec;
    const std::unique_ptr<ImageInput> input = opened(image.extension, memory, spec);
    for (int part = 0; input->seek_subimage(part, 0); ++part) {
        spec = input->spec();
        const int number = spec.channelindex(channel);
        if (number < 0) continue;
        if (spec.width != image.width || spec.height != image.height || spec.depth != 1)
            throw std::runtime_error("it has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                                     " pixels, expected " + std::to_string(image.width) + " x " +
                                     std::to_string(image.height));
        std::vector<float> pixels(static_cast<std::size_t>(image.width) * image.height);
        check(*input, input->read_image(part, 0, number, number + 1, TypeDesc::FLOAT, pixels.data()));
        return pixels;
    }
    throw std::runtime_error(std::string("it has no channel ") + channel);
}

}  // namespace
}  // namespace pelagic::tools

extern "C" __attribute__((visibility("default"))) const pelagic::tools::ImageCodec pelagic_image_codec = {
    PELAGIC_VERSION, pelagic::tools::encode, pelagic::tools::decode, pelagic::tools::decode_channel,
    pelagic::tools::measure};
