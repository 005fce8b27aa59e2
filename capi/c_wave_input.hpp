// Definition of pelagic_input.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "pelagic/pelagic.h"
#include "pelagic/sim/gerstner_input.hpp"
#include "pelagic/sim/ripple_input.hpp"
#include "pelagic/sim/wave_input.hpp"

struct pelagic_input {
    std::shared_ptr<pelagic::WaveInput> input;
    /// The input as its type, for the set functions; null for other types.
    std::shared_ptr<pelagic::GerstnerInput> waves = {};
    std::shared_ptr<pelagic::RippleInput> ripple = {};
    bool has_ocean = false;
};

namespace pelagic::capi {

/// Convert options. Throw std::invalid_argument for null, a wrong struct_size and too many waves.
/// check() checks the values.
AnalyticSea waves_of(const pelagic_waves* pointer);
Ripple ripple_of(const pelagic_ripple* pointer);

/// Converts the application's array. Throws std::invalid_argument for null and for inputs of other
/// oceans.
std::vector<std::shared_ptr<WaveInput>> inputs_of(pelagic_input* const* inputs, std::size_t count);

/// Convert structs of the application. Throw std::invalid_argument for null and a wrong struct_size.
/// The inputs check the values.
AnalyticSea waves_of(const pelagic_waves* waves);
Ripple ripple_of(const pelagic_ripple* ripple);

}  // namespace pelagic::capi
