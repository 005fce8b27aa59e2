#include "pelagic/tools/events/event_player.hpp"

#include <algorithm>
#include <utility>

namespace pelagic::tools {

EventPlayer::EventPlayer(const EventOptions& options, std::shared_ptr<Executor> executor, std::optional<Isa> isa,
                         const WaterFrame& water)
    : options_(options),
      commands_(event_commands(*options.file, options.water.ticks_per_s)),
      numbers_(options.file->events.size()),
      waves_(options.water, DynamicWaves::Resources{.executor = std::move(executor), .isa = isa}),
      has_current_(water.current_x_mps != 0 || water.current_z_mps != 0) {
    waves_.set_current(water.current_x_mps, water.current_z_mps);
    first_tick_ = commands_.front().tick - 1;
    center_grid();
    waves_.advance(time_of(first_tick_));
    tick_ = first_tick_;
    beginning_ = waves_.save_state();
}

void EventPlayer::run_command(const EventCommand& command) {
    const WaterEvent& event = options_.file->events[command.event];
    if (command.kind == EventCommand::Kind::remove) return waves_.remove_source(numbers_[command.event]);
    if (event.duration_s == 0) return waves_.add_impulse(event.push);
    Disturbance source = event.push;
    const double since_s = time_of(command.tick) - event.time_s;
    source.x_m = std::clamp(source.x_m + since_s * source.velocity_x_mps, -1e8, 1e8);
    source.z_m = std::clamp(source.z_m + since_s * source.velocity_z_mps, -1e8, 1e8);
    numbers_[command.event] = waves_.add_source(source);
}

void EventPlayer::go_to(std::int64_t tick) {
    const auto longest_jump = static_cast<std::int64_t>(DynamicWaves::max_jump_s * options_.water.ticks_per_s);
    while (tick_ < tick) {
        for (; next_command_ < commands_.size() && commands_[next_command_].tick == tick_ + 1; ++next_command_)
            run_command(commands_[next_command_]);
        // A current carries the grid, which returns to its place in every tick.
        if (has_current_) center_grid();
        std::int64_t until = std::min(tick, tick_ + (has_current_ ? 1 : longest_jump));
        if (next_command_ < commands_.size()) until = std::min(until, commands_[next_command_].tick - 1);
        waves_.advance(time_of(until));
        tick_ = until;
    }
}

DynamicWavesView EventPlayer::at(double time_s) {
    const std::int64_t tick = waves_.tick_at(time_s);
    if (tick < tick_) {
        waves_.restore_state(beginning_);
        tick_ = first_tick_;
        next_command_ = 0;
    }
    if (tick < first_tick_) return waves_.advance(time_of(first_tick_));
    go_to(tick);
    return waves_.advance(time_s);
}

Frame with_water(const Frame& frame, const DynamicWavesView& water) {
    Frame both = frame;
    both.dynamic_waves = water;
    both.bounds.height_min_m += water.height_min_m;
    both.bounds.height_max_m += water.height_max_m;
    return both;
}

}  // namespace pelagic::tools
