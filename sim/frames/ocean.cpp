#include "pelagic/sim/ocean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/frames/frame_assembly.hpp"
#include "pelagic/sim/shore/shore_source.hpp"

namespace pelagic {
namespace {

// A frame of 64 x 64 takes 20 microseconds, and distributing it to threads takes as long again. See
// docs/performance.md.
constexpr std::size_t max_texels_without_jobs = 64 * 64;

constexpr const char *frame_is_in_flight = "a frame is in flight; call complete() first",
                     *sea_is_computed = "a sea is being computed; call complete_sea() first";

/// Returns an empty string, or which option needs planes that are off.
std::string check_planes(const OceanOptions& options) {
    if (options.planes) return {};
    struct Option {
        const char* name;
        bool is_on;
    };
    for (const Option& option : {Option{"queries", options.queries},
                                 {"velocities", options.velocities},
                                 {"dynamic_waves", options.dynamic_waves.has_value()},
                                 {"shore", options.shore.has_value()},
                                 {"inputs", !options.inputs.empty()}})
        if (option.is_on) return std::string(option.name) + " cannot be combined with an ocean without planes";
    return {};
}

}  // namespace

// The runs are last, so that they are destroyed first and wait for work in flight.
struct Ocean::State {
    /// \pre check(forecast) is empty
    State(const Forecast& forecast, OceanOptions options)
        : executor(options.executor ? std::move(options.executor) : make_default_executor()),
          isa(choose_isa(options.isa)),
          frames(forecast, isa,
                 {.folds = options.queries,
                  .velocities = options.velocities,
                  .gradients = options.gradients,
                  .slopes = options.slopes,
                  .foam = options.foam,
                  .planes = options.planes,
                  .memory = options.memory},
                 std::move(options.inputs)) {
        frames.add_frame_stages(frame_graph);
        if (options.foam) {
            frames.add_tick_stages(tick_graph);
            frames.add_frame_stages(tick_and_frame_graph, frames.add_tick_stages(tick_and_frame_graph));
        }
        if (options.shore) {
            shore = std::make_unique<ShoreSource>(*options.shore, forecast.first, plan_cascades(forecast),
                                                  kernels_for(isa), options.memory);
            shore->add_frame_stage(frame_graph);
            if (options.foam) shore->add_frame_stage(tick_and_frame_graph);
        }
        frames.add_spectrum_stages(spectrum_graph);
        const bool is_small = frames.texels() <= max_texels_without_jobs;
        const std::shared_ptr<Executor> frame_executor = is_small ? make_serial_executor() : executor;
        frame_runs_ahead = frame_executor->runs_ahead();
        // shared by both graphs of frames
        const auto frame_numbers = std::make_shared<std::uint64_t>();
        frame_run = prepare(*frame_executor, frame_graph, options.trace, "frame", frame_numbers);
        if (options.foam) {
            tick_run = prepare(*frame_executor, tick_graph, options.trace, "tick", std::make_shared<std::uint64_t>());
            tick_and_frame_run =
                prepare(*frame_executor, tick_and_frame_graph, options.trace, "frame", frame_numbers);
        }
        spectrum_run = prepare(*executor, spectrum_graph, options.trace, "sea", std::make_shared<std::uint64_t>());
        if (options.dynamic_waves)
            dynamic_waves = std::make_unique<DynamicWaves>(
                *options.dynamic_waves,
                DynamicWaves::Resources{
                    .executor = executor, .isa = isa, .trace = options.trace, .memory = options.memory});
        if (dynamic_waves) dynamic_waves->has_ocean_ = true;
    }

    static std::unique_ptr<GraphRun> prepare(Executor& on, const JobGraph& graph,
                                             const std::shared_ptr<TraceSink>& trace, const char* run_name,
                                             const std::shared_ptr<std::uint64_t>& runs) {
        return trace ? prepare_traced(on, graph, trace, run_name, runs) : on.prepare(graph);
    }

    /// Purpose of the run of spectra.
    enum class Bake {
        nothing,
        ahead,  ///< a sea of the forecast, for later frames
        other,  ///< the sea of schedule_sea(), until complete_sea()
        staged  ///< that sea is complete and stored, and the run is free
    };

