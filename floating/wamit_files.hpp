// Coefficients and wave forces of a hull from the files of a panel method: WAMIT's .1 and .3, which
// Capytaine, NEMOH's and HydroStar's converters write too.
//
//   .1  PER I J A(I,J) [B(I,J)]                    without B at zero and infinite frequency
//   .3  PER BETA I MOD(X) PHASE(X) RE(X) IM(X)     total force of waves (Haskind or diffraction)
//
// Numbers are not dimensional, with the length L (WAMIT user manual 7.5, sections 4.2 and 4.3): A by rho L^k, B by
// rho omega L^k, k = 3 + rotations among I and J; X by rho g L^m for waves of amplitude 1, m = 2 for forces and 3
// for moments. WAMIT's x axis points forward, y to port, z up; modes 1 to 6 are surge, sway, heave, roll, pitch
// and yaw about the body's origin, which lies in the still water's plane or anywhere else.
//
// The result is in the axes and the order of HullMatrix, about the centre of mass.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "pelagic/floating/radiation_table.hpp"

namespace pelagic {

/// What the files do not contain.
struct WamitScale {
    enum class Column { period_s, omega_radps };
    Column first_column = Column::period_s;  ///< what PER is (IPEROUT)
    double length_m = 1;                     ///< ULEN, L; [1e-3, 1e4]
    double density_kgpm3 = 1025;             ///< [500, 2000]
    double gravity_mps2 = 9.80665;           ///< [1, 100]
    /// The body's origin from the centre of mass, in the hull's axes; [-1e3, 1e3] m. WAMIT's global origin lies
    /// above or below it.
    glm::dvec3 origin_m{0};
};

/// Forces of regular waves on a hull that is held at rest, afloat.
struct ForceTable {
    using Forces = std::array<std::complex<double>, 6>;  ///< N/m and N m/m, factors of exp(i omega t)
    std::vector<double> omega_radps;                     ///< increasing, positive
    /// Directions towards which waves travel, from the hull's +x towards +z (starboard), in [0, 2 pi), increasing.
    std::vector<double> heading_rad;
    /// Row by row: forces[i * heading_rad.size() + j] at omega_radps[i] and heading_rad[j], for waves of 1 m whose
    /// elevation at the centre of mass is cos(omega t).
    std::vector<Forces> forces;
};

inline constexpr std::size_t max_wamit_lines = 200'000;
inline constexpr std::size_t max_wamit_frequencies = 256;
inline constexpr std::size_t max_wamit_headings = 72;  ///< each 5 degrees

/// Reads the text of a file .1. Entries that are left out are 0 by symmetry, but for the diagonal. A(inf) is that of
/// the file, else A at its highest frequency.
/// \throws std::invalid_argument  in one line: "line 7: B(3,3) -0.2 is negative, expected damping", a mode or a
///                                frequency that is missing or given twice, another number of columns, values that
///                                are not finite, more than max_wamit_lines
RadiationTable read_wamit_1(std::string_view text, const WamitScale& scale);

/// Reads the text of a file .3. Headings from 0 to 180 degrees are mirrored: the hull is taken as symmetric.
/// \throws std::invalid_argument  in one line, as read_wamit_1(); also where MOD and PHASE do not agree with RE and
///                                IM, which other columns or units would cause
ForceTable read_wamit_3(std::string_view text, const WamitScale& scale);

}  // namespace pelagic
