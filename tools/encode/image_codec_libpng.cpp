// PNG with libpng and EXR with OpenEXR, for systems without OpenImageIO. Encoded files have the bytes
// that image_codec_openimageio.cpp writes. TIFF is not supported.
#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledInputPart.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "pelagic/tools/encode/exr_stream.hpp"
#include "pelagic/tools/encode/image_codec.hpp"

namespace pelagic::tools {
namespace {

bool is_png(const ImageDescription& image) {
    const std::string_view extension = image.extension;
    if (extension != "png" && extension != "exr")
        throw std::runtime_error("this pelagic was built without OpenImageIO, which writes and reads " +
                                 std::string(extension));
    return extension == "png";
}

std::size_t values_of(const ImageDescription& image) {
    return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
           static_cast<std::size_t>(image.channels);
}

void require_size(const ImageDescription& expected, int width, int height) {
    if (width != expected.width || height != expected.height)
        throw std::runtime_error("it has " + std::to_string(width) + " x " + std::to_string(height) +
                                 " pixels, expected " + std::to_string(expected.width) + " x " +
                                 std::to_string(expected.height));
}

// ---- PNG. libpng reports errors by longjmp(), so the functions that call it have no objects with
// destructors, and bytes are kept outside.

struct PngError {
    std::array<char, 120> text{};
};

void note_error(png_structp png, png_const_charp what) {
    auto& error = *static_cast<PngError*>(png_get_error_ptr(png));
    std::strncpy(error.text.data(), what, error.text.size() - 1);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

struct PngOutput {
    std::vector<unsigned char> bytes;
    bool is_out_of_memory = false;
};

void append_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto& output = *static_cast<PngOutput*>(png_get_io_ptr(png));
    try {
        output.bytes.insert(output.bytes.end(), bytes, bytes + count);
    } catch (const std::bad_alloc&) {
        output.is_out_of_memory = true;
    }
    if (output.is_out_of_memory) png_error(png, "out of memory");
}

int colour_type_of(const ImageDescription& image) {
    switch (image.channels) {
        case 1: return PNG_COLOR_TYPE_GRAY;
        case 3: return PNG_COLOR_TYPE_RGB;
        case 4: return PNG_COLOR_TYPE_RGB_ALPHA;
        default: return -1;
    }
}

/// \param row_bytes  of a row of `pixels`
/// \return false on an error
bool write_png(png_structp png, png_infop info, const ImageDescription& image, png_const_bytep pixels,
               std::size_t row_bytes) {
    constexpr int default_level = 6, zlib_default_strategy = 0;  // libpng's default is Z_FILTERED
    if (setjmp(png_jmpbuf(png))) return false;
    const bool is_wide = image.sample == Sample::uint16;
    png_set_compression_level(png, image.png_level.value_or(default_level));
    png_set_compression_strategy(png, zlib_default_strategy);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
                 is_wide ? 16 : 8, colour_type_of(image), PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_oFFs(png, info, 0, 0, PNG_OFFSET_PIXEL);
    if (image.colour_space == std::string_view("sRGB"))
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = const_cast<char*>("oiio:ColorSpace");
    text.text = const_cast<char*>(image.colour_space);
    png_set_text(png, info, &text, 1);
    png_write_info(png, info);
    if (is_wide && std::endian::native == std::endian::little) png_set_swap(png);
    for (int row = 0; row < image.height; ++row)
        png_write_row(png, pixels + static_cast<std::size_t>(row) * row_bytes);
    png_write_end(png, info);
    return true;
}

std::vector<unsigned char> encode_as_png(const ImageDescription& image, const void* pixels) {
    if (colour_type_of(image) < 0 || is_floating(image.sample) || (image.channels == 4 && !image.has_unassociated_alpha))
        throw std::runtime_error("pixels of this kind are not written as PNG");
    PngError error;
    PngOutput output;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, note_error, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    if (!info) {
        png_destroy_write_struct(&png, nullptr);
        throw std::bad_alloc();
    }
    png_set_write_fn(png, &output, append_bytes, nullptr);
    const std::size_t row_bytes =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels) * bytes_of(image.sample);
    const bool is_written = write_png(png, info, image, static_cast<png_const_bytep>(pixels), row_bytes);
    png_destroy_write_struct(&png, &info);
    if (output.is_out_of_memory) throw std::bad_alloc();
    if (!is_written) throw std::runtime_error(std::string("libpng can't encode it: ") + error.text.data());
    return std::move(output.bytes);
}

/// Takes bytes from the front of the span.
void take_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto& rest = *static_cast<std::span<const unsigned char>*>(png_get_io_ptr(png));
    if (count > rest.size()) png_error(png, "it ends before its pixels");
    std::copy_n(rest.begin(), count, bytes);
    rest = rest.subspan(count);
}

