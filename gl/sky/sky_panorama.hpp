// A baked sky as an image of all directions, for renderers that light their scenes with one.
#pragma once

#include <vector>

#include "pelagic/gl/sky/sky.hpp"

namespace pelagic::gl {

/// What the sky's cube holds at its finest level, in equal steps of angle: RGB, rows from the top, width x height texels.
///
/// Column i looks towards the azimuth ((i + 0.5) / width - 0.5) 360 degrees, counted from +x towards +z: +x is in the middle. Row j
/// looks towards the elevation (0.5 - (j + 0.5) / height) 180 degrees. Radiance is relative to the sun's irradiance above the
/// air, also at night. The sun's disc is not in it: it is Sky::sun_irradiance from Sky::sun_direction. The lower half is what mirrors see there,
/// the sky in other waves.
std::vector<float> panorama_of(const Sky& sky, int width, int height);

}  // namespace pelagic::gl
