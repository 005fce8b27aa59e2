// Wave inputs: waves that an application adds to the cascades themselves, so that normals, bounds,
// foam, queries and textures include them.
//
//   const auto waves = std::make_shared<GerstnerInput>(some_waves);
//   const auto rings = std::make_shared<RippleInput>(Ripple{.amplitude_m = 0.1});
//   Ocean ocean(sea, {.inputs = {waves, rings}});
//
// A cascade adds its inputs in their order, each into rows that are 0 before it. So the sum is
// bit-identical on any thread and instruction set. Inputs repeat with the cascade's side.
// Statistics of the sea, its significant wave height, roughness and whitecaps, remain those of the
// wind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

/// The time for which inputs are computed: a frame, or a tick of foam accumulation.
struct InputMoment {
    double time_s = 0;  ///< of the frame, or of the tick
    double loop_period_s = 1;
    /// Position in the loop, in units of 2^-32 of it. An input that uses no other time is
    /// bit-identical in every loop.
    std::uint32_t loop_turns = 0;
    /// 0 for a frame, 1 for a tick. A tick begins after the frame that needs it and may run
    /// concurrently with it. So an input stores what add() needs of a moment separately for each
    /// value of `pass_index`.
    std::size_t pass_index = 0;
    std::span<const CascadeGrid> grids = {};  ///< of the cascades, the coarsest first
    int resolution = 0;                       ///< of each
    Isa isa = {};                             ///< the instruction set that computes
};

/// Rows of a cascade: column i of row first_row + j is element j N + i. All are 0 before the call.
/// The values that an input writes are added to the cascade, in metres and metres a second along
/// the world's axes. They must be finite, with magnitudes of at most WaveInput::max_value.
struct InputRows {
    const InputMoment& moment;
    std::size_t cascade = 0;
    std::size_t first_row = 0, row_count = 0;
    std::span<float> dx, height, dz;
    /// Derivatives in time, m/s. Empty in ticks, and unless OceanOptions::velocities is set.
    std::span<float> velocity_x, velocity_y, velocity_z;

    /// Returns the grid of the cascade.
    const CascadeGrid& grid() const { return moment.grids[cascade]; }
    /// Returns N, the texels along a side.
    std::size_t resolution() const { return static_cast<std::size_t>(moment.resolution); }
    /// Returns one row of a field.
    std::span<float> row_of(std::span<float> field, std::size_t row) const {
        return field.empty() ? field : field.subspan(row * resolution(), resolution());
    }
};

/// A wave input, which belongs to one ocean.
///
/// The thread that calls the ocean's methods may change it, whether or not a frame is in flight.
/// Changes take effect at the next schedule(). Accumulated foam depends on the inputs at its ticks.
/// So its history differs from that after a jump in time if inputs change or do not repeat with the
/// loop.
class WaveInput {
   public:
    /// Largest magnitude of added values, metres or metres a second. For a larger or non-finite
    /// value that frame is lost, complete() throws std::invalid_argument, and the next frame may be
    /// scheduled.
    static constexpr float max_value = 1000;

    WaveInput() = default;
    WaveInput(const WaveInput&) = delete;
    WaveInput& operator=(const WaveInput&) = delete;
    virtual ~WaveInput() = default;

    /// Prepares a moment, on the thread that schedules, before anything is added. Exceptions
    /// pass through schedule() or complete().
    virtual void begin(const InputMoment& moment) = 0;
    /// Returns whether the input adds to a cascade. A cascade to which no input adds is unchanged.
    /// Called after begin().
    virtual bool adds_to(std::size_t cascade) const = 0;
    /// Returns a bound of the slopes that the input adds to a cascade, in [0, 100]. It widens the
    /// range of Cascade::slopes_rgba8; slopes are clamped to the range if the bound is too small.
    /// Called after begin().
    virtual double largest_slope(std::size_t cascade) const = 0;
    /// Writes the waves of some rows, on threads of the executor, several at once. If it throws,
    /// the frame is lost, and the next may be scheduled.
    virtual void add(const InputRows& rows) const = 0;
};

/// A wave input that calls a function of the application.
class CallbackInput final : public WaveInput {
   public:
    using Add = std::function<void(const InputRows&)>;

    static constexpr std::uint32_t all_cascades = ~std::uint32_t{0};

    /// \param largest_slope  bound of the added slopes; [0, 100]
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