/// What libpng allocates to read a file.
struct PngState {
    explicit PngState(PngError& error)
        : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, note_error, ignore_warning)),
          info(png ? png_create_info_struct(png) : nullptr) {}
    ~PngState() { png_destroy_read_struct(&png, &info, nullptr); }
    PngState(const PngState&) = delete;
    PngState& operator=(const PngState&) = delete;

    png_structp png;
    png_infop info;
};

class PngReader {
   public:
    /// \param file  must outlive the reader
    explicit PngReader(std::span<const unsigned char> file) : rest_(file), state_(error_) {
        if (!info_) throw std::bad_alloc();
        png_set_read_fn(png_, &rest_, take_bytes);
        if (!open()) fail();
    }

    int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
    int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
    int channels() const { return png_get_channels(png_, info_); }
    std::size_t bytes_per_value() const { return png_get_bit_depth(png_, info_) / std::size_t{8}; }

    /// Returns the pixels as 8 or 16 bits in this machine's byte order, without padding.
    std::vector<unsigned char> pixels() {
        const std::size_t row_bytes = png_get_rowbytes(png_, info_);
        std::vector<unsigned char> bytes(row_bytes * static_cast<std::size_t>(height()));
        std::vector<png_bytep> rows;
        for (int row = 0; row < height(); ++row)
            rows.push_back(bytes.data() + static_cast<std::size_t>(row) * row_bytes);
        if (!read(rows.data())) fail();
        return bytes;
    }

   private:
    bool open() {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_read_info(png_, info_);
        png_set_expand(png_);  // palettes, 1 to 4 bits, and a transparent colour
        if (std::endian::native == std::endian::little) png_set_swap(png_);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }
    bool read(png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
        return true;
    }
    [[noreturn]] void fail() const { throw std::runtime_error(std::string("libpng can't decode it: ") + error_.text.data()); }

    PngError error_;
    std::span<const unsigned char> rest_;
    PngState state_;
    png_structp png_ = state_.png;
    png_infop info_ = state_.info;
};

template <class Value>
std::vector<float> fractions_of(const std::vector<unsigned char>& bytes) {
    constexpr float step = 1.f / static_cast<float>(std::numeric_limits<Value>::max());
    std::vector<float> fractions(bytes.size() / sizeof(Value));
    for (std::size_t i = 0; i < fractions.size(); ++i) {
        Value value;
        std::memcpy(&value, &bytes[i * sizeof value], sizeof value);
        fractions[i] = static_cast<float>(value) * step;
    }
    return fractions;
}

/// Throws if a pixel is transparent: OpenImageIO would multiply the others by alpha.
void require_opaque(const std::vector<float>& pixels, int channels) {
    const auto step = static_cast<std::size_t>(channels);
    if (channels != 2 && channels != 4) return;
    for (std::size_t i = step - 1; i < pixels.size(); i += step)
        if (pixels[i] != 1) throw std::runtime_error("it has transparent pixels");
}

std::vector<float> decode_png(const ImageDescription& image, std::span<const unsigned char> file) {
    PngReader reader(file);
    require_size(image, reader.width(), reader.height());
    if (reader.channels() != image.channels)
        throw std::runtime_error("it has " + std::to_string(reader.channels()) + " channels, expected " +
                                 std::to_string(image.channels));
    std::vector<float> pixels = reader.bytes_per_value() == 2 ? fractions_of<std::uint16_t>(reader.pixels())
                                                              : fractions_of<std::uint8_t>(reader.pixels());
    require_opaque(pixels, image.channels);
    return pixels;
}

