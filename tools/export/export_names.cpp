#include "pelagic/tools/export/export_names.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/tools/export/frame_times.hpp"
#include "pelagic/tools/export/shard.hpp"

namespace pelagic::tools {
namespace {

constexpr std::size_t frame_digits = 4;
constexpr int max_named_cascades = 4, max_level = mip_levels(2048) - 1;

bool is_extension(std::string_view text, MapKind map) {
    if (text == "tif" || text == "ktx2" || text == "dds") return true;
    const bool has_floats = map != MapKind::gradient, has_parts = !has_floats || has_bit_depth(map);
    return (has_floats && text == "exr") || (has_parts && text == "png");
}

/// Parses a name from the front.
class NameReader {
   public:
    explicit NameReader(std::string_view name) : rest_(name) {}

    bool take(std::string_view text) {
        if (!rest_.starts_with(text)) return false;
        rest_.remove_prefix(text.size());
        return true;
    }
    /// Reads a number in [min, max] with at least `digits` digits; leading zeros only to reach
    /// `digits`.
    bool take_number(std::size_t digits, int min, int max) {
        const std::size_t end = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
        if (end < digits || end > 9 || (end > digits && rest_[0] == '0')) return false;
        const int number = std::stoi(std::string(rest_.substr(0, end)));
        rest_.remove_prefix(end);
        return min <= number && number <= max;
    }
    /// Reads a map and the index of a finer cascade: "displacement_c1".
    std::optional<MapKind> take_map_and_cascade() {
        const auto* map =
            std::find_if(all_maps.begin(), all_maps.end(), [&](MapKind one) { return take(name_of(one)); });
        if (map == all_maps.end() && take(name_of(MapKind::dynamic_waves))) return MapKind::dynamic_waves;
        if (map == all_maps.end() || (take("_c") && !take_number(1, 1, max_named_cascades - 1))) return {};
        return *map;
    }
    /// Reads an optional "_mip2" if the map has mip levels.
    bool take_level(MapKind map) { return !has_chain(map) || !take("_mip") || take_number(1, 1, max_level); }
    std::string_view rest() const { return rest_; }

   private:
    std::string_view rest_;
};

constexpr const char* mesh_mark = "mesh";
constexpr const char* flipbook_mark = "flipbook_";
constexpr const char* packed_start = "sea";

/// Returns "_0007".
std::string number_in_name(int frame) {
    std::array<char, 16> number;
    std::snprintf(number.data(), number.size(), "_%0*d", static_cast<int>(frame_digits), frame);
    return number.data();
}

}  // namespace

std::string image_name(const MapOptions& options, const ImageMark& mark, int frame, bool is_alone) {
    const std::string cascade = mark.cascade > 0 ? "_c" + std::to_string(mark.cascade) : "";
    const std::string level = mark.level > 0 ? "_mip" + std::to_string(mark.level) : "";
    const std::string map(name_of(mark.map));
    const char* extension = extension_of(mark.map, options);
    if (options.names) return options.names->name(is_alone ? "" : map + cascade + level, frame, extension);
    return map + cascade + number_in_name(frame) + level + "." + extension;
}

std::string mesh_name(const std::optional<NamePattern>& pattern, int frame, const char* extension) {
    if (pattern) return pattern->name(mesh_mark, frame, extension);
    return mesh_mark + number_in_name(frame) + "." + extension;
}

std::string packed_name(const MapOptions& options, int frame) {
    return options.names ? options.names->name("", frame, "exr") : packed_start + number_in_name(frame) + ".exr";
}

const char* extension_of(MapKind map, const MapOptions& options) {
    if (options.is_exr(map)) return "exr";
    return options.format == ImageFormat::exr_and_png ? "png" : name_of(options.format).data();
}

bool is_image_name(std::string_view name, const std::optional<NamePattern>& pattern) {
    NameReader reader(name);
    if (reader.take(packed_start))
        return reader.take("_") && reader.take_number(frame_digits, 0, FrameTimes::largest_number) &&
               reader.rest() == ".exr";
    const auto map = reader.take_map_and_cascade();
    if (map && reader.take("_") && reader.take_number(frame_digits, 0, FrameTimes::largest_number) &&
        reader.take_level(*map) && reader.take(".") && is_extension(reader.rest(), *map))
        return true;
    const auto parts = pattern ? pattern->parts_of(name) : std::nullopt;
    if (!parts) return false;
    if (parts->mark.empty())
        return std::any_of(all_maps.begin(), all_maps.end(),
                           [&](MapKind one) { return is_extension(parts->extension, one); });
    NameReader mark(parts->mark);
    const auto marked = mark.take_map_and_cascade();
    return marked && mark.take_level(*marked) && mark.rest().empty() && is_extension(parts->extension, *marked);
}

std::string flipbook_name(const MapOptions& options, MapKind map, int cascade) {
    const std::string mark = cascade > 0 ? "_c" + std::to_string(cascade) : "";
    return std::string(flipbook_mark).append(name_of(map)) + mark + "." + extension_of(map, options);
}

bool is_flipbook_name(std::string_view name) {
    if (name == flipbook_json_name) return true;
    NameReader reader(name);
    if (!reader.take(flipbook_mark)) return false;
    const auto map = reader.take_map_and_cascade();
    return map && reader.take(".") && is_extension(reader.rest(), *map);
}

bool is_mesh_name(std::string_view name, const std::optional<NamePattern>& pattern) {
    if (name == mesh_animation_name || name == point_cache_name) return true;
    const auto is_extension_of_meshes = [](std::string_view text) {
        return text == "obj" || text == "ply" || text == "glb";
    };
    NameReader reader(name);
    if (reader.take("mesh_") && reader.take_number(frame_digits, 0, FrameTimes::largest_number) && reader.take(".") &&
        is_extension_of_meshes(reader.rest()))
        return true;
    const auto parts = pattern ? pattern->parts_of(name) : std::nullopt;
    return parts && parts->mark == mesh_mark && is_extension_of_meshes(parts->extension);
}

bool is_export_name(std::string_view name, const std::optional<NamePattern>& pattern) {
    return is_record_name(name) || name == events_copy_name || is_image_name(name, pattern) ||
           is_mesh_name(name, pattern) || is_flipbook_name(name) || is_export_part(name, pattern);
}

bool is_export_part(std::string_view name, const std::optional<NamePattern>& pattern) {
    constexpr std::string_view end = ".part";
    return name.starts_with('.') && name.ends_with(end) && name.size() > end.size() &&
           is_export_name(name.substr(1, name.size() - 1 - end.size()), pattern);
}

}  // namespace pelagic::tools
