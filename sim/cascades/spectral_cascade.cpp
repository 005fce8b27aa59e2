#include "pelagic/sim/cascades/spectral_cascade.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/cascades/arrival.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/spectrum/mean_square_slope.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {
namespace {

/// Stack of stage `evolve+rows`; an upper bound for stage `columns+finalize`.
std::size_t transform_stack_bytes(int resolution, std::size_t lanes) {
    return 24 * static_cast<std::size_t>(resolution) * lanes + stack_margin;
}

/// Returns Cascade::level_m: the drawn mean of h (1 + Dx,x + Dz,z) is then 0, because only the part of
/// a wave's displacement in quadrature with its height has a mean product with it.
float mean_level_m(double choppiness, const LineStatistics& waves) {
    return static_cast<float>(choppiness * waves.level_m);
}

/// Returns the depth of the water that the sea's waves feel.
double water_depth_m(const SeaState& sea) {
    return sea.waves == WaveModel::spectrum || sea.waves == WaveModel::regular ? sea.depth_m : deep_water.depth_m;
}

// Lines in a job: few, so that baking a spectrum does not delay frames.
constexpr std::size_t spectrum_batch = 2;

}  // namespace

SpectralCascade::SpectralCascade(FrameSlots& slots, std::size_t cascade, const Kernels& kernels)
    : slots_(slots),
      cascade_(cascade),
      kernels_(kernels),
      resolution_(slots.resolution()),
      plan_(resolution_),
      fft_(plan_.tables()),
      plane_bounds_(column_block_pairs(resolution_, kernels_.lanes)),
      velocity_bounds_(slots_.contents().has_drawn_velocities() ? plane_bounds_.size() : 0) {
    if (slots_.contents().has_water_levels())
        levels_ = std::make_unique<WaterLevelRuns>(resolution_, slots_.contents().depth, kernels_, slots_.memory());
}

void SpectralCascade::add_spectrum_stage(JobGraph& graph) {
    const StageId lines_done =
        graph.add({.name = stage_name("spectrum", cascade_),
                   .count = line_count(resolution_),
                   .batch = spectrum_batch,
                   .body = for_each_item([this](std::size_t line) { spectrum(line); }),
                   .stack_bytes = stack_margin});
    if (!levels_) return;
    graph.add({.name = stage_name("spectrum levels", cascade_),
               .count = levels_->max_count(),
               .waits_for = {lines_done},
               .body = for_each_item([this](std::size_t grid) { bake_levels(grid); }),
               .stack_bytes = stack_margin});
}

StageId SpectralCascade::add_line_stage(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) {
    return graph.add({.name = stage_name(pass == Pass::tick ? "tick evolve+rows" : "evolve+rows", cascade_),
                      .count = line_blocks(resolution_, kernels_.lanes),
                      .waits_for = waits_for,
                      .body = for_each_item([this, pass](std::size_t block) {
                          if (shown_[pass].is_idle) return;
                          blend(pass, block);
                          kernels_.evolve_rows(evolve_rows_job(pass, block, slots_.surface(cascade_)));
                      }),
                      .stack_bytes = transform_stack_bytes(resolution_, kernels_.lanes)});
}

FilledBy SpectralCascade::add_stages(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) {
    const std::size_t transforms = transform_stack_bytes(resolution_, kernels_.lanes);
    const bool is_tick = pass == Pass::tick;
    if (levels_ && !is_tick) add_level_stage(graph, waits_for);
    const StageId lines_done = add_line_stage(graph, pass, waits_for);
    const StageId surface_done =
        graph.add({.name = stage_name(is_tick ? "tick columns" : "columns+finalize", cascade_),
                   .count = plane_bounds_.size(),
                   .waits_for = {lines_done},
                   .body = for_each_item([this, pass](std::size_t pair) {
                       if (shown_[pass].is_idle) return;
                       columns_finalize(pass, pair, slots_.surface(cascade_), plane_bounds_[pair],
                                        shown_[pass].level_m);
                   }),
                   .stack_bytes = transforms});
    return {surface_done,
            slots_.contents().has_drawn_velocities() && !is_tick ? add_velocity_stages(graph, lines_done)
                                                                 : surface_done};
}

// The time derivative of a sum of waves is a sum of waves, and uses the transforms of the surface.
StageId SpectralCascade::add_velocity_stages(JobGraph& graph, StageId blend_done) {
    const std::size_t transforms = transform_stack_bytes(resolution_, kernels_.lanes);
    const auto velocity = [this] { return slots_.buffers(cascade_).velocity.data(); };
    const StageId lines_done =
        graph.add({.name = stage_name("velocity rows", cascade_),
                   .count = line_blocks(resolution_, kernels_.lanes),
                   .waits_for = {blend_done},
                   .body = for_each_item([this, velocity](std::size_t block) {
                       kernels_.evolve_velocity_rows(evolve_rows_job(Pass::frame, block, velocity()));
                   }),
                   .stack_bytes = transforms});
    return graph.add({.name = stage_name("velocity columns", cascade_),
                      .count = velocity_bounds_.size(),
                      .waits_for = {lines_done},
                      .body = for_each_item([this, velocity](std::size_t pair) {
                          columns_finalize(Pass::frame, pair, velocity(), velocity_bounds_[pair], 0);
                      }),
                      .stack_bytes = transforms});
}

