// When histories remember: ticks of about a tenth of a second, as many as fit a loop.
#pragma once

#include <cstdint>

namespace pelagic {

/// The place of a moment among ticks.
struct TickPlace {
    std::int64_t number = 0;  ///< of the last tick, counted from t = 0
    std::uint32_t part = 0;   ///< since then, in units of 2^-32 of a tick
};

/// Tick n is at n T / round(10 T), T being the loop's period, so that a loop holds whole ticks.
class TickClock {
   public:
    explicit TickClock(double loop_period_s);

    int ticks_a_loop() const { return ticks_; }
    double tick_s() const { return loop_period_s_ / ticks_; }

    /// The same part for moments that a whole number of loops parts. Beyond 2^40 loops ticks count as those of the loop there.
    /// \pre time_s is finite
    TickPlace at(double time_s) const;
    double time_s(std::int64_t number) const { return static_cast<double>(number) * loop_period_s_ / ticks_; }
    /// In the first loop, where the sea is the same.
    double time_in_loop_s(std::int64_t number) const;
    /// 0 to ticks_a_loop() - 1.
    int in_loop(std::int64_t number) const;

   private:
    double loop_period_s_;
    int ticks_;
};

}  // namespace pelagic
