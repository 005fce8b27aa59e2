// Added mass and radiation damping of a hull by frequency.
#pragma once

#include <vector>

#include "pelagic/floating/hull_matrix.hpp"

namespace pelagic {

/// Coefficients about the centre of mass, in the axes and the order of HullMatrix. They are those
/// of a hull that oscillates afloat with exp(i omega t) and no forward speed, in deep water.
struct RadiationTable {
    std::vector<double> omega_radps;      ///< increasing, positive
    std::vector<HullMatrix> added_mass;   ///< kg, kg m and kg m^2
    std::vector<HullMatrix> damping;      ///< kg/s, kg m/s and kg m^2/s
    HullMatrix infinite_added_mass{};     ///< at infinite frequency
};

}  // namespace pelagic
