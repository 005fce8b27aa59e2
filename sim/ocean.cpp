#include "pelagic/sim/ocean.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/message/refusal.hpp"
#include "pelagic/sim/history/foam_drift.hpp"
#include "pelagic/sim/history/foam_history.hpp"
#include "pelagic/sim/sources/cascade.hpp"
#include "pelagic/sim/sources/pond.hpp"
#include "pelagic/sim/sources/weather.hpp"
#include "pelagic/sim/surface/fold_stages.hpp"
#include "pelagic/sim/surface/surface_stages.hpp"
#include "pelagic/sim/tick_clock.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// A frame of 64 x 64 takes 20 microseconds; sharing it among threads takes as long again. See docs/benchmarks.md.
constexpr std::size_t most_texels_without_jobs = 64 * 64;

// More than a clock counts: 2^40 loops of less than 2^20 ticks.
constexpr std::int64_t most_ticks = std::int64_t{1} << 60;

template <class Options>
const Options& checked(const Options& options) {
    if (const std::string reason = check(options); !reason.empty()) throw std::invalid_argument(reason);
    return options;
}

}  // namespace

/// What the sources of all tiles share, and how a frame is put together from what they make.
class Ocean::Sources {
   public:
    /// One tile always has gradients, several always have slopes.
    static FrameExtras completed(FrameExtras extras, std::size_t tiles) {
        extras.gradients |= tiles == 1;
        extras.slopes |= tiles > 1;
        return extras;
    }

    Sources(const Forecast& forecast, Isa isa, const FrameExtras& wanted)
        : isa_(isa),
          weather_(forecast),
          extras_(completed(wanted, tiles_of(forecast.first))),
          slots_(tiles_of(forecast.first), resolution_of(forecast.first), kernels_for(isa).lanes, extras_),
          folds_(slots_, kernels_for(isa)) {
        for (std::size_t tile = 0; tile < slots_.tile_count(); ++tile) {
            sources_.push_back(source_of(forecast.first.waves, tile));
            surfaces_.push_back(std::make_unique<SurfaceStages>(slots_, tile, kernels_for(isa), extras_));
        }
        if (extras_.foam) foam_.emplace(slots_, kernels_for(isa), extras_.memory);
    }

    /// \param after  those of its tick, by tile, or none
    void add_frame_stages(JobGraph& graph, std::span<const StageId> after = {}) {
        std::vector<StageId> surfaces_done;
        for (std::size_t tile = 0; tile < sources_.size(); ++tile) {
            std::vector<StageId> waits_for;
            if (!after.empty()) waits_for = {after[tile]};
            surfaces_done.push_back(sources_[tile]->add_stages(graph, Pass::frame, waits_for));
            surfaces_[tile]->add_to(graph, surfaces_done.back());
        }
        if (extras_.folds) folds_.add_to(graph, surfaces_done);
    }
    std::vector<StageId> add_tick_stages(JobGraph& graph) {
        std::vector<StageId> surfaces_done;
        for (const auto& source : sources_) surfaces_done.push_back(source->add_stages(graph, Pass::tick, {}));
        return foam_->add_tick_stages(graph, surfaces_done);
    }
    void add_spectrum_stages(JobGraph& graph) {
        for (const auto& source : sources_) source->add_spectrum_stage(graph);
    }