// ---- EXR

/// Calls a function and converts OpenEXR's exceptions to std::runtime_error.
template <class Work>
auto with_openexr(const char* doing, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::runtime_error&) {
        throw;  // an error of this file
    } catch (const std::exception& error) {
        throw std::runtime_error(std::string(doing) + error.what());
    }
}

Imf::Compression compression_named(std::string_view name) {
    constexpr std::pair<std::string_view, Imf::Compression> names[] = {{"none", Imf::NO_COMPRESSION},
                                                                       {"zip", Imf::ZIP_COMPRESSION},
                                                                       {"zips", Imf::ZIPS_COMPRESSION},
                                                                       {"piz", Imf::PIZ_COMPRESSION},
                                                                       {"dwaa", Imf::DWAA_COMPRESSION}};
    for (const auto& [known, compression] : names)
        if (known == name) return compression;
    throw std::invalid_argument("EXR has no compression " + std::string(name));
}

Imf::PixelType exr_type_of(Sample sample) {
    if (sample == Sample::half) return Imf::HALF;
    if (sample == Sample::float32) return Imf::FLOAT;
    throw std::invalid_argument("EXR has halves and floats only");
}

std::vector<unsigned char> encode_as_exr(const ImageDescription& image, const void* pixels) {
    constexpr std::array usual_names = {"R", "G", "B", "A"};
    const Imf::PixelType type = exr_type_of(image.sample);
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t value = bytes_of(image.sample), pixel = value * channels;
    Imf::Header header(image.width, image.height);
    header.compression() = compression_named(image.compression);
    Imf::addCapDate(header, "1970:01:01 00:00:00");
    // OpenImageIO compresses a single channel with zip instead, and stores the default level of dwaa.
    if (header.compression() == Imf::DWAA_COMPRESSION && channels == 1) header.compression() = Imf::ZIP_COMPRESSION;
    if (header.compression() == Imf::DWAA_COMPRESSION)
        header.insert("dwaCompressionLevel", Imf::FloatAttribute(45.f));
    Imf::FrameBuffer buffer;
    for (std::size_t channel = 0; channel < channels; ++channel) {
        const std::string name =
            image.channel_names.empty() ? channels == 1 ? "Y" : usual_names.at(channel) : image.channel_names[channel];
        header.channels().insert(name, Imf::Channel(type));
        char* const first = const_cast<char*>(static_cast<const char*>(pixels)) + channel * value;
        buffer.insert(name, Imf::Slice(type, first, pixel, pixel * static_cast<std::size_t>(image.width)));
    }
    constexpr int own_thread = 0;
    ExrOutput memory((std::size_t{1} << 16) + values_of(image) * value);
    {
        Imf::OutputFile output(memory, header, own_thread);
        output.setFrameBuffer(buffer);
        output.writePixels(image.height);
    }  // the destructor writes the offset table
    return memory.taken();
}

/// The place of a channel's name among the channels of a layer.
std::size_t rank_of(std::string_view name) {
    constexpr std::array<std::string_view, 10> usual = {"R", "Red", "G", "Green", "B", "Blue", "A", "Alpha", "Z", "Depth"};
    const std::string_view suffix = name.substr(name.rfind('.') + 1);
    return static_cast<std::size_t>(std::find(usual.begin(), usual.end(), suffix) - usual.begin());
}

/// Returns the names of the channels: layer by layer, colours before others, as OpenImageIO orders
/// them.
std::vector<std::string> channel_names(const Imf::Header& header) {
    std::vector<std::string> names;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        names.emplace_back(channel.name());
    const auto layer_of = [](std::string_view name) {
        const std::size_t dot = name.rfind('.');
        return dot == std::string_view::npos ? std::string_view() : name.substr(0, dot);
    };
    std::ranges::stable_sort(names, {}, [&](const std::string& name) { return std::pair(layer_of(name), rank_of(name)); });
    return names;
}

struct Side {
    int width, height;
};

