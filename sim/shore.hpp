// A shore: a floor of the sea that waves feel, which may rise above the water as a beach or an island.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

struct ShoreOptions {
    static constexpr int max_samples_a_side = 4096;

    /// Heights of the floor above rest, metres, [-11000, 9000]; sample (i, j) is heights_m[j * columns + i] and stands at
    /// x = corner_x_m + i metres_a_sample, z alike. Columns and rows are 2 to 4096. The field is the shore's rectangle. Beyond it the floor
    /// continues as its nearest edge has it: dry ground stays dry, and the sea is open where it is deep enough for its waves.
    int columns = 0, rows = 0;
    std::vector<float> heights_m = {};
    double corner_x_m = 0, corner_z_m = 0;  ///< [-1e8, 1e8]
    double metres_a_sample = 1;             ///< [0.001, 10000]

    int resolution = 256;  ///< texels along the longer side of what frames show; 64, 128, 256, 512 or 1024
    /// Along the field's edges, where the coarsest cascade gives way to waves that feel the floor; 0: an eighth of its shorter side.
    /// [0, half of it]
    double fade_m = 0;
    /// Waves reach so high on dry sand at most, where those that break would end at the waterline; [0, 10]
    double swash_m = 0.25;
};

/// Empty, or what is wrong: "columns is 1, needs 2 to 4096".
std::string check(const ShoreOptions& options);
/// The same, and whether the sea can have one: of several cascades, and waves of a physical height: "cascades is 1, needs 2 to 4 ...".
/// \pre check(sea) is empty
std::string check(const ShoreOptions& options, const SeaState& sea);

/// Empty, or one line where texels are coarse for the long waves: those of less than 8 texels lose more than 3 % of their height between
/// texels. Lengths are those before the waves feel the floor.
/// \pre check(options), check(sea) and check(options, sea) are empty
std::string warning_about(const ShoreOptions& options, const SeaState& sea);

/// A shore at a place.
struct ShoreSample {
    double depth_m = 0;  ///< of still water; below 0 on land
    double height_m = 0, slope_x = 0, slope_z = 0, vertical_velocity_mps = 0, reach_m = 0;
    double velocity_x_mps = 0, velocity_z_mps = 0;  ///< of the long waves' water, by linear theory
    double foam = 0;                                ///< 0 to 1
    double parts[4] = {1, 1, 1, 1};                 ///< of the cascades
};

/// Of the view that a frame has, between texels as ShoreSurface describes; slopes are the derivatives of the height. The parts are 1 and
/// all else is 0 where x or z is no number.
ShoreSample sample(const ShoreSurface& shore, double x_m, double z_m);

/// XXH3 of all that a frame shows of the shore, little-endian; 0 of a frame without one. hash_of() has none of it.
std::uint64_t shore_hash_of(const Frame& frame);

}  // namespace pelagic
