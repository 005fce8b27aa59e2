// Options of dynamic waves, spray, shores and wave inputs, read from JavaScript objects. Names, defaults
// and ranges are those of the C++ tables of fields, in camelCase.
#pragma once

#include <emscripten/val.h>

#include <memory>
#include <string>

#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/gerstner_input.hpp"
#include "pelagic/sim/ripple_input.hpp"
#include "pelagic/sim/shore.hpp"
#include "pelagic/sim/spray.hpp"
#include "pelagic/sim/water_frame.hpp"

namespace pelagic::web {

// Each function that reads an object throws std::invalid_argument for an unknown option, a wrong
// type and a value out of range. The message is one line that names the option, its value and what
// is accepted. Absent options have their defaults.

/// Reads the option `dynamicWaves` of an ocean.
DynamicWavesOptions dynamic_waves_options_of(const emscripten::val& object);
/// Returns an object of every option.
emscripten::val options_of(const DynamicWavesOptions& options);

Disturbance disturbance_of(const emscripten::val& object);
/// Reads a sea level and a current.
WaterFrame water_frame_of(const emscripten::val& object);
/// Reads rain on dynamic waves of these options.
Rain rain_of(const emscripten::val& object, const DynamicWavesOptions& options);

/// Reads the option `spray` of an ocean.
SprayOptions spray_options_of(const emscripten::val& object);
/// \param name  of the emitter, for messages
SprayEmitter emitter_of(const std::string& name, const emscripten::val& object);

/// Reads the option `shore` of an ocean of this sea. \pre check(sea) is empty
ShoreOptions shore_options_of(const emscripten::val& object, const SeaState& sea);

/// A wave input of an ocean; one of the two is set.
struct OceanInput {
    std::shared_ptr<GerstnerInput> waves = {};
    std::shared_ptr<RippleInput> ripple = {};
};
/// Creates an input from {waves, choppiness} or {ripple}.
/// \param name  of the option, for messages
OceanInput input_of(const std::string& name, const emscripten::val& object);
/// Replaces the waves, or the ripple, of an input. The object must be of the same kind.
void set_input(OceanInput& input, const std::string& name, const emscripten::val& object);

/// Returns {dynamicWaves, disturbance, rain, shore, spray, sprayEmitter, analyticWave, ripple,
/// waterFrame}, arrays of rows as those of sea_option_table().
emscripten::val ocean_option_tables();

}  // namespace pelagic::web
