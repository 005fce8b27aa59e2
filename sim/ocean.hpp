// The ocean: construct it once, then schedule and complete one frame for each image.
//
//   Ocean ocean({.wind_speed_mps = 9});
//   ocean.schedule(0.0);
//   for (double t = 0;; t += 1.0 / 90) {
//       const Frame& frame = ocean.complete();  // the frame scheduled last
//       ocean.schedule(t + 1.0 / 90);           // computes the next frame during drawing
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
#include "pelagic/sim/spray.hpp"
#include "pelagic/sim/texture_targets.hpp"
#include "pelagic/sim/water_frame.hpp"
#include "pelagic/sim/wave_input.hpp"
#include "pelagic/simd/allocator.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

/// How an ocean computes its frames, and what they contain. Cascades are bit-identical whatever the
/// options, except that `foam` changes their foam and `inputs` adds waves.
struct OceanOptions {
    // generated from schema/ocean.toml: members
    /// Executor of the jobs. Null: oneTBB with its default number of threads, else a pool.
    std::shared_ptr<Executor> executor = {};
    /// Instruction set: sse4.2, avx2, avx512 or neon. By default that of the environment variable
    /// PELAGIC_ISA, else the widest of the CPU. Results are bit-identical.
    std::optional<Isa> isa = {};
    /// ChromeTrace or the application's profiler. Null: tracing is disabled and no clock is read.
    std::shared_ptr<TraceSink> trace = {};
    /// Enables queries of points and rays. N^2 / 8 bytes for each cascade of a frame.
    bool queries = false;
    /// Velocities of frames and queries. Drawn: the derivatives of the drawn displacement in time,
    /// in planes of 12 N^2 bytes for each cascade of a frame, with about twice as many transforms.
    /// Water: the water's own at the surface by linear theory, for queries, with a quarter of the
    /// transforms more; waves shorter than four texels are left out.
    Velocities velocities = Velocities::none;
    /// Adds pressure and velocity below the surface, which hulls need. 8 N^2 bytes for each cascade
    /// of a frame, and about a quarter of its time. Waves of a pond do not decrease with depth and
    /// move no water.
    bool depth = false;
    /// Gradients of each cascade: normals, Jacobian and smoothness. By default a sea with cascades
    /// 1 has them, and an ocean whose slopes are off. Slopes and gradients cannot both be off.
    std::optional<bool> gradients = {};
    /// Slopes and moments of each cascade, which add over cascades. By default all oceans have them
    /// but those of a sea with cascades 1 that have gradients and no foam. Foam needs them.
    std::optional<bool> slopes = {};
    /// Enables foam of breaking waves, which drifts and fades over 2.8 seconds. A frame with a tick
    /// (five a second) takes about twice as long. A jump in time computes 16 ticks, which take as
    /// long as ten to twenty frames. 49 N^2 bytes for each cascade.
    bool foam = false;
    /// The grid of dynamic waves, which are added to the cascades and queries. With 256 texels a
    /// tick, of 60 a second, takes about three quarters of a frame of one cascade of 256. By
    /// default none.
    std::optional<DynamicWavesOptions> dynamic_waves = {};
    /// A sea floor that refracts waves. The sea needs 2 to 4 cascades and cannot change.
    /// Construction takes about a second of one core longer, and 290 bytes for each of the shore's
    /// texels. By default none.
    std::optional<ShoreOptions> shore = {};
    /// Droplets of breaking crests and emitters. A frame with a tick (eleven a second, of which
    /// every second is a tick of foam too) computes the displacement once more. A jump in time
    /// computes 19 ticks, which take as long as ten to twenty frames. 3.8 MB. By default none.
    std::optional<SprayOptions> spray = {};
    /// Wave inputs, which are added to the waves of the wind in this order. They change the hash.
    /// None may belong to another ocean. By default none.
    std::vector<std::shared_ptr<WaveInput>> inputs = {};
    /// Keeps displacement as planes of floats. Without them frames have textures and bounds only.
    /// That moves fewer bytes and takes about 12 N^2 bytes less for each cascade; the textures are
    /// bit-identical. Queries, velocities, dynamic waves, a shore, spray and wave inputs need
    /// planes.
    bool planes = true;
    /// Allocator of frames and spectra, all but some 100 KB of an ocean. None: operator new.
    Allocator memory = {};
    // end of generated
};

