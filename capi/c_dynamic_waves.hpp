// Definition of pelagic_dynamic_waves.
#pragma once

#include <memory>

#include "pelagic/pelagic.h"
#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/rain.hpp"

struct pelagic_dynamic_waves {
    std::unique_ptr<pelagic::DynamicWaves> own;  ///< null if an ocean owns the waves
    pelagic::DynamicWaves* waves = nullptr;
    const pelagic_ocean* ocean = nullptr;  ///< the owner, or null
};

namespace pelagic::capi {

/// Reads the application's options. Throws std::invalid_argument for null, a wrong struct_size and
/// a value out of range.
DynamicWavesOptions dynamic_waves_options_of(const pelagic_dynamic_waves_options* options);

/// Convert structs of the application. Throw std::invalid_argument for null, a wrong struct_size and
/// unknown constants. check() checks the values.
Disturbance disturbance_of(const pelagic_disturbance* disturbance, const char* name);
Rain rain_of(const pelagic_rain* rain);

}  // namespace pelagic::capi
