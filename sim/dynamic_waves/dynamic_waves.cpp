// Ticks and frames of dynamic waves: waiting commands, runs of ticks, and two slots for views.
#include "pelagic/sim/dynamic_waves.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/buffers/double_buffer.hpp"
#include "pelagic/sim/buffers/height_field_buffers.hpp"
#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/dynamic_waves/grid.hpp"
#include "pelagic/sim/water_frame.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Fraction of a tick by which rounding may put a tick's time too low.
constexpr double clock_slack = 0x1p-16;
/// Beyond this, doubles cannot distinguish ticks.
constexpr double farthest_tick = 0x1p50;
constexpr double fastest_mps = 1000;  // of Disturbance
constexpr double farthest_center_m = 1e8;  // in the world

struct SavedClock {
    std::uint64_t checksum;  ///< XXH3 of all that follows
    std::uint64_t options;   ///< their digest_of()
    std::int64_t has_clock, last_tick;
    double last_time_s;
};

/// Returns the XXH3 of the options, as numbers without padding.
std::uint64_t digest_of(const DynamicWavesOptions& options) {
    const double numbers[] = {static_cast<double>(options.step),
                              static_cast<double>(options.resolution),
                              options.side_m,
                              static_cast<double>(options.ticks_per_s),
                              options.border_m,
                              options.depth_m,
                              options.viscosity_m2ps,
                              options.wave_speed_mps,
                              options.decay_per_s,
                              options.foam_height_m};
    return XXH3_64bits(numbers, sizeof numbers);
}

/// Returns the XXH3 of a saved state behind its checksum.
std::uint64_t checksum_of(std::span<const std::uint8_t> saved) {
    const std::span<const std::uint8_t> checked = saved.subspan(sizeof(SavedClock::checksum));
    return XXH3_64bits(checked.data(), checked.size());
}

}  // namespace

// The runs are last, so that they are destroyed first and wait for work in flight.
struct DynamicWaves::State {
    State(const DynamicWavesOptions& options, Resources&& resources)
        : executor(resources.executor ? std::move(resources.executor) : make_default_executor()),
          grid(options, choose_isa(resources.isa), resources.memory) {
        const auto n = static_cast<std::size_t>(options.resolution);
        for (Slot& slot : slots) slot.allocate(n * n, n, resources.memory);
        const auto add_show_stage = [&](JobGraph& graph, std::vector<StageId> waits_for) {
            graph.add({.name = "dynamic waves show",
                       .count = n / DynamicWaveGrid::rows_per_item,
                       .waits_for = std::move(waits_for),
                       .body = for_each_item([this](std::size_t item) { show_rows(item); })});
        };
        grid.add_tick_stages(tick_graph);
        add_show_stage(show_graph, {});
        add_show_stage(tick_and_show_graph, {grid.add_tick_stages(tick_and_show_graph)});
        const auto runs = std::make_shared<std::uint64_t>();
        const auto prepared = [&](const JobGraph& graph) {
            return prepare_traced(*executor, graph, resources.trace, "dynamic_waves", runs);
        };
        tick_run = prepared(tick_graph);
        show_run = prepared(show_graph);
        tick_and_show_run = prepared(tick_and_show_graph);
    }

    struct Slot : HeightFieldBuffers {
        DynamicWavesView view;  ///< empty until a frame is complete
    };
    struct Command {
        enum class Kind {
            add_impulse,
            add_source,
            set_source,
            add_footprint,
            set_footprint,
            remove_source,
            set_center,
            set_rain
        } kind;
        std::uint32_t number = 0;
        Disturbance disturbance = {};  ///< for set_center: the position
        Rain rain = {};
        std::size_t footprint = 0;  ///< index in `footprints`
    };

    void need_no_frame_in_flight() const {
        if (frame_in_flight) throw std::logic_error("a frame is in flight; call complete() first");
    }
    std::uint32_t new_source();
    void add_footprint_command(Command::Kind kind, std::uint32_t number, const PressureFootprint& footprint);

    /// Moves a disturbance or a footprint from the world to the water's frame at a time.
    template <class Source>
    void move_to_water(Source& source, double time_s) const;
    /// \param tick_s  time of the tick in which the commands act
    void apply_commands(bool time_goes_on, double tick_s);
    void begin_run(GraphRun& run);
    void complete_run();
    void show_rows(std::size_t item);
    DynamicWavesView view_of_back() const;

