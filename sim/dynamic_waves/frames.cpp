#include "pelagic/sim/dynamic_waves/frames.hpp"

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
#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Of a tick: a time that is meant to be a tick's own may be rounded down.
constexpr double clock_slack = 0x1p-16;
/// Beyond this, doubles don't tell ticks apart.
constexpr double farthest_tick = 0x1p50;

struct SavedClock {
    std::uint64_t options;  ///< digest_of() them
    std::int64_t has_clock, last_tick;
    double last_time_s;
};

/// XXH3 of all that is set, numbers without gaps between them.
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

void check_place(double x_m, double z_m) {
    for (const double at : {x_m, z_m})
        if (!(at >= -1e8 && at <= 1e8))
            throw std::invalid_argument(invalid_value_message("the place to follow", at, "[-1e8, 1e8]"));
}

}  // namespace

DynamicWaveFrames::DynamicWaveFrames(const DynamicWavesOptions& options, Isa isa, const Allocator& memory,
                                     const Prepare& prepare)
    : grid_(options, isa, memory) {
    const auto n = static_cast<std::size_t>(options.resolution);
    for (Slot& slot : slots_) {
        slot.height = AlignedBuffer<float>(n * n, memory);
        slot.vertical_velocity = AlignedBuffer<float>(n * n, memory);
        slot.foam = AlignedBuffer<std::uint8_t>(n * n, memory);
        slot.lowest.resize(n);
        slot.highest.resize(n);
    }
    const auto add_show_stage = [&](JobGraph& graph, std::vector<StageId> waits_for) {
        graph.add({.name = "dynamic waves show",
                   .count = n / DynamicWaveGrid::rows_an_item,
                   .waits_for = std::move(waits_for),
                   .body = for_each_item([this](std::size_t item) { show_rows(item); })});
    };
    grid_.add_tick_stages(tick_graph_);
    add_show_stage(show_graph_, {});
    add_show_stage(tick_and_show_graph_, {grid_.add_tick_stages(tick_and_show_graph_)});
    tick_run_ = prepare(tick_graph_);
    show_run_ = prepare(show_graph_);
    tick_and_show_run_ = prepare(tick_and_show_graph_);
}

void DynamicWaveFrames::enqueue(const Command& command) { commands_.push_back(command); }

void DynamicWaveFrames::disturb(const Disturbance& disturbance) {
    if (const std::string reason = check(disturbance); !reason.empty()) throw std::invalid_argument(reason);
    if (grid_.sources().settled() + new_disturbances_ == DynamicWaveSources::max_count)
        throw std::invalid_argument(invalid_value_message("the number of disturbances of a tick",
                                                          DynamicWaveSources::max_count + 1,
                                                          "at most " + number_text(DynamicWaveSources::max_count)));
    ++new_disturbances_;
    enqueue({Command::Kind::disturb, 0, disturbance});
}

std::uint32_t DynamicWaveFrames::add_source(const Disturbance& source) {
    if (const std::string reason = check(source); !reason.empty()) throw std::invalid_argument(reason);
    if (numbers_.size() == DynamicWaveSources::max_count)
        throw std::invalid_argument(invalid_value_message("the number of sources", DynamicWaveSources::max_count + 1,
                                                          "at most " + number_text(DynamicWaveSources::max_count)));
    const std::uint32_t number = grid_.sources().new_number();
    numbers_.push_back(number);
    enqueue({Command::Kind::add, number, source});
    return number;
}

void DynamicWaveFrames::set_source(std::uint32_t number, const Disturbance& source) {
    if (const std::string reason = check(source); !reason.empty()) throw std::invalid_argument(reason);
    enqueue({Command::Kind::set, number, source});
}

void DynamicWaveFrames::remove_source(std::uint32_t number) {
    const auto at = std::lower_bound(numbers_.begin(), numbers_.end(), number);
    if (at == numbers_.end() || *at != number) return;
    numbers_.erase(at);
    enqueue({Command::Kind::remove, number});
}

void DynamicWaveFrames::follow(double x_m, double z_m) {
    check_place(x_m, z_m);
    enqueue({Command::Kind::follow, 0, {.x_m = x_m, .z_m = z_m}});
}

void DynamicWaveFrames::set_rain(const Rain& rain) {
    if (const std::string reason = check(rain, grid_.options()); !reason.empty()) throw std::invalid_argument(reason);
    enqueue({.kind = Command::Kind::rain, .rain = rain});
}

void DynamicWaveFrames::apply_commands(bool time_goes_on) {
    DynamicWaveSources& sources = grid_.sources();
    const bool is_full = sources.waiting() + new_disturbances_ > DynamicWaveSources::max_count;
    if (new_disturbances_ > 0 && (!time_goes_on || is_full)) sources.forget_provisional();
    for (const Command& command : commands_) {
        switch (command.kind) {
            case Command::Kind::disturb: sources.disturb(command.disturbance); break;
            case Command::Kind::add: grid_.set_source(command.number, command.disturbance); break;
            case Command::Kind::set:
                if (sources.has(command.number)) grid_.set_source(command.number, command.disturbance);
                break;
            case Command::Kind::remove: sources.remove(command.number); break;
            case Command::Kind::follow: grid_.follow(command.disturbance.x_m, command.disturbance.z_m); break;
            case Command::Kind::rain: grid_.set_rain(command.rain); break;
        }
    }
    if (time_goes_on) sources.settle();
    commands_.clear();
    new_disturbances_ = 0;
}

