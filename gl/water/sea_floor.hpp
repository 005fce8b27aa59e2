// Sea floor: an even floor at the sea's depth, or a height field. A height field may rise above the
// water as a beach or an island.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "pelagic/sim/shore.hpp"

namespace pelagic::gl {

struct SeaFloor {
    static constexpr int max_samples_per_side = 4096;

    /// Samples along x and z, each 2 to 4096. 0 selects an even floor at the depth of the sea.
    int columns = 0, rows = 0;
    /// columns * rows heights in the world, metres, [-11000, 9000]. Sample (i, j) is
    /// heights_m[j * columns + i].
    std::vector<float> heights_m = {};
    /// World x and z of sample (0, 0). Ocean::set_origin() moves the floor with the water.
    glm::dvec2 corner_m{};
    /// Distance between neighbouring samples, metres; [0.001, 10000]. Beyond its edges the floor
    /// keeps the height of the nearest edge.
    double metres_per_texel = 1;
    /// Sand has ripples and is darker where it is wet. If false, the albedo is uniform.
    bool is_sand = true;
    glm::vec3 albedo{0.35f, 0.31f, 0.25f};  ///< albedo if is_sand is false; [0, 1] per channel

    /// Returns whether the floor is a plane at the sea's depth.
    bool is_even() const { return columns == 0; }
    /// Returns the height at a position in a world without a shift, bilinear between samples.
    /// \pre the floor is a height field
    double height_at(double x_m, double z_m) const;
};

/// Returns an empty string if the floor is valid, else a message about the first invalid field:
/// "columns is 1, expected 2 to 4096, or 0 for an even floor".
std::string check(const SeaFloor& floor);

/// Returns the floor of a shore, as sand.
SeaFloor floor_of(const ShoreOptions& shore);

/// Heights as half floats for a texture, level after level down to one texel. The precision of a
/// half is a millimetre near the waterline and 3 cm at a depth of 60 m.
struct FloorTexels {
    int levels = 0;
    std::vector<std::uint16_t> halves;
};
/// Returns the heights as texels of a texture, half floats.
FloorTexels texels_of(const SeaFloor& floor);

}  // namespace pelagic::gl
