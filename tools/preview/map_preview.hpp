// A map as people see it: colours for its channels, in a square of any size.
#pragma once

#include "pelagic/tools/maps/map_image.hpp"
#include "pelagic/tools/preview/rgba_image.hpp"

namespace pelagic::tools {

struct MapPreview {
    RgbaImage image;
    float min, max;  ///< of the values, all channels together
};

/// Bytes and words as they are; floats from black, their largest magnitude below 0, to white, where some are below 0, else from 0.
/// One channel is grey. A fourth is left out. \param side  of the image; pixels are means, or repeated
MapPreview preview_of(const MapImage& map, int side);

}  // namespace pelagic::tools
