// The maps that an export can have of each tile.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace pelagic::tools {

enum class MapKind { displacement, gradient, foam };

/// In the order in which records and files list them.
inline constexpr std::array all_maps = {MapKind::displacement, MapKind::gradient, MapKind::foam};

/// As --maps, records and file names have it.
std::string_view name_of(MapKind map);

/// Tiles have smaller levels of it, down to one texel.
constexpr bool has_chain(MapKind map) { return map != MapKind::displacement; }

std::optional<MapKind> map_named(std::string_view name);

}  // namespace pelagic::tools