    void bake(std::size_t number) {
        frames.begin_sea(number);
        try {
            spectrum_run->schedule();
        } catch (...) {
            frames.drop_sea();
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
            frames.drop_sea();
            bake_in_flight = Bake::nothing;
            throw;
        }
    }
    /// Computes blocks of the spectrum on this thread, each two lines of a cascade. Without other
    /// threads a frame computes one block, so that it is not late.
    void bake_blocks(std::size_t max) {
        for (; max > 0 && baking_stage < spectrum_graph.stages().size(); --max) {
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
            frames.begin_sea(number);
            baking_stage = baking_block = 0;
        }
        bake_in_flight = Bake::ahead;
    }
    /// Completes the run of spectra, so that it is free for another sea.
    void end_bake() {
        if (bake_in_flight == Bake::ahead) {
            complete_bake();
            frames.adopt_sea();
            bake_in_flight = Bake::nothing;
        } else if (bake_in_flight == Bake::other) {
            complete_bake();
            frames.stage_sea();
            bake_in_flight = Bake::staged;
        }
    }
    /// Makes the seas of a moment resident for a pass, and computes a missing one immediately.
    /// Called before begin_frame() and before each tick.
    void ensure_resident(Pass pass, double time_s) {
        const SeaMoment moment = frames.weather().moment_at(time_s);
        frames.weather().need(pass, moment);
        for (const std::size_t number : {moment.before, moment.after}) {
            if (frames.weather().has(number)) continue;
            end_bake();
            if (frames.weather().has(number)) continue;
            bake(number);
            complete_bake();
            frames.adopt_sea();
        }
    }
    /// Adopts the sea that was computed ahead, if it is complete. \pre no frame is in flight
    void adopt_ahead() {
        frames.weather().need_nothing();
        if (is_baked_ahead()) end_bake();
    }
    /// Starts to compute the seas that frames near this time will need.
    void bake_ahead(double time_s) {
        if (bake_in_flight == Bake::nothing)
            if (const auto soon = frames.weather().wanted_soon(time_s)) begin_ahead(*soon);
        if (bake_in_flight == Bake::ahead && !executor->runs_ahead()) bake_blocks(1);
    }

    std::shared_ptr<Executor> executor;
    Isa isa;
    FrameAssembly frames;
    std::unique_ptr<ShoreSource> shore;  ///< null without a shore
    JobGraph frame_graph, tick_graph, tick_and_frame_graph, spectrum_graph;
    bool frame_runs_ahead = false;  ///< false: complete() does all the work
    bool frame_in_flight = false;
    /// Time of the frame scheduled last, except to buffers of the application.
    double now_s = -std::numeric_limits<double>::infinity();
    /// Null if complete() starts the run: for a frame that needs several ticks, and in frame_at().
    GraphRun* run_in_flight = nullptr;
    Bake bake_in_flight = Bake::nothing;
    std::size_t baking_stage = 0, baking_block = 0;  ///< next block of bake_blocks()
    const Frame* completed = nullptr;
    std::unique_ptr<GraphRun> frame_run, tick_run, tick_and_frame_run, spectrum_run;
    std::unique_ptr<DynamicWaves> dynamic_waves;  ///< null without dynamic waves
    WaterFrame water_frame;                       ///< of frames scheduled from now on

    /// \pre the ocean has a shore
    void bake_shore() {
        JobGraph graph;
        shore->add_bake_stages(graph);
        executor->prepare(graph)->run();
        shore->end_bake();
    }
    void need_no_frame_in_flight() const {
        if (frame_in_flight) throw std::logic_error(frame_is_in_flight);
    }
    void need_no_other_sea() const {
        if (bake_in_flight == Bake::other || bake_in_flight == Bake::staged) throw std::logic_error(sea_is_computed);
    }
    void require_constant_sea() const {
        if (shore) throw std::invalid_argument("the sea of an ocean with a shore cannot change");
    }

    DynamicWaves& needed_dynamic_waves() {
        if (!dynamic_waves)
            throw std::invalid_argument(
                "the ocean has no dynamic waves: it was created without OceanOptions::dynamic_waves");
        return *dynamic_waves;
    }