Side side_of(const Imf::Header& header) {
    const Imath::Box2i& window = header.dataWindow();
    return {window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
}

/// Reads channels of a part into `pixels`, interleaved.
void read_channels(Imf::MultiPartInputFile& input, int number, const std::vector<std::string>& names,
                   std::vector<float>& pixels) {
    const Imf::Header& header = input.header(number);
    const Imath::V2i first = header.dataWindow().min;
    const auto width = static_cast<std::size_t>(side_of(header).width);
    const std::size_t pixel = names.size() * sizeof(float), line = pixel * width;
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < names.size(); ++i)
        buffer.insert(names[i], Imf::Slice::Make(Imf::FLOAT, pixels.data() + i, first,
                                                 static_cast<std::int64_t>(width), side_of(header).height, pixel, line));
    if (header.hasTileDescription()) {
        Imf::TiledInputPart tiles(input, number);
        tiles.setFrameBuffer(buffer);
        tiles.readTiles(0, tiles.numXTiles() - 1, 0, tiles.numYTiles() - 1);
    } else {
        Imf::InputPart lines(input, number);
        lines.setFrameBuffer(buffer);
        lines.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
    }
}

/// An EXR file without deep data. \param bytes  must outlive the object
class ExrReader {
   public:
    explicit ExrReader(std::span<const unsigned char> bytes) : stream_(bytes), input_(stream_, own_thread) {
        for (int part = 0; part < input_.parts(); ++part)
            if (input_.header(part).hasType() && Imf::isDeepData(input_.header(part).type()))
                throw std::runtime_error("it has deep data");
    }
    Imf::MultiPartInputFile& input() { return input_; }

   private:
    static constexpr int own_thread = 0;
    ExrInput stream_;
    Imf::MultiPartInputFile input_;
};

// ---- The table

constexpr const char* can_not_decode = "OpenEXR can't decode it: ";

std::vector<unsigned char> encode(const ImageDescription& image, const void* pixels) {
    if (is_png(image)) return encode_as_png(image, pixels);
    return with_openexr("OpenEXR can't encode it: ", [&] { return encode_as_exr(image, pixels); });
}

void measure(ImageDescription& image, std::span<const unsigned char> file) {
    if (is_png(image)) {
        const PngReader reader(file);
        image.width = reader.width();
        image.height = reader.height();
        image.channels = reader.channels();
        return;
    }
    with_openexr(can_not_decode, [&] {
        ExrReader reader(file);
        const Imf::Header& header = reader.input().header(0);
        image.width = side_of(header).width;
        image.height = side_of(header).height;
        image.channels = static_cast<int>(channel_names(header).size());
    });
}

std::vector<float> decode(const ImageDescription& image, std::span<const unsigned char> file) {
    if (is_png(image)) return decode_png(image, file);
    return with_openexr(can_not_decode, [&] {
        ExrReader reader(file);
        const Imf::Header& header = reader.input().header(0);
        require_size(image, side_of(header).width, side_of(header).height);
        const std::vector<std::string> names = channel_names(header);
        if (static_cast<int>(names.size()) != image.channels)
            throw std::runtime_error("it has " + std::to_string(names.size()) + " channels, expected " +
                                     std::to_string(image.channels));
        std::vector<float> pixels(values_of(image));
        read_channels(reader.input(), 0, names, pixels);
        return pixels;
    });
}

std::vector<float> decode_channel(const ImageDescription& image, std::span<const unsigned char> file,
                                  const char* channel) {
    if (is_png(image)) throw std::runtime_error("a PNG has no named channels");
    return with_openexr(can_not_decode, [&] {
        ExrReader reader(file);
        for (int part = 0; part < reader.input().parts(); ++part) {
            const Imf::Header& header = reader.input().header(part);
            if (!header.channels().findChannel(channel)) continue;
            require_size(image, side_of(header).width, side_of(header).height);
            std::vector<float> pixels(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
            read_channels(reader.input(), part, {channel}, pixels);
            return pixels;
        }
        throw std::runtime_error(std::string("it has no channel ") + channel);
    });
}

}  // namespace
}  // namespace pelagic::tools

extern "C" __attribute__((visibility("default"))) const pelagic::tools::ImageCodec pelagic_image_codec = {
    PELAGIC_VERSION, pelagic::tools::encode, pelagic::tools::decode, pelagic::tools::decode_channel,
    pelagic::tools::measure};
