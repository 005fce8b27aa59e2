// The sea: construct it once, then schedule and complete a frame as often as you draw.
//
//   Ocean ocean({.wind_speed_mps = 9});
//   ocean.schedule(0.0);
//   for (double t = 0;; t += 1.0 / 90) {
//       const Frame& frame = ocean.complete();  // the frame scheduled last
//       ocean.schedule(t + 1.0 / 90);           // the next one is computed while this one is drawn
//       draw(frame);
//   }
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/trace.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/shore.hpp"
#include "pelagic/sim/texture_targets.hpp"
#include "pelagic/sim/wave_input.hpp"
#include "pelagic/simd/allocator.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

/// How the sea is computed, and what comes with it; nothing in here changes a bit of the cascades but `foam`, and that
/// only foam, and `inputs`.
struct OceanOptions {
    std::shared_ptr<Executor> executor = {};  ///< none: oneTBB with its default number of threads
    std::optional<Isa> isa = {};              ///< none: PELAGIC_ISA, else the strongest that this CPU runs
    std::shared_ptr<TraceSink> trace = {};  ///< none: no clock is read. ChromeTrace or the application's own profiler
    bool queries = false;     ///< frames can be asked about any point (surface_query.hpp); N^2 / 8 bytes a frame
    bool velocities = false;  ///< frames have velocities; 12 N^2 bytes a frame and about twice the transforms
    bool gradients =
        false;            ///< frames of several cascades have each cascade's own normals too; those of one always do
    bool slopes = false;  ///< a frame of one cascade has slopes too (slope_sum.hpp); those of several always do
    /// Frames remember foam: what breaks lasts for 2.9 seconds, fades and drifts (foam/history.hpp). A frame then takes a
    /// tenth to a fifth longer, one of a tick, ten times a second, another half or more, and a jump in time, which computes 29
    /// ticks, as long as ten to twenty frames; 5 N^2 bytes a cascade. Without it half floats hold only what breaks at that very moment.
    bool foam = false;
    /// Dynamic waves beside the waves of the wind (dynamic_waves.hpp): frames have a grid of it, Frame::dynamic_waves, and queries tell the
    /// sum. With 256 texels a tick takes about three quarters of a frame of one cascade of 256, at 60 ticks a second; 18 N^2 bytes for
    /// frames and 29 N^2 for ticks.
    std::optional<DynamicWavesOptions> dynamic_waves = {};
    /// A floor that waves feel (shore.hpp): frames say what it makes of the sea, Frame::shore, and queries tell that. Of a sea of several
    /// cascades that never changes. Baking it takes a second or so of one core; 290 bytes for each of the shore's texels.
    std::optional<ShoreOptions> shore = {};
    /// Waves that are added to those of the wind, in this order (wave_input.hpp). What cascades hold then is the application's sea, and so is
    /// hash_of(); without inputs no bit, no job and no branch of a kernel is another.
    std::vector<std::shared_ptr<WaveInput>> inputs = {};
    Allocator memory = {};  ///< none: operator new. For frames and spectra, all but some 100 KB of an ocean
};

/// Not thread-safe: one thread at a time calls its methods; the work runs on the executor.
/// After construction a frame allocates nothing in Pelagic's code but inputs' tables in the first one, and throws only where an executor
/// fails (GraphRun::complete()) or an input (WaveInput): that frame or sea is lost then, and the next may be scheduled. Misuse is asserted.
class Ocean {
   public:
    /// Bakes the spectrum. Throws std::invalid_argument(check(sea)) if an option is out of range, what
    /// choose_isa() and executors throw, and std::bad_alloc.
    explicit Ocean(const SeaState& sea, OceanOptions options = {});
    /// The same with changes to come. The first sea is baked here, and each later one beside frames, from 10 s of the sea's time
    /// before it is needed. A frame waits for one that is not done, as after a jump.
    explicit Ocean(const Forecast& forecast, OceanOptions options = {});
    ~Ocean();  ///< waits for work in flight
    Ocean(const Ocean&) = delete;
    Ocean& operator=(const Ocean&) = delete;

