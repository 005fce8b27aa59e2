#include "pelagic/sim/frames/spectrum_baker.hpp"

#include <limits>
#include <utility>

namespace pelagic {

SpectrumBaker::SpectrumBaker(Weather& weather, Weather::Sources sources, std::shared_ptr<Executor> executor,
                             const std::shared_ptr<TraceSink>& trace)
    : weather_(weather), sources_(sources), executor_(std::move(executor)) {
    for (const auto& source : sources_) source->add_spectrum_stage(graph_);
    run_ = prepare_traced(*executor_, graph_, trace, "sea");
    begin(0);
    complete();
    weather_.adopt(sources_);
}

void SpectrumBaker::begin_frame(double time_s) {
    weather_.need_nothing();
    if (is_baked_ahead()) finish();
    ensure_resident(Pass::frame, time_s);
    if (baking_ == Baking::nothing)
        if (const auto soon = weather_.wanted_soon(time_s)) begin_ahead(*soon);
    // Without other threads a frame computes one block, so that it is not late.
    if (baking_ == Baking::ahead && !executor_->runs_ahead()) bake_blocks(1);
}

void SpectrumBaker::ensure_resident(Pass pass, double time_s) {
    const SeaMoment moment = weather_.moment_at(time_s);
    weather_.need(pass, moment);
    for (const std::size_t number : {moment.before, moment.after}) {
        if (weather_.has(number)) continue;
        finish();
        if (weather_.has(number)) continue;
        begin(number);
        complete();
        weather_.adopt(sources_);
    }
}

void SpectrumBaker::finish() {
    if (baking_ == Baking::ahead) {
        complete();
        weather_.adopt(sources_);
        baking_ = Baking::nothing;
    } else if (baking_ == Baking::other) {
        complete();
        stage();
        baking_ = Baking::staged;
    }
}

void SpectrumBaker::add(const SeaChange& change) {
    weather_.add(change);
    begin_ahead(weather_.number_of_last());
}

void SpectrumBaker::begin_other(const SeaState& sea) {
    finish();
    weather_.begin_other(sea, sources_);
    schedule();
    baking_ = Baking::other;
}

bool SpectrumBaker::is_other_done() const {
    return baking_ != Baking::other || !executor_->runs_ahead() || run_->is_done();
}

void SpectrumBaker::complete_other() {
    if (baking_ == Baking::staged)
        stage();
    else
        complete();
    baking_ = Baking::nothing;
    weather_.restart(sources_);
}

/// Starts to bake a sea of the forecast.
void SpectrumBaker::begin(std::size_t number) {
    weather_.begin(number, sources_);
    schedule();
}

void SpectrumBaker::begin_ahead(std::size_t number) {
    if (executor_->runs_ahead()) {
        begin(number);
    } else {
        weather_.begin(number, sources_);
        stage_ = block_ = 0;
    }
    baking_ = Baking::ahead;
}

void SpectrumBaker::schedule() {
    try {
        run_->schedule();
    } catch (...) {
        drop();
        throw;
    }
}

void SpectrumBaker::complete() {
    try {
        if (baking_ == Baking::ahead && !executor_->runs_ahead())
            bake_blocks(std::numeric_limits<std::size_t>::max());
        else
            run_->complete();
    } catch (...) {
        drop();
        baking_ = Baking::nothing;
        throw;
    }
}

void SpectrumBaker::drop() {
    for (const auto& source : sources_) source->drop_spectrum();
}

/// Exchanges the baked sea with the stored one.
void SpectrumBaker::stage() {
    for (const auto& source : sources_) source->stage_spectrum();
}

/// Computes blocks of the spectrum on this thread, each two lines of a cascade.
void SpectrumBaker::bake_blocks(std::size_t max) {
    for (; max > 0 && stage_ < graph_.stages().size(); --max) {
        const Stage& stage = graph_.stages()[stage_];
        run_block(stage, block_);
        if (++block_ < block_count(stage)) continue;
        block_ = 0;
        ++stage_;
    }
}

bool SpectrumBaker::is_baked_ahead() const {
    if (baking_ != Baking::ahead) return false;
    return executor_->runs_ahead() ? run_->is_done() : stage_ == graph_.stages().size();
}

}  // namespace pelagic
