// The kinds of maps of an export.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "pelagic/message/enum_names.hpp"

namespace pelagic::tools {

/// `dynamic_waves` is the map of the dynamic-wave grid, which exists with --events only. All others
/// are maps of a cascade.
enum class MapKind { displacement, gradient, normal, foam, velocity, jacobian, slope, compression, dynamic_waves };

}  // namespace pelagic::tools

// Names in options and in records.
namespace pelagic {

template <>
struct EnumNames<tools::MapKind> {
    static constexpr std::array<std::string_view, 9> all = {"displacement", "gradient",    "normal",
                                                            "foam",         "velocity",    "jacobian",
                                                            "slope",        "compression", "dynamic-waves"};
};

}  // namespace pelagic

namespace pelagic::tools {

/// The maps of cascades, in the order of records and files.
inline constexpr std::array all_maps = {MapKind::displacement, MapKind::gradient,   MapKind::normal,
                                        MapKind::foam,         MapKind::velocity,   MapKind::jacobian,
                                        MapKind::slope,        MapKind::compression};

/// Returns the map of a cascade with this name, if there is one.
constexpr std::optional<MapKind> cascade_map_named(std::string_view name) {
    const auto map = value_named<MapKind>(name);
    return map == MapKind::dynamic_waves ? std::nullopt : map;
}

/// Returns true if --mips writes the map's smaller levels, down to one texel. Maps that displace
/// vertices have none.
constexpr bool has_chain(MapKind map) {
    return map != MapKind::displacement && map != MapKind::velocity && map != MapKind::dynamic_waves;
}

/// Returns true if the values lie in [-1, 1], so that --bit-depth can store them as 8 or 16 bits.
constexpr bool has_bit_depth(MapKind map) { return map == MapKind::normal || map == MapKind::foam; }

/// Returns the number of values per texel.
constexpr int channels_of(MapKind map) {
    switch (map) {
        case MapKind::gradient: return 4;
        case MapKind::displacement:
        case MapKind::normal:
        case MapKind::dynamic_waves:
        case MapKind::velocity: return 3;
        case MapKind::slope: return 2;
        case MapKind::foam:
        case MapKind::jacobian:
        case MapKind::compression: return 1;
    }
    return 0;
}

}  // namespace pelagic::tools
