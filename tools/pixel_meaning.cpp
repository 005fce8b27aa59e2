#include "pelagic/tools/pixel_meaning.hpp"

#include <array>
#include <string_view>

namespace pelagic::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Channel {
    std::string_view channel, name, unit;
    double scale, offset;
    std::array<double, 2> range;  ///< of values, {0, 0} where there is no limit
};

constexpr std::array displacement_channels = {
    Channel{"R", "Dx", "m", 1, 0, {}},
    Channel{"G", "height", "m", 1, 0, {}},
    Channel{"B", "Dz", "m", 1, 0, {}},
};

// Equations 50 and 51 with rounding: a byte b stands for (b - 128) / 127.5 up to (b - 127) / 127.5, and 2 b / 255 - 1 is
// the middle of that.
constexpr std::array gradient_channels = {
    Channel{"R", "normal_x", "1", 2, -1, {-1, 1}},
    Channel{"G", "normal_z", "1", 2, -1, {-1, 1}},
    Channel{"B", "jacobian", "1", 2, -1, {-1, 1}},
    Channel{"A", "smoothness", "1", 1, 0, {0, 1}},
};

template <std::size_t Count>
Json list_of(const std::array<Channel, Count>& channels) {
    Json list = Json::array();
    for (const Channel& channel : channels) {
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

}  // namespace

Json channels_as_json(const ExportOptions& options) {
    Json maps = Json::object();
    if (options.displacement) maps["displacement"] = list_of(displacement_channels);
    if (options.gradient) maps["gradient"] = list_of(gradient_channels);
    return maps;
}

Json layout_as_json(const SeaState& sea) {
    const double n = sea.resolution, texel_m = sea.patch_size_m / n;
    return {{"axes", {{"east", "+x"}, {"up", "+y"}, {"south", "+z"}}},
            {"row_0", "upper edge of the image"},
            {"x_m_of_column", line(texel_m, 0)},
            {"z_m_of_row", line(texel_m, 0)},
            {"u_of_column", line(1 / n, 0.5 / n)},
            {"v_down_of_row", line(1 / n, 0.5 / n)},
            {"repeats_after_m", sea.patch_size_m},
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
           "  place         N texels a side, L metres: column i, row j rests at x = i L/N, z = j L/N and is drawn "
           "at\n"
           "                (x + Dx, height, z + Dz). Row 0 is the upper edge of the image and z = 0. The rest place "
           "is\n"
           "                the texel's corner, its number stands at the centre: u = (i + 0.5)/N, v = (j + 0.5)/N "
           "from\n"
           "                the upper edge. The patch repeats after L, so column N is column 0 again\n"
           "  axes          right-handed: +x east, +y up, +z south, so north is -z\n"
           "  colour        none: load as linear, non-colour data, without sRGB, premultiplied alpha or compression";
}

}  // namespace pelagic::tools
