#include "pelagic/sim/frames/frame_assembly.hpp"

#include <algorithm>
#include <utility>

#include "pelagic/sim/cascades/pond.hpp"
#include "pelagic/sim/cascades/spectral_cascade.hpp"
#include "pelagic/sim/foam/drift.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

std::size_t cascade_count_of(const SeaState& sea) { return static_cast<std::size_t>(cascades_of(sea)); }

/// Adds what frames always have: gradients of one cascade, slopes of several.
FrameExtras completed(FrameExtras extras, std::size_t cascades) {
    extras.gradients |= cascades == 1;
    extras.slopes |= cascades > 1;
    return extras;
}

}  // namespace

FrameAssembly::FrameAssembly(const Forecast& forecast, Isa isa, const FrameExtras& wanted, WaveInputs::List inputs)
    : isa_(isa),
      weather_(forecast),
      extras_(completed(wanted, cascade_count_of(forecast.first))),
      slots_(cascade_count_of(forecast.first), resolution_of(forecast.first), kernels_for(isa).lanes, extras_),
      folds_(slots_, kernels_for(isa)),
      inputs_(std::move(inputs), slots_, isa, extras_.velocities),
      at_tick_(slots_.cascade_count()) {
    for (std::size_t cascade = 0; cascade < slots_.cascade_count(); ++cascade) {
        sources_.push_back(source_of(forecast.first.waves, cascade));
        surfaces_.push_back(std::make_unique<SurfaceStages>(slots_, cascade, kernels_for(isa), extras_));
    }
    if (!extras_.foam) return;
    if (slots_.cascade_count() == 1) history_.emplace(slots_, kernels_for(isa), extras_.memory);
    snapshots_.emplace(slots_, kernels_for(isa), extras_.memory);
}

void FrameAssembly::add_frame_stages(JobGraph& graph, std::span<const StageId> after) {
    std::vector<StageId> surfaces_done;
    for (std::size_t cascade = 0; cascade < sources_.size(); ++cascade) {
        std::vector<StageId> waits_for;
        if (!after.empty()) waits_for = {after[cascade]};
        if (has_bands(cascade)) {
            ColumnSource& source = *sources_[cascade]->columns();
            surfaces_[cascade]->add_bands_to(graph, source.add_line_stage(graph, Pass::frame, waits_for),
                                             [&source](std::size_t pair) { source.transform(pair); });
            continue;
        }
        const FilledBy filled = sources_[cascade]->add_stages(graph, Pass::frame, waits_for);
        surfaces_done.push_back(inputs_.add_stage(graph, Pass::frame, cascade, filled));
        surfaces_[cascade]->add_to(graph, surfaces_done.back());
    }
    if (extras_.folds) folds_.add_to(graph, surfaces_done);
}

std::vector<StageId> FrameAssembly::add_tick_stages(JobGraph& graph) {
    std::vector<StageId> surfaces_done;
    for (std::size_t cascade = 0; cascade < sources_.size(); ++cascade) {
        const FilledBy filled = sources_[cascade]->add_stages(graph, Pass::tick, {});
        surfaces_done.push_back(inputs_.add_stage(graph, Pass::tick, cascade, filled));
    }
    if (history_) surfaces_done[0] = history_->add_tick_stage(graph, surfaces_done[0]);
    return snapshots_->add_tick_stages(graph, surfaces_done);
}

void FrameAssembly::add_spectrum_stages(JobGraph& graph) {
    for (const auto& source : sources_) source->add_spectrum_stage(graph);
}

void FrameAssembly::begin_frame(double time_s, std::span<const TextureTargets> targets) {
    const DefaultFloatEnvironment environment;
    slots_.write_textures_to(targets);
    Frame& frame = slots_.frame();
    const SeaMoment moment = weather_.moment_at(time_s);
    frame.time_s = time_s;
    frame.sea = weather_.sea_at(moment);
    frame.statistics = weather_.statistics_at(moment);
    frame.isa = isa_;
    for (std::size_t cascade = 0; cascade < sources_.size(); ++cascade) {
        sources_[cascade]->begin(Pass::frame, moment, slots_.cascade(cascade));
        slots_.cascade(cascade).compression_scale = compression_scale(cascade, frame.statistics);
    }
    begin_inputs(Pass::frame, time_s, time_s);
    if (snapshots_) plan_ticks(moment);
}

