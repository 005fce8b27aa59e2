// Water that answers (local_water.hpp), tick by tick.
//
// spectral (the default)   z = h + i w, where the wave number k of w is that of dh/dt over omega(k). Each wave goes on by
//                          z_k(t + dt) = z_k(t) exp(-i omega(k) dt - (2 nu k^2 + decay) dt),
//                          omega^2 = (g k + (T/rho) k^3) tanh(k depth): exact dispersion, at any length of a tick
// verlet                   h' = (2 h - h_before + c lap h) (1 - decay dt), of which amplitudes lose half, c = (speed dt / dx)^2
//
// In either case the window is a torus whose border takes waves away before they come round, and texels that enter it are flat.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/local_water.hpp"
#include "pelagic/sim/sources/fft_plan.hpp"
#include "pelagic/sim/sources/local_window.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/host_memory.hpp"

namespace pelagic {

class LocalGrid {
   public:
    /// c of Verlet's step, at most: the bound of its stability in two dimensions is 0.5.
    static constexpr double most_coupling = 0.4;
    /// Sources that last, and disturbances of one tick.
    static constexpr std::size_t most_disturbances = 4096;
    /// Texels that Verlet's waves run in a tick.
    static double courant_number(const LocalWaterOptions& options);

    /// Throws std::invalid_argument(check(options)), std::bad_alloc. \pre runs_here(isa)
    LocalGrid(const LocalWaterOptions& options, Isa isa, const HostMemory& memory = {});
    LocalGrid(const LocalGrid&) = delete;  // stages point into it
    LocalGrid& operator=(const LocalGrid&) = delete;

    /// Adds the stages of a tick; returns the one after which it is over. The grid outlives the graph's runs.
    StageId add_tick_stages(JobGraph& graph, const std::vector<StageId>& waits_for = {});

    /// The window's middle, in the world, as near as whole texels allow; those that enter are flat. Throws
    /// std::invalid_argument unless both are in [-1e8, 1e8]. \pre no tick is in flight
    void follow(double x_m, double z_m);

    /// Of the tick to come, in the order of the calls. What lies outside of the window does nothing. Throws
    /// std::invalid_argument(check(disturbance)), or if there are most_disturbances already. \pre no tick is in flight
    void disturb(const Disturbance& disturbance);

    /// One that pushes at every tick from the next one on, until it is set anew or removed. Numbers are used once; sources push in
    /// their order. Throws as disturb(). \pre no tick is in flight
    std::uint32_t new_source_number() { return next_source_++; }
    void set_source(std::uint32_t number, const Disturbance& source);
    void remove_source(std::uint32_t number);
    /// How many there are.
    std::size_t sources() const { return sources_.size(); }
    std::size_t disturbances() const { return waiting_.size(); }  ///< of the tick to come

    /// Before and after each run of the tick's stages.
    void begin_tick();
    void end_tick();

    const LocalWaterOptions& options() const { return options_; }
    double texel_m() const { return window_.texel_m(); }
    double tick_s() const { return 1.0 / options_.ticks_per_s; }
    std::int64_t ticks() const { return ticks_; }  ///< that are over
    /// The lowest texel of the window; texel i stands at i texel_m.
    std::int64_t first_x() const { return first_[0]; }
    std::int64_t first_z() const { return first_[1]; }
    /// At a texel of the window.
    float height_m(std::int64_t x, std::int64_t z) const { return planes_[height_][texel(x, z)]; }
    std::uint8_t foam(std::int64_t x, std::int64_t z) const { return foam_[foam_texel(x, z)]; }
    /// Spectral: w. Verlet: the height of the tick before.
    float companion_m(std::int64_t x, std::int64_t z) const { return planes_[1 - height_][texel(x, z)]; }

    /// Puts together what a frame shows of the rows of an item, `part` of the way from the tick before to the last one: rows of N floats
    /// and bytes, and the extremes of each row's heights. Items may run side by side. \pre no tick is in flight
    static constexpr std::size_t rows_an_item = 16;
    struct Shown {
        float *height_m, *rise_mps;
        std::uint8_t* foam;
        float *lowest_m, *highest_m;
    };
    void show(float part, std::size_t item, const Shown& to) const;

