// What moves the water from outside: oars, hulls, drops.
#pragma once

#include <string>

namespace pelagic {

/// A push at the water: once, or as a source that lasts until it is taken away.
struct Disturbance {
    enum class Shape {
        gauss,  ///< height_m exp(-(r / radius_m)^2), cut off at 3 radii
        hull,  ///< height_m sqrt(1 - (along / length_m)^2 - (across / radius_m)^2) within that ellipse, below 0 where it floats
    };
    enum class Mode {
        /// Presses on the water, or lifts it, by the weight of the shape's own water: at rest the surface becomes the shape and stays
        /// so, and a moving one leaves the waves of a moving pressure (Havelock 1908). Adds no water.
        pressure,
        /// The water goes towards the shape, by 1 - e^(-rate tick) of what is left, times the shape over its height: the bulge is
        /// bounded, and water comes and goes with it.
        relaxation,
        impulse,  ///< the shape is added at once: a drop, a stone
    };

    Shape shape = Shape::gauss;
    Mode mode = Mode::pressure;
    double x_m = 0, z_m = 0;  ///< in the world, when it is given; [-1e8, 1e8]
    double radius_m = 1;      ///< of a hull half its beam; [0.001, 1000]
    double length_m = 1;      ///< of a hull half its length; [0.001, 1000]
    double heading_rad = 0;   ///< of a hull's length, from +x towards +z; [-2 pi, 2 pi]
    double height_m = 0;      ///< [-100, 100]
    double rate_per_s = 10;   ///< of a relaxation; (0, 1000]
    /// How a source that lasts moves from one tick to the next, until it is given anew; [-1000, 1000]
    double velocity_x_mps = 0, velocity_z_mps = 0;
};

/// The shape itself, metres above rest at a place of the world: what a pressure at rest makes of still water.
double shape_at(const Disturbance& disturbance, double x_m, double z_m);

/// Empty, or what is wrong: "radius_m is 0, needs [0.001, 1000]".
std::string check(const Disturbance& disturbance);

}  // namespace pelagic
