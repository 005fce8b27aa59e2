// The dispersion relation at many depths, without surface tension. Several depths are solved
// together, because the steps of one wait for each other.
#pragma once

#include <span>

namespace pelagic {

/// Sets `wave_numbers` to wave_number(omega, depth) of each depth.
/// \param omega  rad/s \param depths_m  metres, above 0 \param wave_numbers  rad/m
/// \pre omega > 0; the spans have the same length
void wave_numbers(double omega, std::span<const double> depths_m, std::span<double> wave_numbers);

/// Sets `velocities` to group_velocity(k, depth) of each wave number and depth.
/// \param wave_numbers  rad/m \param depths_m  metres, above 0 \param velocities  m/s
/// \pre the spans have the same length
void group_velocities(std::span<const double> wave_numbers, std::span<const double> depths_m,
                      std::span<double> velocities);

}  // namespace pelagic
