// Times of ticks, of foam and of spray. Foam has about five a second, and a multiple of 16 of them in
// a loop.
#pragma once

#include <cstdint>

namespace pelagic {

/// A time, in ticks.
struct TickTime {
    std::int64_t number = 0;     ///< of the last tick, counted from t = 0
    std::uint32_t fraction = 0;  ///< fraction of a tick since then, in units of 2^-32
};

/// Foam tick n is at n d. A loop has a multiple of 16 ticks, so that snapshots, which are kept in rings
/// of 16 (snapshots.hpp), have the same place in the ring in every loop. The interval d is at least
/// 0.185 s, if the loop has time for 16 such ticks, and at most twice that; from loops of 30 s on
/// it is at most 0.206 s.
class TickClock {
   public:
    /// Ticks that a frame depends on: foam has faded after 15.
    static constexpr int kept_ticks = 16;

    /// \param per_foam_tick  number of ticks in the interval d of foam ticks; foam ticks are among them
    explicit TickClock(double loop_period_s, int per_foam_tick = 1);

    int ticks_per_loop() const { return ticks_; }
    double tick_s() const { return loop_period_s_ / ticks_; }

    /// Converts a time to ticks. Times that differ by a whole number of loops have identical
    /// fractions. Beyond 2^40 loops the loop number is clamped to 2^40. \pre time_s is finite
    TickTime at(double time_s) const;
    double time_s(std::int64_t number) const { return static_cast<double>(number) * loop_period_s_ / ticks_; }
    /// Returns the time of the corresponding tick in the first loop, at which the waves are
    /// identical.
    double time_in_loop_s(std::int64_t number) const;
    /// Returns a tick's number in its loop, 0 to ticks_per_loop() - 1.
    int in_loop(std::int64_t number) const;

   private:
    double loop_period_s_;
    int ticks_;
};

}  // namespace pelagic