    /// \pre the moment's seas are at hand
    void begin_frame(double time_s, std::span<const TextureTargets> targets) {
        const DefaultFloatEnvironment environment;
        slots_.turn();
        slots_.write_textures_to(targets);
        Frame& frame = slots_.frame();
        const SeaMoment moment = weather_.moment_at(time_s);
        frame.time_s = time_s;
        frame.sea = weather_.sea_at(moment);
        frame.figures = weather_.figures_at(moment);
        frame.isa = isa_;
        for (std::size_t tile = 0; tile < sources_.size(); ++tile)
            sources_[tile]->begin(Pass::frame, moment, slots_.tile(tile));
        if (foam_) plan_ticks(time_s);
    }
    /// How many ticks are still to be remembered before the frame is computed.
    int ticks_due() const { return ticks_due_; }
    /// When the first of them is.
    double next_tick_s() const { return clock().time_s(frame_tick_.number - ticks_due_ + 1); }
    /// The next run of the tick's stages is that one. \pre its moment's seas are at hand
    void begin_tick() {
        const DefaultFloatEnvironment environment;
        const std::int64_t number = frame_tick_.number - --ticks_due_;
        const SeaMoment moment = moment_at_tick(number);
        const SeaFigures figures = weather_.figures_at(moment);
        foam_->advance();
        for (std::size_t tile = 0; tile < sources_.size(); ++tile) {
            Tile& at_tick = foam_->tile(tile);
            sources_[tile]->begin(Pass::tick, moment, at_tick);
            const DriftTexels drift = drift_of(figures, at_tick.lattice, resolution(), clock(), number);
            foam_->set_drift(tile, drift.x, drift.z);
        }
        newest_tick_ = number;
        if (ticks_due_ == 0) show_foam();
    }
    const Frame& end_frame() {
        if (std::exchange(ticks_mix_weathers_, false)) forget();
        slots_.finish_textures();
        Frame& frame = slots_.frame();
        frame.bounds = {};
        for (std::size_t tile = 0; tile < sources_.size(); ++tile) {
            const FrameBounds bounds = slots_.tile(tile).bounds = sources_[tile]->end_frame();
            frame.bounds.height_min_m += bounds.height_min_m;
            frame.bounds.height_max_m += bounds.height_max_m;
            frame.bounds.sideways_x_max_m += bounds.sideways_x_max_m;
            frame.bounds.sideways_z_max_m += bounds.sideways_z_max_m;
        }
        return frame;
    }
    void drop_frame() { slots_.turn(); }
    /// Whatever was being remembered may be half of it.
    void forget() { newest_tick_.reset(); }
    /// What the next change, or the one that is forgotten for it, says of the past may be another past than the foam's.
    void keep_foam_of(const SeaChange& next) {
        ticks_mix_weathers_ = ticks_due_ > 0;  // of a frame in flight
        if (!newest_tick_) return;
        const double oldest_s = clock().time_s(*newest_tick_ - foam_->warm_up_ticks());
        if (clock().time_s(*newest_tick_) > next.from_s || oldest_s < weather_.end_of_forgotten_by_next()) forget();
    }

    std::vector<std::uint8_t> saved_history() const {
        if (!foam_ || !newest_tick_) return {};
        std::vector<std::uint8_t> saved(sizeof *newest_tick_ + foam_->saved_bytes());
        std::memcpy(saved.data(), &*newest_tick_, sizeof *newest_tick_);
        foam_->save(std::span(saved).subspan(sizeof *newest_tick_));
        return saved;
    }
    void restore_history(std::span<const std::uint8_t> saved) {
        if (saved.empty()) return forget();
        const std::size_t needed = foam_ ? sizeof *newest_tick_ + foam_->saved_bytes() : 0;
        if (saved.size() != needed)
            throw std::invalid_argument(
                refusal("history", number_text(saved.size()) + " bytes", "none or " + number_text(needed)));
        std::int64_t number;
        std::memcpy(&number, saved.data(), sizeof number);
        if (number < -most_ticks || number > most_ticks)
            throw std::invalid_argument(refusal("history's tick", number, "one of a clock"));
        newest_tick_ = number;
        foam_->restore(saved.subspan(sizeof *newest_tick_));
    }

    void begin_sea(std::size_t number) {
        const DefaultFloatEnvironment environment;
        weather_.begin(number, sources_);
    }
    void adopt_sea() {
        const DefaultFloatEnvironment environment;
        weather_.adopt(sources_);
    }
    void begin_other_weather(const SeaState& sea) {
        const DefaultFloatEnvironment environment;
        weather_.begin_other(sea, sources_);
    }
    void adopt_other_weather() {
        const DefaultFloatEnvironment environment;
        weather_.restart(sources_);
        forget();
    }
    void set_sea_aside() {
        for (const auto& source : sources_) source->set_aside();
    }
    void drop_sea() {
        for (const auto& source : sources_) source->drop_spectrum();
    }

