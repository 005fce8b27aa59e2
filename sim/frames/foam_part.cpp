#include "pelagic/sim/frames/foam_part.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "pelagic/sim/foam/drift.hpp"

namespace pelagic {

FoamPart::FoamPart(FrameSlots& slots, const Weather& weather, const Kernels& kernels, bool repeats)
    : slots_(slots), weather_(weather), repeats_(repeats), snapshots_(slots, kernels) {}

void FoamPart::add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) {
    if (pass == Pass::frame) return;
    const std::vector<StageId> read = snapshots_.add_tick_stages(graph, surfaces_done);
    std::copy(read.begin(), read.end(), surfaces_done.begin());
}

void FoamPart::begin(const PassMoment& at) { at.pass == Pass::frame ? begin_frame(at) : begin_tick(at); }

/// Determines the ticks that the frame needs beyond those that are kept. A constant sea has equal
/// foam in every loop if its waves repeat.
void FoamPart::begin_frame(const PassMoment& at) {
    set_drift(at);
    frame_tick_ = clock().at(at.time_s);
    const std::int64_t all = TickClock::kept_ticks;
    std::int64_t ahead = all;
    if (newest_tick_) {
        ahead = frame_tick_.number - *newest_tick_;
        if (repeats_ && weather_.forecast().changes.empty()) ahead = clock().in_loop(ahead);
    }
    set_due(static_cast<int>(ahead < 0 ? all : std::min(ahead, all)));
    if (due_.count == 0) set_views();
}

void FoamPart::begin_tick(const PassMoment& at) {
    const std::int64_t number = frame_tick_.number - (due_.count - 1);
    for (std::size_t cascade = 0; cascade < at.cascades.size(); ++cascade)
        snapshots_.begin_tick(cascade, at.cascades[cascade].grid, at.cascades[cascade].compression_scale, clock(),
                              number);
    newest_tick_ = number;
    set_due(due_.count - 1);
    if (due_.count == 0) set_views();
}

void FoamPart::end(Frame&) {
    if (std::exchange(ends_with_frame_, false)) forget();
}

void FoamPart::drop() {
    due_.count = 0;
    ends_with_frame_ = false;
}

void FoamPart::before_change(const SeaChange& next) {
    const bool is_due = due_.count > 0;  // ticks of a frame in flight
    if (!is_due && !newest_tick_) return;
    const std::int64_t newest = is_due ? frame_tick_.number : *newest_tick_;
    const double oldest_s = clock().time_s(newest - TickClock::kept_ticks);
    if (clock().time_s(newest) <= next.from_s && oldest_s >= weather_.end_of_forgotten_by_next()) return;
    if (is_due)
        ends_with_frame_ = true;
    else
        forget();
}

std::size_t FoamPart::bytes() const { return sizeof *this + snapshots_.bytes(); }

/// Sets the drift of the snapshots, which is constant while all of them are computed with it: that
/// of the sea with the larger weight. Snapshots of another drift are discarded.
void FoamPart::set_drift(const PassMoment& at) {
    const SeaMoment moment = weather_.moment_at(at.time_s);
    const std::size_t sea = moment.weight < 0.5 ? moment.before : moment.after;
    if (drift_sea_ == sea) return;
    const SeaStatistics statistics = weather_.statistics_at({.before = sea, .after = sea});
    for (std::size_t cascade = 0; cascade < at.cascades.size(); ++cascade)
        snapshots_.set_sea(cascade, weather_.foam_weight(cascade),
                           drift_per_loop(statistics, at.cascades[cascade].grid, slots_.resolution(), clock()));
    drift_sea_ = sea;
    forget();
}

/// Waves of a tick are those of its time in the loop, so that foam repeats with the loop.
void FoamPart::set_due(int count) {
    const std::int64_t next = frame_tick_.number - count + 1;
    due_ = {count, clock().time_s(next), clock().time_in_loop_s(next)};
}

/// Gives the frame the foam of the kept ticks.
void FoamPart::set_views() {
    slots_.frame().foam.level = static_cast<float>(slots_.frame().statistics.foam_level);
    snapshots_.set_views(clock(), frame_tick_);
}

}  // namespace pelagic
