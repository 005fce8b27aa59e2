// Waves that an application adds to those of the wind: into the cascades themselves, so that whatever is made of cascades has them, normals,
// bounds, foam, queries, textures.
//
//   const auto waves = std::make_shared<GerstnerInput>(some_waves);
//   const auto rings = std::make_shared<RippleInput>(Ripple{.wavelength_m = 2, .amplitude_m = 0.1});
//   Ocean ocean(sea, {.inputs = {waves, rings}});
//
// A cascade gets them in their order, each into rows that are 0 before it, so the sum has the same bits on any thread and
// instruction set. It repeats after the cascade's side, and so do they. Figures of the sea, its significant height, its roughness
// and where it whitens, stay those of the wind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

/// What is about to be made: a frame, or a tick of foam that lasts.
struct InputMoment {
    double time_s = 0;  ///< of the frame, or of the tick
    double loop_period_s = 1;
    /// Where in the loop that is, 2^32 being all of it: an input that knows no other time has the same bits in every loop.
    std::uint32_t loop_turns = 0;
    /// 0 for a frame, 1 for a tick, which is begun after the frame that needs it and may be made in the same run. What add() needs of
    /// a moment is kept in one of two places.
    std::size_t place = 0;
    std::span<const CascadeGrid> grids = {};  ///< of the cascades, the coarsest first
    int resolution = 0;                       ///< of each
    Isa isa = {};                             ///< that computes
};

/// Some rows of a cascade, tight: column i of row first_row + j is at j N + i. They are 0, and what an input leaves there is added to the
/// cascade: metres and metres a second, in the world's axes. Values are finite and at most WaveInput::most.
struct InputRows {
    const InputMoment& moment;
    std::size_t cascade = 0;
    std::size_t first_row = 0, row_count = 0;
    std::span<float> dx, height, dz;
    /// Their derivatives in time. Empty unless OceanOptions::velocities, and in ticks.
    std::span<float> velocity_x, velocity_y, velocity_z;

    const CascadeGrid& grid() const { return moment.grids[cascade]; }
    std::size_t resolution() const { return static_cast<std::size_t>(moment.resolution); }
    /// One row of a field.
    std::span<float> row_of(std::span<float> field, std::size_t row) const {
        return field.empty() ? field : field.subspan(row * resolution(), resolution());
    }
};

/// An input belongs to one ocean. It is altered by the thread that calls the ocean's methods, whether or not a frame is in flight;
/// what it is then counts from the next schedule() on. Foam that lasts was made by inputs as they were at its ticks, so an
/// ocean whose inputs are altered, or don't loop, remembers other foam than one that jumps there.
class WaveInput {
   public:
    /// Of what is added, metres or metres a second. Anything else is refused: that frame is lost, complete() throws
    /// std::invalid_argument, and the next may be scheduled.
    static constexpr float max_value = 1000;

    WaveInput() = default;
    WaveInput(const WaveInput&) = delete;
    WaveInput& operator=(const WaveInput&) = delete;
    virtual ~WaveInput() = default;

    /// On the thread that schedules, before anything is added. What it throws, schedule() or complete() throws.
    virtual void begin(const InputMoment& moment) = 0;
    /// A cascade to which nothing is added keeps its bits. After begin().
    virtual bool adds_to(std::size_t cascade) const = 0;
    /// What slopes of the cascade get steeper by at most: the bytes of Cascade::slopes_rgba8 count in coarser parts, so that they hold
    /// both. In [0, 100]; where it is too little they stop at the end of their range. After begin().
    virtual double largest_slope(std::size_t cascade) const = 0;
    /// On threads of the executor, several at once. A frame is lost as above if it throws.
    virtual void add(const InputRows& rows) const = 0;
};

/// Calls a function of the application's.
class CallbackInput final : public WaveInput {
   public:
    using Add = std::function<void(const InputRows&)>;

    static constexpr std::uint32_t all_cascades = ~std::uint32_t{0};

    /// \param cascades  bit i: cascade i
    explicit CallbackInput(Add add, double largest_slope = 0.5, std::uint32_t cascades = all_cascades)
        : add_(std::move(add)), largest_slope_(largest_slope), cascades_(cascades) {}

    void begin(const InputMoment&) override {}
    bool adds_to(std::size_t cascade) const override { return add_ && (cascades_ >> cascade & 1) != 0; }
    double largest_slope(std::size_t) const override { return largest_slope_; }
    void add(const InputRows& rows) const override { add_(rows); }

   private:
    Add add_;
    double largest_slope_;
    std::uint32_t cascades_;
};

}  // namespace pelagic
