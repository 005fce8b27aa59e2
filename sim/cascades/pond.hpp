// Octaves of exp(sin - 1) on the grid of one cascade (analytic/pond_waves.hpp, sim/spectrum/wave_list.hpp): a stage that
// sums them at each texel. Octaves that move those after them are no sum of waves that a transform could make.
//
//   spectrum (on demand) -> octaves
//
// Nothing moves horizontally. Velocities are those of the surface, straight up and down.
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
    /// \param cascade  which of the slots' cascades it fills
    Pond(FrameSlots& slots, std::size_t cascade, Isa isa, const FrameExtras& extras);
    Pond(const Pond&) = delete;  // stages point into it
    Pond& operator=(const Pond&) = delete;

    FilledBy add_stages(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) override;
    void begin(Pass pass, const SeaMoment& moment, Cascade& cascade) override;
    FrameBounds end_frame() override;
    std::size_t bytes() const override;

    void add_spectrum_stage(JobGraph& graph) override;
    void begin_spectrum(const SeaState& sea, const CascadePlan& plan, double whitecap_cover) override;
    /// It has one sea at a time: Forecast lets none of its kind turn into another.
    LineStatistics adopt_spectrum(std::size_t number, std::size_t place) override;
    const CascadeGrid& grid() const override { return waves_.plan.grid; }
    void drop_spectrum() override { bake_.reset(); }
    void stage_spectrum() override { bake_.swap(staged_); }
    void forget_seas() override {}

   private:
    /// The octaves of a sea, as the kernel takes them with texels for metres: so a place's turns are exact, and texel N is texel 0.
    struct Waves {
        CascadePlan plan;
        double loop_period_s = 1;
        std::vector<GridOctave> octaves;
        std::vector<PondTerms> terms;
        SlopeRanges slope_ranges;
    };
    struct RowBounds {
        float min, max;
    };
    static Waves waves_of(const SeaState& sea, const CascadePlan& plan);
    static LineStatistics statistics_of(const Waves& waves);
    void fill_row(Pass pass, std::size_t row);

    FrameSlots& slots_;
    std::size_t cascade_, lanes_;
    const AnalyticKernels& kernels_;
    bool has_velocities_;
    int resolution_;
    std::vector<double> columns_;  ///< 0, 1, ..., N - 1

    Waves waves_;  ///< of the frames to come
    std::optional<Waves> bake_, staged_;
    OfEachPass<std::vector<double>> starts_;  ///< of each octave, turns in [-1/2, 1/2)
    std::vector<RowBounds> row_bounds_;
};

}  // namespace pelagic