void SpectralCascade::add_level_stage(JobGraph& graph, const std::vector<StageId>& waits_for) {
    graph.add({.name = stage_name("water levels", cascade_),
               .count = levels_->max_count(),
               .waits_for = waits_for,
               .body = for_each_item([this](std::size_t grid) {
                   const Shown& shown = shown_[Pass::frame];
                   levels_->compute({.before = &shown.before->of_levels,
                                     .after = &shown.after->of_levels,
                                     .is_blend = shown.is_blend,
                                     .weight = shown.weight,
                                     .band_weights = &shown.band_weights,
                                     .fraction = shown.fraction.turns,
                                     .first_frequency = shown.first_frequency,
                                     .cosine = shown.cosine,
                                     .sine = shown.sine},
                                    grid, *slots_.buffers(cascade_).water);
               }),
               .stack_bytes = levels_->stack_bytes() + stack_margin});
}

const SpectralCascade::Waves& SpectralCascade::waves_of(std::size_t number) const {
    const auto found =
        std::find_if(seas_.begin(), seas_.end(), [&](const auto& waves) { return waves && waves->number == number; });
    assert(found != seas_.end() && "the sea's spectrum has not been baked");
    return **found;
}

void SpectralCascade::begin(Pass pass, const SeaMoment& moment, Cascade& cascade) {
    Shown& shown = shown_[pass];
    const Waves &before = waves_of(moment.before), &after = waves_of(moment.after);
    shown.before = &before;
    shown.after = &after;
    shown.weight = static_cast<float>(moment.weight);
    double choppiness = before.choppiness;
    shown.cosine = static_cast<float>(grid_.cosine);
    shown.sine = static_cast<float>(grid_.sine);
    shown.first_frequency = static_cast<float>(two_pi / loop_period_s_);
    shown.fraction = loop_fraction(moment.time_s, loop_period_s_);
    shown.band_weights.clear();
    LineStatistics statistics = before.statistics;
    cascade.slope_ranges = before.slope_ranges;
    if (!moment.is_steady()) {
        if (shown.blended.size() == 0)
            shown.blended = AlignedBuffer<float>(before.spectrum.waves.size(), slots_.memory());
        choppiness = (1 - moment.weight) * before.choppiness + moment.weight * after.choppiness;
        statistics = between(before.statistics, after.statistics, moment.weight);
        if (moment.arrival) {
            for (std::size_t band = 0; band < moment.arrival->bands(); ++band)
                shown.band_weights.push_back(static_cast<float>(moment.arrival->fraction(band, moment.since_s)));
            statistics = between(before.by_band, after.by_band, *moment.arrival, moment.since_s);
        }
        cascade.slope_ranges = slope_ranges(statistics.mean_square_slope, statistics.mean_square_convergence);
    }
    shown.is_blend = shown.weight != 0 || !shown.band_weights.empty();
    cascade.grid = grid_;
    shown.choppiness = static_cast<float>(choppiness);
    cascade.level_m = shown.level_m = mean_level_m(choppiness, statistics);
    if (levels_ && pass == Pass::frame) {
        slots_.buffers(cascade_).water->view(levels_->layout(), cascade.water);
        const auto [x, z] = grid_.in_world(statistics.lacking_x, statistics.lacking_z);
        cascade.water.drift_x_mps = x;
        cascade.water.drift_z_mps = z;
        cascade.water.drift_k = statistics.lacking_size > 0 ? statistics.lacking_k / statistics.lacking_size : 0;
    }
    shown.is_idle = moment.whitecaps_only && foam_weight_ == 0;
}

FrameBounds SpectralCascade::end_frame() {
    FrameBounds all = plane_bounds_.front();
    for (const FrameBounds& bounds : plane_bounds_) all.extend(bounds);
    return all;
}

void SpectralCascade::begin_spectrum(const SeaState& sea, const CascadePlan& plan) {
    bake_.emplace(Bake{sea,
                       plan,
                       std::make_unique<std::once_flag>(),
                       {},
                       PackedSpectrum(plan_, kernels_.lanes, slots_.memory()),
                       std::vector<LineStatistics>(line_count(resolution_)),
                       std::vector<StatisticsByBand>(line_count(resolution_)),
                       {},
                       {}});
    if (!levels_) return;
    bake_->water = std::make_unique<WaterLayout>(levels_->layout_of(plan, water_depth_m(sea)));
    bake_->of_levels = levels_->empty_spectra(*bake_->water);
}

