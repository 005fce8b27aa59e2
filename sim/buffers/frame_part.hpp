// Interface of the parts of a frame: foam, a shore, dynamic waves, wave inputs and all else that
// adds to a frame beside the sources of its cascades.
//
// An ocean adds the stages of its parts to its graphs once. It then calls, for each frame:
//
//   swap_buffers()  before any step that may fail
//   begin()         for the frame, and for each tick of a part, before the run of the stages
//   end()           after the last run: the frame is complete
//   drop()          in place of end() if a step failed, or after it if the frame is discarded
//
// It calls the parts in the order in which they were added, on the thread that calls the ocean's
// methods. Stages run on threads of the executor. Nothing allocates in a frame after the first.
#pragma once

#include <cstddef>
#include <span>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/pass.hpp"
#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/water_frame.hpp"

namespace pelagic {

/// The stages after which a cascade's displacement and velocity are complete.
struct FilledBy {
    StageId displacement;
    /// Equals `displacement` without velocities, or where one stage computes both.
    StageId velocity;
};

/// A run of the stages: of a frame, or of a tick before it.
struct PassMoment {
    Pass pass;
    double time_s;          ///< of the frame or the tick
    double time_in_loop_s;  ///< time of the waves, which differs from time_s by whole loops
    double loop_period_s;
    const SeaStatistics& statistics;
    std::span<Cascade> cascades;  ///< with what their sources set: grids, thresholds, ranges
    /// Whether the run may leave out cascades that make no whitecaps, and the shore: for a tick of
    /// foam alone.
    bool whitecaps_only;
};

/// The ticks that a part needs before a frame. A tick computes the displacement of the cascades, in
/// the memory that the frame's displacement replaces. Parts share ticks of equal times.
struct TicksDue {
    int count = 0;
    double time_s = 0;          ///< of the first of them
    double time_in_loop_s = 0;  ///< time of its waves, which differs from time_s by whole loops
    bool whitecaps_only = false;  ///< PassMoment::whitecaps_only, unless it is another part's tick too

    /// Returns whether the first of them is at a time.
    bool begins_at(double at_s) const { return count > 0 && time_s == at_s; }
};

class FramePart {
   public:
    FramePart() = default;
    FramePart(const FramePart&) = delete;  // stages point to it
    FramePart& operator=(const FramePart&) = delete;
    virtual ~FramePart() = default;

    /// Adds the stages of a pass that change a cascade, before its textures are computed.
    /// \param filled  the stages that fill the cascade
    /// \returns       the stages after which the cascade is complete
    virtual FilledBy add_cascade_stages(JobGraph&, Pass, std::size_t /*cascade*/, FilledBy filled) { return filled; }
    /// Adds the stages of a pass that need all cascades, or none. Called after those of all cascades
    /// were added; a stage that waits for none of them starts with the first.
    /// \param surfaces_done  the stages that complete the cascades, by cascade. Stages that read a
    ///                       tick's surface replace them, because the frame overwrites it.
    /// \pre frames have planes, if a stage of Pass::frame reads them
    virtual void add_stages(JobGraph&, Pass, std::span<StageId> /*surfaces_done*/) {}

    /// Makes the buffers of the frame before last those of the next frame. It cannot fail.
    virtual void swap_buffers() {}
    /// Prepares the next run of a pass. \throws what the application's code throws
    virtual void begin(const PassMoment&) {}
    /// Returns whether end() would return without waiting for other threads. Never blocks.
    virtual bool is_done() const { return true; }
    /// Completes a frame: sets its views and widens its bounds, which the cascades' are added to.
    virtual void end(Frame&) {}
    /// Discards the last frame and reverts swap_buffers(). \pre swap_buffers() for this frame
    virtual void drop() {}

    /// Returns the ticks that the frame begun last needs. begin() of a tick at the time of the first
    /// removes it; that of another part's tick makes the part's stages do nothing. The pointer is
    /// constant: null for a part that never needs ticks.
    virtual const TicksDue* ticks() const { return nullptr; }

    /// Discards what the part keeps of earlier frames and ticks: after a failure, and where another
    /// sea replaces the forecast.
    virtual void forget() {}
    /// Prepares for one more change of the forecast. A frame may be in flight.
    virtual void before_change(const SeaChange&) {}
    /// Returns the name of the option if the part exists for one sea in still water only, which
    /// therefore cannot change: "shore". Null otherwise.
    virtual const char* fixes_sea() const { return nullptr; }
    /// Sets the sea level, the current and the origin of the next frames. \pre check(water) is empty
    virtual void set_water_frame(const WaterFrame&) {}

    /// Returns the memory of the part, the object included.
    virtual std::size_t bytes() const = 0;
};

}  // namespace pelagic
