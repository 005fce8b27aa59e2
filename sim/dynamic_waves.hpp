// Dynamic waves: wakes, ripples and splashes on a grid around a point that the application sets, in ticks of a fixed length.
//
//   DynamicWaves waves({.side_m = 64});
//   waves.add_impulse({.mode = Disturbance::Mode::impulse, .radius_m = 0.5, .height_m = 0.3});
//   const DynamicWavesView& view = waves.advance(time_s);
//
// An Ocean makes one with OceanOptions::dynamic_waves and advances it with its frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/trace.hpp"
#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/dynamic_waves_view.hpp"
#include "pelagic/sim/rain.hpp"
#include "pelagic/simd/allocator.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

enum class DynamicWavesStep {
    /// Advances each wave by its own phase: the exact dispersion of deep or shallow water, stable at
    /// any length of a tick. Wakes have Kelvin's angle.
    spectral,
    /// h' = h + d^2 (h - h_before) + d c lap h, d = e^(-decay dt), c = (speed dt / dx)^2 <= 0.4: one
    /// speed for all waves, for ponds and rings.
    verlet
};

struct DynamicWavesOptions {
    DynamicWavesStep step = DynamicWavesStep::spectral;
    int resolution = 256;  ///< N, texels along a side; 64, 128, 256, 512 or 1024
    double side_m = 64;    ///< [1, 10000]
    int ticks_per_s = 60;  ///< [10, 240]
    /// Width of the absorbing border along each side, [0.001, side_m / 4]; 0: no border, and waves wrap
    /// around.
    double border_m = 12;
    double depth_m = 1e4;          ///< spectral; [0.01, 11000]
    double viscosity_m2ps = 2e-3;  ///< spectral: eddy viscosity nu; [0, 1]
    double wave_speed_mps = 3;     ///< Verlet; (0, 1000], and c <= 0.4
    double decay_per_s = 0.01;     ///< of amplitudes; [0, 10]
    double foam_height_m = 0.2;    ///< foam begins above this height and is full at twice it; [0.001, 100]
};

/// Returns an empty string for usable options, else a message that names the first bad one:
/// "resolution is 100, needs 64, 128, 256, 512 or 1024".
std::string check(const DynamicWavesOptions& options);

/// The dynamic waves at a point.
struct DynamicWavesSample {
    double height_m = 0;
    double slope_x = 0, slope_z = 0;
    double vertical_velocity_mps = 0;
    double foam = 0;  ///< 0 to 1
};

/// Samples a view: bilinear between texels, slopes by central differences at texels. Returns zeros
/// outside the grid, and if x_m or z_m is not finite. Any thread.
DynamicWavesSample sample(const DynamicWavesView& view, double x_m, double z_m);

/// Returns the XXH3 of the grid's position, heights, vertical velocities and foam, little-endian;
/// 0 for an empty view. hash_of(frame) leaves dynamic waves out.
std::uint64_t hash_of(const DynamicWavesView& view);

/// Waves that an application makes.
///
/// Commands take effect at the next advance(), in the order of the calls; for the waves of an ocean, at
/// its next schedule(), whether or not a frame is in flight. A tick is a function of the ticks before it and of
/// the commands before it, so equal times with equal commands between them give bit-identical waves on every machine.
///
/// Every function throws std::invalid_argument for a value out of range and changes nothing then.
/// Not thread-safe: one thread at a time calls its functions; the work runs on the executor.
class DynamicWaves {
   public:
    /// What the ticks run on.
    struct Resources {
        std::shared_ptr<Executor> executor = {};  ///< null: oneTBB with its default number of threads
        std::optional<Isa> isa = {};              ///< none: PELAGIC_ISA, else the strongest of this CPU
        std::shared_ptr<TraceSink> trace = {};    ///< null: tracing is disabled and no clock is read
        Allocator memory = {};                    ///< empty: operator new. For all that grows with N^2
    };

    /// Throws std::invalid_argument(check(options)), what choose_isa() and executors throw, and
    /// std::bad_alloc.
    explicit DynamicWaves(const DynamicWavesOptions& options) : DynamicWaves(options, Resources{}) {}
    DynamicWaves(const DynamicWavesOptions& options, Resources resources);
    ~DynamicWaves();  ///< waits for work in flight
    DynamicWaves(const DynamicWaves&) = delete;
    DynamicWaves& operator=(const DynamicWaves&) = delete;

    /// Acts once, in the next tick. At most 4096 of them wait for a tick. While time stands still, in
    /// advances to a time that is not later than the one before, they do not accumulate: only those of the last such advance
    /// that has any wait.
    void add_impulse(const Disturbance& disturbance);
    /// Acts in every tick, moving at its velocity, until it is removed. At most 4096 sources at once;
    /// they act in the order of their numbers, before impulses. Returns its number, which is used once.
    std::uint32_t add_source(const Disturbance& source);
    /// Replaces a source from the next tick on. Does nothing if there is no source of that number.
    void set_source(std::uint32_t number, const Disturbance& source);
    /// Does nothing if there is no source of that number.
    void remove_source(std::uint32_t number);
    /// Moves the grid's centre to within half a texel of the point; x_m and z_m in [-1e8, 1e8]. Texels that
    /// stay in the grid keep their bits, and those that enter are flat.
    void set_center(double x_m, double z_m);
    /// Sets the rain from the next tick on; 0 drops end it.
    void set_rain(const Rain& rain);

    /// A jump ahead in time computes the ticks of so many seconds at most.
    static constexpr double max_jump_s = 0.5;
    /// Returns the number of the last tick at a time, counted from t = 0.
    std::int64_t tick_at(double time_s) const;

    /// Computes the ticks up to a time and returns the waves there, a tick late: between the last tick
    /// and the one before it. A time before the last one leaves the waves as they are. The view stays valid until the second advance() from now. Throws what executors throw;
    /// the view of the last advance stays then. \pre time_s is finite; no ocean owns the object
    const DynamicWavesView& advance(double time_s);
    /// Returns the waves of the last advance, or of the ocean's frame completed last; empty before the
    /// first.
    const DynamicWavesView& view() const;

    /// Returns all that ticks to come depend on, but for commands since the last advance; 17 N^2
    /// bytes and some. \pre no frame of an ocean is in flight
    std::vector<std::uint8_t> save_state() const;
    /// Continues from a saved state with equal options, of any machine of the same byte order. Drops
    /// commands since the last advance. Throws std::invalid_argument, changing nothing, if the options differ or the bytes are
    /// damaged. \pre no frame of an ocean is in flight
    void restore_state(std::span<const std::uint8_t> saved);

    const DynamicWavesOptions& options() const;
    std::size_t memory_bytes() const;  ///< everything that the object allocated

   private:
    friend class Ocean;  // computes frames beside the ticks

    /// Makes room for the next frame, before anything of it can fail; drop_frame() gives it back.
    void turn();
    /// Starts a frame: its ticks, of which all but one are left to complete_frame(), and its view. \pre turn() for this frame
    void begin_frame(double time_s);
    void complete_frame();
    bool is_done() const;
    /// Discards the frame that begin_frame() began; its ticks are not undone.
    void drop_frame();

    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
