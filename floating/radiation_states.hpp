// Radiation forces with memory: Cummins' equation with a fixed number of states.
//
// A hull that moves leaves waves, which act on it later (W. E. Cummins, "The impulse response function and
// ship motions", Schiffstechnik 9, 1962), with u the velocities about the centre of mass:
//
//   F(t) = -A(inf) du/dt - integral of K(t - s) u(s) ds,   K(t) = 2/pi integral of B(omega) cos(omega t) domega
//
// K is fitted by the responses of resonators, masses on springs and dampers that the motion drives:
//
//   K(t) = sum of C_n y_n(t),   y_n" + 2 zeta_n w_n y_n' + w_n^2 y_n = 0,   y_n(0) = 1, y_n'(0) = -2 zeta_n w_n
//   B(omega) = sum of C_n 2 zeta_n w_n omega^2 / ((w_n^2 - omega^2)^2 + (2 zeta_n w_n omega)^2)
//
// With C_n positive semi-definite each takes energy from the motion, stores it and loses it, so that the fit is
// passive whatever the data (T. Perez and T. I. Fossen, "A Matlab toolbox for parametric identification of
// radiation-force models", Modeling, Identification and Control 30, 2009, fits general systems and has to check
// that). Steps use the implicit midpoint rule, which keeps this: the energy of hull and states falls in still
// water, for steps of any length.
//
// The damping of smooth data, such as a hemisphere's, is met within 3 % of its maximum and the added mass within 5 %.
// Damping that rises faster than omega^2 from low frequencies, as that of pitch, is met within 17 %.
//
//   const RadiationFit fit = fit_radiation(table);
//   RadiationState state;                                      // at rest
//   const RadiationStep memory = begin_step(fit, state, step_s);
//   // solve (M + A(inf)) (u1 - u0) / step = F + memory.force - memory.damping (u0 + u1) / 2
//   complete_step(fit, state, step_s, mean);                   // mean = (u0 + u1) / 2
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "pelagic/floating/hull_matrix.hpp"
#include "pelagic/floating/radiation_table.hpp"

namespace pelagic {

/// The fit of a table. Immutable once made, so any thread may read it.
struct RadiationFit {
    static constexpr std::size_t resonator_count = RadiationState::resonator_count;
    struct Resonator {
        double omega_radps = 1, damping_ratio = 1;
        HullMatrix strength{};  ///< C_n, symmetric and positive semi-definite; kg/s^2, kg m/s^2 and kg m^2/s^2
    };
    std::array<Resonator, resonator_count> resonators{};
    HullMatrix infinite_added_mass{};

    /// Returns the damping of the fit. \pre omega_radps is positive
    HullMatrix damping(double omega_radps) const;
    /// Returns the added mass of the fit: A(inf) and what the resonators add. \pre omega_radps is positive
    HullMatrix added_mass(double omega_radps) const;
    /// Returns K(t). \pre t_s is at least 0
    HullMatrix retardation(double t_s) const;
};

/// The mean force in a step: force - damping * mean velocity.
struct RadiationStep {
    Vector6 force{};
    HullMatrix damping{};  ///< symmetric and positive semi-definite
};

/// Returns an empty string for a usable table, else what is wrong: at least 4 and at most 256 increasing
/// frequencies in (0, 1e4] rad/s, finite symmetric matrices within +-1e15, and damping[i][i] that is not negative.
std::string check(const RadiationTable& table);

/// Fits a table. Takes some 0.1 s and allocates. Bit-identical on every machine.
/// \throws std::invalid_argument  check(table), unless it is empty
RadiationFit fit_radiation(const RadiationTable& table);

/// Returns the mean force of a step as a function of the mean velocity. Allocates nothing.
/// \pre step_s is at least 0
RadiationStep begin_step(const RadiationFit& fit, const RadiationState& state, double step_s);

/// Advances the states by a step.
/// \param mean_velocity  of the step, in the order of HullMatrix
void complete_step(const RadiationFit& fit, RadiationState& state, double step_s, const Vector6& mean_velocity);

/// Returns the energy that the resonators store, J.
double stored_energy(const RadiationFit& fit, const RadiationState& state);

}  // namespace pelagic