void DynamicWaveFrames::begin_frame(double time_s) {
    assert(!frame_in_flight_);
    const DefaultFloatEnvironment environment;
    apply_commands(!has_clock_ || time_s > last_time_s_);
    last_time_s_ = time_s;
    const double rate = grid_.options().ticks_per_s;
    const double place = std::clamp(time_s * rate + clock_slack, -farthest_tick, farthest_tick);
    const double tick = std::floor(place);
    const auto number = static_cast<std::int64_t>(tick);
    const auto max = static_cast<std::int64_t>(max_seconds_a_frame * rate);
    ticks_due_ = has_clock_ ? std::clamp(number - last_tick_, std::int64_t{0}, max) : 0;
    last_tick_ = number;
    has_clock_ = true;
    part_ = static_cast<float>(std::min(place - tick, 1.0));
    frame_in_flight_ = true;
    run_in_flight_ = nullptr;
    if (ticks_due_ == 0) begin_run(*show_run_);
    if (ticks_due_ == 1) begin_run(*tick_and_show_run_);
}

void DynamicWaveFrames::complete() {
    if (!frame_in_flight_) return;
    frame_in_flight_ = false;
    while (ticks_due_ > 1) {
        --ticks_due_;
        begin_run(*tick_run_);
        complete_run();
    }
    if (!run_in_flight_) begin_run(ticks_due_ == 1 ? *tick_and_show_run_ : *show_run_);
    complete_run();
}

void DynamicWaveFrames::begin_run(GraphRun& run) {
    if (&run != show_run_.get()) grid_.begin_tick();
    run_in_flight_ = &run;
    run.schedule();
}

void DynamicWaveFrames::complete_run() {
    GraphRun& run = *std::exchange(run_in_flight_, nullptr);
    // A run that fails has done what it could, and the next tick follows on it.
    struct EndOfTick {
        DynamicWaveGrid* grid;
        ~EndOfTick() {
            if (grid) grid->end_tick();
        }
    } const end{&run == show_run_.get() ? nullptr : &grid_};
    run.complete();
}

bool DynamicWaveFrames::is_done() const { return !frame_in_flight_ || !run_in_flight_ || run_in_flight_->is_done(); }

void DynamicWaveFrames::show_rows(std::size_t item) {
    Slot& slot = slots_[back_];
    grid_.show(part_, item,
               {slot.height.data(), slot.vertical_velocity.data(), slot.foam.data(), slot.lowest.data(),
                slot.highest.data()});
}

DynamicWavesView DynamicWaveFrames::surface() const {
    const Slot& slot = slots_[back_];
    return {.resolution = grid_.options().resolution,
            .texel_m = grid_.texel_m(),
            .first_x = grid_.first_x(),
            .first_z = grid_.first_z(),
            .height_m = {slot.height.data(), slot.height.size()},
            .vertical_velocity_mps = {slot.vertical_velocity.data(), slot.vertical_velocity.size()},
            .foam = {slot.foam.data(), slot.foam.size()},
            .height_min_m = *std::min_element(slot.lowest.begin(), slot.lowest.end()),
            .height_max_m = *std::max_element(slot.highest.begin(), slot.highest.end())};
}

void DynamicWaveFrames::drop_frame() {
    try {
        complete();
    } catch (...) {  // it is lost already
    }
    turn();
}

std::vector<std::uint8_t> DynamicWaveFrames::saved() const {
    const SavedClock clock = {digest_of(grid_.options()), has_clock_, last_tick_, last_time_s_};
    std::vector<std::uint8_t> bytes(sizeof clock);
    std::memcpy(bytes.data(), &clock, sizeof clock);
    const std::vector<std::uint8_t> water = grid_.saved();
    bytes.insert(bytes.end(), water.begin(), water.end());
    return bytes;
}

void DynamicWaveFrames::restore(std::span<const std::uint8_t> saved) {
    SavedClock clock{};
    if (saved.size() < sizeof clock)
        throw std::invalid_argument(
            invalid_value_message("the saved water", number_text(saved.size()) + " bytes", "more"));
    std::memcpy(&clock, saved.data(), sizeof clock);
    if (clock.options != digest_of(grid_.options()))
        throw std::invalid_argument("the saved water is of other options, needs those of this ocean's water");
    if (std::fabs(static_cast<double>(clock.last_tick)) > farthest_tick)
        throw std::invalid_argument(
            invalid_value_message("the saved water's clock", clock.last_tick, "a tick within 2^50"));
    if (!std::isfinite(clock.last_time_s))
        throw std::invalid_argument(
            invalid_value_message("the saved water's time", clock.last_time_s, "a finite one"));
    grid_.restore(saved.subspan(sizeof clock));
    has_clock_ = clock.has_clock != 0;
    last_tick_ = clock.last_tick;
    last_time_s_ = clock.last_time_s;
    commands_.clear();
    new_disturbances_ = 0;
    numbers_ = grid_.sources().numbers();
}

std::size_t DynamicWaveFrames::bytes() const {
    std::size_t bytes = sizeof(DynamicWaveFrames) + grid_.bytes() + commands_.capacity() * sizeof(Command) +
                        numbers_.capacity() * sizeof(std::uint32_t);
    for (const Slot& slot : slots_)
        bytes += slot.height.bytes() + slot.vertical_velocity.bytes() + slot.foam.bytes() +
                 (slot.lowest.capacity() + slot.highest.capacity()) * sizeof(float);
    return bytes;
}

}  // namespace pelagic