    /// Starts the frame at `time_s` and returns at once; a small one (N up to 64) is left to complete(), which is done
    /// with it sooner than other threads would be. Any finite time, in any order: a frame is a pure function of
    /// the forecast and the time, and while one sea lasts time_s + n * loop_period_s gives the same bits. With
    /// OceanOptions::foam the warm-up of a jump in time is left to complete(), too.
    /// \pre no frame is in flight
    void schedule(double time_s) { schedule(time_s, {}); }

    /// The same with textures in memory of the application's, by cascade. The frame has no views of what is written there, and
    /// hash_of() none of its bits; the memory must stay until complete() returns. Throws
    /// std::invalid_argument(check(targets, ...)) before it computes.
    void schedule(double time_s, std::span<const TextureTargets> cascades);

    /// complete() would not wait for other threads: they are done with the frame, or have no part in it (a small frame, an
    /// executor without threads), or none is in flight. Never blocks.
    bool is_ready() const;

    /// Waits for the scheduled frame, helping, and hands it out. Without one in flight: the frame completed last.
    /// Its views stay valid while the next frame is computed, until the second schedule() from now.
    const Frame& complete();

    /// schedule() and complete() in one.
    const Frame& frame_at(double time_s);

    /// Computes the frame of `time_s` and writes it into the caller's arrays, those of a cascade each; for servers and replays. The views of the frame
    /// completed last stay valid, and what complete() hands out without a frame in flight is still that one. Throws
    /// std::invalid_argument(check(buffers, ...)) before it computes.
    /// \pre no frame is in flight
    FrameBounds frame_at(double time_s, std::span<const FrameBuffers> cascades);
    FrameBounds frame_at(double time_s, const FrameBuffers& only_cascade) {
        return frame_at(time_s, {&only_cascade, 1});
    }

    /// Starts to bake the spectrum of another sea beside the current one (stage `spectrum`); frames go on with the
    /// old one. The resolution must stay. Throws std::invalid_argument if a value is out of range or it does not.
    /// \pre no other sea is being baked
    void schedule_sea(const SeaState& sea);
    bool sea_is_ready() const;  ///< complete_sea() would not wait for other threads
    /// Frames scheduled from now on show the sea given last to schedule_sea(); waits for its spectrum.
    /// \pre no frame is in flight
    /// The changes that were to come are forgotten then.
    void complete_sea();

    /// One more change of the forecast: the sea turns into another one, and its spectrum is baked beside frames from now on
    /// (Forecast says what may change). The ocean remembers the last two changes, and times before them have the oldest sea that is
    /// left. Throws std::invalid_argument(check(forecast)) if the change before isn't over by `from_s`, or the sea doesn't fit.
    /// A frame may be in flight, and stays that of the forecast that it was scheduled in.
    /// \pre no sea is between schedule_sea(sea) and complete_sea()
    void schedule_sea(const SeaChange& change);
    void schedule_sea(const SeaState& sea, double from_s, double over_s) {
        schedule_sea({.sea = sea, .from_s = from_s, .over_s = over_s});
    }

    /// What frames remember, for whoever wants to go on from `time_s` without a warm-up: the bytes of ticks up to the frame
    /// completed last. Empty without OceanOptions::foam. \pre no frame is in flight
    std::vector<std::uint8_t> saved_history() const;
    /// Takes that up, in an ocean of the same sea. Throws std::invalid_argument if it is none of such an ocean.
    /// \pre no frame is in flight
    void restore_history(std::span<const std::uint8_t> saved);

    /// The dynamic waves of OceanOptions::dynamic_waves, which advance with the ocean's frames: frames of
    /// equal times with equal commands between them have bit-identical waves. Throws std::invalid_argument without that option.
    DynamicWaves& dynamic_waves();
    const DynamicWaves& dynamic_waves() const;

    std::size_t cascade_count() const;  ///< of every frame
    int resolution() const;             ///< texels along a side of each cascade
    const SeaState& sea() const;        ///< the last one of the forecast; Frame::sea is that of the frame
    const Forecast& forecast() const;   ///< with the largest_peak_m that the cascades have
    Isa isa() const;
    const Executor& executor() const;
    const JobGraph& graph() const;     ///< the stages of a frame
    std::size_t memory_bytes() const;  ///< everything that the ocean allocated, two frames and the spectrum included

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
