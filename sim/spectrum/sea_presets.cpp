// Seas by name: the files of presets/, which cmake/sea_presets.cmake has made a table of. Heights
// of the named ones follow the World Meteorological Organization's sea states (Manual on Codes,
// WMO-No. 306, code table 3700). Those of beaufort-1 to beaufort-12 are the probable wave heights
// of the open sea in its table of Beaufort's forces, at a speed of the force's range and the fetch
// that gives them; waves of 0.1 m, the table's least, need more than a light air, so beaufort-1 has
// 0.06 m.
#include <array>

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {
namespace {

const std::array presets = {
#include "pelagic/generated/sea_presets.inc"
};

}  // namespace

std::span<const SeaPreset> sea_presets() { return presets; }

const SeaPreset* sea_preset_named(std::string_view name) {
    for (const SeaPreset& preset : presets)
        if (preset.name == name) return &preset;
    return nullptr;
}

}  // namespace pelagic
