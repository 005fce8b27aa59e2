// What pushes at a grid of water: sources that last, rain, what is said once, and the texels that all reach in a tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/dynamic_waves/grid_placement.hpp"
#include "pelagic/sim/dynamic_waves/rain_drops.hpp"

namespace pelagic {

class DynamicWaveSources {
   public:
    /// Sources that last, and disturbances of one tick.
    static constexpr std::size_t max_count = 4096;

    /// Adds a disturbance for the next tick. \pre check(disturbance) is empty, and waiting() < max_count
    void add_impulse(const Disturbance& disturbance);
    /// What waits for the tick to come. Some of it may be provisional, until settle().
    std::size_t waiting() const { return waiting_.size(); }
    std::size_t settled() const { return settled_; }
    void settle() { settled_ = waiting_.size(); }
    void forget_provisional() { waiting_.resize(settled_); }
    std::uint32_t new_number() { return next_number_++; }
    /// \param ticks  that are over: the source moves from where it is from then on
    void set(std::uint32_t number, const Disturbance& source, std::int64_t ticks);
    void remove(std::uint32_t number);
    bool has(std::uint32_t number) const;
    /// Sets the rain from the next tick on. \pre check(rain, water) is empty
    void set_rain(const Rain& rain, const DynamicWavesOptions& water) { rain_ = RainDrops(rain, water); }
    /// Of what lasts, in ascending order.
    std::vector<std::uint32_t> numbers() const;

    /// Finds what the tick after `ticks` of them reaches in the grid. Sources push in the order of their numbers, then
    /// disturbances in theirs, then rain.
    void begin_tick(const GridPlacement& placement, std::int64_t ticks, double tick_s);
    /// Before the step, in rows of the torus: presses take the shape away, which lift_rows() puts back after it.
    void push_rows(const GridPlacement& placement, std::size_t first_row, std::size_t rows,
                   HeightPlanes heights) const;
    void lift_rows(const GridPlacement& placement, std::size_t first_row, std::size_t rows,
                   HeightPlanes heights) const;
    void end_tick();

    /// What lasts, what waits and the rain, as bytes.
    std::size_t saved_bytes() const;
    void save(std::span<std::uint8_t> bytes) const;
    /// Throws std::invalid_argument if no such water of so many ticks can have saved them.
    static DynamicWaveSources restored(std::span<const std::uint8_t> bytes, std::int64_t ticks,
                                       const DynamicWavesOptions& water);
    std::size_t bytes() const;

   private:
    struct Source {
        std::uint32_t number;
        Disturbance disturbance;
        std::int64_t since;  ///< ticks that were over when it was set
    };
    /// A push as the rows of a tick need it.
    struct Splash {
        Disturbance of;
        float part;                   ///< of the way that a pull goes in one tick
        std::int64_t first_x, end_x;  ///< texels that it reaches, within the grid
        std::int64_t first_z, end_z;
        std::size_t profile;  ///< of a gauss: its values along x, then along z
        double cosine, sine;  ///< of a hull's heading
    };

    void add_splash(const Disturbance& of, const GridPlacement& placement, double tick_s);
    void add_profile(const Splash& splash, const GridPlacement& placement);
    template <class AtTexel>
    void for_texels(const Splash& splash, const GridPlacement& placement, std::size_t first_row, std::size_t rows,
                    AtTexel at_texel) const;

    std::uint32_t next_number_ = 1;
    std::vector<Source> sources_;       ///< by number
    std::vector<Disturbance> waiting_;  ///< for the tick to come
    std::size_t settled_ = 0;           ///< of these, the first ones
    std::vector<Splash> splashes_;      ///< of the tick in flight
    std::vector<float> profiles_;
    RainDrops rain_;
    std::int64_t tick_ = 0;  ///< in flight
};

}  // namespace pelagic
