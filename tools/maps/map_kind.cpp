#include "pelagic/tools/maps/map_kind.hpp"

#include <algorithm>

namespace pelagic::tools {

std::string_view name_of(MapKind map) {
    switch (map) {
        case MapKind::displacement: return "displacement";
        case MapKind::gradient: return "gradient";
        case MapKind::normal: return "normal";
        case MapKind::foam: return "foam";
        case MapKind::velocity: return "velocity";
        case MapKind::jacobian: return "jacobian";
        case MapKind::slope: return "slope";
        case MapKind::dynamic_waves: return "dynamic-waves";
    }
    return "";
}

std::optional<MapKind> map_named(std::string_view name) {
    const auto* found =
        std::find_if(all_maps.begin(), all_maps.end(), [&](MapKind map) { return name_of(map) == name; });
    return found == all_maps.end() ? std::nullopt : std::optional(*found);
}

}  // namespace pelagic::tools
