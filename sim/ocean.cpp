#include "pelagic/sim/ocean.hpp"

#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "pelagic/message/refusal.hpp"
#include "pelagic/sim/sources/cascade.hpp"

namespace pelagic {
namespace {

// A frame of 64 x 64 takes 20 microseconds; sharing it among threads takes as long again. See docs/benchmarks.md.
constexpr int largest_resolution_without_jobs = 64;

const SeaState& checked(const SeaState& sea) {
    if (const std::string reason = check(sea); !reason.empty()) throw std::invalid_argument(reason);
    return sea;
}

}  // namespace

// The runs are last, so that they go first and wait for what is in flight.
struct Ocean::State {
    State(const SeaState& sea, OceanOptions options)
        : executor(options.executor ? std::move(options.executor) : make_default_executor()),
          isa(choose_isa(options.isa)),
          has_velocities(options.velocities),
          cascade(checked(sea), isa,
                  {.folds = options.queries, .velocities = options.velocities, .memory = options.memory}) {
        cascade.add_frame_stages(frame_graph);
        cascade.add_spectrum_stage(spectrum_graph);
        const bool is_small = sea.resolution <= largest_resolution_without_jobs;
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
    bool has_velocities;
    Cascade cascade;
    JobGraph frame_graph, spectrum_graph;
    bool frame_runs_ahead = false;  ///< else complete() does all the work
    bool frame_in_flight = false;
    bool sea_in_flight = false;
    const Frame* completed = nullptr;
    std::unique_ptr<GraphRun> frame_run, spectrum_run;
};

Ocean::Ocean(const SeaState& sea, OceanOptions options) : state_(new State(checked(sea), std::move(options))) {
    schedule_sea(sea);
    complete_sea();
}

Ocean::~Ocean() = default;

void Ocean::schedule(double time_s) {
    assert(!state_->frame_in_flight && "complete() the frame in flight first");
    assert(std::isfinite(time_s));
    state_->cascade.begin_frame(time_s);
    try {
        state_->frame_run->schedule();
    } catch (...) {
        state_->cascade.drop_frame();
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
            state_->cascade.drop_frame();
            throw;
        }
        state_->completed = &state_->cascade.end_frame();
    }
    return *state_->completed;
}

const Frame& Ocean::frame_at(double time_s) {
    schedule(time_s);
    return complete();
}

FrameBounds Ocean::frame_at(double time_s, const FrameBuffers& buffers) {
    const Frame* const completed = state_->completed;
    if (const std::string reason = check(buffers, sea().resolution, state_->has_velocities); !reason.empty())
        throw std::invalid_argument(reason);
    const Frame& frame = frame_at(time_s);
    copy_frame(frame, buffers);
    state_->completed = completed;
    state_->cascade.drop_frame();
    return frame.bounds;
}

void Ocean::schedule_sea(const SeaState& sea) {
    assert(!state_->sea_in_flight && "complete_sea() first");
    if (checked(sea).resolution != state_->cascade.sea().resolution)
        throw std::invalid_argument(
            refusal("resolution", sea.resolution,
                    number_text(state_->cascade.sea().resolution) + ", as the ocean was built"));
    state_->cascade.begin_spectrum(sea);
    try {
        state_->spectrum_run->schedule();
    } catch (...) {
        state_->cascade.drop_spectrum();
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
        state_->cascade.drop_spectrum();
        throw;
    }
    state_->cascade.adopt_spectrum();
}

const SeaState& Ocean::sea() const { return state_->cascade.sea(); }
Isa Ocean::isa() const { return state_->isa; }
const Executor& Ocean::executor() const { return *state_->executor; }
const JobGraph& Ocean::graph() const { return state_->frame_graph; }
std::size_t Ocean::memory_bytes() const { return sizeof(State) + state_->cascade.bytes(); }

}  // namespace pelagic
