#include "pelagic/tools/export/image_files.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <span>

#include "pelagic/message/number_text.hpp"
#include "pelagic/simd/half_float.hpp"
#include "pelagic/tools/encode/exr_codec.hpp"
#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/encode/texture.hpp"
#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/maps/map_image.hpp"
#include "pelagic/tools/maps/pixel_meaning.hpp"

namespace pelagic::tools {
namespace {

/// Returns true if a file of the map contains all of its mip levels.
bool has_levels_within(const ExportOptions& options, MapKind map) {
    return is_texture(options.maps.format) || (options.maps.tiled && options.maps.is_exr(map));
}

/// Returns the number of stored mip levels. Formats with levels in a file store those of every map;
/// other formats store levels of maps that have a mip chain.
int stored_levels(const ExportOptions& options, MapKind map) {
    if (!options.maps.mips) return 1;
    return has_levels_within(options, map) || has_chain(map) ? mip_levels(resolution_of(options.sea.sea)) : 1;
}

ImageDescription description_of(MapKind map, const TextureImage& image, const MapOptions& options) {
    const bool is_png = extension_of(map, options) == std::string_view("png");
    return {.extension = extension_of(map, options),
            .width = image.width,
            .height = image.height,
            .channels = image.channels,
            .sample = image.sample,
            .colour_space = is_floating(image.sample) ? "Linear" : "Raw",
            .compression = is_png ? nullptr : name_of(options.compression).data(),
            // The default level of zlib for PNG, 6, takes four times as long for files 6 % smaller
            // (512 x 512, jonswap).
            .png_level = is_png ? std::optional(2) : std::nullopt,
            // The alpha channel is smoothness, not coverage; otherwise OpenImageIO would divide the
            // normals by it.
            .has_unassociated_alpha = map == MapKind::gradient};
}

TextureImage as_texture_image(MapImage image) {
    return {image.side, image.side, image.channels, image.sample, std::move(image.pixels)};
}

/// Returns true for a map of the sea instead of a cascade, which has no smaller levels.
bool is_of_patch(MapKind map, const MapOptions& options) { return map == MapKind::foam && options.foam_patch; }

std::vector<ImageFile> cascade_files(const ExportOptions& options, int frame) {
    std::vector<ImagePart> parts;
    for (int cascade = 0; cascade < cascades_of(options.sea.sea); ++cascade)
        for (const MapKind map : options.maps.maps) {
            if (is_of_patch(map, options.maps)) continue;
            const int levels = stored_levels(options, map);
            const int levels_per_part = has_levels_within(options, map) ? levels : 1;
            for (int level = 0; level < levels; level += levels_per_part)
                parts.push_back({.map = map, .cascade = cascade, .first_level = level, .levels = levels_per_part});
        }
    if (options.maps.pack != Pack::files && !parts.empty())
        return {{.name = packed_name(options.maps, frame), .parts = parts}};
    std::vector<ImageFile> files;
    for (const ImagePart& part : parts) {
        const ImageMark mark{.map = part.map, .cascade = part.cascade, .level = part.first_level};
        files.push_back({.name = image_name(options.maps, mark, frame, parts.size() == 1), .parts = {part}});
    }
    return files;
}

/// Returns the bytes of the value 1 in the sample type, in the machine's byte order.
std::vector<std::byte> one(Sample sample) {
    std::vector<std::byte> bytes(bytes_of(sample), std::byte{0xFF});
    if (sample == Sample::half) bytes = {std::byte{0x00}, std::byte{0x3C}};
    if (sample == Sample::float32) bytes = {std::byte{0x00}, std::byte{0x00}, std::byte{0x80}, std::byte{0x3F}};
    return bytes;
}

TextureImage with_fourth_channel(const TextureImage& image) {
    TextureImage filled{image.width, image.height, 4, image.sample, {}};
    const std::size_t sample = bytes_of(image.sample), texels = image.pixels.size() / (3 * sample);
    const std::vector<std::byte> fourth = one(image.sample);
    filled.pixels.resize(texels * 4 * sample);
    for (std::size_t texel = 0; texel < texels; ++texel) {
        std::byte* const to = &filled.pixels[texel * 4 * sample];
        std::memcpy(to, &image.pixels[texel * 3 * sample], 3 * sample);
        std::memcpy(to + 3 * sample, fourth.data(), sample);
    }
    return filled;
}

/// The value of each byte b = round(255 c) as a half.
constexpr std::array<std::uint16_t, 256> fractions_of_255 = [] {
    std::array<std::uint16_t, 256> halves{};
    for (std::size_t byte = 0; byte < halves.size(); ++byte)
        halves[byte] = static_cast<std::uint16_t>(half_of(static_cast<float>(byte) / 255.f));
    return halves;
}();

Sample exr_sample(Sample sample) { return sample == Sample::uint8 ? Sample::half : sample; }

template <class Value>
std::vector<std::byte> bytes_of_values(const std::vector<Value>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(Value));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

MapImage without_bytes(MapImage image) {
    if (image.sample != Sample::uint8) return image;
    std::vector<std::uint16_t> halves;
    halves.reserve(image.pixels.size());
    for (const std::byte byte : image.pixels) halves.push_back(fractions_of_255[std::to_integer<std::size_t>(byte)]);
    image.sample = Sample::half;
    image.pixels = bytes_of_values(halves);
    return image;
}

/// Returns "Dx = R m; height = G m; Dz = B m", or "normal_x = 2 R - 1; ...".
std::string channels_text(std::span<const ChannelMeaning> channels) {
    std::string text;
    for (const ChannelMeaning& channel : channels) {
        if (!text.empty()) text += "; ";
        text.append(channel.name).append(" = ");
        if (channel.scale != 1) text += number_text(channel.scale) + " ";
        text += channel.channel;
        if (channel.offset != 0) text += (channel.offset < 0 ? " - " : " + ") + number_text(std::abs(channel.offset));
        if (channel.unit != "1") text.append(" ").append(channel.unit);
    }
    return text;
}

/// Returns the name of a part or layer: "displacement", "displacement_c1".
std::string part_name(const ImagePart& part) {
    return std::string(name_of(part.map)) + (part.cascade > 0 ? "_c" + number_text(part.cascade) : "");
}

ExrLayer layer_of(const ImagePart& part, const Frame& frame, const MapOptions& options, const std::string& before) {
    const Sample sample = options.sample_of(part.map);
    ExrLayer layer{.channels = {}, .sample = exr_sample(sample), .image_of = [&frame, &options, part](int level) {
                       return without_bytes(
                           map_image(frame, part.cascade, part.map, part.first_level + level, options));
                   }};
    for (const ChannelMeaning& channel : channel_meanings(part.map, options))
        layer.channels.push_back(before + std::string(channel.channel));
    return layer;
}

void add_map(std::vector<ExrAttribute>& attributes, const ImagePart& part, const Cascade& cascade,
             const MapOptions& options, const std::string& layer) {
    const auto add = [&](const char* name, auto value) {
        attributes.emplace_back("pelagic:" + layer + name, std::move(value));
    };
    add("map", std::string(name_of(part.map)));
    add("channels", channels_text(channel_meanings(part.map, options)));
    add("cascade", part.cascade);
    add("side_m", cascade.grid.side_m);
    add("rotation_cosine", cascade.grid.cosine);
    add("rotation_sine", options.up_axis == UpAxis::z ? 0 - cascade.grid.sine : cascade.grid.sine);
}

ExrPart empty_part(const ImagePart& of, const Frame& frame, int number, const FrameTimes& times,
                   const MapOptions& maps) {
    return {.name = "",
            .side = frame.cascades[static_cast<std::size_t>(of.cascade)].resolution() >> of.first_level,
            .levels = of.levels,
            .layers = {},
            .attributes = {{"wrapmodes", "periodic,periodic"},
                           {"pelagic:frame", number},
                           {"pelagic:time_s", frame.time_s},
                           {"pelagic:loop_period_s", times.loop_period_s},
                           {"pelagic:axes",
                            maps.up_axis == UpAxis::z ? "+x east, +y north, +z up" : "+x east, +y up, +z south"},
                           {"pelagic:rows", maps.rows == FirstRow::bottom
                                                ? "the last row is z = 0 of the cascade"
                                                : "row 0 is the upper edge, z = 0 of the cascade"}},
            .frames_per_second = times.fps ? *times.fps : static_cast<double>(times.count()) / times.loop_period_s};
}

/// A grid of the water, which does not repeat.
struct PlainGrid {
    int side;
    double texel_m, first_x_m, first_z_m;
};

/// Returns the part with the dynamic-wave grid, or with the foam of several cascades.
ExrPart plain_part(MapKind map, const Frame& frame, int number, const ExportOptions& options) {
    const MapOptions& maps = options.maps;
    const DynamicWavesView& water = frame.dynamic_waves;
    const ImagePart of{.map = map};
    const bool is_foam = map == MapKind::foam;
    const FoamPatch patch = maps.foam_patch.value_or(FoamPatch());
    const PlainGrid grid =
        is_foam ? PlainGrid{patch.pixels, patch.pixel_m(), patch.pixel_m() / 2, patch.pixel_m() / 2}
                : PlainGrid{water.resolution, water.texel_m, static_cast<double>(water.first_x) * water.texel_m,
                            static_cast<double>(water.first_z) * water.texel_m};
    ExrPart part = empty_part(of, frame, number, options.times, maps);
    part.side = grid.side;
    const auto image_of = [&frame, &maps, is_foam](int) {
        return is_foam ? without_bytes(foam_patch_image(frame, maps))
                       : dynamic_waves_map_image(frame.dynamic_waves, maps);
    };
    ExrLayer layer{.channels = {}, .sample = exr_sample(maps.sample_of(map)), .image_of = image_of};
    for (const ChannelMeaning& channel : channel_meanings(of.map, maps)) layer.channels.emplace_back(channel.channel);
    part.layers.push_back(std::move(layer));
    for (auto& [name, value] : part.attributes) {
        if (name == "wrapmodes") value = "black,black";
        if (name == "pelagic:rows")
            value = maps.rows == FirstRow::bottom ? "the last row is the grid's lowest z"
                                                  : "row 0 is the upper edge, the grid's lowest z";
    }
    const auto add = [&](const char* name, auto value) {
        part.attributes.emplace_back(std::string("pelagic:") + name, std::move(value));
    };
    add("map", std::string(name_of(of.map)));
    add("channels", channels_text(channel_meanings(of.map, maps)));
    add("texel_m", grid.texel_m);
    add("x_m_of_column_0", grid.first_x_m);
    add("lowest_z_m", grid.first_z_m);
    return part;
}

}  // namespace

std::vector<ImageFile> image_files(const ExportOptions& options, int frame) {
    std::vector<ImageFile> files = cascade_files(options, frame);
    // The foam of several cascades and the dynamic-wave grid always have their own files, because
    // their sizes differ from those of cascades.
    if (options.maps.foam_patch)
        files.push_back({.name = image_name(options.maps, {.map = MapKind::foam, .cascade = 0, .level = 0}, frame,
                                            files.empty() && !options.events),
                         .parts = {{.map = MapKind::foam}}});
    if (options.events)
        files.push_back({.name = image_name(options.maps, {.map = MapKind::dynamic_waves, .cascade = 0, .level = 0},
                                            frame, false),
                         .parts = {{.map = MapKind::dynamic_waves}}});
    return files;
}

void load_codecs(const ExportOptions& options) {
    const bool is_texture = tools::is_texture(options.maps.format);
    bool has_exr = false, has_images = options.preview || (options.flipbook && !is_texture);
    for (const ImageFile& file : image_files(options, 0)) {
        const bool is_exr = options.maps.is_exr(file.parts.front().map);
        has_exr |= is_exr;
        has_images |= !is_exr && !is_texture;
    }
    if (has_exr) exr_codec();
    if (has_images) image_codec();
}

std::vector<unsigned char> encode_image_file(const ImageFile& file, const Frame& frame, int number,
                                             const ExportOptions& options) {
    const ImagePart& part = file.parts.front();
    if (options.maps.is_exr(part.map)) return exr_codec().encode(exr_file(file, frame, number, options));
    if (part.map == MapKind::dynamic_waves)
        return encode_pixels(part.map, {as_texture_image(dynamic_waves_map_image(frame.dynamic_waves, options.maps))},
                             options.maps);
    if (is_of_patch(part.map, options.maps))
        return encode_pixels(part.map, {as_texture_image(foam_patch_image(frame, options.maps))}, options.maps);
    std::vector<TextureImage> levels;
    if (is_texture(options.maps.format))
        for (MapImage& level : map_levels(frame, part.cascade, part.map, 0, part.levels, options.maps))
            levels.push_back(as_texture_image(std::move(level)));
    else
        levels.push_back(
            as_texture_image(map_image(frame, part.cascade, part.map, part.first_level, options.maps)));
    return encode_pixels(part.map, levels, options.maps);
}

std::vector<unsigned char> encode_pixels(MapKind map, const std::vector<TextureImage>& levels,
                                         const MapOptions& options) {
    if (is_texture(options.format)) return encode_texture(levels, options);
    return image_codec().encode(description_of(map, levels.front(), options), levels.front().pixels.data());
}

std::vector<unsigned char> encode_texture(const std::vector<TextureImage>& levels, const MapOptions& options) {
    assert(is_texture(options.format) && !levels.empty());
    std::vector<TextureImage> filled;
    Texture texture{.width = levels[0].width,
                    .height = levels[0].height,
                    .channels = levels[0].channels == 3 ? 4 : levels[0].channels,
                    .sample = levels[0].sample,
                    .levels = {}};
    filled.reserve(levels.size());
    for (const TextureImage& level : levels) {
        if (level.channels == 3) filled.push_back(with_fourth_channel(level));
        const std::vector<std::byte>& pixels = level.channels == 3 ? filled.back().pixels : level.pixels;
        texture.levels.emplace_back(reinterpret_cast<const unsigned char*>(pixels.data()), pixels.size());
    }
    if (options.format == ImageFormat::dds) return dds_file(texture);
    return ktx2_file(texture,
                     options.compression == Compression::zstd ? Supercompression::zstd : Supercompression::none);
}

ExrFile exr_file(const ImageFile& file, const Frame& frame, int number, const ExportOptions& options) {
    ExrFile exr{.parts = {}, .is_tiled = options.maps.tiled, .compression = options.maps.compression};
    // Channel names contain the layer in multi-part files too: OpenEXR advises readers not to
    // derive it from the part's name.
    const bool is_packed = options.maps.pack != Pack::files, has_layers = options.maps.pack == Pack::layers;
    for (const ImagePart& of : file.parts) {
        if (of.map == MapKind::dynamic_waves || (of.map == MapKind::foam && options.maps.foam_patch)) {
            exr.parts.push_back(plain_part(of.map, frame, number, options));
            continue;
        }
        const Cascade& cascade = frame.cascades[static_cast<std::size_t>(of.cascade)];
        if (exr.parts.empty() || !has_layers) {
            exr.parts.push_back(empty_part(of, frame, number, options.times, options.maps));
            if (is_packed && !has_layers) exr.parts.back().name = part_name(of);
        }
        ExrPart& part = exr.parts.back();
        part.layers.push_back(layer_of(of, frame, options.maps, is_packed ? part_name(of) + "." : ""));
        add_map(part.attributes, of, cascade, options.maps, has_layers ? part_name(of) + ":" : "");
    }
    return exr;
}

}  // namespace pelagic::tools