    /// Two windows that agree on it go on alike: a hash of all that is saved.
    std::uint64_t hash() const;
    /// All that ticks and frames to come depend on; 13 N^2 bytes and some. \pre no tick is in flight
    std::vector<std::uint8_t> saved() const;
    /// Takes that up, in a grid of the same options, on any machine of the same byte order. Throws std::invalid_argument if such a
    /// grid can't have saved it; nothing has changed then. \pre no tick is in flight
    void restore(std::span<const std::uint8_t> saved);

    std::size_t bytes() const;

   private:
    /// A disturbance as the rows of a tick need it.
    struct Splash {
        Disturbance of;
        float part;                   ///< of the way that a pull goes in one tick
        std::int64_t first_x, end_x;  ///< texels that it reaches, within the window
        std::int64_t first_z, end_z;
        std::size_t profile;  ///< of a gauss: its values along x, then along z
        double cosine, sine;  ///< of a hull's heading
    };

    struct Source {
        std::uint32_t number;
        Disturbance disturbance;
        std::int64_t since;  ///< ticks that were over when it was set
    };

    std::size_t texel(std::int64_t x, std::int64_t z) const {
        return local_margin + window_.in_torus(z) * local_row_stride(n()) + window_.in_torus(x);
    }
    std::size_t foam_texel(std::int64_t x, std::int64_t z) const {
        return window_.in_torus(z) * n() + window_.in_torus(x);
    }
    std::size_t n() const { return static_cast<std::size_t>(options_.resolution); }
    std::size_t block_stride() const;
    /// Which plane holds h once the step is done: Verlet's goes where the height of the tick before was.
    std::size_t stepped_plane() const { return options_.step == LocalStep::verlet ? 1 - height_ : height_; }
    float* first_texel(std::size_t plane) { return planes_[plane].data() + local_margin; }
    const float* first_texel(std::size_t plane) const { return planes_[plane].data() + local_margin; }

    StageId add_spectral_stages(JobGraph& graph, StageId prepared);
    StageId add_verlet_stage(JobGraph& graph, StageId prepared);
    LocalBorder border() const { return {left_[0].data(), left_[1].data()}; }
    void bake_phases();
    void lay_border();
    void flatten_column(std::int64_t x);
    void flatten_row(std::int64_t z);
    static std::vector<Source> restored_sources(const std::uint8_t* from, std::size_t count, std::int64_t next_source,
                                                std::int64_t ticks);
    void add_splash(const Disturbance& disturbance);
    Splash splash_of(const Disturbance& disturbance);
    void prepare_rows(std::size_t job);
    template <class AtTexel>
    void for_texels(const Splash& splash, std::size_t first_row, AtTexel at_texel) const;
    void splash_rows(const Splash& splash, std::size_t first_row);
    void finish_rows(std::size_t job);
    void foam_rows(std::size_t first_row);
    void repeat_ends(std::size_t plane, std::size_t first_row);

    LocalWaterOptions options_;
    const Kernels& kernels_;
    LocalWindow window_;
    std::array<std::int64_t, 2> first_{};
    std::int64_t ticks_ = 0;
    std::uint32_t next_source_ = 1;
    std::size_t height_ = 0;  ///< which plane holds h
    std::array<AlignedBuffer<float>, 2> planes_;
    AlignedBuffer<float> tick_before_;  ///< h of the tick before, which frames show the way from
    AlignedBuffer<std::uint8_t> foam_;
    std::vector<std::uint8_t> has_foam_;         ///< by row; 0: none
    std::array<AlignedBuffer<float>, 2> left_;   ///< of each column and row of the torus by a tick
    std::array<AlignedBuffer<float>, 2> shown_;  ///< and by what a frame shows: 0 at the edges
    std::vector<Source> sources_;                ///< by number
    std::vector<Disturbance> waiting_;           ///< for the tick to come
    std::vector<Splash> splashes_;               ///< of the tick in flight
    std::vector<float> profiles_;

    // Of the spectral step alone.
    std::vector<FftPlan> plan_;  ///< one, or none
    AlignedBuffer<float> phases_;
    AlignedBuffer<float> lines_;
};

}  // namespace pelagic
