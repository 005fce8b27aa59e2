// Droplets of breaking crests, which leave at ticks (spray.hpp).
//
//   tick n:  the water of tick n - 1 that breaks has moved by v d since then; its droplets leave
//            within d from tick n on, with the velocity v
//            cells are searched for water that breaks at tick n
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pelagic/sim/spray/breaking_surface.hpp"
#include "pelagic/sim/spray/droplets.hpp"

namespace pelagic {

class CrestSpray {
   public:
    /// Candidates along the radius of the reach. A candidate stands for a cell, 2 m wide by default.
    static constexpr int cells_of_reach = 40;
    static constexpr std::size_t rows = 2 * cells_of_reach + 1;
    /// Largest number of ticks that launched a droplet which is still in the air: with the shortest
    /// ticks, of 0.0925 s, droplets live for max_spray_lifetime_s.
    static constexpr int launch_ticks = 18;
    /// Ticks that a frame depends on: droplets of the first launch need water of the tick before.
    static constexpr int kept_ticks = launch_ticks + 1;

    struct Tick {
        std::int64_t number = 0;
        int in_loop = 0;    ///< its number in its loop
        double tick_s = 0;  ///< interval of ticks
        SprayWind wind;
        double foam_level = 0;    ///< SeaStatistics::foam_level
        double x_m = 0, z_m = 0;  ///< centre, in the frame of the water
    };

    CrestSpray(const SprayOptions& options, const Allocator& memory);

    /// Discards all droplets.
    void clear();
    /// Begins a tick. \pre it follows the last one since clear()
    /// \param surface  of the tick; it is read by search_row() and launch() only
    void begin_tick(const Tick& tick, const BreakingSurface& surface);
    /// Finds the cells of a row in which water breaks. Thread-safe for different rows.
    void search_row(std::size_t row);
    /// Launches droplets. \pre search_row() of all rows
    void launch();

    const DropletRing& droplets() const { return droplets_; }
    const SprayOptions& options() const { return options_; }
    std::size_t bytes() const;

   private:
    /// A cell in which water breaks.
    struct Candidate {
        double x_m, z_m;  ///< reference position
        double droplets;  ///< mean number
        std::uint64_t key;
    };
    /// Water that breaks, from which a droplet leaves in the next tick.
    struct Breaking {
        double x_m, z_m;  ///< reference position
        SprayVector at_m;
        std::uint64_t key;
    };
    /// Droplets of a tick. All launch ticks together have no more than the ring. The mean is kept
    /// below, so that a tick seldom has too many.
    static constexpr std::size_t max_in_tick = max_spray_droplets / launch_ticks;

    void launch_breaking();
    void find_breaking();
    double burst(std::int64_t cell_x, std::int64_t cell_z) const;

    SprayOptions options_;
    double cell_m_;
    DropletRing droplets_;
    AlignedBuffer<Candidate> candidates_;  ///< by row
    std::array<std::size_t, rows> counts_{};
    AlignedBuffer<Breaking> breaking_;
    std::size_t breaking_count_ = 0;
    Tick tick_;
    BreakingSurface surface_;
};

}  // namespace pelagic
