// Transforms of the waves of a cascade at the depths of its water levels (sim/water_levels.hpp).
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "pelagic/sim/buffers/water_planes.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/kernels/fft_plan.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/water_levels.hpp"

namespace pelagic {

class WaterLevelRuns {
   public:
    /// \param has_depth  false: only the velocity at the surface
    WaterLevelRuns(int resolution, bool has_depth, const Kernels& kernels, const Allocator& memory);

    /// Upper bound of the number of grids.
    std::size_t max_count() const;

    /// Returns a cascade's levels: down to the bottom, or to where no wave reaches.
    WaterLayout layout_of(const CascadePlan& plan, double water_m) const;

    /// The waves of a grid.
    struct GridSpectra {
        PackedSpectrum velocity;  ///< height: the integral of the vertical velocity over time
        /// WaterRowsJob::head_factors of all blocks; empty if there is only the velocity at the surface.
        AlignedBuffer<float> head_factors;

        std::size_t bytes() const { return velocity.bytes() + head_factors.bytes(); }
    };
    using Spectra = std::vector<GridSpectra>;
    Spectra empty_spectra(const WaterLayout& layout) const;
    /// Fills the waves of a grid. \param of  the cascade's waves, by `plan`
    void bake(const PackedSpectrum& of, const FftPlan& plan, const CascadePlan& cascade, double water_m,
              const WaterGrid& grid, GridSpectra& out) const;

    /// Sets the levels of the next frames, and allocates what compute() needs for them.
    void set_layout(const WaterLayout& layout);
    const WaterLayout& layout() const { return layout_; }

    /// Waves of a moment: those of `before`, or blended with those of `after`.
    struct Blend {
        const Spectra *before = nullptr, *after = nullptr;
        bool is_blend = false;
        float weight = 0;
        const std::vector<float>* band_weights = nullptr;  ///< empty: one weight
        std::uint32_t fraction = 0;                         ///< LoopFraction::turns
        float first_frequency = 0;
        float cosine = 1, sine = 0;
    };
    /// Computes a grid, if there are so many. Different grids may be computed concurrently.
    void compute(const Blend& blend, std::size_t grid, WaterPlanes& planes);

    std::size_t stack_bytes() const;
    std::size_t bytes() const;

   private:
    struct Transform {
        explicit Transform(int size) : plan(size), fft(plan.tables()) {}
        Transform(const Transform&) = delete;  // tables point into the plan
        FftPlan plan;
        FftTables fft;
    };
    const Transform& transform_of(int resolution) const;

    int resolution_;
    bool has_depth_;
    const Kernels& kernels_;
    Allocator memory_;
    std::vector<std::unique_ptr<const Transform>> transforms_;
    WaterLayout layout_;
    std::vector<AlignedBuffer<float>> blended_;  ///< waves of one block of lines, by grid
};

/// Blends a block of lines of two spectra. \param band_weights  empty: all waves have one weight
void blend_waves(const Kernels& kernels, const PackedSpectrum& before, const PackedSpectrum& after,
                 std::size_t line_block, float weight, const std::vector<float>& band_weights, float* out);

}  // namespace pelagic
