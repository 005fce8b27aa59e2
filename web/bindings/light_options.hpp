// Light as a page gives it, an object {preset: "noon", cloudCover: 0.3}: names and ranges are those of gl/sky/sky.hpp, in JavaScript's
// spelling.
#pragma once

#include <emscripten/val.h>

#include "pelagic/gl/sky/sky.hpp"

namespace pelagic::web {

struct Light {
    gl::SkyOptions sky;
    float stops = 0;  ///< brighter than the sky's own exposure
};

/// The preset or the default, and on top of it what else the object says; undefined: the default. Throws std::invalid_argument, one line
/// that names the option, the value and what is accepted.
Light light_with(const emscripten::val& options);

}  // namespace pelagic::web
