// Light options, read from JavaScript objects such as {preset: "noon", cloudCover: 0.3}. Names and
// ranges are those of gl/sky/sky.hpp, in camelCase.
#pragma once

#include <emscripten/val.h>

#include "pelagic/gl/sky/sky.hpp"

namespace pelagic::web {

struct Light {
    gl::SkyOptions sky;
    float stops = 0;  ///< above the sky's exposure; [-5, 5]
};

/// Returns the preset, or the default light, with the other options of an object; for undefined the
/// default light. Throws std::invalid_argument, one line that names the option, its value and what
/// is accepted.
Light light_with(const emscripten::val& options);

}  // namespace pelagic::web