/// An ocean, which computes frames of a sea or a forecast.
///
/// Not thread-safe: one thread at a time calls its methods; the work runs on the executor. After
/// construction a frame allocates nothing in Pelagic's code, except tables of inputs in the first
/// frame. Apart from misuse it throws only if an executor (GraphRun::complete()) or an input
/// (WaveInput) fails. That frame or sea is lost then, and the next may be scheduled. Misuse changes
/// nothing.
class Ocean {
   public:
    /// Computes the spectrum of a sea.
    /// \throws std::invalid_argument  check(sea), unless it is empty, if an option needs planes or
    ///                                slopes that are off, if gradients and slopes are off, or what choose_isa() throws
    /// \throws std::bad_alloc         if memory is exhausted
    /// \throws                        what executors throw
    explicit Ocean(const SeaState& sea, OceanOptions options = {});
    /// Computes the spectrum of the forecast's first sea. That of each later sea is computed
    /// together with frames, from 10 s of the sea's time before frames need it. A frame waits for a
    /// spectrum that is not ready, for instance after a jump in time.
    /// \throws std::invalid_argument  check(forecast), unless it is empty, if it has changes and the
    ///                                options a shore, or what the other constructor throws
    explicit Ocean(const Forecast& forecast, OceanOptions options = {});
    ~Ocean();  ///< waits for work in flight
    Ocean(const Ocean&) = delete;
    Ocean& operator=(const Ocean&) = delete;

    /// Starts a frame and returns immediately.
    ///
    /// \param time_s  any finite time, in any order. A frame is a pure function of the forecast and
    ///     the time. Outside transitions time_s + n * loop_period_s gives a bit-identical frame.
    ///
    /// complete() computes small frames (N up to 64), for which threads would take longer. With
    /// OceanOptions::foam it also computes the warm-up after a jump in time.
    /// \throws std::invalid_argument  if the time is not finite
    /// \throws std::logic_error       if a frame is in flight
    void schedule(double time_s) { schedule(time_s, {}); }

    /// Starts a frame as above, with textures in memory of the application, by cascade. The frame
    /// has no views of these textures and hash_of() leaves them out. The memory must stay valid
    /// until complete() returns.
    /// \throws std::invalid_argument  check(cascades, ...), unless it is empty, or for such a time
    /// \throws std::logic_error       if a frame is in flight
    void schedule(double time_s, std::span<const TextureTargets> cascades);

    /// Returns whether complete() would return without waiting for other threads. It does if they
    /// have finished the frame, if they do not work on it (a small frame, an executor without
    /// threads), or if no frame is in flight. Never blocks.
    bool is_ready() const;

    /// Completes the scheduled frame and returns it; the calling thread takes part in the work.
    /// Returns the frame completed last if none is in flight. Its views stay valid until the second
    /// schedule() from now, so also while the next frame is computed.
    /// \throws std::logic_error       if no frame was scheduled
    /// \throws std::invalid_argument  if an input adds a value out of range
    /// \throws                        what GraphRun::complete() throws
    const Frame& complete();

    /// Schedules and completes a frame. \throws what both throw
    const Frame& frame_at(double time_s);

    /// Computes a frame and writes it to the caller's arrays, one FrameBuffers for each cascade;
    /// for servers and replays. The views of the frame completed last stay valid, and complete()
    /// still returns that frame if none is in flight.
    /// \throws std::invalid_argument  check(cascades, ...) before it computes, unless it is empty
    /// \throws                        what schedule() and complete() throw
    FrameBounds frame_at(double time_s, std::span<const FrameBuffers> cascades);
    /// As above, for an ocean with one cascade.
    FrameBounds frame_at(double time_s, const FrameBuffers& only_cascade) {
        return frame_at(time_s, {&only_cascade, 1});
    }

    /// Starts to compute the spectrum of another sea (stage `spectrum`). Frames show the current
    /// sea until complete_sea(). The resolution, the number of cascades and the kind of waves (pond
    /// or not) must not change.
    /// \throws std::invalid_argument  if they do, a value is out of range, or the ocean has a shore
    /// \throws std::logic_error       if another sea is being computed
    void schedule_sea(const SeaState& sea);
    /// Returns whether complete_sea() would return without waiting for other threads.
    bool sea_is_ready() const;
    /// Waits for the spectrum of schedule_sea(sea), which frames show from now on. Discards the
    /// changes of the forecast.
    /// \throws std::logic_error  if a frame is in flight
    /// \throws                   what GraphRun::complete() throws; the sea is lost then
    void complete_sea();

