// The ticks of a part of a frame (foam/tick_clock.hpp): a frame depends on the last ticks before its
// time, of which only those are computed that the part does not keep.
#pragma once

#include <cstdint>
#include <optional>

#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/cascades/weather.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"

namespace pelagic {

class KeptTicks {
   public:
    struct Options {
        int count = 0;                ///< ticks that a frame depends on, that before its time included
        int per_foam_tick = 1;        ///< of the clock
        bool repeats = false;         ///< whether ticks of one loop serve the next, in a constant sea
        bool whitecaps_only = false;  ///< TicksDue::whitecaps_only
    };
    KeptTicks(const Weather& weather, const Options& options) : weather_(weather), options_(options) {}

    TickClock clock() const {
        return TickClock(weather_.forecast().first.loop_period_s, options_.per_foam_tick);
    }
    const TicksDue& due() const { return due_; }
    /// Returns the place of the frame that was begun last.
    const TickTime& frame_tick() const { return frame_tick_; }

    /// Determines the ticks that a frame needs beyond those that are kept.
    void begin_frame(double time_s);
    /// Makes the first tick that is due the newest one, and returns its number. \pre due().count > 0
    std::int64_t begin_tick();
    /// Ends a frame.
    void end();
    /// Discards the frame in flight.
    void drop();
    /// Discards all ticks.
    void forget() { newest_.reset(); }
    /// Discards the ticks if the next change, or the change that is discarded for it, alters the sea
    /// at their times.
    void before_change(const SeaChange& next);

   private:
    void set_due(int count);

    const Weather& weather_;
    Options options_;
    TickTime frame_tick_;
    std::optional<std::int64_t> newest_;  ///< none: no tick is kept
    TicksDue due_;
    /// The ticks become invalid after the frame in flight.
    bool ends_with_frame_ = false;
};

}  // namespace pelagic