    std::shared_ptr<Executor> executor;
    DynamicWaveGrid grid;
    std::vector<Command> commands;  ///< since the last begin_frame()
    /// Footprints of commands: the first new_footprints since the last begin_frame(); the rest keep
    /// their memory.
    std::vector<PressureFootprint> footprints;
    std::size_t new_footprints = 0;
    std::size_t new_impulses = 0;        ///< among the commands
    std::vector<std::uint32_t> numbers;  ///< of the sources after all commands, in ascending order
    DoubleBuffer<Slot> slots;
    const DynamicWavesView* shown = &slots.back().view;  ///< of the frame completed last
    bool has_clock = false;
    WaterFrame water_frame;      ///< with current and origin
    double last_time_s = 0;      ///< of the last frame
    std::int64_t last_tick = 0;  ///< by the frames' time
    std::int64_t ticks_due = 0;
    float fraction = 0;  ///< of a tick, since the last one
    bool frame_in_flight = false;
    JobGraph tick_graph, show_graph, tick_and_show_graph;
    GraphRun* run_in_flight = nullptr;
    std::unique_ptr<GraphRun> tick_run, show_run, tick_and_show_run;
};

DynamicWaves::DynamicWaves(const DynamicWavesOptions& options, Resources resources) {
    require(check(options));
    state_ = std::make_unique<State>(options, std::move(resources));
}

DynamicWaves::~DynamicWaves() = default;

void DynamicWaves::add_impulse(const Disturbance& disturbance) {
    require(check(disturbance));
    if (state_->grid.sources().settled() + state_->new_impulses == DynamicWaveSources::max_count)
        throw std::invalid_argument(invalid_value_message("the number of impulses of a tick",
                                                          DynamicWaveSources::max_count + 1,
                                                          "at most " + number_text(DynamicWaveSources::max_count)));
    ++state_->new_impulses;
    state_->commands.push_back({State::Command::Kind::add_impulse, 0, disturbance});
}

std::uint32_t DynamicWaves::State::new_source() {
    if (numbers.size() == DynamicWaveSources::max_count)
        throw std::invalid_argument(invalid_value_message("the number of sources", DynamicWaveSources::max_count + 1,
                                                          "at most " + number_text(DynamicWaveSources::max_count)));
    numbers.push_back(grid.sources().new_number());
    return numbers.back();
}

void DynamicWaves::State::add_footprint_command(Command::Kind kind, std::uint32_t number,
                                                const PressureFootprint& footprint) {
    if (new_footprints == footprints.size()) footprints.emplace_back();
    footprints[new_footprints] = footprint;
    commands.push_back({.kind = kind, .number = number, .footprint = new_footprints++});
}

std::uint32_t DynamicWaves::add_source(const Disturbance& source) {
    require(check(source));
    const std::uint32_t number = state_->new_source();
    state_->commands.push_back({State::Command::Kind::add_source, number, source});
    return number;
}

std::uint32_t DynamicWaves::add_footprint(const PressureFootprint& footprint) {
    require(check(footprint));
    const std::uint32_t number = state_->new_source();
    state_->add_footprint_command(State::Command::Kind::add_footprint, number, footprint);
    return number;
}

void DynamicWaves::set_footprint(std::uint32_t number, const PressureFootprint& footprint) {
    require(check(footprint));
    state_->add_footprint_command(State::Command::Kind::set_footprint, number, footprint);
}

void DynamicWaves::set_source(std::uint32_t number, const Disturbance& source) {
    require(check(source));
    state_->commands.push_back({State::Command::Kind::set_source, number, source});
}

void DynamicWaves::remove_source(std::uint32_t number) {
    const auto at = std::lower_bound(state_->numbers.begin(), state_->numbers.end(), number);
    if (at == state_->numbers.end() || *at != number) return;
    state_->numbers.erase(at);
    state_->commands.push_back({State::Command::Kind::remove_source, number});
}

void DynamicWaves::set_center(double x_m, double z_m) {
    for (const double at : {x_m, z_m})
        if (!(at >= -farthest_center_m && at <= farthest_center_m))
            throw std::invalid_argument(invalid_value_message("the centre", at, "[-1e8, 1e8]"));
    state_->commands.push_back({State::Command::Kind::set_center, 0, {.x_m = x_m, .z_m = z_m}});
}

void DynamicWaves::set_current(double x_mps, double z_mps) {
    WaterFrame water = state_->water_frame;
    water.current_x_mps = x_mps;
    water.current_z_mps = z_mps;
    require(check(water));
    state_->water_frame = water;
}

void DynamicWaves::set_origin(double x_m, double z_m) {
    WaterFrame water = state_->water_frame;
    water.origin_x_m = x_m;
    water.origin_z_m = z_m;
    require(check(water));
    const double moved_x = state_->water_frame.origin_x_m - x_m, moved_z = state_->water_frame.origin_z_m - z_m;
    const auto move = [&](auto& command) {
        command.x_m += moved_x;
        command.z_m += moved_z;
    };
    for (State::Command& command : state_->commands) move(command.disturbance);
    for (std::size_t i = 0; i < state_->new_footprints; ++i) move(state_->footprints[i]);
    state_->water_frame = water;
}