double FrameAssembly::next_tick_s() const { return clock().time_s(frame_tick_.number - ticks_due_ + 1); }

void FrameAssembly::begin_tick() {
    const DefaultFloatEnvironment environment;
    const std::int64_t number = frame_tick_.number - --ticks_due_;
    const SeaMoment moment = moment_at_tick(number);
    const SeaStatistics statistics = weather_.statistics_at(moment);
    for (std::size_t cascade = 0; cascade < sources_.size(); ++cascade) {
        Cascade& at_tick = at_tick_[cascade];
        sources_[cascade]->begin(Pass::tick, moment, at_tick);
        at_tick.compression_scale = compression_scale(cascade, statistics);
        snapshots_->begin_tick(cascade, at_tick.grid, at_tick.compression_scale, clock(), number);
    }
    if (history_)
        history_->advance(at_tick_[0], drift_of(statistics, at_tick_[0].grid, resolution(), clock(), number));
    begin_inputs(Pass::tick, clock().time_s(number), moment.time_s);
    newest_tick_ = number;
    if (ticks_due_ == 0) show_foam();
}

const Frame& FrameAssembly::end_frame() {
    if (std::exchange(foam_ends_with_frame_, false)) forget();
    slots_.finish_textures();
    Frame& frame = slots_.frame();
    frame.bounds = {};
    for (std::size_t cascade = 0; cascade < sources_.size(); ++cascade) {
        const bool has_inputs = !inputs_.empty() && inputs_.adds_to(cascade);
        const FrameBounds bounds = slots_.cascade(cascade).bounds =
            has_inputs ? inputs_.bounds(cascade) : sources_[cascade]->end_frame();
        frame.bounds.height_min_m += bounds.height_min_m;
        frame.bounds.height_max_m += bounds.height_max_m;
        frame.bounds.horizontal_x_max_m += bounds.horizontal_x_max_m;
        frame.bounds.horizontal_z_max_m += bounds.horizontal_z_max_m;
    }
    frame.bounds.height_min_m += frame.dynamic_waves.height_min_m + frame.shore.height_min_m;
    frame.bounds.height_max_m += frame.dynamic_waves.height_max_m + frame.shore.height_max_m;
    return frame;
}

void FrameAssembly::drop_frame() {
    slots_.turn();
    ticks_due_ = 0;
    foam_ends_with_frame_ = false;
}

void FrameAssembly::keep_foam_of(const SeaChange& next) {
    const bool has_ticks_due = ticks_due_ > 0;  // of a frame in flight
    if (!has_ticks_due && !newest_tick_) return;
    const std::int64_t newest = has_ticks_due ? frame_tick_.number : *newest_tick_;
    const double oldest_s = clock().time_s(newest - TickClock::kept_ticks);
    if (clock().time_s(newest) <= next.from_s && oldest_s >= weather_.end_of_forgotten_by_next()) return;
    if (has_ticks_due)
        foam_ends_with_frame_ = true;
    else
        forget();
}

void FrameAssembly::begin_sea(std::size_t number) {
    const DefaultFloatEnvironment environment;
    weather_.begin(number, sources_);
}

void FrameAssembly::adopt_sea() {
    const DefaultFloatEnvironment environment;
    weather_.adopt(sources_);
}

void FrameAssembly::begin_other_weather(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    weather_.begin_other(sea, sources_);
}

void FrameAssembly::adopt_other_weather() {
    const DefaultFloatEnvironment environment;
    weather_.restart(sources_);
    forget();
}

void FrameAssembly::stage_sea() {
    for (const auto& source : sources_) source->stage_spectrum();
}

void FrameAssembly::drop_sea() {
    for (const auto& source : sources_) source->drop_spectrum();
}

std::size_t FrameAssembly::texels() const {
    return cascade_count() * static_cast<std::size_t>(resolution()) * static_cast<std::size_t>(resolution());
}

std::size_t FrameAssembly::bytes() const {
    std::size_t bytes = slots_.bytes() + inputs_.bytes();
    for (const auto& source : sources_) bytes += source->bytes();
    for (const auto& surface : surfaces_) bytes += sizeof(SurfaceStages) + surface->bytes();
    if (history_) bytes += history_->bytes();
    if (snapshots_) bytes += snapshots_->bytes();
    return bytes;
}