LineStatistics SpectralCascade::adopt_spectrum(std::size_t number, std::size_t entry) {
    LineStatistics all;
    for (const LineStatistics& line : bake_->lines) all += line;
    StatisticsByBand by_band;
    for (const StatisticsByBand& line : bake_->lines_by_band) by_band += line;
    const SeaState& sea = bake_->sea;
    grid_ = bake_->plan.grid;
    loop_period_s_ = sea.loop_period_s;
    foam_weight_ = sea.waves == WaveModel::spectrum ? bake_->plan.foam_weight() : 0;
    seas_[entry].emplace(Waves{number, sea.choppiness, std::move(bake_->spectrum), all, std::move(by_band),
                               slope_ranges(all.mean_square_slope, all.mean_square_convergence),
                               std::move(bake_->of_levels)});
    if (levels_) levels_->set_layout(*bake_->water);
    bake_.reset();
    return all;
}

void SpectralCascade::spectrum(std::size_t line) {
    std::call_once(*bake_->has_begun, [this] { bake_->waves.emplace(bake_->sea, bake_->plan); });
    bake_->lines[line] =
        bake_spectrum_line(bake_->sea, *bake_->waves, plan_, line, bake_->spectrum, &bake_->lines_by_band[line]);
}

void SpectralCascade::bake_levels(std::size_t grid) {
    if (grid < bake_->of_levels.size())
        levels_->bake(bake_->spectrum, plan_, bake_->plan, water_depth_m(bake_->sea), bake_->water->levels.grids[grid],
                      bake_->of_levels[grid]);
}

/// Blends the waves of a block of lines for the evolve kernel, if the pass blends two seas.
void SpectralCascade::blend(Pass pass, std::size_t line_block) {
    Shown& shown = shown_[pass];
    if (!shown.is_blend) return;
    const PackedSpectrum &before = shown.before->spectrum, &after = shown.after->spectrum;
    blend_waves(kernels_, before, after, line_block, shown.weight, shown.band_weights,
                shown.blended.data() + line_block * before.block_floats());
}

EvolveRowsJob SpectralCascade::evolve_rows_job(Pass pass, std::size_t line_block, float* lines) {
    const std::size_t first_line = line_block * kernels_.lanes;
    const Shown& shown = shown_[pass];
    const PackedSpectrum& spectrum = shown.before->spectrum;  // harmonics of both are equal
    return {.waves = !shown.is_blend ? spectrum.block(line_block)
                                     : shown.blended.data() + line_block * spectrum.block_floats(),
            .harmonics = spectrum.block_harmonics(line_block),
            .fraction = shown.fraction.turns,
            .first_line = first_line,
            .line_count = std::min(kernels_.lanes, line_count(resolution_) - first_line),
            .fft = &fft_,
            .lines = lines,
            .first_frequency = shown.first_frequency};
}

void SpectralCascade::transform(std::size_t pair) {
    columns_finalize(Pass::frame, pair, slots_.surface(cascade_), plane_bounds_[pair],
                     shown_[Pass::frame].level_m);
}

void SpectralCascade::columns_finalize(Pass pass, std::size_t number, float* surface, FrameBounds& bounds,
                                       float level_m) {
    const Shown& shown = shown_[pass];
    ColumnsFinalizeJob job{.blocks = {},
                           .fft = &fft_,
                           .choppiness = shown.choppiness,
                           .cosine = shown.cosine,
                           .sine = shown.sine,
                           .bounds = &bounds,
                           .level_m = level_m};
    const std::size_t block_floats = column_block_floats(resolution_, kernels_.lanes);
    const ColumnBlockPair pair = column_block_pair(resolution_, kernels_.lanes, number);
    job.blocks[0] = surface + pair.first * block_floats;
    if (pair.has_second) job.blocks[1] = surface + pair.second * block_floats;
    kernels_.columns_finalize(job);
}

std::size_t SpectralCascade::bytes() const {
    std::size_t bytes = sizeof(SpectralCascade) + plan_.bytes() +
                        (plane_bounds_.capacity() + velocity_bounds_.capacity()) * sizeof(FrameBounds);
    for (const auto& waves : seas_)
        if (waves) {
            bytes += waves->spectrum.bytes() + waves->by_band.bytes();
            for (const WaterLevelRuns::GridSpectra& of : waves->of_levels) bytes += of.bytes();
        }
    if (levels_) bytes += sizeof(WaterLevelRuns) + levels_->bytes();
    for (const Pass pass : {Pass::tick, Pass::frame}) bytes += shown_[pass].blended.bytes();
    return bytes;
}

}  // namespace pelagic
