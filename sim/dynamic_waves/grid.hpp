// The grid of dynamic waves (dynamic_waves.hpp), which advances in ticks.
//
// spectral (the default)   z = h + i w, where the wave number k of w is that of dh/dt / omega(k):
//                          z_k(t + dt) = z_k(t) exp(-i omega(k) dt - (2 nu k^2 + decay) dt),
//                          omega^2 = (g k + (T/rho) k^3) tanh(k depth)
//                          The dispersion is exact at any length of a tick.
// verlet                   h' = h + d^2 (h - h_before) + d c lap h,
//                          d = exp(-decay dt),  c = (speed dt / dx)^2
//
// With both steps the grid is a torus. Its border absorbs waves before they wrap around, and texels
// that enter the grid are flat.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/dynamic_waves/grid_placement.hpp"
#include "pelagic/sim/dynamic_waves/sources.hpp"
#include "pelagic/sim/kernels/fft_plan.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/allocator.hpp"

namespace pelagic {

class DynamicWaveGrid {
   public:
    /// Upper limit of c; the stability limit of the Verlet step in two dimensions is 0.5.
    static constexpr double max_coupling = 0.4;
    /// Returns the number of texels that Verlet's waves travel in a tick.
    static double courant_number(const DynamicWavesOptions& options);

    /// Throws std::bad_alloc. \pre check(options) is empty; runs_here(isa)
    DynamicWaveGrid(const DynamicWavesOptions& options, Isa isa, const Allocator& memory = {});
    DynamicWaveGrid(const DynamicWaveGrid&) = delete;  // stages point into it
    DynamicWaveGrid& operator=(const DynamicWaveGrid&) = delete;

    /// Adds the stages of a tick and returns the last one. The grid must outlive the graph's runs.
    StageId add_tick_stages(JobGraph& graph, const std::vector<StageId>& waits_for = {});

    /// Moves the grid's centre to within half a texel of the point. Texels that enter are flat.
    /// \pre both in [-1e8, 1e8]; no tick is in flight
    void set_center(double x_m, double z_m);

    /// Returns the disturbances from the next tick on; those outside the grid have no effect.
    /// \pre no tick is in flight
    DynamicWaveSources& sources() { return sources_; }
    const DynamicWaveSources& sources() const { return sources_; }
    void set_source(std::uint32_t number, const Disturbance& source) { sources_.set(number, source, ticks_); }
    void set_footprint(std::uint32_t number, const PressureFootprint& footprint) {
        sources_.set_footprint(number, footprint, ticks_);
    }
    void set_rain(const Rain& rain) { sources_.set_rain(rain, options_); }

    /// Prepare and finish each run of the tick's stages.
    void begin_tick();
    void end_tick();

    const DynamicWavesOptions& options() const { return options_; }
    double texel_m() const { return placement_.texel_m(); }
    double tick_s() const { return 1.0 / options_.ticks_per_s; }
    std::int64_t ticks() const { return ticks_; }  ///< number of completed ticks
    /// First texels of the grid; texel i has the position i texel_m.
    std::int64_t first_x() const { return placement_.first()[0]; }
    std::int64_t first_z() const { return placement_.first()[1]; }
    /// Returns the height at a texel of the grid.
    float height_m(std::int64_t x, std::int64_t z) const { return planes_[height_][texel(x, z)]; }
    std::uint8_t foam(std::int64_t x, std::int64_t z) const { return foam_[foam_texel(x, z)]; }
    /// Returns w (spectral) or the height of the previous tick (Verlet).
    float companion_m(std::int64_t x, std::int64_t z) const { return planes_[1 - height_][texel(x, z)]; }

