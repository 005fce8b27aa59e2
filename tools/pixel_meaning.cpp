#include "pelagic/tools/pixel_meaning.hpp"

#include <string>
#include <string_view>
#include <vector>

#include "pelagic/sim/tile_plan.hpp"

namespace pelagic::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double two_pi = 6.28318530717958647693;

constexpr std::array displacement_channels = {
    ChannelMeaning{"R", "Dx", "m", 1, 0, {}},
    ChannelMeaning{"G", "height", "m", 1, 0, {}},
    ChannelMeaning{"B", "Dz", "m", 1, 0, {}},
};

// Equations 50 and 51 with rounding: a byte b stands for (b - 128) / 127.5 up to (b - 127) / 127.5, and 2 b / 255 - 1 is
// the middle of that.
constexpr std::array gradient_channels = {
    ChannelMeaning{"R", "normal_x", "1", 2, -1, {-1, 1}},
    ChannelMeaning{"G", "normal_z", "1", 2, -1, {-1, 1}},
    ChannelMeaning{"B", "jacobian", "1", 2, -1, {-1, 1}},
    ChannelMeaning{"A", "smoothness", "1", 1, 0, {0, 1}},
};

constexpr std::array foam_channels = {ChannelMeaning{"Y", "foam", "1", 1, 0, {0, 1}}};

Json list_of(std::span<const ChannelMeaning> channels) {
    Json list = Json::array();
    for (const ChannelMeaning& channel : channels) {
        Json entry = {{"channel", channel.channel},
                      {"name", channel.name},
                      {"unit", channel.unit},
                      {"scale", channel.scale},
                      {"offset", channel.offset}};
        if (channel.range[0] < channel.range[1]) entry["range"] = channel.range;
        list.push_back(entry);
    }
    return list;
}

Json line(double scale, double offset) { return {{"scale", scale}, {"offset", offset}}; }

/// Where the texels of a tile rest: x and z are sums of what a column and a row give.
Json tile_as_json(const TilePlan& tile) {
    const TileLattice& lattice = tile.lattice;
    const double texel_m = lattice.side_m / tile.resolution;
    const auto place = [](double column_m, double row_m) -> Json {
        return {{"column", column_m}, {"row", row_m}, {"offset", 0.0}};
    };
    Json json = {{"in_file_names", tile.number == 0 ? "" : "c" + std::to_string(tile.number)},
                 {"side_m", lattice.side_m},
                 {"resolution", tile.resolution},
                 {"turn", {{"cosine", lattice.cosine}, {"sine", lattice.sine}}},
                 {"x_m", place(lattice.cosine * texel_m, -lattice.sine * texel_m)},
                 {"z_m", place(lattice.sine * texel_m, lattice.cosine * texel_m)}};
    if (tile.least_k > 0) json["longest_wave_m"] = two_pi / tile.least_k;
    if (tile.is_banded()) json["shortest_wave_m"] = two_pi / tile.most_k;
    return json;
}

}  // namespace

std::span<const ChannelMeaning> channel_meanings(MapKind map) {
    switch (map) {
        case MapKind::displacement: return displacement_channels;
        case MapKind::gradient: return gradient_channels;
        case MapKind::foam: return foam_channels;
    }
    return {};
}

Json channels_as_json(const MapOptions& options) {
    Json maps = Json::object();
    for (const MapKind map : options.maps) maps[std::string(name_of(map))] = list_of(channel_meanings(map));
    return maps;
}

Json layout_as_json(const Forecast& forecast) {
    const std::vector<TilePlan> plans = plan_tiles(forecast);
    const double n = plans.front().resolution, side_m = plans.front().lattice.side_m, texel_m = side_m / n;
    Json tiles = Json::array();
    for (const TilePlan& plan : plans) tiles.push_back(tile_as_json(plan));
    return {{"axes", {{"east", "+x"}, {"up", "+y"}, {"south", "+z"}}},
            {"row_0", "upper edge of the image"},
            {"x_m_of_column", line(texel_m, 0)},
            {"z_m_of_row", line(texel_m, 0)},
            {"u_of_column", line(1 / n, 0.5 / n)},
            {"v_down_of_row", line(1 / n, 0.5 / n)},
            {"repeats_after_m", side_m},
            {"tiles", tiles},
            {"colour", false},
            {"alpha_is_opacity", false}};
}

std::string pixel_meaning() {
    return "What a pixel means (sea.json has it as numbers):\n"
           "  displacement  R, G, B = Dx, height, Dz in metres, as they are\n"
           "  gradient      a byte's part of 255 is c: normal x = 2R - 1, normal z = 2G - 1, Jacobian J = 2B - 1, "
           "which\n"
           "                was clamped to [-1, 1], each within 1/255; smoothness = A, no opacity. The normal's y "
           "is\n"
           "                sqrt(1 - x^2 - z^2), below 0 where J is: there the surface is turned over\n"
           "  foam          one channel: 0 none, 1 covered with foam, what breaks now and what is left of 2.9 "
           "seconds "
           "before\n"
           "  place         N texels a side, L metres: column i, row j rests at x = i L/N, z = j L/N and is drawn "
           "at\n"
           "                (x + Dx, height, z + Dz). Row 0 is the upper edge of the image and z = 0. The rest place "
           "is\n"
           "                the texel's corner, its number stands at the centre: u = (i + 0.5)/N, v = (j + 0.5)/N "
           "from\n"
           "                the upper edge. The tile repeats after L, so column N is column 0 again\n"
           "  several tiles what they hold adds up. Files of the coarsest have no mark, those of the next c1, c2, "
           "c3. Their "
           "sides\n"
           "                differ, and their columns and rows are turned in the world, about x = z = 0: sea.json "
           "says how\n"
           "                (layout, tiles). Dx, Dz and normals are along the world's axes in all of them. "
           "Displacements "
           "add;\n"
           "                normals don't, so take them from the sum, or add the slopes -x/y and -z/y for a "
           "start.\n"
           "                Foam at a place is the largest of the tiles'; a tile whose waves make none has black "
           "images\n"
           "  axes          right-handed: +x east, +y up, +z south, so north is -z\n"
           "  colour        none: load as linear, non-colour data, without sRGB, premultiplied alpha or compression";
}

}  // namespace pelagic::tools
