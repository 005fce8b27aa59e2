#include "pelagic/tools/maps/pixel_meaning.hpp"

#include <array>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic::tools {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Linear conversion of a pixel's number c: scale c + offset.
struct Line {
    double scale = 1, offset = 0;
};

struct Channel {
    std::string_view name, unit;
    Line line;
    std::array<double, 2> range = {};  ///< range of values; {0, 0}: unlimited
};

/// Equations 50 and 51 with rounding: byte b represents values from (b - 128) / 127.5 to (b - 127)
/// / 127.5, whose middle is 2 b / 255 - 1.
constexpr Line scaled_from_minus_one = {2, -1};
constexpr std::array<double, 2> both_signs = {-1, 1}, one_sign = {0, 1};

std::vector<Channel> channels_of(MapKind map, const MapOptions& options) {
    const bool is_z_up = options.up_axis == UpAxis::z;
    const Line of_normals = is_floating(options.sample_of(map)) ? Line{} : scaled_from_minus_one;
    const Line in_metres{.scale = 1 / static_cast<double>(units_per_metre(options.unit))};
    switch (map) {
        case MapKind::displacement:
            if (is_z_up) return {{"Dx", "m", in_metres}, {"Dy", "m", in_metres}, {"height", "m", in_metres}};
            return {{"Dx", "m", in_metres}, {"height", "m", in_metres}, {"Dz", "m", in_metres}};
        case MapKind::velocity:
            return {
                {"velocity_x", "m/s", in_metres}, {"velocity_y", "m/s", in_metres}, {"velocity_z", "m/s", in_metres}};
        case MapKind::gradient:
            return {{"normal_x", "1", scaled_from_minus_one, both_signs},
                    {is_z_up ? "normal_y" : "normal_z", "1", scaled_from_minus_one, both_signs},
                    {"jacobian", "1", scaled_from_minus_one, both_signs},
                    {"smoothness", "1", {}, one_sign}};
        case MapKind::normal:
            return {{"normal_right", "1", of_normals, both_signs},
                    {options.normal_y == NormalY::up ? "normal_image_up" : "normal_image_down", "1", of_normals,
                     both_signs},
                    {"normal_out", "1", of_normals, one_sign}};
        case MapKind::jacobian: return {{"jacobian", "1", {}}};
        case MapKind::slope: return {{"dh_dx", "1", {}}, {is_z_up ? "dh_dy" : "dh_dz", "1", {}}};
        case MapKind::foam: return {{"foam", "1", {}, one_sign}};
        case MapKind::compression: return {{"compression", "1", {}}};
        case MapKind::dynamic_waves:
            return {{"height", "m", in_metres}, {"vertical_velocity", "m/s", in_metres}, {"foam", "1", {}, one_sign}};
    }
    return {};
}

std::string_view type_name(Sample sample) {
    switch (sample) {
        case Sample::uint8: return "uint8";
        case Sample::uint16: return "uint16";
        case Sample::half: return "half";
        case Sample::float32: return "float";
    }
    return "";
}

/// Returns the sample type in files. EXR has no 8-bit and 16-bit integers, so they are stored as
/// halves.
Sample stored_sample(MapKind map, const MapOptions& options) {
    const Sample sample = options.sample_of(map);
    return options.is_exr(map) && !is_floating(sample) ? Sample::half : sample;
}

OrderedJson channel_list(MapKind map, const MapOptions& options) {
    OrderedJson list = OrderedJson::array();
    for (const ChannelMeaning& channel : channel_meanings(map, options)) {
        OrderedJson entry = {{"channel", channel.channel}, {"name", channel.name},
                             {"unit", channel.unit},       {"type", type_name(stored_sample(map, options))},
                             {"scale", channel.scale},     {"offset", channel.offset}};
        if (channel.range[0] < channel.range[1]) entry["range"] = channel.range;
        list.push_back(entry);
    }
    return list;
}

OrderedJson line_as_json(const Line& line) { return {{"scale", line.scale}, {"offset", line.offset}}; }

/// Offset of a texel's position per row of the image, computed from the offset per row of the
/// cascade.
struct RowPlaces {
    double a_row, offset;

    RowPlaces(double a_row_of_the_cascade, int resolution, FirstRow first)
        : a_row(first == FirstRow::top ? a_row_of_the_cascade : -a_row_of_the_cascade),
          offset(first == FirstRow::top ? 0 : a_row_of_the_cascade * (resolution - 1)) {}
};