    Weather& weather() { return weather_; }
    const Weather& weather() const { return weather_; }
    FrameContents contents() const { return {extras_.velocities, extras_.gradients, extras_.slopes, extras_.foam}; }
    std::size_t tile_count() const { return slots_.tile_count(); }
    int resolution() const { return slots_.resolution(); }
    std::size_t texels() const {
        return tile_count() * static_cast<std::size_t>(resolution()) * static_cast<std::size_t>(resolution());
    }
    std::size_t bytes() const {
        std::size_t bytes = slots_.bytes();
        for (const auto& source : sources_) bytes += source->bytes();
        for (const auto& surface : surfaces_) bytes += sizeof(SurfaceStages) + surface->bytes();
        if (foam_) bytes += foam_->bytes();
        return bytes;
    }

   private:
    std::unique_ptr<SeaSource> source_of(WaveModel waves, std::size_t tile) {
        if (waves == WaveModel::exp_sine) return std::make_unique<Pond>(slots_, tile, isa_, extras_);
        return std::make_unique<Cascade>(slots_, tile, kernels_for(isa_), extras_);
    }
    static std::size_t tiles_of(const SeaState& sea) { return static_cast<std::size_t>(cascades_of(sea)); }

    TickClock clock() const { return TickClock(weather_.forecast().first.loop_period_s); }

    /// The waves are those of the first loop, which are the same; the weather is that of the tick's own time.
    SeaMoment moment_at_tick(std::int64_t number) const {
        SeaMoment moment = weather_.moment_at(clock().time_s(number));
        moment.time_s = clock().time_in_loop_s(number);
        return moment;
    }

    /// Which ticks the frame of a time needs beyond those that are remembered. A sea that does not change has the same foam in
    /// every loop.
    void plan_ticks(double time_s) {
        frame_tick_ = clock().at(time_s);
        const std::int64_t all = foam_->warm_up_ticks();
        std::int64_t ahead = all;
        if (newest_tick_) {
            ahead = frame_tick_.number - *newest_tick_;
            if (weather_.forecast().changes.empty()) ahead = clock().in_loop(ahead);
        }
        ticks_due_ = static_cast<int>(ahead < 0 ? all : std::min(ahead, all));
        if (ticks_due_ == all) foam_->forget();
        if (ticks_due_ == 0) show_foam();
    }
    /// The frame finds what is remembered now.
    void show_foam() {
        const int fade = static_cast<int>(std::uint64_t{FoamTickJob::fade} * frame_tick_.part >> 32);
        for (std::size_t tile = 0; tile < slots_.tile_count(); ++tile)
            slots_.remembered_foam(tile) = {foam_->remembered(tile), fade};
    }

    Isa isa_;
    Weather weather_;
    FrameExtras extras_;
    FrameSlots slots_;
    std::vector<std::unique_ptr<SeaSource>> sources_;
    std::vector<std::unique_ptr<SurfaceStages>> surfaces_;
    FoldStages folds_;
    std::optional<FoamHistory> foam_;
    TickPlace frame_tick_;                     ///< of the frame begun last
    std::optional<std::int64_t> newest_tick_;  ///< none: nothing is remembered
    int ticks_due_ = 0;
    bool ticks_mix_weathers_ = false;
};

