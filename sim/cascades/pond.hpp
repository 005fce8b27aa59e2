// Procedural pond waves on the grid of one cascade: octaves of exp(sin - 1)
// (analytic/pond_waves.hpp, sim/spectrum/wave_list.hpp). One stage sums them at each texel. No
// Fourier transform can compute them, because each octave displaces the octaves after it.
//
//   spectrum (on demand) -> octaves
//
// Horizontal displacements are 0. Velocities are vertical: the derivatives of the heights in time.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/cascades/sea_source.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/wave_list.hpp"

namespace pelagic {

class Pond final : public SeaSource {
   public:
    /// \param cascade  index of the cascade in the slots that the source fills
    Pond(FrameSlots& slots, std::size_t cascade, Isa isa);
    Pond(const Pond&) = delete;  // stages point into it
    Pond& operator=(const Pond&) = delete;

    FilledBy add_stages(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) override;
    void begin(Pass pass, const SeaMoment& moment, Cascade& cascade) override;
    FrameBounds end_frame() override;
    std::size_t bytes() const override;

    void add_spectrum_stage(JobGraph& graph) override;
    void begin_spectrum(const SeaState& sea, const CascadePlan& plan) override;
    /// Replaces the waves. A pond holds one sea, because a Forecast of ponds has no changes.
    LineStatistics adopt_spectrum(std::size_t number, std::size_t entry) override;
    const CascadeGrid& grid() const override { return waves_.plan.grid; }
    void drop_spectrum() override { bake_.reset(); }
    void stage_spectrum() override { bake_.swap(staged_); }
    void forget_seas() override {}

   private:
    /// The octaves of a sea, with positions in texels instead of metres. Phases at texels are
    /// therefore exact, and texel N equals texel 0.
    struct Waves {
        CascadePlan plan;
        double loop_period_s = 1;
        std::vector<GridOctave> octaves;
        std::vector<PondTerms> terms;
        SlopeRanges slope_ranges;
    };
    static Waves waves_of(const SeaState& sea, const CascadePlan& plan);
    static LineStatistics statistics_of(const Waves& waves);
    void fill_row(Pass pass, std::size_t row);

    FrameSlots& slots_;
    std::size_t cascade_, lanes_;
    const AnalyticKernels& kernels_;
    int resolution_;
    std::vector<double> columns_;  ///< 0, 1, ..., N - 1

    Waves waves_;  ///< of the next frames
    std::optional<Waves> bake_, staged_;
    /// Phase of each octave at the origin, turns in [-1/2, 1/2).
    OfEachPass<std::vector<double>> starts_;
    std::vector<FrameBounds> row_bounds_;
};

}  // namespace pelagic