/// The second horizontal axis of a file, and its sign relative to Pelagic's z.
const char* other_axis(UpAxis up) { return up == UpAxis::z ? "y" : "z"; }
double sign_of_z(UpAxis up) { return up == UpAxis::z ? -1 : 1; }

/// Returns the reference positions of a cascade's texels: x and the second axis as linear functions
/// of column and row.
OrderedJson cascade_as_json(const CascadePlan& cascade, const MapOptions& options) {
    const CascadeGrid& grid = cascade.grid;
    const double texel_m = grid.side_m / cascade.resolution, sign = sign_of_z(options.up_axis);
    const auto place = [&](double column_m, double row_m) -> OrderedJson {
        const RowPlaces rows(row_m, cascade.resolution, options.rows);
        // + 0.0 converts -0 to 0.
        return {{"column", column_m + 0.0}, {"row", rows.a_row + 0.0}, {"offset", rows.offset + 0.0}};
    };
    const std::string other = other_axis(options.up_axis);
    OrderedJson json = {{"in_file_names", cascade.number == 0 ? "" : "c" + std::to_string(cascade.number)},
                        {"side_m", grid.side_m},
                        {"resolution", cascade.resolution},
                        {"rotation", {{"cosine", grid.cosine}, {"sine", sign * grid.sine + 0.0}}},
                        {"x_m", place(grid.cosine * texel_m, -grid.sine * texel_m)},
                        {other + "_m", place(sign * grid.sine * texel_m, sign * grid.cosine * texel_m)}};
    if (cascade.min_k > 0) json["longest_wave_m"] = two_pi / cascade.min_k;
    if (cascade.is_banded()) json["shortest_wave_m"] = two_pi / cascade.max_k;
    return json;
}

OrderedJson axes_as_json(UpAxis up) {
    if (up == UpAxis::z) return {{"east", "+x"}, {"north", "+y"}, {"up", "+z"}};
    return {{"east", "+x"}, {"up", "+y"}, {"south", "+z"}};
}

}  // namespace

std::vector<ChannelMeaning> channel_meanings(MapKind map, const MapOptions& options) {
    const std::vector<Channel> channels = channels_of(map, options);
    constexpr std::string_view of_one = "Y", of_several = "RGBA";
    std::vector<ChannelMeaning> meanings;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const auto& [name, unit, line, range] = channels[i];
        meanings.push_back(
            {channels.size() == 1 ? of_one : of_several.substr(i, 1), name, unit, line.scale, line.offset, range});
    }
    return meanings;
}

OrderedJson channels_as_json(const MapOptions& options, bool has_dynamic_waves) {
    OrderedJson maps = OrderedJson::object();
    for (const MapKind map : options.maps) maps[std::string(name_of(map))] = channel_list(map, options);
    if (has_dynamic_waves)
        maps[std::string(name_of(MapKind::dynamic_waves))] = channel_list(MapKind::dynamic_waves, options);
    return maps;
}

OrderedJson layout_as_json(const Forecast& forecast, const MapOptions& options) {
    const std::vector<CascadePlan> plans = plan_cascades(forecast);
    const CascadePlan& first = plans.front();
    const double n = first.resolution, side_m = first.grid.side_m, texel_m = side_m / n;
    const RowPlaces rows(sign_of_z(options.up_axis) * texel_m, first.resolution, options.rows);
    OrderedJson cascades = OrderedJson::array();
    for (const CascadePlan& plan : plans) cascades.push_back(cascade_as_json(plan, options));
    return {{"axes", axes_as_json(options.up_axis)},
            {"row_0", "upper edge of the image"},
            {"x_m_of_column", line_as_json({texel_m, 0})},
            {std::string(other_axis(options.up_axis)) + "_m_of_row", line_as_json({rows.a_row, rows.offset})},
            {"u_of_column", line_as_json({1 / n, 0.5 / n})},
            {"v_down_of_row", line_as_json({1 / n, 0.5 / n})},
            {"repeats_after_m", side_m},
            {"cascades", cascades},
            {"colour", false},
            {"alpha_is_opacity", false}};
}

