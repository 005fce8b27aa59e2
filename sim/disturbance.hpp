// Disturbances of dynamic waves: oars, hulls, drops.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "pelagic/message/enum_names.hpp"
#include "pelagic/message/numeric_field.hpp"

namespace pelagic {

/// A disturbance of the water: an impulse, or a source that acts in every tick until it is removed.
struct Disturbance {
    enum class Shape {
        gauss,  ///< height_m exp(-(r / radius_m)^2), cut off at 3 radii
        /// height_m sqrt(1 - (along / length_m)^2 - (across / radius_m)^2) within that ellipse;
        /// height_m of a floating hull is below 0.
        hull,
    };
    enum class Mode {
        /// A pressure, or suction, equal to the weight of the shape's water. At rest the surface
        /// becomes the shape and stays so. A moving one leaves the waves of a moving pressure
        /// (Havelock 1908). The volume of the water is constant.
        pressure,
        /// The surface approaches the shape: a tick removes the fraction 1 - e^(-rate tick) of the
        /// difference, times the shape over its height. The bulge is bounded, and its volume is
        /// added to the water.
        relaxation,
        impulse,  ///< the shape is added to the surface at once: a drop, a stone
        /// Adds the foam that waves as high as the shape have (DynamicWavesOptions::foam_height_m),
        /// and no waves: water that a hull or a propeller breaks.
        foam,
    };

    // generated from schema/disturbance.toml: members
    Shape shape = Shape::gauss;  ///< shape
    Mode mode = Mode::pressure;  ///< what the shape does to the water
    double x_m = 0, z_m = 0;     ///< initial position in the world; [-1e8, 1e8]
    double radius_m = 1;         ///< radius, of a hull half its beam; [0.001, 1000]
    double length_m = 1;         ///< half the length of a hull; [0.001, 1000]
    double heading_rad = 0;      ///< direction of a hull's length, from +x towards +z; [-2 pi, 2 pi]
    double height_m = 0;         ///< height of the shape, below 0 for a floating hull; [-100, 100]
    double rate_per_s = 10;      ///< rate of a relaxation; (0, 1000]
    /// Velocity of a source until it is replaced; [-1000, 1000].
    double velocity_x_mps = 0, velocity_z_mps = 0;
    // end of generated
};

/// Returns the height of the shape at a position in the world, metres above rest. It is the surface
/// that a pressure at rest makes of still water.
double shape_at(const Disturbance& disturbance, double x_m, double z_m);

/// Returns the table of its numeric fields.
template <>
struct EnumNames<Disturbance::Shape> {
    static constexpr std::array<std::string_view, 2> all = {"gauss", "hull"};
};
template <>
struct EnumNames<Disturbance::Mode> {
    static constexpr std::array<std::string_view, 4> all = {"pressure", "relaxation", "impulse", "foam"};
};

/// Returns the numeric fields of a disturbance, with names and ranges.
std::span<const NumericField<Disturbance>> disturbance_fields();

/// Returns an empty string for a usable disturbance, else what is wrong: "radius_m 0 is out of
/// range [0.001, 1000]".
std::string check(const Disturbance& disturbance);

}  // namespace pelagic