    /// Appends a change to the forecast, whose spectrum is computed together with frames from now
    /// on (Forecast describes what may change). The ocean keeps the last two changes, and frames of
    /// earlier times show the oldest sea that it has. The call takes about 2 ms, in which it
    /// searches the new sea's spectrum.
    ///
    /// A change from before the frame that was scheduled last, except by frame_at() with buffers,
    /// starts at that frame's time, so that the water does not jump. forecast() has the start. That
    /// time differs between peers: schedule changes that begin after every peer's frame.
    ///
    /// A frame may be in flight; it belongs to the forecast in which it was scheduled.
    /// \throws std::invalid_argument  if the preceding change ends after `from_s`, the sea is
    ///                                incompatible, or the ocean has a shore
    /// \throws std::logic_error       between schedule_sea(sea) and complete_sea()
    void schedule_sea(const SeaChange& change);
    /// As above, for a change without a distant swell.
    void schedule_sea(const SeaState& sea, double from_s, double over_s) {
        schedule_sea({.sea = sea, .from_s = from_s, .over_s = over_s});
    }

    /// Sets the sea level and the current of frames that are scheduled from now on, and the current
    /// of the ocean's dynamic waves. Frame::water_frame has them; all else in a frame is unchanged.
    /// The current has flowed since t = 0: to change it moves the sea by the change times t. Keeps
    /// the origin.
    /// \throws std::invalid_argument  check(water), unless it is empty, or for a level or a current
    ///                                other than 0 if the ocean has a shore
    void set_water_frame(const WaterFrame& water);
    /// Shifts the world's origin to a position of the world as it was before any shift, each in
    /// [-1e8, 1e8]. It counts for frames that are scheduled from now on (Frame::water_frame), for
    /// commands of dynamic waves and for spray; commands that wait keep their places. A position
    /// in the old coordinates plus the old origin minus the new one is that in the new ones:
    /// FloatingBodies::shift() moves bodies. Textures, hashes and a shore's place stay. Shifts by
    /// multiples of a quarter of QuadtreeOptions::size_m keep the mesh of the sea.
    /// \throws std::invalid_argument  out of range
    void set_origin(double x_m, double z_m);
    /// Returns the sea level, the current and the origin of the frame scheduled next.
    const WaterFrame& water_frame() const;

    /// Returns the dynamic waves of OceanOptions::dynamic_waves, which advance with the ocean's
    /// frames. Frames of equal times with equal commands between them have bit-identical waves.
    /// \throws std::invalid_argument  without that option
    DynamicWaves& dynamic_waves();
    /// As above.
    const DynamicWaves& dynamic_waves() const;

    /// Sets the centre of the spray of crests, usually the camera, in the world; each in
    /// [-1e8, 1e8]. It takes effect at the next schedule(), for the ticks computed from then on.
    /// \throws std::invalid_argument  without OceanOptions::spray, or out of range
    void set_spray_center(double x_m, double z_m);
    /// Adds droplets of emitters to frames that are scheduled from now on. Their wind is that of the
    /// forecast at their times, and they move with the water frame of now. The ocean keeps droplets
    /// for jumps in time; of more than 8192, it discards the oldest.
    /// \throws std::invalid_argument  without OceanOptions::spray, if an emitter is invalid, or if the
    ///                                emitters have more than 8192 droplets; nothing is changed then
    void emit(std::span<const SprayEmitter> emitters);
    /// Returns the droplets of emitters, at most 918 KB. Droplets of crests need no state.
    /// \throws std::invalid_argument  without OceanOptions::spray
    /// \throws std::logic_error       if a frame is in flight
    std::vector<std::uint8_t> save_spray() const;
    /// Replaces the droplets of emitters, on any machine of equal byte order.
    /// \throws std::invalid_argument  without OceanOptions::spray, or if the bytes are damaged
    /// \throws std::logic_error       if a frame is in flight
    void restore_spray(std::span<const std::uint8_t> saved);

    const FrameContents& contents() const;  ///< of every frame
    std::size_t cascade_count() const;  ///< of every frame
    int resolution() const;             ///< texels along a side of each cascade
    const SeaState& sea() const;        ///< last sea of the forecast; Frame::sea is the sea at a frame's time
    const Forecast& forecast() const;   ///< with the largest_peak_m of the cascades
    /// Returns the instruction set of the kernels.
    Isa isa() const;
    /// Returns the executor of the options, or the default one.
    const Executor& executor() const;
    const JobGraph& graph() const;  ///< the stages of a frame
    /// Returns all memory of the ocean, two frames and the spectrum included.
    std::size_t memory_bytes() const;

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
