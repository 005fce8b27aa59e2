// Converts a baked sky to an equirectangular image, for renderers that light their scenes with one.
#pragma once

#include <vector>

#include "pelagic/gl/sky/sky.hpp"

namespace pelagic::gl {

/// Resamples the sky's finest level to an equirectangular image: RGB, top row first, width x height
/// texels.
///
/// Column i has the azimuth ((i + 0.5) / width - 0.5) 360 degrees, counted from +x towards +z, so
/// that +x is in the middle. Row j has the elevation (0.5 - (j + 0.5) / height) 180 degrees.
/// Radiance is relative to the sun's irradiance above the atmosphere, also at night. The image does
/// not contain the key light's disc: its direction is Sky::sun_direction, and its irradiance is
/// Sky::sun_irradiance times Sky::unit. The lower half holds the sky as other waves reflect it.
std::vector<float> panorama_of(const Sky& sky, int width, int height);

}  // namespace pelagic::gl
