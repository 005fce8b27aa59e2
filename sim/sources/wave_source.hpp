// What makes waves: fills the displacement of one cascade, of frames and of the ticks that histories remember.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/cascade.hpp"

namespace pelagic {

/// What the waves are wanted for. A tick's displacement lies where the frame's will: a frame's stages come after those of its tick.
enum class Pass { tick, frame };
inline constexpr std::size_t passes = 2;

/// One of something for each pass.
template <class T>
struct OfEachPass {
    T& operator[](Pass pass) { return values[static_cast<std::size_t>(pass)]; }
    const T& operator[](Pass pass) const { return values[static_cast<std::size_t>(pass)]; }
    std::array<T, passes> values{};
};

class Arrival;

/// A moment of the sea: which of its ocean's seas there are, by number, and how much of the second (Forecast).
struct SeaMoment {
    double time_s = 0;
    std::size_t before = 0, after = 0;
    double part = 0;  ///< below 1; 0 where both are one
    /// None: all waves have that part. Else each band has its own, and `part` is that of the waves at the swell's peak.
    const Arrival* arrival = nullptr;
    double since_s = 0;  ///< the change began

    /// One sea's own waves, as they were baked.
    bool is_steady() const { return before == after; }
};

/// The stages after which a source's part of a pass stands.
struct FilledBy {
    StageId displacement;
    StageId velocity;  ///< the same where nobody wants any, or one stage makes both
};

class WaveSource {
   public:
    virtual ~WaveSource() = default;

    /// Adds the stages of a pass, which fill the buffers of the source's cascade in the slot that is the back one when they run.
    /// The source outlives the graph's runs.
    virtual FilledBy add_stages(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) = 0;

    /// What the next run of the pass's stages makes. Says what the cascade is, too. \pre none is in flight
    virtual void begin(Pass pass, const SeaMoment& moment, Cascade& cascade) = 0;
    /// The extremes of the last run.
    virtual FrameBounds end_frame() = 0;

    virtual std::size_t bytes() const = 0;
};

}  // namespace pelagic
