// Sea level and current: the position of the water's frame in the world.
//
// A uniform current moves all water, so it is a change of frame. Frames of an ocean and all of
// their hashes are in the water's frame, whose origin lies at (current_x t, sea level, current_z t)
// in the world. Queries, drawing, spray and commands of dynamic waves use positions in the world.
// The wind is relative to the water.
#pragma once

#include <span>
#include <string>

#include "pelagic/message/numeric_field.hpp"

namespace pelagic {

/// A sea level, for instance of a tide, and a uniform current.
struct WaterFrame {
    // generated from schema/water_frame.toml: members
    double sea_level_m = 0;    ///< height of still water; [-1000, 1000]
    double current_x_mps = 0;  ///< velocity of the water along x; [-10, 10]
    double current_z_mps = 0;  ///< velocity of the water along z; [-10, 10]
    // end of generated

    /// A position in the world.
    struct Origin {
        double x_m = 0, y_m = 0, z_m = 0;
    };
    /// Returns the position of the water's origin at a time: a position in the world minus it is
    /// the position in the water.
    Origin origin_at(double time_s) const { return {current_x_mps * time_s, sea_level_m, current_z_mps * time_s}; }
    /// Returns whether all values are equal.
    bool operator==(const WaterFrame&) const = default;
};

/// Returns the table of its fields.
std::span<const NumericField<WaterFrame>> water_frame_fields();

/// Returns an empty string for a usable water frame, else a message about the first invalid field:
/// "sea_level_m 2000 is out of range [-1000, 1000]".
std::string check(const WaterFrame& water);

}  // namespace pelagic
