// Wave numbers at many depths.
#pragma once

#include <span>

namespace pelagic {

/// Sets `wave_numbers` to wave_number(omega, depth) of each depth. Several depths are solved
/// together, because the steps of one wait for each other.
/// \param omega  rad/s \param depths_m  metres, above 0 \param wave_numbers  rad/m
/// \pre omega > 0; the spans have the same length
void wave_numbers(double omega, std::span<const double> depths_m, std::span<double> wave_numbers);

}  // namespace pelagic
