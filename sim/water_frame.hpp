// Sea level, current and the world's origin: the position of the water's frame in the world.
//
// A uniform current moves all water, so it is a change of frame. So is a shift of the world's origin,
// which keeps an application's coordinates small. Frames of an ocean and all of their hashes are in
// the water's frame, whose origin lies at (current_x t - origin_x, sea level, current_z t - origin_z)
// in the world. Queries, drawing, spray and commands of dynamic waves use positions in the world.
// The wind is relative to the water.
#pragma once

#include <span>
#include <string>

#include "pelagic/message/numeric_field.hpp"

namespace pelagic {

/// A sea level, for instance of a tide, a uniform current, and the world's origin.
struct WaterFrame {
    // generated from schema/water_frame.toml: members
    double sea_level_m = 0;    ///< height of still water; [-1000, 1000]
    double current_x_mps = 0;  ///< velocity of the water along x; [-10, 10]
    double current_z_mps = 0;  ///< velocity of the water along z; [-10, 10]
    // end of generated
    /// Position of the world's origin relative to that of a world without a shift; [-1e8, 1e8].
    /// Ocean::set_origin() and ExactWater::set_origin() set it.
    double origin_x_m = 0, origin_z_m = 0;

    /// A position in the world.
    struct Origin {
        double x_m = 0, y_m = 0, z_m = 0;
    };
    /// Returns the position of the water's origin at a time: a position in the world minus it is
    /// the position in the water.
    Origin origin_at(double time_s) const {
        return {current_x_mps * time_s - origin_x_m, sea_level_m, current_z_mps * time_s - origin_z_m};
    }
    /// Returns whether all values are equal.
    bool operator==(const WaterFrame&) const = default;
};

/// Returns the table of sea level and current.
std::span<const NumericField<WaterFrame>> water_frame_fields();

/// Returns an empty string for a usable water frame, else a message about the first invalid field:
/// "sea_level_m 2000 is out of range [-1000, 1000]".
std::string check(const WaterFrame& water);

}  // namespace pelagic
