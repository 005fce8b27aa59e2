#include "pelagic/sim/ocean.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/message/refusal.hpp"
#include "pelagic/sim/history/foam_drift.hpp"
#include "pelagic/sim/history/foam_history.hpp"
#include "pelagic/sim/sources/cascade.hpp"
#include "pelagic/sim/spectrum/whitecaps.hpp"
#include "pelagic/sim/surface/fold_stages.hpp"
#include "pelagic/sim/surface/surface_stages.hpp"
#include "pelagic/sim/tick_clock.hpp"
#include "pelagic/sim/tile_plan.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// A frame of 64 x 64 takes 20 microseconds; sharing it among threads takes as long again. See docs/benchmarks.md.
constexpr std::size_t most_texels_without_jobs = 64 * 64;

const SeaState& checked(const SeaState& sea) {
    if (const std::string reason = check(sea); !reason.empty()) throw std::invalid_argument(reason);
    return sea;
}

}  // namespace

/// What the sources of all tiles share, and how a frame is put together from what they make.
class Ocean::Sources {
   public:
    Sources(const SeaState& sea, Isa isa, const FrameExtras& extras) : Sources(plan_tiles(sea), isa, extras) {}

    /// One tile always has gradients, several always have slopes.
    static FrameExtras completed(FrameExtras extras, std::size_t tiles) {
        extras.gradients |= tiles == 1;
        extras.slopes |= tiles > 1;
        return extras;
    }

    Sources(const std::vector<TilePlan>& plans, Isa isa, const FrameExtras& wanted)
        : isa_(isa),
          extras_(completed(wanted, plans.size())),
          slots_(plans.size(), plans.front().resolution, kernels_for(isa).lanes, extras_),
          folds_(slots_, kernels_for(isa)) {
        for (std::size_t tile = 0; tile < plans.size(); ++tile) {
            cascades_.push_back(std::make_unique<Cascade>(slots_, tile, kernels_for(isa), extras_));
            surfaces_.push_back(std::make_unique<SurfaceStages>(slots_, tile, kernels_for(isa), extras_));
        }
        if (extras_.foam) foam_.emplace(slots_, kernels_for(isa), extras_.memory);
    }

    /// \param after  those of its tick, by tile, or none
    void add_frame_stages(JobGraph& graph, std::span<const StageId> after = {}) {
        std::vector<StageId> surfaces_done;
        for (std::size_t tile = 0; tile < cascades_.size(); ++tile) {
            std::vector<StageId> waits_for;
            if (!after.empty()) waits_for = {after[tile]};
            surfaces_done.push_back(cascades_[tile]->add_stages(graph, Pass::frame, waits_for));
            surfaces_[tile]->add_to(graph, surfaces_done.back());
        }
        if (extras_.folds) folds_.add_to(graph, surfaces_done);
    }
    std::vector<StageId> add_tick_stages(JobGraph& graph) {
        std::vector<StageId> surfaces_done;
        for (const auto& cascade : cascades_) surfaces_done.push_back(cascade->add_stages(graph, Pass::tick, {}));
        return foam_->add_tick_stages(graph, surfaces_done);
    }
    void add_spectrum_stages(JobGraph& graph) {
        for (const auto& cascade : cascades_) cascade->add_spectrum_stage(graph);
    }

