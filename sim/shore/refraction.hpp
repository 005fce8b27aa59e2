// Refraction of one long wave over a sea floor: phase and height at each texel.
//
//   phase    |grad phase| = k(x), omega^2 = g k tanh(k d): the eikonal equation. The phase is that
//            of the first arrival, by fast sweeping (Zhao 2005).
//   energy   div(E Cg grad phase / k) = 0 along the rays (Munk and Traylor 1947): height = Ks Kr,
//            Ks = sqrt(Cg0 / Cg). Fluxes propagate from texel to texel in the order of the phases,
//            so water behind an island receives only energy that passes around it.
//
// At the edges where the wave enters, Snell's law gives its phase and direction. There the contours
// of the floor are assumed straight, as those of the plane that fits the floor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "pelagic/sim/shore/sea_bed.hpp"

namespace pelagic {

/// A wave in the open sea, before the depth affects it.
struct IncomingWave {
    double omega;             ///< rad/s
    double along_x, along_z;  ///< unit vector of the direction in which it travels
    double depth_m;           ///< depth of the open sea
};

class Refraction {
   public:
    /// Upper bound of Kr. Behind caustics rays cross, which one phase per texel cannot represent.
    static constexpr double max_focus = 1.5;
    /// Lower bound of the wavelength in texels, at any depth: the grid cannot represent shorter
    /// waves.
    static constexpr double min_texels = 4;

    /// Allocates the memory of any number of waves, one at a time.
    /// \param bed  must outlive the object
    explicit Refraction(const SeaBed& bed);

    /// Propagates a wave, which replaces the wave before.
    void propagate(const IncomingWave& wave);
    /// Propagates a wave without refraction: the depth has no effect, and land blocks the wave.
    void propagate_straight(double along_x, double along_z);

    static constexpr double nowhere = std::numeric_limits<double>::infinity();
    /// Returns the phase lag by texel, in radians, from the corner of the rectangle where the wave
    /// enters first. It is `nowhere` on land and at texels that the wave does not reach.
    const std::vector<double>& phase() const { return phase_; }
    /// Returns the wave's height divided by its height in the open sea; 0 where phase() is
    /// `nowhere`.
    const std::vector<double>& height() const { return height_; }
    /// Returns the shoaling coefficient Ks; 1 on land.
    double shoaling(std::size_t texel) const { return shoaling_[texel]; }
    /// Returns the texels that the wave reaches, in the order of arrival.
    const std::vector<std::uint32_t>& order() const { return order_; }
    /// Upstream neighbours of a texel along x and z, and the fraction of the energy that each
    /// supplies.
    struct Upstream {
        std::size_t x, z;         ///< texels
        double share_x, share_z;  ///< 0 if the neighbour supplies nothing; the sum is 1 or 0
    };
    /// \pre !comes_in_at(texel)
    Upstream upstream(std::size_t texel) const;
    /// Returns whether the wave enters the rectangle at the texel.
    bool comes_in_at(std::size_t texel) const { return comes_in_[texel] != 0; }
    /// Returns the phase, radians, at the corner where the wave enters first, if it is 0 at the
    /// world's origin.
    double corner_phase() const { return corner_phase_; }

   private:
    void propagate(const IncomingWave& wave, double open_k);
    void come_in(const IncomingWave& wave, double open_k);
    void come_in_along(const IncomingWave& wave, double open_k, bool along_columns);
    void sweep();
    bool arrive(int i, int j);
    void mark_later_neighbours(int i, int j);
    void sort_by_arrival();
    void carry_energy();

    const SeaBed& bed_;
    std::vector<double> k_, phase_, height_, shoaling_;
    std::vector<double> flux_;                      ///< E Cg divided by its value in the open sea
    std::vector<float> direction_x_, direction_z_;  ///< unit vector
    std::vector<std::uint8_t> comes_in_;
    std::vector<std::uint32_t> order_;
    double corner_phase_ = 0;

    // Memory of one call. Pages that the system provided again for each wave took over a third of
    // an ocean's first bake (256^2, one thread, virtual machine).
    struct Arrival {
        std::uint64_t phase_bits;
        std::uint32_t texel;
    };
    std::vector<std::size_t> water_;                 ///< texels, the same for each wave
    std::vector<double> water_depth_m_;              ///< of them
    std::vector<double> water_k_, water_speed_mps_;  ///< of them
    std::vector<std::uint8_t> may_change_;           ///< see sweep()
    std::vector<Arrival> arrivals_, sorted_;
};

}  // namespace pelagic
