// Dynamic waves: wakes, ripples and splashes on a grid around a point that the application sets, in
// ticks of a fixed length.
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
#include "pelagic/message/enum_names.hpp"
#include "pelagic/message/numeric_field.hpp"
#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/dynamic_waves_view.hpp"
#include "pelagic/sim/pressure_footprint.hpp"
#include "pelagic/sim/rain.hpp"
#include "pelagic/simd/allocator.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

// generated from schema/dynamic_waves.toml: enumerations
enum class DynamicWavesStep {
    /// Advances each wave by its own phase: the exact dispersion of deep or shallow water, stable
    /// at any length of a tick; wakes have Kelvin's angle.
    spectral,
    /// h' = h + d^2 (h - h_before) + d c lap h, d = e^(-decay dt), c = (speed dt / dx)^2 <= 0.4:
    /// one speed for all waves, for ponds and rings.
    verlet,
};
template <>
struct EnumNames<DynamicWavesStep> {
    static constexpr std::array<std::string_view, 2> all = {"spectral", "verlet"};
};
// end of generated

struct DynamicWavesOptions {
    // generated from schema/dynamic_waves.toml: members
    DynamicWavesStep step = DynamicWavesStep::spectral;  ///< how a tick advances the waves
    int resolution = 256;                                ///< N, texels along a side; 64, 128, 256, 512 or 1024
    double side_m = 64;                                  ///< side of the grid; [1, 10000]
    int ticks_per_s = 60;                                ///< ticks of the simulation a second; [10, 240]
    /// Width of the absorbing border along each side; [0.001, side_m / 4]. 0: no border, and waves
    /// wrap around.
    double border_m = 12;
    double depth_m = 1e4;  ///< depth of the water (spectral); [0.01, 11000]
    /// Eddy viscosity nu, which damps amplitudes at the rate 2 nu k^2 (spectral); [0, 1].
    double viscosity_m2ps = 2e-3;
    /// Speed of all waves, with (speed / (ticks_per_s texel))^2 at most 0.4 (verlet); (0, 1000].
    double wave_speed_mps = 3;
    double decay_per_s = 0.01;  ///< decay rate of amplitudes; [0, 10]
    /// Foam begins above this height and is full at twice it; [0.001, 100].
    double foam_height_m = 0.2;
    // end of generated
};

/// Returns the table of the numeric options.
std::span<const NumericField<DynamicWavesOptions>> dynamic_waves_fields();

/// Returns an empty string for usable options, else a message that names the first invalid one:
/// "resolution is 100, expected 64, 128, 256, 512 or 1024".
std::string check(const DynamicWavesOptions& options);

/// The dynamic waves at a point.
struct DynamicWavesSample {
    double height_m = 0;
    double slope_x = 0, slope_z = 0;
    double vertical_velocity_mps = 0;
    double foam = 0;  ///< 0 to 1
};

/// Samples a view at a position in the water's frame: bilinear between texels, slopes by central
/// differences at texels. Returns zeros outside the grid, and if x_m or z_m is infinite or NaN.
DynamicWavesSample sample(const DynamicWavesView& view, double x_m, double z_m);

/// Returns the part of its height that a frame shows of a texel, 0 to 1.
/// \param from_edge  number of texels between it and the nearest edge of the grid; below 0: outside
double shown_part(const DynamicWavesOptions& options, std::int64_t from_edge);

/// Returns the XXH3 of the grid's position, heights, vertical velocities and foam, little-endian;
/// 0 for an empty view. hash_of(frame) leaves dynamic waves out.
std::uint64_t hash_of(const DynamicWavesView& view);

/// Waves that an application makes.
///
/// Commands take effect in the order of the calls, at the next advance(). For the waves of an ocean
/// that is its next schedule(), whether or not a frame is in flight. A tick is a function of the
/// ticks and the commands before it. So equal times with equal commands between them give
/// bit-identical waves on every machine.
///
/// A function that throws changes nothing. Not thread-safe: one thread at a time calls its
/// functions; the work runs on the executor.
class DynamicWaves {
   public:
    /// Executor, instruction set, tracing and memory of the ticks.
    struct Resources {
        /// Null: oneTBB with its default number of threads.
        std::shared_ptr<Executor> executor = {};
        /// None: PELAGIC_ISA, else the widest of this CPU.
        std::optional<Isa> isa = {};
        /// Null: tracing is disabled and no clock is read.
        std::shared_ptr<TraceSink> trace = {};
        /// Allocator of all memory that grows with N^2; empty: operator new.
        Allocator memory = {};
    };

    /// \throws std::invalid_argument  check(options), unless it is empty, or what choose_isa() throws
    /// \throws std::bad_alloc         if memory is exhausted
    /// \throws                        what executors throw
    explicit DynamicWaves(const DynamicWavesOptions& options) : DynamicWaves(options, Resources{}) {}
    /// As above, with an executor, an instruction set and memory of the application.
    DynamicWaves(const DynamicWavesOptions& options, Resources resources);
    ~DynamicWaves();  ///< waits for work in flight
    DynamicWaves(const DynamicWaves&) = delete;
    DynamicWaves& operator=(const DynamicWaves&) = delete;