    void begin_tick() {
        ensure_resident(Pass::tick, frames.next_tick_s());
        frames.begin_tick();
    }
    /// Returns the run that computes the frame, with its last tick if it needs one.
    GraphRun& prepared_run() {
        if (frames.ticks_due() == 0) return *frame_run;
        begin_tick();
        return *tick_and_frame_run;
    }
    void begin_run() {
        run_in_flight = &prepared_run();
        run_in_flight->schedule();
    }
    void complete_run() {
        if (run_in_flight) return run_in_flight->complete();
        while (frames.ticks_due() > 1) {
            begin_tick();
            tick_run->run();
        }
        prepared_run().run();
    }
    /// \param is_ahead  whether work starts before complete()
    void begin_frame(double time_s, std::span<const TextureTargets> cascades, bool is_ahead) {
        need_no_frame_in_flight();
        if (!std::isfinite(time_s))
            throw std::invalid_argument(invalid_value_message("time_s", time_s, "a finite number"));
        adopt_ahead();
        ensure_resident(Pass::frame, time_s);
        bake_ahead(time_s);
        run_in_flight = nullptr;
        turn();
        try {
            if (dynamic_waves) dynamic_waves->begin_frame(time_s);
            if (shore) shore->begin_frame(time_s);
            frames.begin_frame(time_s, cascades);
            frames.show(water_frame);
            if (is_ahead && frames.ticks_due() <= 1) begin_run();
        } catch (...) {
            drop_frame();
            throw;
        }
        frame_in_flight = true;
        now_s = time_s;
    }
    /// Swaps all of a frame's buffers, before any step that may fail; drop_frame() swaps them back.
    void turn() {
        if (dynamic_waves) dynamic_waves->turn();
        if (shore) shore->turn();
        frames.turn();
    }
    /// \pre turn() for this frame
    void drop_frame() {
        if (dynamic_waves) dynamic_waves->drop_frame();
        if (shore) shore->drop_frame();
        frames.drop_frame();
        frames.forget();
        frames.weather().need_nothing();
    }
};

Ocean::Ocean(const SeaState& sea, OceanOptions options)
    : Ocean(Forecast{.first = checked(sea)}, std::move(options)) {}

Ocean::Ocean(const Forecast& forecast, OceanOptions options) {
    checked(forecast);
    require(check_planes(options));
    if (options.shore) {
        require(check(*options.shore, forecast.first));
        if (!forecast.changes.empty())
            throw std::invalid_argument("a forecast with changes cannot be combined with a shore");
    }
    state_.reset(new State(forecast, std::move(options)));
    state_->bake(0);
    state_->complete_bake();
    state_->frames.adopt_sea();
    if (state_->shore) state_->bake_shore();
}

Ocean::~Ocean() = default;

void Ocean::schedule(double time_s, std::span<const TextureTargets> cascades) {
    require(cascades.empty() ? std::string()
                             : check(cascades, cascade_count(), resolution(), state_->frames.contents()));
    state_->begin_frame(time_s, cascades, true);
}

bool Ocean::is_ready() const {
    if (!state_->frame_in_flight) return true;
    if (state_->dynamic_waves && state_->executor->runs_ahead() && !state_->dynamic_waves->is_done()) return false;
    return !state_->frame_runs_ahead || !state_->run_in_flight || state_->run_in_flight->is_done();
}

const Frame& Ocean::complete() {
    if (!state_->frame_in_flight && !state_->completed)
        throw std::logic_error("there is no frame; call schedule() first");
    if (state_->frame_in_flight) {
        state_->frame_in_flight = false;
        try {
            state_->complete_run();
            if (state_->shore) state_->frames.show(state_->shore->end_frame());
            if (state_->dynamic_waves) {
                state_->dynamic_waves->complete_frame();
                state_->frames.show(state_->dynamic_waves->view());
            }
        } catch (...) {
            state_->drop_frame();
            throw;
        }
        state_->completed = &state_->frames.end_frame();
        state_->frames.weather().need_nothing();
    }
    return *state_->completed;
}

const Frame& Ocean::frame_at(double time_s) {
    state_->begin_frame(time_s, {}, false);
    return complete();
}

FrameBounds Ocean::frame_at(double time_s, std::span<const FrameBuffers> cascades) {
    const Frame* const completed = state_->completed;
    const double now_s = state_->now_s;
    require(check(cascades, cascade_count(), resolution(), state_->frames.contents()));
    state_->begin_frame(time_s, {}, false);
    state_->now_s = now_s;
    const Frame& frame = complete();
    copy_frame(frame, cascades);
    state_->completed = completed;
    state_->frames.drop_frame();
    if (state_->dynamic_waves) state_->dynamic_waves->drop_frame();
    if (state_->shore) state_->shore->drop_frame();
    return frame.bounds;
}

void Ocean::schedule_sea(const SeaState& sea) {
    state_->need_no_other_sea();
    state_->require_constant_sea();
    checked(sea);
    if (const auto cascades = static_cast<std::size_t>(cascades_of(sea)); cascades != cascade_count())
        throw std::invalid_argument(
            invalid_value_message("cascades", cascades, number_text(cascade_count()) + ", as the ocean was built"));
    if (resolution_of(sea) != resolution())
        throw std::invalid_argument(invalid_value_message("resolution", resolution_of(sea),
                                                          number_text(resolution()) + ", as the ocean was built"));
    if ((sea.waves == WaveModel::pond) != (this->sea().waves == WaveModel::pond))
        throw std::invalid_argument(invalid_value_message(
            "waves", name_of(sea.waves), std::string(name_of(this->sea().waves)) + ", as the ocean was built"));
    state_->end_bake();
    state_->frames.begin_other_weather(sea);
    try {
        state_->spectrum_run->schedule();
    } catch (...) {
        state_->frames.drop_sea();
        throw;
    }
    state_->bake_in_flight = State::Bake::other;
}

bool Ocean::sea_is_ready() const {
    return state_->bake_in_flight != State::Bake::other || !state_->executor->runs_ahead() ||
           state_->spectrum_run->is_done();
}

void Ocean::complete_sea() {
    using Bake = State::Bake;
    state_->need_no_frame_in_flight();
    if (state_->bake_in_flight != Bake::other && state_->bake_in_flight != Bake::staged) return;
    if (state_->bake_in_flight == Bake::staged)
        state_->frames.stage_sea();
    else
        state_->complete_bake();
    state_->bake_in_flight = Bake::nothing;
    state_->frames.adopt_other_weather();
}

void Ocean::schedule_sea(const SeaChange& asked) {
    state_->need_no_other_sea();
    state_->require_constant_sea();
    Weather& weather = state_->frames.weather();
    checked(weather.with(asked));
    SeaChange change = asked;
    if (change.from_s < state_->now_s) {
        change.from_s = state_->now_s;
        checked(weather.with(change));
    }
    state_->end_bake();
    state_->frames.keep_foam_of(change);
    weather.add(change);
    state_->begin_ahead(weather.number_of_last());
}

void Ocean::set_water_frame(const WaterFrame& water) {
    require(check(water));
    if (state_->shore && water.sea_level_m != 0)
        throw std::invalid_argument("WaterFrame::sea_level_m cannot be combined with OceanOptions::shore");
    if (state_->shore && (water.current_x_mps != 0 || water.current_z_mps != 0))
        throw std::invalid_argument(
            "WaterFrame::current_x_mps and current_z_mps cannot be combined with OceanOptions::shore");
    state_->water_frame = water;
    if (state_->dynamic_waves) state_->dynamic_waves->set_current(water.current_x_mps, water.current_z_mps);
}
const WaterFrame& Ocean::water_frame() const { return state_->water_frame; }

DynamicWaves& Ocean::dynamic_waves() { return state_->needed_dynamic_waves(); }
const DynamicWaves& Ocean::dynamic_waves() const { return state_->needed_dynamic_waves(); }

std::size_t Ocean::cascade_count() const { return state_->frames.cascade_count(); }
int Ocean::resolution() const { return state_->frames.resolution(); }
const SeaState& Ocean::sea() const { return state_->frames.weather().forecast().last(); }
const Forecast& Ocean::forecast() const { return state_->frames.weather().forecast(); }
Isa Ocean::isa() const { return state_->isa; }
const Executor& Ocean::executor() const { return *state_->executor; }
const JobGraph& Ocean::graph() const { return state_->frame_graph; }
std::size_t Ocean::memory_bytes() const {
    return sizeof(State) + state_->frames.bytes() +
           (state_->dynamic_waves ? state_->dynamic_waves->memory_bytes() : 0) +
           (state_->shore ? state_->shore->bytes() : 0);
}

}  // namespace pelagic
