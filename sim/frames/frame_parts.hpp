// The parts of an ocean's frames that its options ask for.
#pragma once

#include <memory>
#include <string>

#include "pelagic/sim/frames/frame_assembly.hpp"
#include "pelagic/sim/frames/spray_part.hpp"
#include "pelagic/sim/ocean.hpp"

namespace pelagic {

/// Returns an empty string if the parts that the options ask for can be combined with the other
/// options and the forecast, else a message that names the first that cannot.
/// \pre check(forecast) is empty
std::string check_parts(const Forecast& forecast, const OceanOptions& options);

/// Returns what frames of a sea contain, with defaults for options that are not set.
FrameContents contents_of(const OceanOptions& options, const SeaState& sea);

/// Parts that answer to the application, which the frames own; null without their options.
struct CommandedParts {
    DynamicWaves* dynamic_waves = nullptr;
    SprayPart* spray = nullptr;
};

/// Adds the parts to the frames of a forecast.
/// Throws std::invalid_argument if an option of a part is out of range, and what executors throw.
/// \pre check_parts() is empty
CommandedParts add_parts(FrameAssembly& frames, const Forecast& forecast, const OceanOptions& options,
                        const std::shared_ptr<Executor>& executor, Isa isa);

}  // namespace pelagic
