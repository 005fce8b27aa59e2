#include "pelagic/sim/ocean.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/frames/frame_assembly.hpp"
#include "pelagic/sim/frames/frame_parts.hpp"
#include "pelagic/sim/frames/spectrum_baker.hpp"

namespace pelagic {
namespace {

// A frame of 64 x 64 takes 20 microseconds, and distributing it to threads takes as long again. See
// docs/performance.md.
constexpr std::size_t max_texels_without_jobs = 64 * 64;

}  // namespace

// The runs are last, so that they are destroyed first and wait for work in flight.
struct Ocean::State {
    /// \pre check(forecast) and check_parts() are empty
    State(const Forecast& forecast, OceanOptions options)
        : executor(options.executor ? std::move(options.executor) : make_default_executor()),
          isa(choose_isa(options.isa)),
          frames(forecast, isa, contents_of(options, forecast.first), options.memory),
          commanded(add_parts(frames, forecast, options, executor, isa)),
          baker(frames.weather(), frames.sources(), executor, options.trace) {
        const bool is_small = frames.texels() <= max_texels_without_jobs;
        const std::shared_ptr<Executor> frame_executor = is_small ? make_serial_executor() : executor;
        frame_runs_ahead = frame_executor->runs_ahead();
        // shared by both graphs of frames
        const auto frame_numbers = std::make_shared<std::uint64_t>();
        frames.add_frame_stages(frame_graph);
        frame_run = prepare_traced(*frame_executor, frame_graph, options.trace, "frame", frame_numbers);
        if (!frames.has_ticks()) return;
        frames.add_tick_stages(tick_graph);
        tick_run = prepare_traced(*frame_executor, tick_graph, options.trace, "tick");
        frames.add_frame_stages(tick_and_frame_graph, frames.add_tick_stages(tick_and_frame_graph));
        tick_and_frame_run =
            prepare_traced(*frame_executor, tick_and_frame_graph, options.trace, "frame", frame_numbers);
    }

    std::shared_ptr<Executor> executor;
    Isa isa;
    FrameAssembly frames;
    CommandedParts commanded;
    SpectrumBaker baker;
    JobGraph frame_graph, tick_graph, tick_and_frame_graph;
    bool frame_runs_ahead = false;  ///< false: complete() does all the work
    bool frame_in_flight = false;
    /// Time of the frame scheduled last, except to buffers of the application.
    double now_s = -std::numeric_limits<double>::infinity();
    /// Null if complete() starts the run: for a frame that needs several ticks, and in frame_at().
    GraphRun* run_in_flight = nullptr;
    const Frame* completed = nullptr;
    std::unique_ptr<GraphRun> frame_run, tick_run, tick_and_frame_run;
    WaterFrame water_frame;  ///< of frames scheduled from now on

    void need_no_frame_in_flight() const {
        if (frame_in_flight) throw std::logic_error("a frame is in flight; call complete() first");
    }
    void need_no_other_sea() const {
        if (baker.has_other()) throw std::logic_error("a sea is being computed; call complete_sea() first");
    }
    void require_changeable_sea() const {
        for (const auto& part : frames.parts())
            if (const char* const name = part->fixes_sea())
                throw std::invalid_argument("the sea of an ocean with a " + std::string(name) + " cannot change");
    }
    DynamicWaves& needed_dynamic_waves() {
        if (!commanded.dynamic_waves)
            throw std::invalid_argument(
                "the ocean has no dynamic waves: it was created without OceanOptions::dynamic_waves");
        return *commanded.dynamic_waves;
    }
    SprayPart& needed_spray() {
        if (!commanded.spray)
            throw std::invalid_argument("the ocean has no spray: it was created without OceanOptions::spray");
        return *commanded.spray;
    }
    SprayPart& needed_spray_between_frames() {
        SprayPart& spray = needed_spray();
        need_no_frame_in_flight();
        return spray;
    }

    void move_water(const WaterFrame& water) {
        water_frame = water;
        for (const auto& part : frames.parts()) part->set_water_frame(water);
    }

