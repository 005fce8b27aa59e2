#include "pelagic/sim/frames/foam_part.hpp"

#include <algorithm>
#include <vector>

#include "pelagic/sim/foam/drift.hpp"

namespace pelagic {

FoamPart::FoamPart(FrameSlots& slots, const Weather& weather, const Kernels& kernels, bool repeats)
    : slots_(slots),
      weather_(weather),
      ticks_(weather, {.count = TickClock::kept_ticks, .repeats = repeats, .whitecaps_only = true}),
      snapshots_(slots, kernels) {}

void FoamPart::add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) {
    if (pass == Pass::frame) return;
    const std::vector<StageId> read = snapshots_.add_tick_stages(graph, surfaces_done);
    std::copy(read.begin(), read.end(), surfaces_done.begin());
}

void FoamPart::begin(const PassMoment& at) {
    if (at.pass == Pass::frame) {
        set_drift(at);
        ticks_.begin_frame(at.time_s);
    } else {
        const bool is_ours = ticks_.due().begins_at(at.time_s);
        snapshots_.set_idle(!is_ours);
        if (!is_ours) return;
        begin_tick(at);
    }
    if (ticks_.due().count == 0) set_views();
}

void FoamPart::begin_tick(const PassMoment& at) {
    const std::int64_t number = ticks_.begin_tick();
    for (std::size_t cascade = 0; cascade < at.cascades.size(); ++cascade)
        snapshots_.begin_tick(cascade, at.cascades[cascade], ticks_.clock(), number);
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
                           drift_per_loop(statistics, at.cascades[cascade].grid, slots_.resolution(), ticks_.clock()));
    drift_sea_ = sea;
    forget();
}

/// Gives the frame the foam of the kept ticks.
void FoamPart::set_views() {
    slots_.frame().foam.level = static_cast<float>(slots_.frame().statistics.foam_level);
    snapshots_.set_views(ticks_.clock(), ticks_.frame_tick());
}

}  // namespace pelagic
