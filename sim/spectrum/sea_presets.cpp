// The sea-state presets: cmake/sea_presets.cmake converts the files of presets/ to a table.
//
// Heights of the named presets follow the World Meteorological Organization's sea states (Manual on
// Codes, WMO-No. 306, code table 3700). Heights of beaufort-1 to beaufort-12 are the probable wave
// heights of the open sea in its table of Beaufort forces. Each has a wind speed in the range of
// the force and the fetch that gives the height. The smallest height of the table, 0.1 m, needs
// more wind than force 1 has, so beaufort-1 has 0.06 m.
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
