// The library pelagic_exr: EXR encoding with OpenEXR. OpenImageIO can write neither several parts
// nor mip levels to memory.
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfFramesPerSecond.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputPart.h>

#include <stdexcept>
#include <type_traits>

#include "pelagic/tools/encode/exr_codec.hpp"
#include "pelagic/tools/encode/exr_stream.hpp"

namespace pelagic::tools {
namespace {

// the tile size of renderers' texture caches, and of maketx and txmake
constexpr unsigned tile_side = 64;
constexpr int own_thread = 0;  // 0 threads of OpenEXR: encode() works on the calling thread

Imf::Compression compression_of(Compression compression) {
    switch (compression) {
        case Compression::zip: return Imf::ZIP_COMPRESSION;
        case Compression::zips: return Imf::ZIPS_COMPRESSION;
        case Compression::piz: return Imf::PIZ_COMPRESSION;
        case Compression::dwaa: return Imf::DWAA_COMPRESSION;
        case Compression::none: return Imf::NO_COMPRESSION;
        case Compression::lzw:
        case Compression::zstd: break;
    }
    throw std::invalid_argument("EXR has no such compression");
}

Imf::PixelType type_of(Sample sample) {
    if (sample == Sample::half) return Imf::HALF;
    if (sample == Sample::float32) return Imf::FLOAT;
    throw std::invalid_argument("EXR has halves and floats only");
}

Imf::Header header_of(const ExrPart& part, const ExrFile& file) {
    Imf::Header header(part.side, part.side);
    header.compression() = compression_of(file.compression);
    header.setType(file.is_tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    if (file.is_tiled)
        header.setTileDescription({tile_side, tile_side, part.levels > 1 ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL});
    if (!part.name.empty()) header.setName(part.name);
    for (const ExrLayer& layer : part.layers)
        for (const std::string& channel : layer.channels)
            header.channels().insert(channel, Imf::Channel(type_of(layer.sample)));
    if (part.frames_per_second) Imf::addFramesPerSecond(header, Imf::guessExactFps(*part.frames_per_second));
    for (const ExrAttribute& attribute : part.attributes)
        std::visit(
            [&](const auto& known) {
                using Value = std::remove_cvref_t<decltype(known)>;
                header.insert(attribute.first, Imf::TypedAttribute<Value>(known));
            },
            attribute.second);
    return header;
}

/// Returns an upper bound of the file size, so that a buffer of hundreds of megabytes is not
/// reallocated. Untouched pages take no memory.
std::size_t max_file_size(const ExrFile& file) {
    std::size_t size = std::size_t{1} << 16;
    for (const ExrPart& part : file.parts)
        for (const ExrLayer& layer : part.layers) {
            const auto side = static_cast<std::size_t>(part.side);
            const std::size_t pixels = side * side * layer.channels.size() * bytes_of(layer.sample);
            size += pixels + (part.levels > 1 ? pixels / 2 : 0) + pixels / 16;
        }
    return size;
}

/// Returns the addresses and strides of the channels of all layers.
Imf::FrameBuffer buffer_of(const ExrPart& part, std::vector<MapImage>& images) {
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const ExrLayer& layer = part.layers[i];
        const std::size_t value = bytes_of(layer.sample), pixel = value * layer.channels.size();
        auto* at = reinterpret_cast<char*>(images[i].pixels.data());
        for (const std::string& channel : layer.channels) {
            buffer.insert(channel, Imf::Slice(type_of(layer.sample), at, pixel,
                                              pixel * static_cast<std::size_t>(images[i].side)));
            at += value;
        }
    }
    return buffer;
}

void write_part(Imf::MultiPartOutputFile& output, const ExrFile& file, int number) {
    const ExrPart& part = file.parts[static_cast<std::size_t>(number)];
    for (int level = 0; level < part.levels; ++level) {
        std::vector<MapImage> images;
        for (const ExrLayer& layer : part.layers) images.push_back(layer.image_of(level));
        const Imf::FrameBuffer buffer = buffer_of(part, images);
        if (!file.is_tiled) {
            Imf::OutputPart lines(output, number);
            lines.setFrameBuffer(buffer);
            lines.writePixels(part.side);
        } else {
            Imf::TiledOutputPart tiles(output, number);
            tiles.setFrameBuffer(buffer);
            tiles.writeTiles(0, tiles.numXTiles(level) - 1, 0, tiles.numYTiles(level) - 1, level);
        }
    }
}

std::vector<unsigned char> encode(const ExrFile& file) {
    try {
        std::vector<Imf::Header> headers;
        for (const ExrPart& part : file.parts) headers.push_back(header_of(part, file));
        ExrOutput memory(max_file_size(file));
        {
            constexpr bool override_shared = false;
            Imf::MultiPartOutputFile output(memory, headers.data(), static_cast<int>(headers.size()), override_shared,
                                            own_thread);
            for (int part = 0; part < output.parts(); ++part) write_part(output, file, part);
        }  // the destructor writes the offset tables
        return memory.taken();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw std::runtime_error(std::string("OpenEXR can't encode it: ") + error.what());
    }
}

}  // namespace
}  // namespace pelagic::tools

extern "C" __attribute__((visibility("default"))) const pelagic::tools::ExrCodec pelagic_exr_codec = {
    PELAGIC_VERSION, pelagic::tools::encode};
