#include "pelagic/tools/export/exr_image.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <span>

#include "pelagic/message/number_text.hpp"
#include "pelagic/simd/half_float.hpp"
#include "pelagic/tools/maps/pixel_meaning.hpp"

namespace pelagic::tools {
namespace {

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