    void begin_frame(double time_s, std::span<const TextureTargets> targets) {
        const DefaultFloatEnvironment environment;
        slots_.turn();
        slots_.write_textures_to(targets);
        Frame& frame = slots_.frame();
        const SeaMoment moment = moment_at(time_s);
        frame.time_s = time_s;
        frame.sea = sea_;
        frame.figures = figures_;
        frame.isa = isa_;
        for (std::size_t tile = 0; tile < cascades_.size(); ++tile)
            cascades_[tile]->begin(Pass::frame, moment, slots_.tile(tile));
        if (foam_) plan_ticks(time_s);
    }
    /// How many ticks are still to be remembered before the frame is computed.
    int ticks_due() const { return ticks_due_; }
    /// The next run of the tick's stages is the first of these.
    void begin_tick() {
        const DefaultFloatEnvironment environment;
        const std::int64_t number = frame_tick_.number - --ticks_due_;
        const TickClock clock(sea_.loop_period_s);
        const SeaMoment moment = moment_at_tick(number);
        foam_->advance();
        for (std::size_t tile = 0; tile < cascades_.size(); ++tile) {
            Tile& at_tick = foam_->tile(tile);
            cascades_[tile]->begin(Pass::tick, moment, at_tick);
            const DriftTexels drift = drift_of(figures_, at_tick.lattice, resolution(), clock, number);
            foam_->set_drift(tile, drift.x, drift.z);
        }
        newest_tick_ = number;
        if (ticks_due_ == 0) show_foam();
    }
    const Frame& end_frame() {
        slots_.finish_textures();
        Frame& frame = slots_.frame();
        frame.bounds = {};
        for (std::size_t tile = 0; tile < cascades_.size(); ++tile) {
            const FrameBounds bounds = slots_.tile(tile).bounds = cascades_[tile]->end_frame();
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
        std::memcpy(&newest_tick_.emplace(), saved.data(), sizeof *newest_tick_);
        foam_->restore(saved.subspan(sizeof *newest_tick_));
    }

    void begin_sea(const SeaState& sea) {
        const DefaultFloatEnvironment environment;
        const std::vector<TilePlan> plans = plan_tiles(sea);
        const auto white =
            std::count_if(plans.begin(), plans.end(), [](const TilePlan& plan) { return plan.makes_whitecaps(); });
        const double cover = cover_of_each(whitecap_cover(sea.wind_speed_mps), static_cast<int>(white));
        for (std::size_t tile = 0; tile < plans.size(); ++tile)
            cascades_[tile]->begin_spectrum(sea, plans[tile], plans[tile].makes_whitecaps() ? cover : 0);
        baked_sea_ = sea;
    }
    void adopt_sea() {
        const DefaultFloatEnvironment environment;
        double variance = 0;
        double stokes_x = 0, stokes_z = 0;
        SlopeMoments slopes;
        for (const auto& cascade : cascades_) {
            const LineFigures added = cascade->adopt_spectrum();
            variance += added.height_variance;
            slopes += added.slopes.in_world(cascade->lattice());
            const TileLattice::Place stokes = cascade->lattice().in_world(added.stokes_x, added.stokes_z);
            stokes_x += stokes.along;
            stokes_z += stokes.across;
        }
        sea_ = baked_sea_;
        figures_.significant_wave_height_m = 4 * std::sqrt(variance);
        const WindDrift wind = wind_drift(sea_);
        figures_.foam_drift_x_mps = wind.x_mps + stokes_x;
        figures_.foam_drift_z_mps = wind.z_mps + stokes_z;
        figures_.resolved_slopes = slopes.around(sea_.wind_direction_rad);
        figures_.unresolved_slopes = unresolved_slopes(figures_.resolved_slopes, sea_.wind_speed_mps);
        figures_.roughness = roughness_of(sea_, figures_.unresolved_slopes);
        forget();
    }
    void drop_sea() {
        for (const auto& cascade : cascades_) cascade->drop_spectrum();
    }

    const SeaState& sea() const { return sea_; }
    FrameContents contents() const { return {extras_.velocities, extras_.gradients, extras_.slopes}; }
    std::size_t tile_count() const { return slots_.tile_count(); }
    int resolution() const { return slots_.resolution(); }
    std::size_t texels() const {
        return tile_count() * static_cast<std::size_t>(resolution()) * static_cast<std::size_t>(resolution());
    }
    std::size_t bytes() const {
        std::size_t bytes = slots_.bytes();
        for (const auto& cascade : cascades_) bytes += sizeof(Cascade) + cascade->bytes();
        for (const auto& surface : surfaces_) bytes += sizeof(SurfaceStages) + surface->bytes();
        if (foam_) bytes += foam_->bytes();
        return bytes;
    }

   private:
    /// What the sea is at a time, of frames and of ticks.
    SeaMoment moment_at(double time_s) const { return {.time_s = time_s}; }
    SeaMoment moment_at_tick(std::int64_t number) const {
        return {.time_s = TickClock(sea_.loop_period_s).time_in_loop_s(number)};
    }

    /// Which ticks the frame of a time needs beyond those that are remembered. A sea that does not change has the same foam in
    /// every loop.
    void plan_ticks(double time_s) {
        const TickClock clock(sea_.loop_period_s);
        frame_tick_ = clock.at(time_s);
        const int all = foam_->warm_up_ticks();
        ticks_due_ = newest_tick_ ? std::min(clock.in_loop(frame_tick_.number - *newest_tick_), all) : all;
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
    FrameExtras extras_;
    FrameSlots slots_;
    std::vector<std::unique_ptr<Cascade>> cascades_;
    std::vector<std::unique_ptr<SurfaceStages>> surfaces_;
    FoldStages folds_;
    std::optional<FoamHistory> foam_;
    TickPlace frame_tick_;                     ///< of the frame begun last
    std::optional<std::int64_t> newest_tick_;  ///< none: nothing is remembered
    int ticks_due_ = 0;
    SeaState sea_, baked_sea_;
    SeaFigures figures_;
};

// The runs are last, so that they go first and wait for what is in flight.
struct Ocean::State {
    State(const SeaState& sea, OceanOptions options)
        : executor(options.executor ? std::move(options.executor) : make_default_executor()),
          isa(choose_isa(options.isa)),
          sources(checked(sea), isa,
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
        frame_run = prepare(*frame_executor, frame_graph, options.trace, "frame");
        if (options.foam) {
            tick_run = prepare(*frame_executor, tick_graph, options.trace, "tick");
            tick_and_frame_run = prepare(*frame_executor, tick_and_frame_graph, options.trace, "frame");
        }
        spectrum_run = prepare(*executor, spectrum_graph, options.trace, "sea");
    }

    static std::unique_ptr<GraphRun> prepare(Executor& on, const JobGraph& graph,
                                             const std::shared_ptr<TraceSink>& trace, const char* run_name) {
        return trace ? prepare_traced(on, graph, trace, run_name) : on.prepare(graph);
    }

    std::shared_ptr<Executor> executor;
    Isa isa;
    Sources sources;
    JobGraph frame_graph, tick_graph, tick_and_frame_graph, spectrum_graph;
    bool frame_runs_ahead = false;  ///< else complete() does all the work
    bool frame_in_flight = false;
    GraphRun* run_in_flight = nullptr;  ///< none: complete() has not begun a frame that needs several ticks
    bool sea_in_flight = false;
    const Frame* completed = nullptr;
    std::unique_ptr<GraphRun> frame_run, tick_run, tick_and_frame_run, spectrum_run;

    /// Begins the run that makes the frame, with its last tick if it needs one.
    void begin_run() {
        const bool with_tick = sources.ticks_due() > 0;
        if (with_tick) sources.begin_tick();
        run_in_flight = with_tick ? tick_and_frame_run.get() : frame_run.get();
        run_in_flight->schedule();
    }
    void complete_run() {
        if (!run_in_flight) {
            while (sources.ticks_due() > 1) {
                sources.begin_tick();
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

Ocean::Ocean(const SeaState& sea, OceanOptions options) : state_(new State(checked(sea), std::move(options))) {
    schedule_sea(sea);
    complete_sea();
}

Ocean::~Ocean() = default;

void Ocean::schedule(double time_s, std::span<const TextureTargets> tiles) {
    assert(!state_->frame_in_flight && "complete() the frame in flight first");
    assert(std::isfinite(time_s));
    if (const std::string reason =
            tiles.empty() ? std::string() : check(tiles, tile_count(), resolution(), state_->sources.contents());
        !reason.empty())
        throw std::invalid_argument(reason);
    state_->sources.begin_frame(time_s, tiles);
    state_->run_in_flight = nullptr;
    try {
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
    assert(!state_->sea_in_flight && "complete_sea() first");
    const std::vector<TilePlan> plans = plan_tiles(checked(sea));
    if (plans.size() != tile_count())
        throw std::invalid_argument(
            refusal("cascades", plans.size(), number_text(tile_count()) + ", as the ocean was built"));
    if (plans.front().resolution != resolution())
        throw std::invalid_argument(
            refusal("resolution", plans.front().resolution, number_text(resolution()) + ", as the ocean was built"));
    state_->sources.begin_sea(sea);
    try {
        state_->spectrum_run->schedule();
    } catch (...) {
        state_->sources.drop_sea();
        throw;
    }
    state_->sea_in_flight = true;
}

bool Ocean::sea_is_ready() const { return !state_->executor->runs_ahead() || state_->spectrum_run->is_done(); }

void Ocean::complete_sea() {
    assert(!state_->frame_in_flight && "complete() the frame in flight first");
    if (!state_->sea_in_flight) return;
    state_->sea_in_flight = false;
    try {
        state_->spectrum_run->complete();
    } catch (...) {
        state_->sources.drop_sea();
        throw;
    }
    state_->sources.adopt_sea();
}

std::vector<std::uint8_t> Ocean::saved_history() const { return state_->sources.saved_history(); }

void Ocean::restore_history(std::span<const std::uint8_t> saved) {
    assert(!state_->frame_in_flight && "complete() the frame in flight first");
    state_->sources.restore_history(saved);
}

std::size_t Ocean::tile_count() const { return state_->sources.tile_count(); }
int Ocean::resolution() const { return state_->sources.resolution(); }
const SeaState& Ocean::sea() const { return state_->sources.sea(); }
Isa Ocean::isa() const { return state_->isa; }
const Executor& Ocean::executor() const { return *state_->executor; }
const JobGraph& Ocean::graph() const { return state_->frame_graph; }
std::size_t Ocean::memory_bytes() const { return sizeof(State) + state_->sources.bytes(); }

}  // namespace pelagic