// The runs are last, so that they go first and wait for what is in flight.
struct Ocean::State {
    /// \pre check(forecast) is empty
    State(const Forecast& forecast, OceanOptions options)
        : executor(options.executor ? std::move(options.executor) : make_default_executor()),
          isa(choose_isa(options.isa)),
          sources(forecast, isa,
                  {.folds = options.queries,
                   .velocities = options.velocities,
                   .gradients = options.gradients,
                   .slopes = options.slopes,
                   .foam = options.foam,
                   .memory = options.memory}) {
        sources.add_frame_stages(frame_graph);
        if (options.foam) {
            sources.add_tick_stages(tick_graph);
            sources.add_frame_stages(tick_and_frame_graph, sources.add_tick_stages(tick_and_frame_graph));
        }
        sources.add_spectrum_stages(spectrum_graph);
        const bool is_small = sources.texels() <= most_texels_without_jobs;
        const std::shared_ptr<Executor> frame_executor = is_small ? make_serial_executor() : executor;
        frame_runs_ahead = frame_executor->runs_ahead();
        const auto frames = std::make_shared<std::uint64_t>();  // of both graphs that make some
        frame_run = prepare(*frame_executor, frame_graph, options.trace, "frame", frames);
        if (options.foam) {
            tick_run = prepare(*frame_executor, tick_graph, options.trace, "tick", std::make_shared<std::uint64_t>());
            tick_and_frame_run = prepare(*frame_executor, tick_and_frame_graph, options.trace, "frame", frames);
        }
        spectrum_run = prepare(*executor, spectrum_graph, options.trace, "sea", std::make_shared<std::uint64_t>());
    }

    static std::unique_ptr<GraphRun> prepare(Executor& on, const JobGraph& graph,
                                             const std::shared_ptr<TraceSink>& trace, const char* run_name,
                                             const std::shared_ptr<std::uint64_t>& runs) {
        return trace ? prepare_traced(on, graph, trace, run_name, runs) : on.prepare(graph);
    }

    /// What the run of spectra is for.
    enum class Bake {
        nothing,
        ahead,  ///< a sea of the forecast, which frames will need
        other,  ///< another weather's, until complete_sea()
        aside   ///< that one is done and waits, and the run is free
    };

    void bake(std::size_t number) {
        sources.begin_sea(number);
        try {
            spectrum_run->schedule();
        } catch (...) {
            sources.drop_sea();
            throw;
        }
    }
    void complete_bake() {
        try {
            if (bake_in_flight == Bake::ahead && !executor->runs_ahead())
                bake_blocks(std::numeric_limits<std::size_t>::max());
            else
                spectrum_run->complete();
        } catch (...) {
            sources.drop_sea();
            bake_in_flight = Bake::nothing;
            throw;
        }
    }
    /// Without other threads a frame bakes as much as it is not late for: one block, of two lines of a tile.
    void bake_blocks(std::size_t most) {
        for (; most > 0 && baking_stage < spectrum_graph.stages().size(); --most) {
            const Stage& stage = spectrum_graph.stages()[baking_stage];
            run_block(stage, baking_block);
            if (++baking_block < block_count(stage)) continue;
            baking_block = 0;
            ++baking_stage;
        }
    }
    bool is_baked_ahead() const {
        if (bake_in_flight != Bake::ahead) return false;
        return executor->runs_ahead() ? spectrum_run->is_done() : baking_stage == spectrum_graph.stages().size();
    }
    void begin_ahead(std::size_t number) {
        if (executor->runs_ahead()) {
            bake(number);
        } else {
            sources.begin_sea(number);
            baking_stage = baking_block = 0;
        }
        bake_in_flight = Bake::ahead;
    }
    /// Leaves the run free for another sea.
    void end_bake() {
        if (bake_in_flight == Bake::ahead) {
            complete_bake();
            sources.adopt_sea();
            bake_in_flight = Bake::nothing;
        } else if (bake_in_flight == Bake::other) {
            complete_bake();
            sources.set_sea_aside();
            bake_in_flight = Bake::aside;
        }
    }
    /// Puts at hand what a pass of that moment takes: a sea that is missing is baked here and now. Before begin_frame() and before
    /// each tick.
    void hold_seas(Pass pass, double time_s) {
        const SeaMoment moment = sources.weather().moment_at(time_s);
        sources.weather().need(pass, moment);
        for (const std::size_t number : {moment.before, moment.after}) {
            if (sources.weather().has(number)) continue;
            end_bake();
            if (sources.weather().has(number)) continue;
            bake(number);
            complete_bake();
            sources.adopt_sea();
        }
    }
    /// Takes what was baked ahead, if it is done. \pre no frame is in flight
    void adopt_ahead() {
        sources.weather().need_nothing();
        if (is_baked_ahead()) end_bake();
    }
    /// Begins to bake what frames around this one will take.
    void bake_ahead(double time_s) {
        if (bake_in_flight == Bake::nothing)
            if (const auto soon = sources.weather().wanted_soon(time_s)) begin_ahead(*soon);
        if (bake_in_flight == Bake::ahead && !executor->runs_ahead()) bake_blocks(1);
    }

