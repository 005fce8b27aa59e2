#include "pelagic/sim/foam/tick_clock.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/spectrum/dispersion.hpp"

namespace pelagic {
namespace {
/// Foam fades in 15 ticks, about 2.8 s. Longer intervals lose crests that pass between two ticks.
constexpr double min_tick_s = 0.185;
constexpr double max_loops = 0x1p40;
}  // namespace

TickClock::TickClock(double loop_period_s, int per_foam_tick)
    : loop_period_s_(loop_period_s),
      ticks_(per_foam_tick * kept_ticks * std::max(1, static_cast<int>(loop_period_s / (kept_ticks * min_tick_s)))) {}

// A tick's fraction of the loop is rounded by up to half a unit of 2^-32, so one unit is added
// before truncation.
TickTime TickClock::at(double time_s) const {
    const std::uint64_t turns = loop_fraction(time_s, loop_period_s_).turns;
    const std::uint64_t ticks = static_cast<std::uint64_t>(ticks_);
    const std::uint64_t place = turns * ticks + ticks;
    // The loop number is rounded, because the fraction may have been rounded up to 0 of the next
    // loop.
    const double loops = std::floor(time_s / loop_period_s_ - static_cast<double>(turns) * 0x1p-32 + 0.5);
    const auto whole = static_cast<std::int64_t>(std::clamp(loops, -max_loops, max_loops));
    return {whole * ticks_ + static_cast<std::int64_t>(place >> 32), static_cast<std::uint32_t>(place)};
}

int TickClock::in_loop(std::int64_t number) const {
    const std::int64_t remainder = number % ticks_;
    return static_cast<int>(remainder < 0 ? remainder + ticks_ : remainder);
}

double TickClock::time_in_loop_s(std::int64_t number) const { return in_loop(number) * loop_period_s_ / ticks_; }

}  // namespace pelagic
