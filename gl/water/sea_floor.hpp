// What lies below the sea: an even floor at the sea's depth, or a field of heights, which may rise above the water as a beach
// or an island.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "pelagic/sim/shore.hpp"

namespace pelagic::gl {

struct SeaFloor {
    static constexpr int max_samples_a_side = 4096;

    /// Samples along x and z, each from 2 to 4096; 0: an even floor at the depth of the sea that is drawn.
    int columns = 0, rows = 0;
    /// columns * rows heights above rest, metres, [-11000, 9000]; sample (i, j) is heights_m[j * columns + i].
    std::vector<float> heights_m = {};
    glm::dvec2 corner_m{};  ///< world x and z of sample (0, 0)
    double metres_a_texel =
        1;  ///< between neighbouring samples; [0.001, 10000]. Beyond its edges the floor goes on as high as they are.
    bool is_sand = true;                    ///< with ripples, darker where it is wet; else of an even albedo
    glm::vec3 albedo{0.35f, 0.31f, 0.25f};  ///< of what is not sand; [0, 1]

    bool is_even() const { return columns == 0; }
    /// Of a field, bilinear between samples.
    double height_at(double x_m, double z_m) const;
};

/// Empty if usable, else the first bad field: "columns is 1, needs 2 to 4096, or 0 for an even floor".
std::string check(const SeaFloor& floor);

/// The floor that a shore's waves feel, of sand.
SeaFloor floor_of(const ShoreOptions& shore);

/// Heights as half floats, level after level down to one texel: what a texture takes. A half tells heights near the waterline
/// apart to a millimetre, and 60 m down to 3 cm.
struct FloorTexels {
    int levels = 0;
    std::vector<std::uint16_t> halves;
};
FloorTexels texels_of(const SeaFloor& floor);

}  // namespace pelagic::gl