    /// Impulses of a tick, and sources at once, at most.
    static constexpr std::size_t max_disturbances = 4096;

    /// Enqueues a disturbance that acts once, in the next tick. At most 4096 impulses wait for a
    /// tick. Impulses before an advance to a time that is not later than the one before are
    /// provisional: the next such advance with impulses replaces them.
    /// \throws std::invalid_argument  check(disturbance), unless it is empty, or if there are more
    void add_impulse(const Disturbance& disturbance);
    /// Adds a source, which acts in every tick and moves at its velocity, until it is removed. At
    /// most 4096 sources exist at once. They act in the order of their numbers, before impulses.
    /// Returns its number, which is never reused.
    /// \throws std::invalid_argument  check(source), unless it is empty, or if there are more
    std::uint32_t add_source(const Disturbance& source);
    /// Replaces a source from the next tick on. Does nothing if there is no source of that number.
    /// \throws std::invalid_argument  check(source), unless it is empty
    void set_source(std::uint32_t number, const Disturbance& source);
    /// Adds the pressure of a floating body, as a source. Footprints act after other sources.
    /// \throws std::invalid_argument  check(footprint), unless it is empty, or for more sources
    std::uint32_t add_footprint(const PressureFootprint& footprint);
    /// Replaces a footprint from the next tick on. Does nothing if there is none of that number.
    /// \throws std::invalid_argument  check(footprint), unless it is empty
    void set_footprint(std::uint32_t number, const PressureFootprint& footprint);
    /// Removes a source or a footprint. Does nothing if there is none of that number.
    void remove_source(std::uint32_t number);
    /// Moves the grid's centre to within half a texel of the point; x_m and z_m in [-1e8, 1e8].
    /// Texels that stay in the grid are unchanged, and those that enter are flat.
    /// \throws std::invalid_argument  if the point is out of range
    void set_center(double x_m, double z_m);
    /// Sets the current, which carries the grid; each in [-10, 10]. Positions and velocities of
    /// commands are then in the world, and those of views in the water's frame (water_frame.hpp).
    /// Call set_center() again to keep the grid at a point. Ocean::set_water_frame() sets the
    /// current of an ocean's waves. A saved state does not include it.
    /// \throws std::invalid_argument  if the current is out of range
    void set_current(double x_mps, double z_mps);
    /// Shifts the world's origin, as Ocean::set_origin(), which sets that of an ocean's waves: for
    /// commands from now on. Those that wait and the grid keep their places. A saved state does not
    /// include it. x_m and z_m in [-1e8, 1e8].
    /// \throws std::invalid_argument  if the origin is out of range
    void set_origin(double x_m, double z_m);
    /// Sets the rain from the next tick on; 0 drops end it.
    /// \throws std::invalid_argument  check(rain, options()), unless it is empty
    void set_rain(const Rain& rain);

    /// A jump ahead computes the ticks of at most this time, seconds.
    static constexpr double max_jump_s = 0.5;
    /// Returns the number of the last tick at a time, counted from t = 0.
    /// \throws std::invalid_argument  if the time is not finite
    std::int64_t tick_at(double time_s) const;

    /// Computes the ticks up to a time and returns the waves. The view is a tick late: it is
    /// interpolated between the last two ticks. A time before that of the last call computes no
    /// tick, and later ticks are counted from it. The view stays valid until the second advance()
    /// from now.
    /// \throws std::invalid_argument  if time_s is not finite
    /// \throws std::logic_error       if an ocean owns the object
    /// \throws                        what executors throw; the view of the last advance stays
    const DynamicWavesView& advance(double time_s);
    /// Returns the waves of the last advance, or of the ocean's frame completed last; empty before
    /// the first.
    const DynamicWavesView& view() const;

    /// Returns all that later ticks depend on, except commands since the last advance; slightly
    /// more than 17 N^2 bytes.
    /// \throws std::logic_error  while a frame of an ocean is in flight
    std::vector<std::uint8_t> save_state() const;
    /// Restores a state saved with equal options, on any machine of equal byte order. Discards
    /// commands since the last advance.
    /// \throws std::invalid_argument  if the options differ, or the bytes are damaged by a checksum
    /// \throws std::logic_error       while a frame of an ocean is in flight
    void restore_state(std::span<const std::uint8_t> saved);

    /// Returns the options of construction.
    const DynamicWavesOptions& options() const;
    std::size_t memory_bytes() const;  ///< all memory of the object

   private:
    friend class DynamicWavesPart;  // of a frame

    /// Swaps the view's buffers for the next frame, before any step that may fail; drop_frame()
    /// reverts it.
    void swap_buffers();
    /// Starts a frame: its ticks, except those that complete_frame() computes, and its view.
    /// \pre swap_buffers() for this frame
    void begin_frame(double time_s);
    void complete_frame();
    bool is_done() const;
    /// Discards the frame that begin_frame() began; its ticks are not undone.
    void drop_frame();

    struct State;
    std::unique_ptr<State> state_;
    bool has_ocean_ = false;
};

}  // namespace pelagic