void DynamicWaves::set_rain(const Rain& rain) {
    require(check(rain, options()));
    state_->commands.push_back({.kind = State::Command::Kind::set_rain, .rain = rain});
}

std::int64_t DynamicWaves::tick_at(double time_s) const {
    if (!std::isfinite(time_s))
        throw std::invalid_argument(invalid_value_message("time_s", time_s, "a finite number"));
    const double ticks = time_s * options().ticks_per_s + clock_slack;
    return static_cast<std::int64_t>(std::floor(std::clamp(ticks, -farthest_tick, farthest_tick)));
}

const DynamicWavesView& DynamicWaves::advance(double time_s) {
    if (has_ocean_) throw std::logic_error("the ocean advances these waves");
    swap_buffers();
    try {
        begin_frame(time_s);
        complete_frame();
    } catch (...) {
        drop_frame();
        throw;
    }
    return view();
}

const DynamicWavesView& DynamicWaves::view() const { return *state_->shown; }

template <class Source>
void DynamicWaves::State::move_to_water(Source& source, double time_s) const {
    const WaterFrame::Origin origin = water_frame.origin_at(time_s);
    source.x_m = std::clamp(source.x_m - origin.x_m, -farthest_position_m, farthest_position_m);
    source.z_m = std::clamp(source.z_m - origin.z_m, -farthest_position_m, farthest_position_m);
    source.velocity_x_mps = std::clamp(source.velocity_x_mps - water_frame.current_x_mps, -fastest_mps, fastest_mps);
    source.velocity_z_mps = std::clamp(source.velocity_z_mps - water_frame.current_z_mps, -fastest_mps, fastest_mps);
}

void DynamicWaves::State::apply_commands(bool time_goes_on, double tick_s) {
    DynamicWaveSources& sources = grid.sources();
    const bool is_full = sources.waiting() + new_impulses > DynamicWaveSources::max_count;
    if (new_impulses > 0 && (!time_goes_on || is_full)) sources.forget_provisional();
    for (std::size_t i = 0; i < new_footprints; ++i) move_to_water(footprints[i], tick_s);
    for (Command& command : commands) {
        Disturbance& disturbance = command.disturbance;
        move_to_water(disturbance, tick_s);
        switch (command.kind) {
            case Command::Kind::add_impulse: sources.add_impulse(disturbance); break;
            case Command::Kind::add_source: grid.set_source(command.number, disturbance); break;
            case Command::Kind::set_source:
                if (sources.has(command.number)) grid.set_source(command.number, disturbance);
                break;
            case Command::Kind::add_footprint:
                grid.set_footprint(command.number, footprints[command.footprint]);
                break;
            case Command::Kind::set_footprint:
                if (sources.has_footprint(command.number))
                    grid.set_footprint(command.number, footprints[command.footprint]);
                break;
            case Command::Kind::remove_source: sources.remove(command.number); break;
            case Command::Kind::set_center: grid.set_center(disturbance.x_m, disturbance.z_m); break;
            case Command::Kind::set_rain: grid.set_rain(command.rain); break;
        }
    }
    if (time_goes_on) sources.settle();
    commands.clear();
    new_footprints = 0;
    new_impulses = 0;
}

void DynamicWaves::swap_buffers() { state_->slots.swap(); }

void DynamicWaves::begin_frame(double time_s) {
    State& s = *state_;
    assert(!s.frame_in_flight);
    const DefaultFloatEnvironment environment(time_s);
    const double rate = options().ticks_per_s;
    const double ticks = std::clamp(time_s * rate + clock_slack, -farthest_tick, farthest_tick);
    const std::int64_t tick = tick_at(time_s);
    const auto max_ticks = static_cast<std::int64_t>(max_jump_s * rate);
    s.ticks_due = s.has_clock ? std::clamp(tick - s.last_tick, std::int64_t{0}, max_ticks) : 0;
    s.apply_commands(!s.has_clock || time_s > s.last_time_s, static_cast<double>(tick - s.ticks_due + 1) / rate);
    s.last_time_s = time_s;
    s.last_tick = tick;
    s.has_clock = true;
    s.fraction = static_cast<float>(std::min(ticks - static_cast<double>(tick), 1.0));
    s.frame_in_flight = true;
    s.run_in_flight = nullptr;
    if (s.ticks_due == 0) s.begin_run(*s.show_run);
    if (s.ticks_due == 1) s.begin_run(*s.tick_and_show_run);
}

void DynamicWaves::complete_frame() {
    State& s = *state_;
    if (!s.frame_in_flight) return;
    s.frame_in_flight = false;
    while (s.ticks_due > 1) {
        --s.ticks_due;
        s.begin_run(*s.tick_run);
        s.complete_run();
    }
    if (!s.run_in_flight) s.begin_run(s.ticks_due == 1 ? *s.tick_and_show_run : *s.show_run);
    s.complete_run();
    s.slots.back().view = s.view_of_back();
    s.shown = &s.slots.back().view;
}

