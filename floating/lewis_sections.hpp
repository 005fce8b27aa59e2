// Added mass and radiation damping of a hull from its sections, for hulls without given coefficients.
//
// The hull below the still waterline is cut into sections across its length. Each is replaced by the
// Lewis form of its beam, draught and area (F. M. Lewis, "The inertia of the water surrounding a
// vibrating ship", Trans. SNAME 37, 1929; J. M. J. Journee and W. W. Massie, "Offshore
// Hydromechanics", Delft 2001, chapter 7).
//
//   damping       The amplitude of the waves that a heaving section makes follows from Ursell's and
//                 Tasai's multipoles in the plane of the Lewis form (F. Ursell, Q. J. Mech. Appl. Math. 2,
//                 1949; F. Tasai, J. Soc. Nav. Arch. Japan 105, 1959). By Haskind's relation, it is
//                 also the force f(x) of waves on the section. The force on the hull is the sum over
//                 its sections, and Haskind's relation in three dimensions gives the damping (Newman,
//                 Marine Hydrodynamics, chapter 6), with F_j(beta) = integral of f(x) x_j exp(-i k x
//                 cos(beta)) dx, x_j 1 for heave and x for pitch:
//
//                   B_jl = k omega / (4 pi rho g^2) integral over beta of F_j conj(F_l)
//
//   added mass    At infinite frequency in heave and pitch, at zero frequency in the other modes, the
//                 sum of the sections' times a factor for three dimensions: that of the ellipsoid of
//                 the hull's axes (Lamb, Hydrodynamics, sections 114 and 115). The relation of Kramers
//                 and Kronig adds what the damping demands at other frequencies:
//
//                   A(omega) = A(inf) + 2/pi PV integral of B(s) / (s^2 - omega^2) ds
//
//   surge         that of a Lewis form of the waterplane times the factor of an ellipsoid, distributed in
//                 depth as the displaced volume; sway and roll of a hull that is deeper than long alike.
//
// Compared with a panel method (tests/potential_flow) up to 1.2 times the wave number of the resonance, heave of
// a hemisphere, a spar, a barge and a boat is within 3 to 20 % in added mass and 25 % in damping; pitch of the
// barge and the boat within 38 % and 75 %.
//
// Limitations. No forward speed. Deep water. Sections that do not reach the surface do not count. A section has
// one Lewis form: the hulls of a catamaran count as one, and the coupling of sway and roll of sections with hard
// chines has the wrong size or sign. Radiation damping of surge, sway, roll and yaw is 0.
#pragma once

#include <glm/vec3.hpp>

#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/hull_mesh.hpp"
#include "pelagic/floating/radiation_table.hpp"

namespace pelagic {

struct SectionCoefficients {
    /// At the resonance of heave, symmetric and positive semi-definite; kg, kg m and kg m^2.
    HullMatrix added_mass{};
    /// Of heave and pitch by their waves at the resonance of heave, symmetric and positive
    /// semi-definite; kg/s, kg m/s and kg m^2/s. 0 in the other modes.
    HullMatrix damping{};
    double heave_omega_radps = 0;        ///< of the resonance of heave
    double heave_wave_number_radpm = 0;  ///< of waves of that frequency, omega^2 / g
    double waterplane_m2 = 0;
    double displaced_m3 = 0;
    RadiationTable table;  ///< the same at other frequencies; other modes than heave and pitch are constant
};

/// Returns the coefficients of an upright hull afloat, about its centre of mass.
///
/// \param centre_of_mass_m  in the axes of the mesh
/// \param waterline_y_m     of the still water in the axes of the mesh; the hull's mass is that of
///                          the water that it displaces
/// \param density_kgpm3     of the water
/// Without water under the hull or a waterplane, the result is 0. Takes some 10 ms and allocates. Bit-identical on
/// every machine.
SectionCoefficients lewis_coefficients(const HullMesh& mesh, const glm::dvec3& centre_of_mass_m, double waterline_y_m,
                                       double density_kgpm3);

}  // namespace pelagic