    void begin_tick() {
        baker.ensure_resident(Pass::tick, frames.next_tick()->time_s);
        frames.begin_tick();
    }
    /// Returns the run that computes the frame, with its last tick if it needs one.
    GraphRun& prepared_run() {
        if (!frames.next_tick()) return *frame_run;
        begin_tick();
        return *tick_and_frame_run;
    }
    void complete_run() {
        if (run_in_flight) return run_in_flight->complete();
        while (frames.has_tick_after_next()) {
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
        baker.begin_frame(time_s);
        run_in_flight = nullptr;
        frames.swap_buffers();
        try {
            frames.begin_frame(time_s, water_frame, cascades);
            if (is_ahead && !frames.has_tick_after_next()) {
                run_in_flight = &prepared_run();
                run_in_flight->schedule();
            }
        } catch (...) {
            lose_frame();
            throw;
        }
        frame_in_flight = true;
        now_s = time_s;
    }
    /// Discards a frame that failed. \pre swap_buffers() for this frame
    void lose_frame() {
        frames.drop_frame();
        forget();
    }
    void forget() {
        for (const auto& part : frames.parts()) part->forget();
    }
};

Ocean::Ocean(const SeaState& sea, OceanOptions options)
    : Ocean(Forecast{.first = checked(sea)}, std::move(options)) {}

Ocean::Ocean(const Forecast& forecast, OceanOptions options) {
    checked(forecast);
    require(check_parts(forecast, options));
    state_.reset(new State(forecast, std::move(options)));
}

Ocean::~Ocean() = default;

void Ocean::schedule(double time_s, std::span<const TextureTargets> cascades) {
    require(cascades.empty() ? std::string() : check(cascades, cascade_count(), resolution(), contents()));
    state_->begin_frame(time_s, cascades, true);
}

bool Ocean::is_ready() const {
    if (!state_->frame_in_flight) return true;
    if (!state_->frames.is_done()) return false;
    return !state_->frame_runs_ahead || !state_->run_in_flight || state_->run_in_flight->is_done();
}

const Frame& Ocean::complete() {
    if (!state_->frame_in_flight && !state_->completed)
        throw std::logic_error("there is no frame; call schedule() first");
    if (state_->frame_in_flight) {
        state_->frame_in_flight = false;
        try {
            state_->complete_run();
            state_->completed = &state_->frames.end_frame();
        } catch (...) {
            state_->lose_frame();
            throw;
        }
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
    require(check(cascades, cascade_count(), resolution(), contents()));
    state_->begin_frame(time_s, {}, false);
    state_->now_s = now_s;
    const Frame& frame = complete();
    copy_frame(frame, cascades);
    state_->completed = completed;
    state_->frames.drop_frame();
    return frame.bounds;
}

void Ocean::schedule_sea(const SeaState& sea) {
    state_->need_no_other_sea();
    state_->require_changeable_sea();
    checked(sea);
    if (const auto cascades = static_cast<std::size_t>(cascades_of(sea)); cascades != cascade_count())
        throw std::invalid_argument(
            invalid_value_message("cascades", cascades, number_text(cascade_count()) + ", as the ocean was built"));
    if (resolution_of(sea) != resolution())
        throw std::invalid_argument(invalid_value_message("resolution", resolution_of(sea),
                                                          number_text(resolution()) + ", as the ocean was built"));
    if (sea.waves != this->sea().waves && (is_of_fixed_model(sea) || is_of_fixed_model(this->sea())))
        throw std::invalid_argument(invalid_value_message(
            "waves", name_of(sea.waves), std::string(name_of(this->sea().waves)) + ", as the ocean was built"));
    state_->baker.begin_other(sea);
}

bool Ocean::sea_is_ready() const { return state_->baker.is_other_done(); }

void Ocean::complete_sea() {
    state_->need_no_frame_in_flight();
    if (!state_->baker.has_other()) return;
    state_->baker.complete_other();
    state_->forget();
}

void Ocean::schedule_sea(const SeaChange& asked) {
    state_->need_no_other_sea();
    state_->require_changeable_sea();
    const Weather& weather = state_->frames.weather();
    checked(weather.with(asked));
    SeaChange change = asked;
    if (change.from_s < state_->now_s) {
        change.from_s = state_->now_s;
        checked(weather.with(change));
    }
    state_->baker.finish();
    for (const auto& part : state_->frames.parts()) part->before_change(change);
    state_->baker.add(change);
}

void Ocean::set_water_frame(const WaterFrame& water) {
    require(check(water));
    const bool is_lifted = water.sea_level_m != 0, flows = water.current_x_mps != 0 || water.current_z_mps != 0;
    const char* const moved = is_lifted ? "sea_level_m" : "current_x_mps and current_z_mps";
    for (const auto& part : state_->frames.parts())
        if (const char* const name = part->fixes_sea(); name && (is_lifted || flows))
            throw std::invalid_argument("WaterFrame::" + std::string(moved) +
                                        " cannot be combined with OceanOptions::" + name);
    WaterFrame frame = water;
    frame.origin_x_m = water_frame().origin_x_m;
    frame.origin_z_m = water_frame().origin_z_m;
    state_->move_water(frame);
}
void Ocean::set_origin(double x_m, double z_m) {
    WaterFrame frame = water_frame();
    frame.origin_x_m = x_m;
    frame.origin_z_m = z_m;
    require(check(frame));
    state_->move_water(frame);
}
const WaterFrame& Ocean::water_frame() const { return state_->water_frame; }

DynamicWaves& Ocean::dynamic_waves() { return state_->needed_dynamic_waves(); }
const DynamicWaves& Ocean::dynamic_waves() const { return state_->needed_dynamic_waves(); }

void Ocean::set_spray_center(double x_m, double z_m) { state_->needed_spray().set_center(x_m, z_m); }
void Ocean::emit(std::span<const SprayEmitter> emitters) { state_->needed_spray().emit(emitters); }
std::vector<std::uint8_t> Ocean::save_spray() const { return state_->needed_spray_between_frames().save_state(); }
void Ocean::restore_spray(std::span<const std::uint8_t> saved) {
    state_->needed_spray_between_frames().restore_state(saved);
}

const FrameContents& Ocean::contents() const { return state_->frames.contents(); }
std::size_t Ocean::cascade_count() const { return state_->frames.cascade_count(); }
int Ocean::resolution() const { return state_->frames.resolution(); }
const SeaState& Ocean::sea() const { return state_->frames.weather().forecast().last(); }
const Forecast& Ocean::forecast() const { return state_->frames.weather().forecast(); }
Isa Ocean::isa() const { return state_->isa; }
const Executor& Ocean::executor() const { return *state_->executor; }
const JobGraph& Ocean::graph() const { return state_->frame_graph; }
std::size_t Ocean::memory_bytes() const { return sizeof(State) + state_->frames.bytes(); }

}  // namespace pelagic
