#include "pelagic/sim/ocean.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/message/refusal.hpp"
#include "pelagic/sim/sources/cascade.hpp"
#include "pelagic/sim/sources/weather.hpp"
#include "pelagic/sim/surface/fold_stages.hpp"
#include "pelagic/sim/surface/surface_stages.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// A frame of 64 x 64 takes 20 microseconds; sharing it among threads takes as long again. See docs/benchmarks.md.
constexpr std::size_t most_texels_without_jobs = 64 * 64;

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
            cascades_.push_back(std::make_unique<Cascade>(slots_, tile, kernels_for(isa), extras_));
            surfaces_.push_back(std::make_unique<SurfaceStages>(slots_, tile, kernels_for(isa), extras_));
        }
    }

    void add_frame_stages(JobGraph& graph) {
        std::vector<StageId> surfaces_done;
        for (std::size_t tile = 0; tile < cascades_.size(); ++tile) {
            surfaces_done.push_back(cascades_[tile]->add_stages(graph, Pass::frame, {}));
            surfaces_[tile]->add_to(graph, surfaces_done.back());
        }
        if (extras_.folds) folds_.add_to(graph, surfaces_done);
    }
    void add_spectrum_stages(JobGraph& graph) {
        for (const auto& cascade : cascades_) cascade->add_spectrum_stage(graph);
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
        for (std::size_t tile = 0; tile < cascades_.size(); ++tile)
            cascades_[tile]->begin(Pass::frame, moment, slots_.tile(tile));
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

    void begin_sea(std::size_t number) {
        const DefaultFloatEnvironment environment;
        weather_.begin(number, cascades_);
    }
    void adopt_sea() {
        const DefaultFloatEnvironment environment;
        weather_.adopt(cascades_);
    }
    void begin_other_weather(const SeaState& sea) {
        const DefaultFloatEnvironment environment;
        weather_.begin_other(sea, cascades_);
    }
    void adopt_other_weather() {
        const DefaultFloatEnvironment environment;
        weather_.restart(cascades_);
    }
    void set_sea_aside() {
        for (const auto& cascade : cascades_) cascade->set_aside();
    }
    void drop_sea() {
        for (const auto& cascade : cascades_) cascade->drop_spectrum();
    }

    Weather& weather() { return weather_; }
    const Weather& weather() const { return weather_; }
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
        return bytes;
    }

   private:
    static std::size_t tiles_of(const SeaState& sea) { return static_cast<std::size_t>(cascades_of(sea)); }

    Isa isa_;
    Weather weather_;
    FrameExtras extras_;
    FrameSlots slots_;
    std::vector<std::unique_ptr<Cascade>> cascades_;
    std::vector<std::unique_ptr<SurfaceStages>> surfaces_;
    FoldStages folds_;
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
                   .memory = options.memory}) {
        sources.add_frame_stages(frame_graph);
        sources.add_spectrum_stages(spectrum_graph);
        const bool is_small = sources.texels() <= most_texels_without_jobs;
        const std::shared_ptr<Executor> frame_executor = is_small ? make_serial_executor() : executor;
        frame_runs_ahead = frame_executor->runs_ahead();
        frame_run = prepare(*frame_executor, frame_graph, options.trace, "frame");
        spectrum_run = prepare(*executor, spectrum_graph, options.trace, "sea");
    }

    static std::unique_ptr<GraphRun> prepare(Executor& on, const JobGraph& graph,
                                             const std::shared_ptr<TraceSink>& trace, const char* run_name) {
        return trace ? prepare_traced(on, graph, trace, run_name) : on.prepare(graph);
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
            spectrum_run->complete();
        } catch (...) {
            sources.drop_sea();
            bake_in_flight = Bake::nothing;
            throw;
        }
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
        if (bake_in_flight == Bake::ahead && spectrum_run->is_done()) end_bake();
        for (const std::size_t number : {moment.before, moment.after}) {
            if (sources.weather().has(number)) continue;
            end_bake();
            if (sources.weather().has(number)) continue;
            bake(number);
            complete_bake();
            sources.adopt_sea();
        }
    }
    /// Begins to bake what frames around this one will take.
    void bake_ahead(double time_s) {
        if (bake_in_flight != Bake::nothing || !executor->runs_ahead()) return;
        if (const auto soon = sources.weather().wanted_soon(time_s)) {
            bake(*soon);
            bake_in_flight = Bake::ahead;
        }
    }

    std::shared_ptr<Executor> executor;
    Isa isa;
    Sources sources;
    JobGraph frame_graph, spectrum_graph;
    bool frame_runs_ahead = false;  ///< else complete() does all the work
    bool frame_in_flight = false;
    Bake bake_in_flight = Bake::nothing;
    const Frame* completed = nullptr;
    std::unique_ptr<GraphRun> frame_run, spectrum_run;
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
    state_->hold_seas(Pass::frame, time_s);
    state_->bake_ahead(time_s);
    try {
        state_->sources.begin_frame(time_s, tiles);
        state_->frame_run->schedule();
    } catch (...) {
        state_->sources.drop_frame();
        throw;
    }
    state_->frame_in_flight = true;
}

bool Ocean::is_ready() const {
    return !state_->frame_in_flight || !state_->frame_runs_ahead || state_->frame_run->is_done();
}

const Frame& Ocean::complete() {
    assert((state_->frame_in_flight || state_->completed) && "schedule() a frame first");
    if (state_->frame_in_flight) {
        state_->frame_in_flight = false;
        try {
            state_->frame_run->complete();
        } catch (...) {
            state_->sources.drop_frame();
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
    weather.add(change);
    if (!state_->executor->runs_ahead()) return;
    state_->bake(weather.number_of_last());
    state_->bake_in_flight = State::Bake::ahead;
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
