// The pixels of one map of a cascade for any file format: interleaved channels, rows from the
// top.
#pragma once

#include <cstddef>
#include <vector>

#include "pelagic/sim/dynamic_waves_view.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

struct MapImage {
    int side = 0;
    int channels = 0;
    Sample sample = Sample::float32;
    std::vector<std::byte> pixels;  ///< side^2 * channels values without padding, native byte order
};

/// Returns one mip level of a map. channels_as_json() and layout_as_json() describe its pixels and
/// rows (pixel_meaning.hpp). Levels are means of 2 x 2 texels; normals are unit vectors at every
/// level.
/// \param cascade  index in the frame
/// \pre the cascade has the map's views (asserted); foam is of a frame of one cascade
MapImage map_image(const Frame& frame, int cascade, MapKind map, int level, const MapOptions& options);

/// Returns several levels of a map, the largest first. Faster than separate calls of map_image().
std::vector<MapImage> map_levels(const Frame& frame, int cascade, MapKind map, int first_level, int levels,
                                 const MapOptions& options);

/// Returns the map of dynamic waves: height, vertical velocity and foam. Rows are along z and
/// columns along x, from the grid's lowest texel on.
MapImage dynamic_waves_map_image(const DynamicWavesView& water, const MapOptions& options);

/// Returns the foam of all cascades, at the centres of the pixels. Rows are along z and columns along
/// x, from the origin on. \pre options.foam_patch is set, and the frame has foam
MapImage foam_patch_image(const Frame& frame, const MapOptions& options);

/// Returns true if a value in any image of this process was clamped to +-65504, the largest half.
/// Thread safety: any thread may call it.
bool clamped_halves();

/// A square of texels from row 0 of the cascade on, independent of the image's first row.
struct MapValues {
    int side = 0;
    int channels = 0;
    std::vector<float> values;  ///< interleaved, side^2 * channels
};

/// Returns level 0 of any map but gradient, which the cascade stores as bytes. Vectors are along
/// the options' axes and in their unit; normals are along the cascade's own axes. Foam is that of
/// all cascades.
/// \param cascade  index in the frame
/// \pre the cascade has the map's views (asserted)
MapValues map_values(const Frame& frame, int cascade, MapKind map, const MapOptions& options);

/// Returns the foam of all cascades on a square of side^2 points, metres apart along x and z. The
/// first point is at the fraction `first` of this distance. \pre the frame has foam (asserted)
MapValues foam_values(const Frame& frame, int side, double spacing_m, double first);

/// Returns the next mip level, the means of 2 x 2 texels.
MapValues halved(const MapValues& finer);

/// Returns unit vectors; zero vectors become vertical.
MapValues normalised(MapValues normals);

}  // namespace pelagic::tools