void DynamicWaves::State::begin_run(GraphRun& run) {
    if (&run != show_run.get()) grid.begin_tick();
    run_in_flight = &run;
    run.schedule();
}

void DynamicWaves::State::complete_run() {
    GraphRun& run = *std::exchange(run_in_flight, nullptr);
    // A tick whose run fails counts as completed, and the next tick continues from its state.
    struct EndOfTick {
        DynamicWaveGrid* grid;
        ~EndOfTick() {
            if (grid) grid->end_tick();
        }
    } const end{&run == show_run.get() ? nullptr : &grid};
    run.complete();
}

bool DynamicWaves::is_done() const {
    return !state_->frame_in_flight || !state_->run_in_flight || state_->run_in_flight->is_done();
}

void DynamicWaves::State::show_rows(std::size_t item) {
    Slot& slot = slots.back();
    grid.interpolate(fraction, item,
                     {slot.height.data(), slot.vertical_velocity.data(), slot.foam.data(), slot.lowest.data(),
                      slot.highest.data()});
}

DynamicWavesView DynamicWaves::State::view_of_back() const {
    const Slot& slot = slots.back();
    return {.resolution = grid.options().resolution,
            .texel_m = grid.texel_m(),
            .first_x = grid.first_x(),
            .first_z = grid.first_z(),
            .height_m = {slot.height.data(), slot.height.size()},
            .vertical_velocity_mps = {slot.vertical_velocity.data(), slot.vertical_velocity.size()},
            .foam = {slot.foam.data(), slot.foam.size()},
            .bounds = {.height_min_m = slot.min_height(), .height_max_m = slot.max_height()}};
}

void DynamicWaves::drop_frame() {
    try {
        complete_frame();
    } catch (...) {  // the frame is discarded anyway
    }
    swap_buffers();
    state_->shown = &state_->slots.back().view;
}

std::vector<std::uint8_t> DynamicWaves::save_state() const {
    const State& s = *state_;
    s.need_no_frame_in_flight();
    SavedClock clock = {0, digest_of(options()), s.has_clock, s.last_tick, s.last_time_s};
    std::vector<std::uint8_t> bytes(sizeof clock);
    std::memcpy(bytes.data(), &clock, sizeof clock);
    const std::vector<std::uint8_t> texels = s.grid.saved();
    bytes.insert(bytes.end(), texels.begin(), texels.end());
    clock.checksum = checksum_of(bytes);
    std::memcpy(bytes.data(), &clock.checksum, sizeof clock.checksum);
    return bytes;
}

void DynamicWaves::restore_state(std::span<const std::uint8_t> saved) {
    State& s = *state_;
    s.need_no_frame_in_flight();
    SavedClock clock{};
    if (saved.size() < sizeof clock)
        throw std::invalid_argument(
            invalid_value_message("the saved state", number_text(saved.size()) + " bytes", "more"));
    std::memcpy(&clock, saved.data(), sizeof clock);
    if (clock.checksum != checksum_of(saved))
        throw std::invalid_argument("the saved state is damaged, expected the bytes that save_state() returned");
    if (clock.options != digest_of(options()))
        throw std::invalid_argument("the saved state has other options, expected those of these dynamic waves");
    if (std::fabs(static_cast<double>(clock.last_tick)) > farthest_tick)
        throw std::invalid_argument(
            invalid_value_message("the saved state's clock", clock.last_tick, "a tick within 2^50"));
    if (!std::isfinite(clock.last_time_s))
        throw std::invalid_argument(
            invalid_value_message("the saved state's time", clock.last_time_s, "a finite one"));
    s.grid.restore(saved.subspan(sizeof clock));
    s.has_clock = clock.has_clock != 0;
    s.last_tick = clock.last_tick;
    s.last_time_s = clock.last_time_s;
    s.commands.clear();
    s.new_footprints = 0;
    s.new_impulses = 0;
    s.numbers = s.grid.sources().numbers();
}

const DynamicWavesOptions& DynamicWaves::options() const { return state_->grid.options(); }

std::size_t DynamicWaves::memory_bytes() const {
    const State& s = *state_;
    std::size_t bytes = sizeof(State) + s.grid.bytes() + s.commands.capacity() * sizeof(State::Command) +
                        s.numbers.capacity() * sizeof(std::uint32_t);
    for (const PressureFootprint& footprint : s.footprints)
        bytes += sizeof footprint + footprint.depth_m.capacity() * sizeof(float);
    for (const State::Slot& slot : s.slots) bytes += slot.bytes();
    return bytes;
}

}  // namespace pelagic