OrderedJson dynamic_waves_layout_as_json(const GridRecord& grid, const MapOptions& options) {
    const double sign = sign_of_z(options.up_axis), texel_m = grid.texel_m;
    const RowPlaces rows(sign * texel_m, grid.resolution, options.rows);
    const double first_row_m = sign * static_cast<double>(grid.first_z) * texel_m;
    return {{"resolution", grid.resolution},
            {"texel_m", texel_m},
            {"first_x", grid.first_x},
            {"first_z", grid.first_z},
            {"x_m_of_column", line_as_json({texel_m, static_cast<double>(grid.first_x) * texel_m + 0.0})},
            {std::string(other_axis(options.up_axis)) + "_m_of_row",
             line_as_json({rows.a_row, rows.offset + first_row_m + 0.0})}};
}

OrderedJson foam_patch_layout_as_json(const MapOptions& options) {
    const FoamPatch& patch = *options.foam_patch;
    const double sign = sign_of_z(options.up_axis), pixel_m = patch.pixel_m();
    const RowPlaces rows(sign * pixel_m, patch.pixels, options.rows);
    return {{"side_m", patch.side_m},
            {"resolution", patch.pixels},
            {"x_m_of_column", line_as_json({pixel_m, pixel_m / 2})},
            {std::string(other_axis(options.up_axis)) + "_m_of_row",
             line_as_json({rows.a_row, rows.offset + sign * pixel_m / 2})}};
}

std::string pixel_meaning() {
    return R"(Pixel values (sea.json holds the exact conversions for the chosen options):
  displacement  R, G, B = Dx, height, Dz in metres; with --axes z-up: Dx, Dy, height
  gradient      8 bits, scaled to [0, 1]: normal x = 2R - 1, normal z = 2G - 1 (z-up: y), Jacobian J = 2B - 1,
                clamped to [-1, 1], each within 1/255; smoothness = A, which is not opacity. The normal's y is
                sqrt(1 - x^2 - z^2), negative if J < 0, where the surface is overturned
  normal        tangent-space normal map along the cascade's own axes: right = 2R - 1, up the image = 2G - 1
                (--normal-y down: down the image), out of the water = 2B - 1; floats are stored unscaled. Unit
                vectors at every level. Normals of an overturned surface are horizontal
  foam          one channel: 0 no foam, 1 covered; breaking now, plus foam of earlier breaking, which decays in 2.8
                seconds. Of several cascades the map is one image of --foam-size metres, which does not repeat:
                column i, row j has the reference position x = (i + 0.5) p, z = (j + 0.5) p, p the side of a pixel
                (sea.json: foam_map)
  velocity      velocity of the displaced point along x, y, z in m/s; for motion blur
  jacobian      one channel: J, not clamped; below 1 the surface is compressed, below 0 overturned
  slope         R, G = dh/dx, dh/dz (z-up: dh/dy) of the heights over reference positions
  compression   one channel: q, the horizontal compression, with a fraction of the slope along the wind, in standard
                deviations of the sea's. Water breaks with the foam clamp(1/2 + (S - level) / ramp, 0, 1) of the
                cascades' sum S (sea.json: foam), and 1 of foam fades in fade_s seconds
  dynamic-waves with --events: R, G, B = height, vertical velocity (m/s), foam (1 covered) as floats. Add the height
                to the displaced surface. sea.json holds the position of the grid (dynamic_waves)
  position      N texels per side of L metres: column i, row j has the reference position x = i L/N, z = j L/N and
                the displaced position (x + Dx, height, z + Dz). Row 0 is the upper edge of the image and z = 0
                (--rows bottom: the last row is z = 0). A texel's value belongs to its corner in the world and to
                its centre in the image: u = (i + 0.5)/N, v = (j + 0.5)/N from the upper edge. The cascade repeats
                after L, so column N equals column 0
  cascades      files of the coarsest cascade have no mark, those of the next have c1, c2, c3. The cascades' sides
                differ, and their grids are rotated about x = z = 0; sea.json holds the rotations (layout, cascades).
                All maps but normal are along the world's axes. Displacements, velocities and slopes are added.
                Normals and Jacobians are not additive: compute them from the summed displacement, or approximate
                them from summed slopes. Compressions are added; those of a cascade that makes no foam are 0
  axes          right-handed: +x east, +y up, +z south, so north is -z; z-up: +x east, +y north, +z up
  colour        none: load as linear, non-colour data, without sRGB, premultiplied alpha or lossy compression)";
}

}  // namespace pelagic::tools