    std::shared_ptr<Executor> executor;
    Isa isa;
    Sources sources;
    JobGraph frame_graph, tick_graph, tick_and_frame_graph, spectrum_graph;
    bool frame_runs_ahead = false;  ///< else complete() does all the work
    bool frame_in_flight = false;
    GraphRun* run_in_flight = nullptr;  ///< none: complete() has not begun a frame that needs several ticks
    Bake bake_in_flight = Bake::nothing;
    std::size_t baking_stage = 0, baking_block = 0;  ///< next of what bake_blocks() does
    const Frame* completed = nullptr;
    std::unique_ptr<GraphRun> frame_run, tick_run, tick_and_frame_run, spectrum_run;

    void begin_tick() {
        hold_seas(Pass::tick, sources.next_tick_s());
        sources.begin_tick();
    }
    /// Begins the run that makes the frame, with its last tick if it needs one.
    void begin_run() {
        const bool with_tick = sources.ticks_due() > 0;
        if (with_tick) begin_tick();
        run_in_flight = with_tick ? tick_and_frame_run.get() : frame_run.get();
        run_in_flight->schedule();
    }
    void complete_run() {
        if (!run_in_flight) {
            while (sources.ticks_due() > 1) {
                begin_tick();
                tick_run->schedule();
                tick_run->complete();
            }
            begin_run();
        }
        run_in_flight->complete();
    }
    void drop_frame() {
        sources.drop_frame();
        sources.forget();
    }
};

Ocean::Ocean(const SeaState& sea, OceanOptions options)
    : Ocean(Forecast{.first = checked(sea)}, std::move(options)) {}

Ocean::Ocean(const Forecast& forecast, OceanOptions options)
    : state_(new State(checked(forecast), std::move(options))) {
    state_->bake(0);
    state_->complete_bake();
    state_->sources.adopt_sea();
}

Ocean::~Ocean() = default;

void Ocean::schedule(double time_s, std::span<const TextureTargets> tiles) {
    assert(!state_->frame_in_flight && "complete() the frame in flight first");
    assert(std::isfinite(time_s));
    if (const std::string reason =
            tiles.empty() ? std::string() : check(tiles, tile_count(), resolution(), state_->sources.contents());
        !reason.empty())
        throw std::invalid_argument(reason);
    state_->adopt_ahead();
    state_->hold_seas(Pass::frame, time_s);
    state_->bake_ahead(time_s);
    state_->run_in_flight = nullptr;
    try {
        state_->sources.begin_frame(time_s, tiles);
        if (state_->sources.ticks_due() <= 1) state_->begin_run();
    } catch (...) {
        state_->drop_frame();
        throw;
    }
    state_->frame_in_flight = true;
}

bool Ocean::is_ready() const {
    return !state_->frame_in_flight || !state_->frame_runs_ahead || !state_->run_in_flight ||
           state_->run_in_flight->is_done();
}

const Frame& Ocean::complete() {
    assert((state_->frame_in_flight || state_->completed) && "schedule() a frame first");
    if (state_->frame_in_flight) {
        state_->frame_in_flight = false;
        try {
            state_->complete_run();
        } catch (...) {
            state_->drop_frame();
            throw;
        }
        state_->completed = &state_->sources.end_frame();
    }
    return *state_->completed;
}

