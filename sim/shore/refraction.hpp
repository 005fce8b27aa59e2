// How one long wave goes over a floor: where its crests are, and how high.
//
//   phase    |grad phase| = k(x), omega^2 = g k tanh(k d): the eikonal equation, its first arrival (Zhao 2005, fast sweeping)
//   energy   div(E Cg grad phase / k) = 0 along the rays (Munk and Traylor 1947): height = Ks Kr, Ks = sqrt(Cg0 / Cg). Fluxes go from
//            texel to texel in the order of the phases, so what lies behind an island gets what comes round it and no more
//
// Where the waves come in, Snell's law says how they ran up to there, over contours as straight as those of the plane that fits the floor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "pelagic/sim/shore/sea_bed.hpp"

namespace pelagic {

/// A wave before it feels the floor.
struct IncomingWave {
    double omega;             ///< rad/s
    double along_x, along_z;  ///< where it runs to, a unit vector
    double depth_m;           ///< of the open sea
};

class Refraction {
   public:
    /// Behind caustics rays cross, which heights of one phase can't tell: no wave is higher by refraction than this, Kr.
    static constexpr double max_focus = 1.5;
    /// A wave keeps so many texels, whatever the depth: shorter ones could not be drawn.
    static constexpr double min_texels = 4;

    Refraction(const SeaBed& bed, const IncomingWave& wave);
    /// Straight on: the floor is no more than where land is.
    static Refraction straight(const SeaBed& bed, double along_x, double along_z);

    static constexpr double nowhere = std::numeric_limits<double>::infinity();
    /// Radians that the wave is behind the rectangle's corner where it comes in first; `nowhere` on land and where no way leads.
    const std::vector<double>& phase() const { return phase_; }
    /// Its height over that in the open sea; 0 where it is nowhere.
    const std::vector<double>& height() const { return height_; }
    /// Ks alone; 1 on land.
    double shoaling(std::size_t texel) const { return shoaling_[texel]; }
    /// Texels where it is, in the order in which it comes there.
    const std::vector<std::uint32_t>& order() const { return order_; }
    /// The share of what comes to a texel that comes along x and along z, from the neighbours upstream. \pre not at an edge where it comes in
    struct Upstream {
        std::size_t x, z;         ///< texels
        double share_x, share_z;  ///< 0 if nothing comes from there; together 1, or 0
    };
    Upstream upstream(std::size_t texel) const;
    bool comes_in_at(std::size_t texel) const { return comes_in_[texel] != 0; }
    /// Radians at the corner where it comes in first, for a phase of 0 in the world's origin.
    double corner_phase() const { return corner_phase_; }

   private:
    Refraction(const SeaBed& bed, const IncomingWave& wave, bool is_straight);
    void come_in(const IncomingWave& wave, double open_k);
    void come_in_along(const IncomingWave& wave, double open_k, bool along_columns);
    void sweep();
    bool arrive(int i, int j);
    void carry_energy();

    const SeaBed& bed_;
    std::vector<double> k_, phase_, height_, shoaling_;
    std::vector<double> flux_;          ///< E Cg over that of the open sea
    std::vector<float> way_x_, way_z_;  ///< unit vector
    std::vector<std::uint8_t> comes_in_;
    std::vector<std::uint32_t> order_;
    double corner_phase_ = 0;
};

}  // namespace pelagic
