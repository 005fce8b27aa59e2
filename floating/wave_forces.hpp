// Forces of a sea on a hull from its forces in regular waves: a sum over the waves of the sea.
//
//   F(t) = sum of a_n Re(X(omega_n, beta_n) exp(i (omega_n t - k_n . x - phase_n)))
//
// with beta_n the direction of a wave from the heading of the hull, and x the position of its centre of mass.
// X is interpolated between the frequencies and the headings of a ForceTable. Forces are those on a hull at its
// height and attitude of rest. Hull uses them less the pressure of undisturbed waves (Hull::diffraction()).
//
// Limitations. Linear: a hull that leaves the water, or waves that break, do not count. A wave takes 3.5 kB and
// some 200 ns a sum.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "pelagic/floating/hull_matrix.hpp"
#include "pelagic/floating/wamit_files.hpp"
#include "pelagic/sim/sea_waves.hpp"

namespace pelagic {

/// The waves of a sea that carry most of its variance, with their forces on a hull. Immutable.
class WaveForces {
   public:
    static constexpr std::size_t headings = 72;  ///< the table's are interpolated to each 5 degrees

    /// Keeps the highest waves that carry `share` of the sum of squares of all amplitudes, 0 to 1. Forces of
    /// waves slower than the table's lowest frequency are those of the lowest; faster ones have none.
    /// \throws std::invalid_argument  check(table) or check(waves), unless it is empty
    WaveForces(const ForceTable& table, std::span<const WaveComponent> waves, double share = 0.99);

    /// Returns an empty string for a usable table, else what is wrong.
    static std::string check(const ForceTable& table);
    /// Returns the table interpolated to `headings`. \pre check(table) is empty
    static ForceTable at_each_heading(const ForceTable& table);
    /// Returns an empty string for usable waves, else what is wrong: at most a million; finite numbers; omega_radps in
    /// [0, 1e4]; amplitudes in [0, 1e3] m.
    static std::string check(std::span<const WaveComponent> waves);

    /// Returns the force and the torque about the centre of mass in axes of the hull upright, in the order of
    /// HullMatrix. Allocates nothing; the same bits for any thread.
    /// \param x_m, z_m     of the centre of mass
    /// \param heading_rad  of the hull's x axis, from +x towards +z
    Vector6 force(double x_m, double z_m, double heading_rad, double time_s) const;

    std::size_t wave_count() const { return waves_.size(); }  ///< that are kept
    /// Returns the fraction of the variance of the waves that are kept and lie below the table's highest frequency.
    double kept_share() const { return kept_share_; }

   private:
    struct Wave {
        WaveComponent of;
        double direction_turns;
    };
    std::vector<Wave> waves_;
    /// wave by wave, headings of each, six complex forces
    std::vector<float> forces_;
    double kept_share_ = 0;
};

}  // namespace pelagic
