// Seas by name. Heights follow the World Meteorological Organization's sea states (code table 3700), winds the
// Beaufort scale; each patch holds at least two peak wavelengths, so that the sea is the one that the wind makes.
#include <array>

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {
namespace {

const std::array presets = {
    SeaPreset{"calm",
              "light breeze near a coast, Hs 0.3 m (sea state 2)",
              {.patch_size_m = 50, .wind_speed_mps = 3, .fetch_m = 20e3, .choppiness = 0.6}},
    SeaPreset{"moderate",
              "fresh breeze in open water, Hs 2.2 m (sea state 4)",
              {.patch_size_m = 200, .wind_speed_mps = 8, .fetch_m = 150e3, .choppiness = 0.8}},
    SeaPreset{"rough",
              "strong breeze over a long fetch, Hs 3.5 m (sea state 5)",
              {.patch_size_m = 300, .wind_speed_mps = 12, .fetch_m = 200e3, .choppiness = 0.9, .alignment = 0.6}},
    SeaPreset{"storm",
              "gale over a long fetch, Hs 8 m (sea state 7)",
              {.resolution = 512,
               .patch_size_m = 800,
               .wind_speed_mps = 19,
               .fetch_m = 400e3,
               .choppiness = 1,
               .alignment = 0.7}},
};

}  // namespace

std::span<const SeaPreset> sea_presets() { return presets; }

}  // namespace pelagic
