// The maps that an export can have of each cascade.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace pelagic::tools {

/// `dynamic_waves` is no cascade's: a dynamic-wave grid, which is there with --events alone.
enum class MapKind { displacement, gradient, normal, foam, velocity, jacobian, slope, dynamic_waves };

/// Those of cascades, in the order in which records and files list them.
inline constexpr std::array all_maps = {MapKind::displacement, MapKind::gradient, MapKind::normal, MapKind::foam,
                                        MapKind::velocity,     MapKind::jacobian, MapKind::slope};

/// As --maps, records and file names have it.
std::string_view name_of(MapKind map);

/// Its smaller levels, down to one texel, have files of their own: those of what moves vertices are rarely asked for.
constexpr bool has_chain(MapKind map) {
    return map != MapKind::displacement && map != MapKind::velocity && map != MapKind::dynamic_waves;
}

/// Its values lie in [-1, 1], so that --bit-depth can store them as 8 or 16 bits.
constexpr bool has_bit_depth(MapKind map) { return map == MapKind::normal || map == MapKind::foam; }

/// How many values a texel of the map has.
constexpr int channels_of(MapKind map) {
    switch (map) {
        case MapKind::gradient: return 4;
        case MapKind::displacement:
        case MapKind::normal:
        case MapKind::dynamic_waves:
        case MapKind::velocity: return 3;
        case MapKind::slope: return 2;
        case MapKind::foam:
        case MapKind::jacobian: return 1;
    }
    return 0;
}

std::optional<MapKind> map_named(std::string_view name);

}  // namespace pelagic::tools