const Frame& Ocean::frame_at(double time_s) {
    schedule(time_s);
    return complete();
}

FrameBounds Ocean::frame_at(double time_s, std::span<const FrameBuffers> tiles) {
    const Frame* const completed = state_->completed;
    if (const std::string reason = check(tiles, tile_count(), resolution(), state_->sources.contents());
        !reason.empty())
        throw std::invalid_argument(reason);
    const Frame& frame = frame_at(time_s);
    copy_frame(frame, tiles);
    state_->completed = completed;
    state_->sources.drop_frame();
    return frame.bounds;
}

void Ocean::schedule_sea(const SeaState& sea) {
    using Bake = State::Bake;
    assert((state_->bake_in_flight == Bake::nothing || state_->bake_in_flight == Bake::ahead) &&
           "complete_sea() first");
    checked(sea);
    if (const auto tiles = static_cast<std::size_t>(cascades_of(sea)); tiles != tile_count())
        throw std::invalid_argument(
            refusal("cascades", tiles, number_text(tile_count()) + ", as the ocean was built"));
    if (resolution_of(sea) != resolution())
        throw std::invalid_argument(
            refusal("resolution", resolution_of(sea), number_text(resolution()) + ", as the ocean was built"));
    if ((sea.waves == WaveModel::exp_sine) != (this->sea().waves == WaveModel::exp_sine))
        throw std::invalid_argument(refusal("waves", name_of(sea.waves),
                                            std::string(name_of(this->sea().waves)) + ", as the ocean was built"));
    state_->end_bake();
    state_->sources.begin_other_weather(sea);
    try {
        state_->spectrum_run->schedule();
    } catch (...) {
        state_->sources.drop_sea();
        throw;
    }
    state_->bake_in_flight = Bake::other;
}

bool Ocean::sea_is_ready() const {
    return state_->bake_in_flight != State::Bake::other || !state_->executor->runs_ahead() ||
           state_->spectrum_run->is_done();
}

void Ocean::complete_sea() {
    using Bake = State::Bake;
    assert(!state_->frame_in_flight && "complete() the frame in flight first");
    if (state_->bake_in_flight != Bake::other && state_->bake_in_flight != Bake::aside) return;
    if (state_->bake_in_flight == Bake::aside)
        state_->sources.set_sea_aside();
    else
        state_->complete_bake();
    state_->bake_in_flight = Bake::nothing;
    state_->sources.adopt_other_weather();
}

void Ocean::schedule_sea(const SeaChange& change) {
    assert((state_->bake_in_flight == State::Bake::nothing || state_->bake_in_flight == State::Bake::ahead) &&
           "complete_sea() first");
    Weather& weather = state_->sources.weather();
    checked(weather.with(change));
    state_->end_bake();
    state_->sources.keep_foam_of(change);
    weather.add(change);
    state_->begin_ahead(weather.number_of_last());
}

std::vector<std::uint8_t> Ocean::saved_history() const {
    assert(!state_->frame_in_flight && "complete() the frame in flight first");
    return state_->sources.saved_history();
}

void Ocean::restore_history(std::span<const std::uint8_t> saved) {
    assert(!state_->frame_in_flight && "complete() the frame in flight first");
    state_->sources.restore_history(saved);
}

std::size_t Ocean::tile_count() const { return state_->sources.tile_count(); }
int Ocean::resolution() const { return state_->sources.resolution(); }
const SeaState& Ocean::sea() const { return state_->sources.weather().forecast().last(); }
const Forecast& Ocean::forecast() const { return state_->sources.weather().forecast(); }
Isa Ocean::isa() const { return state_->isa; }
const Executor& Ocean::executor() const { return *state_->executor; }
const JobGraph& Ocean::graph() const { return state_->frame_graph; }
std::size_t Ocean::memory_bytes() const { return sizeof(State) + state_->sources.bytes(); }

}  // namespace pelagic