/// Prepares the wave inputs. Called after the sources, which set the grids of the cascades.
void FrameAssembly::begin_inputs(Pass pass, double time_s, double time_in_loop_s) {
    if (inputs_.empty()) return;
    for (std::size_t cascade = 0; cascade < cascade_count(); ++cascade)
        inputs_.set_grid(pass, cascade, cascade_of(pass, cascade).grid);
    inputs_.begin(pass, time_s, time_in_loop_s, weather_.forecast().first.loop_period_s);
    for (std::size_t cascade = 0; cascade < cascade_count(); ++cascade)
        inputs_.begin_cascade(pass, cascade, cascade_of(pass, cascade));
}

std::unique_ptr<SeaSource> FrameAssembly::source_of(WaveModel waves, std::size_t cascade) {
    if (waves == WaveModel::pond) return std::make_unique<Pond>(slots_, cascade, isa_, extras_);
    return std::make_unique<SpectralCascade>(slots_, cascade, kernels_for(isa_), extras_);
}

/// Returns whether one stage of a frame computes a cascade's columns and textures.
bool FrameAssembly::has_bands(std::size_t cascade) const {
    return !extras_.planes && sources_[cascade]->columns() && TextureBands::are_worthwhile(slots_.resolution());
}

TickClock FrameAssembly::clock() const { return TickClock(weather_.forecast().first.loop_period_s); }

/// Returns the moment of a tick. The forecast is evaluated at the tick's time, and the waves at its
/// time in the loop, which makes foam repeat with the loop.
SeaMoment FrameAssembly::moment_at_tick(std::int64_t number) const {
    SeaMoment moment = weather_.moment_at(clock().time_s(number));
    moment.time_s = clock().time_in_loop_s(number);
    return moment;
}

/// Returns Cascade::compression_scale at a moment.
float FrameAssembly::compression_scale(std::size_t cascade, const SeaStatistics& statistics) const {
    if (statistics.foam_level == SeaStatistics::no_foam_level) return 0;
    return static_cast<float>(weather_.foam_weight(cascade) / statistics.compression_deviation);
}

/// Sets the drift of the snapshots, which is constant while all of them are computed with it: that
/// of the sea with the larger weight. Snapshots of another drift are discarded.
void FrameAssembly::set_foam_drift(const SeaMoment& moment) {
    const std::size_t sea = moment.weight < 0.5 ? moment.before : moment.after;
    if (drift_sea_ == sea) return;
    const SeaStatistics statistics = weather_.statistics_at({.before = sea, .after = sea});
    for (std::size_t cascade = 0; cascade < sources_.size(); ++cascade)
        snapshots_->set_sea(cascade, weather_.foam_weight(cascade),
                            drift_a_loop(statistics, sources_[cascade]->grid(), resolution(), clock()));
    drift_sea_ = sea;
    forget();
}

/// Determines the ticks that the frame of a moment needs beyond the foam history. A constant sea
/// has equal foam in every loop, unless it has wave inputs, which need not repeat with the loop.
void FrameAssembly::plan_ticks(const SeaMoment& moment) {
    set_foam_drift(moment);
    frame_tick_ = clock().at(moment.time_s);
    const std::int64_t all = TickClock::kept_ticks;
    std::int64_t ahead = all;
    if (newest_tick_) {
        ahead = frame_tick_.number - *newest_tick_;
        if (weather_.forecast().changes.empty() && inputs_.empty()) ahead = clock().in_loop(ahead);
    }
    ticks_due_ = static_cast<int>(ahead < 0 ? all : std::min(ahead, all));
    if (ticks_due_ == all && history_) history_->forget();
    if (ticks_due_ == 0) show_foam();
}

/// Gives the frame the current foam history.
void FrameAssembly::show_foam() {
    if (history_)
        slots_.remembered_foam() = {history_->remembered(),
                                    static_cast<int>(std::uint64_t{FoamTickJob::fade} * frame_tick_.fraction >> 32)};
    slots_.frame().foam.level = static_cast<float>(slots_.frame().statistics.foam_level);
    snapshots_->show(clock(), frame_tick_);
}

}  // namespace pelagic
