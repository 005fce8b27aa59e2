// A shore: a sea floor that refracts waves and may rise above the water as a beach or an island.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pelagic/message/numeric_field.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic {

struct ShoreOptions {
    static constexpr int max_samples_per_side = 4096;

    // generated from schema/shore.toml: members
    int columns = 0;  ///< samples of the floor along x; 2 to 4096
    int rows = 0;     ///< samples of the floor along z; 2 to 4096
    /// Heights of the floor above the rest level, row by row; [-11000, 9000]. Sample (i, j) is
    /// heights_m[j * columns + i] and has the position x = corner_x_m + i metres_per_sample, z
    /// alike. The shore is the rectangle of the samples. Beyond it the floor continues as at its
    /// nearest edge: dry ground stays dry, and the sea is open where it is deep enough for its
    /// waves.
    std::vector<float> heights_m = {};
    double corner_x_m = 0, corner_z_m = 0;  ///< position of the first sample; [-1e8, 1e8]
    double metres_per_sample = 1;           ///< distance of neighbouring samples; [0.001, 10000]
    /// Texels along the longer side of the shore; 64, 128, 256, 512 or 1024.
    int resolution = 256;
    /// Width of the strip along the edges over which the coarsest cascade fades into waves over the
    /// floor; [0, half the field's shorter side]. 0: an eighth of the shorter side.
    double fade_m = 0;
    /// Maximum height above still water that waves reach on dry sand, with the set-up; [0, 10]. -1:
    /// the height that 2 % of the waves reach by Stockdon et al. 2006, from the sea's significant
    /// wave height and peak period and the median slope at the waterline. Waves in the water do not
    /// depend on it.
    double swash_m = -1;
    // end of generated
};

/// Returns the table of the numeric options.
std::span<const NumericField<ShoreOptions>> shore_fields();

/// Returns an empty string for usable options, else what is wrong: "columns is 1, expected 2 to
/// 4096".
std::string check(const ShoreOptions& options);
/// Checks the options and whether the sea can have a shore, which needs several cascades and waves
/// of a physical height: "cascades is 1, expected 2 to 4 ...". \pre check(sea) is empty
std::string check(const ShoreOptions& options, const SeaState& sea);

/// Returns a warning of one line if texels are coarse for the long waves, else an empty string.
/// Waves of less than 8 texels lose more than 3 % of their height between texels. Wavelengths are
/// those in open water. \pre check(options), check(sea) and check(options, sea) are empty
std::string warning_about(const ShoreOptions& options, const SeaState& sea);

/// A shore at a position.
struct ShoreSample {
    double depth_m = 0;  ///< of still water; below 0 on land
    double height_m = 0, slope_x = 0, slope_z = 0, vertical_velocity_mps = 0, reach_m = 0;
    double velocity_x_mps = 0, velocity_z_mps = 0;  ///< of the long waves, by linear theory
    double foam = 0;                                ///< 0 to 1
    double weights[4] = {1, 1, 1, 1};               ///< weights of the cascades
};

/// Samples the shore of a frame at a position in the water's frame (water_frame.hpp), interpolated as
/// ShoreSurface describes; slopes are the derivatives of the height. Returns weights of 1 and zeros
/// otherwise if x_m or z_m is not finite. Thread-safe.
ShoreSample sample(const ShoreSurface& shore, double x_m, double z_m);

/// Returns ShoreSample::weights without the cost of the other fields. Thread-safe.
/// \pre the shore is not empty
std::array<float, 4> shore_weights_at(const ShoreSurface& shore, double x_m, double z_m);

/// Returns the XXH3 of the frame's shore, little-endian; 0 for a frame without one. hash_of()
/// leaves the shore out.
std::uint64_t shore_hash_of(const Frame& frame);

}  // namespace pelagic
