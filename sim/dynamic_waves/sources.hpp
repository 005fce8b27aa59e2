// Disturbances of a dynamic-wave grid: sources, impulses and rain, and the texels that they reach
// in a tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/dynamic_waves/grid_placement.hpp"
#include "pelagic/sim/dynamic_waves/rain_drops.hpp"

namespace pelagic {

class DynamicWaveSources {
   public:
    /// Maximum number of sources, and of impulses in one tick.
    static constexpr std::size_t max_count = DynamicWaves::max_disturbances;

    /// Adds an impulse for the next tick. \pre check(disturbance) is empty, and waiting() <
    /// max_count
    void add_impulse(const Disturbance& disturbance);
    /// Returns the number of impulses that wait for the next tick. They are provisional until
    /// settle().
    std::size_t waiting() const { return waiting_.size(); }
    std::size_t settled() const { return settled_; }
    void settle() { settled_ = waiting_.size(); }
    void forget_provisional() { waiting_.resize(settled_); }
    std::uint32_t new_number() { return next_number_++; }
    /// Adds or replaces a source.
    /// \param ticks  number of completed ticks, from which on the source moves from its position
    void set(std::uint32_t number, const Disturbance& source, std::int64_t ticks);
    /// Adds or replaces a footprint. \pre check(footprint) is empty
    void set_footprint(std::uint32_t number, const PressureFootprint& footprint, std::int64_t ticks);
    bool has_footprint(std::uint32_t number) const;
    /// Removes a source or a footprint.
    void remove(std::uint32_t number);
    bool has(std::uint32_t number) const;
    /// Sets the rain from the next tick on. \pre check(rain, water) is empty
    void set_rain(const Rain& rain, const DynamicWavesOptions& water) { rain_ = RainDrops(rain, water); }
    /// Returns the numbers of sources and footprints, in ascending order.
    std::vector<std::uint32_t> numbers() const;

    /// Determines the texels that the next tick's disturbances reach. They act in this order:
    /// sources by number, footprints by number, impulses in the order of their commands, rain.
    /// \param ticks  number of completed ticks
    void begin_tick(const GridPlacement& placement, std::int64_t ticks, double tick_s);
    /// Applies disturbances to rows of the torus before the step. Pressures subtract their shape,
    /// which lift_rows() adds again after the step.
    void push_rows(const GridPlacement& placement, std::size_t first_row, std::size_t rows,
                   HeightPlanes heights) const;
    void lift_rows(const GridPlacement& placement, std::size_t first_row, std::size_t rows,
                   HeightPlanes heights) const;
    /// Adds the foam of disturbances to rows of the torus, after that of waves.
    /// \param threshold  DynamicWavesOptions::foam_height_m
    struct FoamPlane {
        std::uint8_t* foam;
        std::uint8_t* has_foam;  ///< by row; 0: none
    };
    void foam_rows(const GridPlacement& placement, std::size_t first_row, std::size_t rows, float threshold,
                   FoamPlane to) const;
    void end_tick();

    /// Saves sources, waiting impulses and rain as bytes.
    std::size_t saved_bytes() const;
    void save(std::span<std::uint8_t> bytes) const;
    /// Restores saved bytes. Throws std::invalid_argument if no grid with these options and ticks
    /// can have saved them.
    static DynamicWaveSources restored(std::span<const std::uint8_t> bytes, std::int64_t ticks,
                                       const DynamicWavesOptions& water);
    std::size_t bytes() const;

   private:
    struct Source {
        std::uint32_t number;
        Disturbance disturbance;
        std::int64_t since;  ///< number of completed ticks when it was set
    };
    struct Footprint {
        std::uint32_t number;
        PressureFootprint of;
        std::int64_t since;
        double moved_x_m = 0, moved_z_m = 0;  ///< since then, in the tick in flight
    };
    /// A disturbance in the tick in flight.
    struct Splash {
        Disturbance of;
        float fraction;               ///< of the difference that a relaxation removes in one tick
        std::int64_t first_x, end_x;  ///< reached texels within the grid
        std::int64_t first_z, end_z;
        std::size_t profile;  ///< of a Gaussian: index of its values along x, then along z
        double cosine, sine;  ///< of a hull's heading
        /// Null: one of the shapes. Else only the texels and the mode of the other members count.
        const Footprint* footprint = nullptr;
    };

    void add_footprint_splash(const Footprint& footprint, const GridPlacement& placement);
    void add_splash(const Disturbance& of, const GridPlacement& placement, double tick_s);
    void add_profile(const Splash& splash, const GridPlacement& placement);
    template <class AtTexel>
    void for_texels(const Splash& splash, const GridPlacement& placement, std::size_t first_row, std::size_t rows,
                    AtTexel at_texel) const;

    std::uint32_t next_number_ = 1;
    std::vector<Source> sources_;        ///< in ascending order of numbers
    std::vector<Footprint> footprints_;  ///< in ascending order of numbers
    std::vector<Disturbance> waiting_;   ///< impulses for the next tick
    /// Number of impulses that are not provisional, which are the first ones.
    std::size_t settled_ = 0;
    std::vector<Splash> splashes_;  ///< disturbances of the tick in flight
    std::vector<float> profiles_;
    RainDrops rain_;
    std::int64_t tick_ = 0;  ///< the tick in flight
};

}  // namespace pelagic