    /// Interpolates a frame's view for the rows of an item.
    ///
    /// \param fraction  position between the previous and the last tick, 0 to 1. A wave's velocity
    ///     has the relative error (3 fraction^2 - 1) / 6 (omega tick)^2
    /// \param to  receives rows of N floats and bytes, and the extremes of each row's heights
    ///
    /// Items may run concurrently. \pre no tick is in flight
    static constexpr std::size_t rows_per_item = 16;
    struct Interpolated {
        float *height_m, *vertical_velocity_mps;
        std::uint8_t* foam;
        float *lowest_m, *highest_m;
    };
    void interpolate(float fraction, std::size_t item, const Interpolated& to) const;

    /// Returns the XXH3 of the saved state without the sources: position, ticks and texels.
    std::uint64_t hash() const;
    /// Returns all that later ticks and frames depend on; slightly more than 17 N^2 bytes.
    /// \pre no tick is in flight
    std::vector<std::uint8_t> saved() const;
    /// Restores the state of a grid with equal options, on any machine of equal byte order. Throws
    /// std::invalid_argument and changes nothing if such a grid cannot have saved it.
    /// \pre no tick is in flight
    void restore(std::span<const std::uint8_t> saved);

    std::size_t bytes() const;

   private:
    std::size_t texel(std::int64_t x, std::int64_t z) const {
        return dynamic_row_margin + placement_.in_torus(z) * dynamic_row_stride(n()) + placement_.in_torus(x);
    }
    std::size_t foam_texel(std::int64_t x, std::int64_t z) const {
        return placement_.in_torus(z) * n() + placement_.in_torus(x);
    }
    std::size_t n() const { return static_cast<std::size_t>(options_.resolution); }
    /// Returns the plane that holds h after the step. Verlet's overwrites the height of the
    /// previous tick.
    std::size_t stepped_plane() const { return options_.step == DynamicWavesStep::verlet ? 1 - height_ : height_; }
    /// Returns Verlet's height plane other than `plane`; null for the spectral step, which has one.
    float* verlets_other(std::size_t plane) {
        return options_.step == DynamicWavesStep::verlet ? first_texel(1 - plane) : nullptr;
    }
    static constexpr std::size_t saved_planes = 4;
    std::size_t saved_texel_bytes() const { return saved_planes * n() * n() * sizeof(float) + foam_.size(); }
    float* first_texel(std::size_t plane) { return planes_[plane].data() + dynamic_row_margin; }
    const float* first_texel(std::size_t plane) const { return planes_[plane].data() + dynamic_row_margin; }

    StageId add_spectral_stages(JobGraph& graph, StageId prepared);
    StageId add_verlet_stage(JobGraph& graph, StageId prepared);
    BorderDamping border() const { return {damping_[0].data(), damping_[1].data()}; }
    void bake_phases();
    void lay_border();
    void flatten_column(std::int64_t x);
    void flatten_row(std::int64_t z);
    void prepare_rows(std::size_t job);
    void finish_rows(std::size_t job);
    void foam_rows(std::size_t first_row);
    void repeat_ends(std::size_t plane, std::size_t first_row);

    DynamicWavesOptions options_;
    const Kernels& kernels_;
    GridPlacement placement_;
    std::int64_t ticks_ = 0;
    std::size_t height_ = 0;  ///< the plane that holds h
    std::array<AlignedBuffer<float>, 2> planes_;
    /// h at the beginning of the last tick, with its impulses. Frames interpolate from here.
    AlignedBuffer<float> tick_before_;
    AlignedBuffer<float> difference_before_;  ///< change of h in the previous tick
    AlignedBuffer<std::uint8_t> foam_;
    std::vector<std::uint8_t> has_foam_;  ///< by row; 0: none
    /// Factor of each column and row of the torus in a tick: the absorbing border.
    std::array<AlignedBuffer<float>, 2> damping_;
    /// Factor of each column and row in a frame's view: 0 at the edges.
    std::array<AlignedBuffer<float>, 2> shown_;
    DynamicWaveSources sources_;

    // Only for the spectral step.
    std::vector<FftPlan> plan_;  ///< one, or none for Verlet's
    AlignedBuffer<float> phases_;
};

}  // namespace pelagic
