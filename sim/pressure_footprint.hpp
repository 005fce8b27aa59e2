// The water that a floating body displaces, cell by cell, as a pressure on dynamic waves.
#pragma once

#include <string>
#include <vector>

namespace pelagic {

/// A pressure equal to the weight of a depth of water in each cell of a rectangle. At rest the
/// surface sinks by that depth; a moving one leaves the waves of a moving pressure (Havelock 1908).
struct PressureFootprint {
    static constexpr int max_columns = 64, max_rows = 64;

    double x_m = 0, z_m = 0;  ///< middle of the rectangle in the world; [-1e8, 1e8]
    /// Unit vector along the length.
    double forward_x = 1, forward_z = 0;
    /// Velocity until it is replaced; [-1000, 1000].
    double velocity_x_mps = 0, velocity_z_mps = 0;
    double length_m = 1, beam_m = 1;  ///< of the rectangle; [0.001, 1000]
    int columns = 0, rows = 0;        ///< cells along the length and across it; [1, 64]
    /// Depth at the middle of each cell, [0, 100]: columns x rows, rows from port to starboard, the
    /// first column aft. Linear between middles, and 0 half a cell outside the outermost ones.
    std::vector<float> depth_m;
};

/// Returns the depth at a position in the world, metres.
double depth_at(const PressureFootprint& footprint, double x_m, double z_m);

/// A depth and its derivatives along x and z.
struct DepthAndSlope {
    double depth_m = 0, slope_x = 0, slope_z = 0;
};

/// Returns the depth at a position in the world, and its slope there.
DepthAndSlope depth_and_slope_at(const PressureFootprint& footprint, double x_m, double z_m);

/// Returns an empty string for a usable footprint, else what is wrong: "columns 0 is out of range
/// [1, 64]".
std::string check(const PressureFootprint& footprint);

}  // namespace pelagic
