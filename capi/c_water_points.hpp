// Conversion of points in the water and of arrays for their samples. All throw std::invalid_argument.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "pelagic/capi/c_status.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/pelagic.h"
#include "pelagic/sim/water_kinematics.hpp"

namespace pelagic::capi {

/// The largest count whose size in bytes fits ptrdiff_t; no array in memory is larger.
inline constexpr std::size_t max_count = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);

inline void check_count(std::size_t count) {
    if (count > max_count) reject(invalid_value_message("points.count", count, "at most " + number_text(max_count)));
}

inline std::span<const double> positions_of(const double* all, const char* name, std::size_t count) {
    if (count == 0) return {};
    return {&needed(all, name), count};
}

/// Returns a conversion of the application's arrays of `count` elements.
inline auto arrays_of(std::size_t count) {
    return [count]<class T>(T* data) { return data ? std::span<T>(data, count) : std::span<T>(); };
}

inline WaterSamples water_samples_of(const pelagic_water_samples& from, std::size_t count) {
    const auto array = arrays_of(count);
    return {.depth_m = array(from.depth_m),
            .pressure_pa = array(from.pressure_pa),
            .velocity_x_mps = array(from.velocity_x_mps),
            .velocity_y_mps = array(from.velocity_y_mps),
            .velocity_z_mps = array(from.velocity_z_mps),
            .acceleration_x_mps2 = array(from.acceleration_x_mps2),
            .acceleration_y_mps2 = array(from.acceleration_y_mps2),
            .acceleration_z_mps2 = array(from.acceleration_z_mps2)};
}

inline double footprint_of(double footprint_m) {
    if (!(footprint_m >= 0 && std::isfinite(footprint_m)))
        reject(invalid_value_message("points.footprint_m", footprint_m, "0 or more"));
    return footprint_m;
}

/// Converts points that read_struct() has read.
inline WaterPoints water_points_of(const pelagic_water_points& from) {
    check_count(from.count);
    return {.x = positions_of(from.x, "points.x", from.count),
            .y = positions_of(from.y, "points.y", from.count),
            .z = positions_of(from.z, "points.z", from.count),
            .footprint_m = footprint_of(from.footprint_m)};
}

}  // namespace pelagic::capi
