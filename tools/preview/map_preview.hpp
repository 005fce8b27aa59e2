// Preview images of maps, with colours for channels.
#pragma once

#include "pelagic/tools/maps/map_image.hpp"
#include "pelagic/tools/preview/rgba_image.hpp"

namespace pelagic::tools {

struct MapPreview {
    RgbaImage image;
    float min, max;  ///< range of the values over all channels
};

/// Draws a map as a square image. Integers are shown unscaled. Floats are scaled by their largest
/// magnitude m: black to white is [-m, m] if some are negative, else [0, m]. One channel is shown
/// as grey; a fourth is ignored.
/// \param side  side of the image in pixels; pixels are means of texels, or texels are repeated
MapPreview preview_of(const MapImage& map, int side);

}  // namespace pelagic::tools
