#include "pelagic/tools/events/event_player.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pelagic::tools {
namespace {

/// Of a tick: a time that is meant to be a tick's own may be rounded, as an ocean takes it (dynamic_waves/frames.cpp).
constexpr double clock_slack = 0x1p-16;
/// An ocean's jump in time has no more than that many seconds of ticks.
constexpr double longest_jump_s = 0.5;

/// The sea is not looked at: as small as can be.
SeaState min_sea() { return {.cascades = 1, .resolution = 16}; }

}  // namespace

EventPlayer::EventPlayer(const EventOptions& options, std::shared_ptr<Executor> executor, std::optional<Isa> isa)
    : options_(options),
      rate_(options.water.ticks_per_s),
      commands_(event_commands(*options.file, options.water.ticks_per_s)),
      numbers_(options.file->events.size()),
      ocean_(min_sea(), {.executor = std::move(executor), .isa = isa, .dynamic_waves = options.water}) {
    first_tick_ = commands_.front().tick - 1;
    ocean_.follow(options_.middle_x_m, options_.middle_z_m);
    ocean_.frame_at(time_of(first_tick_));
    tick_ = first_tick_;
    beginning_ = ocean_.saved_water();
}

void EventPlayer::run_command(const EventCommand& command) {
    const WaterEvent& event = options_.file->events[command.event];
    if (command.kind == EventCommand::Kind::remove) return ocean_.remove_source(numbers_[command.event]);
    if (event.duration_s == 0) return ocean_.disturb(event.push);
    Disturbance source = event.push;
    const double since_s = time_of(command.tick) - event.time_s;
    source.x_m = std::clamp(source.x_m + since_s * source.velocity_x_mps, -1e8, 1e8);
    source.z_m = std::clamp(source.z_m + since_s * source.velocity_z_mps, -1e8, 1e8);
    numbers_[command.event] = ocean_.add_source(source);
}

void EventPlayer::go_to(std::int64_t tick) {
    const auto longest_jump = static_cast<std::int64_t>(longest_jump_s * rate_);
    while (tick_ < tick) {
        for (; next_command_ < commands_.size() && commands_[next_command_].tick == tick_ + 1; ++next_command_)
            run_command(commands_[next_command_]);
        std::int64_t until = std::min(tick, tick_ + longest_jump);
        if (next_command_ < commands_.size()) until = std::min(until, commands_[next_command_].tick - 1);
        ocean_.frame_at(time_of(until));
        tick_ = until;
    }
}

DynamicWavesView EventPlayer::at(double time_s) {
    const auto tick = static_cast<std::int64_t>(std::floor(time_s * rate_ + clock_slack));
    if (tick < tick_) {
        ocean_.restore_water(beginning_);
        tick_ = first_tick_;
        next_command_ = 0;
    }
    if (tick < first_tick_) return ocean_.frame_at(time_of(first_tick_)).dynamic_waves;
    go_to(tick);
    return ocean_.frame_at(time_s).dynamic_waves;
}

Frame with_water(const Frame& frame, const DynamicWavesView& water) {
    Frame both = frame;
    both.dynamic_waves = water;
    both.bounds.height_min_m += water.height_min_m;
    both.bounds.height_max_m += water.height_max_m;
    return both;
}

}  // namespace pelagic::tools
