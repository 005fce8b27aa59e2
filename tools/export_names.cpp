#include "pelagic/tools/export_names.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/tile.hpp"
#include "pelagic/tools/frame_times.hpp"

namespace pelagic::tools {
namespace {

/// Takes a name to pieces from the front.
class NameReader {
   public:
    explicit NameReader(std::string_view name) : rest_(name) {}

    bool take(std::string_view text) {
        if (!rest_.starts_with(text)) return false;
        rest_.remove_prefix(text.size());
        return true;
    }
    /// A number from `least` to `most` in at least `digits` digits, with leading zeros up to there and no further.
    bool take_number(std::size_t digits, int least, int most) {
        const std::size_t end = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
        if (end < digits || end > 9 || (end > digits && rest_[0] == '0')) return false;
        const int number = std::stoi(std::string(rest_.substr(0, end)));
        rest_.remove_prefix(end);
        return least <= number && number <= most;
    }
    bool is_at_end() const { return rest_.empty(); }

   private:
    std::string_view rest_;
};

constexpr std::size_t frame_digits = 4;

}  // namespace

std::string image_name(const MapOptions& options, MapKind map, int tile, int frame, int level) {
    std::array<char, 16> number;
    std::snprintf(number.data(), number.size(), "%0*d", static_cast<int>(frame_digits), frame);
    std::string name(name_of(map));
    if (tile > 0) name += "_c" + std::to_string(tile);
    name.append("_").append(number.data());
    if (level > 0) name += "_mip" + std::to_string(level);
    return name + "." + extension_of(map, options);
}

const char* extension_of(MapKind map, const MapOptions& options) {
    if (options.format == ImageFormat::tiff) return "tif";
    if (options.format == ImageFormat::ktx2) return "ktx2";
    if (options.format == ImageFormat::dds) return "dds";
    return options.sample_of(map) == Sample::uint8 ? "png" : "exr";
}

bool is_image_name(std::string_view name) {
    constexpr int most_tiles = 4, most_level = mip_levels(2048) - 1;
    NameReader reader(name);
    const auto* map = std::find_if(all_maps.begin(), all_maps.end(),
                                   [&](MapKind one) { return reader.take(std::string(name_of(one)) + "_"); });
    if (map == all_maps.end()) return false;
    if (reader.take("c") && !(reader.take_number(1, 1, most_tiles - 1) && reader.take("_"))) return false;
    if (!reader.take_number(frame_digits, 0, FrameTimes::largest_number)) return false;
    if (reader.take(".ktx2") || reader.take(".dds")) return reader.is_at_end();
    if (has_chain(*map) && reader.take("_mip") && !reader.take_number(1, 1, most_level)) return false;
    return (reader.take(".tif") || reader.take(has_chain(*map) ? ".png" : ".exr")) && reader.is_at_end();
}

bool is_export_name(std::string_view name) {
    constexpr std::string_view end = ".part";
    if (name.starts_with('.') && name.ends_with(end) && name.size() > end.size())
        name = name.substr(1, name.size() - 1 - end.size());
    return name == sea_json_name || name == journal_name || name == lock_name || is_image_name(name);
}

}  // namespace pelagic::tools
