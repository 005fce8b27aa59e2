// Waves of a spectrum on the grid of a cascade: the stages that transform it to displacement.
//
//   spectrum (on demand) -> evolve+rows -> columns+finalize
//
// With velocities, evolve+rows and columns+finalize run a second time. Stages whose intermediate
// data fits a near cache are fused into one job. Intermediate data is on the stack or in the
// outputs.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/cascades/sea_source.hpp"
#include "pelagic/sim/cascades/spectrum_cache.hpp"
#include "pelagic/sim/cascades/water_level_runs.hpp"
#include "pelagic/sim/kernels/fft_plan.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"

namespace pelagic {

class SpectralCascade final : public SeaSource, public ColumnSource {
   public:
    /// \param cascade  index of the cascade in the slots that the source fills
    SpectralCascade(FrameSlots& slots, std::size_t cascade, const Kernels& kernels);
    SpectralCascade(const SpectralCascade&) = delete;  // stages point into it
    SpectralCascade& operator=(const SpectralCascade&) = delete;

    /// Velocities are computed for frames only, not for ticks.
    ColumnSource* columns() override { return this; }
    StageId add_line_stage(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) override;
    void transform(std::size_t pair) override;
    FilledBy add_stages(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) override;
    void begin(Pass pass, const SeaMoment& moment, Cascade& cascade) override;
    FrameBounds end_frame() override;
    std::size_t bytes() const override;

    void add_spectrum_stage(JobGraph& graph) override;
    void begin_spectrum(const SeaState& sea, const CascadePlan& plan) override;
    LineStatistics adopt_spectrum(std::size_t number, std::size_t entry) override;
    const StatisticsByBand* statistics_by_band(std::size_t entry) const override { return &seas_[entry]->by_band; }
    const CascadeGrid& grid() const override { return grid_; }
    void drop_spectrum() override { bake_.reset(); }
    void stage_spectrum() override { bake_.swap(staged_); }
    void forget_seas() override { seas_ = {}; }

   private:
    StageId add_velocity_stages(JobGraph& graph, StageId blend_done);
    void add_level_stage(JobGraph& graph, const std::vector<StageId>& waits_for);
    void bake_levels(std::size_t grid);
    void spectrum(std::size_t line);
    void blend(Pass pass, std::size_t line_block);
    EvolveRowsJob evolve_rows_job(Pass pass, std::size_t line_block, float* lines);
    void columns_finalize(Pass pass, std::size_t number, float* surface, FrameBounds& bounds, float level_m);

    FrameSlots& slots_;
    std::size_t cascade_;
    const Kernels& kernels_;
    int resolution_;
    FftPlan plan_;
    FftTables fft_;

    /// The waves of a sea.
    struct Waves {
        std::size_t number;
        double choppiness;
        PackedSpectrum spectrum;
        LineStatistics statistics;
        StatisticsByBand by_band;
        SlopeRanges slope_ranges;
        WaterLevelRuns::Spectra of_levels;
    };
    const Waves& waves_of(std::size_t number) const;
    std::array<std::optional<Waves>, SpectrumCache::entries> seas_;
    CascadeGrid grid_;          ///< of the next frames; a pass in flight has a copy in its Cascade
    double loop_period_s_ = 1;  ///< of the next frames
    double foam_weight_ = 0;    ///< CascadePlan::foam_weight(), 0 without whitecaps

    /// Inputs of a pass.
    struct Shown {
        const Waves *before = nullptr, *after = nullptr;
        bool is_blend = false;  ///< false: only `before` is used
        float weight = 0;       ///< of `after`, if all waves have one weight
        /// Weight of `after` for each band while swell arrives from a distance; empty otherwise.
        std::vector<float> band_weights;
        bool is_idle = false;  ///< the pass needs whitecaps only, and the cascade makes none
        float choppiness = 0;
        float level_m = 0;
        float cosine = 1, sine = 0;  ///< of the grid's rotation
        float first_frequency = 0;   ///< 2 pi / loop period, rad/s
        LoopFraction fraction;
        /// Laid out as PackedSpectrum::waves; empty until a transition.
        AlignedBuffer<float> blended;
    };
    OfEachPass<Shown> shown_;

    /// A spectrum being baked.
    struct Bake {
        SeaState sea;
        CascadePlan plan;
        std::unique_ptr<std::once_flag> has_begun;
        /// Computed by the first line that is baked, because it takes longer than a frame may.
        std::optional<CascadeWaves> waves;
        PackedSpectrum spectrum;
        std::vector<LineStatistics> lines;
        std::vector<StatisticsByBand> lines_by_band;
        std::unique_ptr<WaterLayout> water;
        WaterLevelRuns::Spectra of_levels;
    };
    std::optional<Bake> bake_, staged_;

    std::unique_ptr<WaterLevelRuns> levels_;  ///< if FrameContents::has_water_levels()

    std::vector<FrameBounds> plane_bounds_;     ///< of each pair of column blocks
    std::vector<FrameBounds> velocity_bounds_;  ///< written by the kernel and not read
};

}  // namespace pelagic
