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
#include "pelagic/sim/sources/pond.hpp"
#include "pelagic/sim/spectrum/whitecaps.hpp"
#include "pelagic/sim/surface/fold_stages.hpp"
#include "pelagic/sim/surface/surface_stages.hpp"
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
    Sources(const SeaState& sea, Isa isa, const FrameExtras& extras)
        : Sources(plan_tiles(sea), sea.waves, isa, extras) {}

    /// One tile always has gradients, several always have slopes.
    static FrameExtras completed(FrameExtras extras, std::size_t tiles) {
        extras.gradients |= tiles == 1;
        extras.slopes |= tiles > 1;
        return extras;
    }

    Sources(const std::vector<TilePlan>& plans, WaveModel waves, Isa isa, const FrameExtras& wanted)
        : isa_(isa),
          extras_(completed(wanted, plans.size())),
          slots_(plans.size(), plans.front().resolution, kernels_for(isa).lanes, extras_),
          folds_(slots_, kernels_for(isa)) {
        for (std::size_t tile = 0; tile < plans.size(); ++tile) {
            cascades_.push_back(source_of(waves, tile));
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

    void begin_sea(const SeaState& sea) {
        const DefaultFloatEnvironment environment;
        const std::vector<TilePlan> plans = plan_tiles(sea);
        const auto white =
            std::count_if(plans.begin(), plans.end(), [](const TilePlan& plan) { return plan.makes_whitecaps(); });
        const double cover = cover_of_each(whitecap_cover(sea), static_cast<int>(white));
        for (std::size_t tile = 0; tile < plans.size(); ++tile)
            cascades_[tile]->begin_spectrum(sea, plans[tile], plans[tile].makes_whitecaps() ? cover : 0);
        baked_sea_ = sea;
        baked_whitecap_depth_ = quantile_of_sum(whitecap_cover(sea), static_cast<int>(white));
    }
    void adopt_sea() {
        const DefaultFloatEnvironment environment;
        double variance = 0;
        SlopeMoments slopes;
        for (const auto& cascade : cascades_) {
            const LineFigures added = cascade->adopt_spectrum();
            variance += added.height_variance;
            slopes += added.slopes.in_world(cascade->lattice());
        }
        sea_ = baked_sea_;
        figures_.significant_wave_height_m = 4 * std::sqrt(variance);
        figures_.resolved_slopes = slopes.around(sea_.wind_direction_rad);
        figures_.unresolved_slopes = slopes_left(sea_, figures_.resolved_slopes);
        figures_.whitecap_depth_of_sum = baked_whitecap_depth_;
        figures_.roughness = roughness_of(sea_, figures_.unresolved_slopes);
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
        for (const auto& cascade : cascades_) bytes += cascade->bytes();
        for (const auto& surface : surfaces_) bytes += sizeof(SurfaceStages) + surface->bytes();
        return bytes;
    }

   private:
    std::unique_ptr<SeaSource> source_of(WaveModel waves, std::size_t tile) {
        if (waves == WaveModel::exp_sine) return std::make_unique<Pond>(slots_, tile, isa_, extras_);
        return std::make_unique<Cascade>(slots_, tile, kernels_for(isa_), extras_);
    }

    /// What the sea is at a time, of frames and of ticks.
    SeaMoment moment_at(double time_s) const { return {.time_s = time_s}; }

    Isa isa_;
    FrameExtras extras_;
    FrameSlots slots_;
    std::vector<std::unique_ptr<SeaSource>> cascades_;
    std::vector<std::unique_ptr<SurfaceStages>> surfaces_;
    FoldStages folds_;
    SeaState sea_, baked_sea_;
    double baked_whitecap_depth_ = 1;
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

    std::shared_ptr<Executor> executor;
    Isa isa;
    Sources sources;
    JobGraph frame_graph, spectrum_graph;
    bool frame_runs_ahead = false;  ///< else complete() does all the work
    bool frame_in_flight = false;
    bool sea_in_flight = false;
    bool has_sea = false;
    const Frame* completed = nullptr;
    std::unique_ptr<GraphRun> frame_run, spectrum_run;
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
    try {
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
    assert(!state_->sea_in_flight && "complete_sea() first");
    const std::vector<TilePlan> plans = plan_tiles(checked(sea));
    if (plans.size() != tile_count())
        throw std::invalid_argument(
            refusal("cascades", plans.size(), number_text(tile_count()) + ", as the ocean was built"));
    if (plans.front().resolution != resolution())
        throw std::invalid_argument(
            refusal("resolution", plans.front().resolution, number_text(resolution()) + ", as the ocean was built"));
    if ((sea.waves == WaveModel::exp_sine) != (this->sea().waves == WaveModel::exp_sine) && state_->has_sea)
        throw std::invalid_argument(refusal("waves", name_of(sea.waves),
                                            std::string(name_of(this->sea().waves)) + ", as the ocean was built"));
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
    state_->has_sea = true;
}

std::size_t Ocean::tile_count() const { return state_->sources.tile_count(); }
int Ocean::resolution() const { return state_->sources.resolution(); }
const SeaState& Ocean::sea() const { return state_->sources.sea(); }
Isa Ocean::isa() const { return state_->isa; }
const Executor& Ocean::executor() const { return *state_->executor; }
const JobGraph& Ocean::graph() const { return state_->frame_graph; }
std::size_t Ocean::memory_bytes() const { return sizeof(State) + state_->sources.bytes(); }

}  // namespace pelagic
