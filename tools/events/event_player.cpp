#include "pelagic/tools/events/event_player.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

/// Returns a plan whose cells are at least a texel, so that a pressure that moves over the texels
/// keeps its volume.
HullPlan plan_on(const HullMesh& hull, double texel_m) {
    const auto cells = [&](double size_m) { return static_cast<int>(std::clamp(size_m / texel_m, 1.0, 64.0)); };
    const glm::dvec3 size = hull.upper_m() - hull.lower_m();
    return plan_of(hull, cells(size.x), cells(size.z));
}

/// Returns the pressure of an event's hull: in each cell the depth of its volume below the water.
PressureFootprint footprint_of(const WaterEvent& event, const HullPlan& plan) {
    const Disturbance& push = event.push;
    PressureFootprint footprint;
    footprint.velocity_x_mps = push.velocity_x_mps;
    footprint.velocity_z_mps = push.velocity_z_mps;
    footprint.length_m = plan.length_m;
    footprint.beam_m = plan.beam_m;
    footprint.columns = plan.columns;
    footprint.rows = plan.rows;
    const det::SineCosine heading = det::sine_cosine_of_turns(push.heading_rad / (2 * std::numbers::pi));
    footprint.forward_x = heading.cosine;
    footprint.forward_z = heading.sine;
    footprint.x_m = push.x_m + plan.x_m * heading.cosine - plan.z_m * heading.sine;
    footprint.z_m = push.z_m + plan.x_m * heading.sine + plan.z_m * heading.cosine;
    const double water_m = event.hull->lower_m().y - push.height_m;  // in the axes of the mesh
    for (std::size_t i = 0; i < plan.low_m.size(); ++i) {
        const double low = plan.low_m[i], high = plan.high_m[i];
        footprint.depth_m.push_back(static_cast<float>(
            std::clamp(plan.coverage[i] * std::clamp(water_m - low, 0.0, high - low), 0.0, 100.0)));
    }
    return footprint;
}

/// Fraction of a tick by which a time that is meant to be a tick's own may be rounded up.
constexpr double clock_slack = 0x1p-16;

}  // namespace

EventPlayer::EventPlayer(const EventOptions& options, std::shared_ptr<Executor> executor, std::optional<Isa> isa,
                         const WaterFrame& water, std::optional<double> begins_s)
    : options_(options),
      commands_(event_commands(*options.file, options.water.ticks_per_s)),
      numbers_(options.file->events.size()),
      waves_(options.water, DynamicWaves::Resources{.executor = std::move(executor), .isa = isa}),
      has_current_(water.current_x_mps != 0 || water.current_z_mps != 0) {
    for (const WaterEvent& event : options.file->events)
        if (event.hull && !plans_.contains(event.hull.get()))
            plans_.emplace(event.hull.get(), plan_on(*event.hull, options.texel_m()));
    waves_.set_current(water.current_x_mps, water.current_z_mps);
    first_tick_ = commands_.empty() ? waves_.tick_at(*begins_s) : commands_.front().tick - 1;
    if (begins_s) first_tick_ = std::min(first_tick_, waves_.tick_at(*begins_s));
    center_grid();
    waves_.advance(time_of(first_tick_));
    tick_ = first_tick_;
    beginning_ = waves_.save_state();
}

void EventPlayer::follow_hull(double x_m, double z_m) {
    if (!options_.follows_hull) return;
    options_.middle_x_m = x_m;
    options_.middle_z_m = z_m;
    center_grid();
}

void EventPlayer::run_command(const EventCommand& command) {
    const WaterEvent& event = options_.file->events[command.event];
    if (command.kind == EventCommand::Kind::remove) return waves_.remove_source(numbers_[command.event]);
    if (event.duration_s == 0) return waves_.add_impulse(event.push);
    const double since_s = time_of(command.tick) - event.time_s;
    const auto move = [&](auto source) {
        source.x_m = std::clamp(source.x_m + since_s * source.velocity_x_mps, -1e8, 1e8);
        source.z_m = std::clamp(source.z_m + since_s * source.velocity_z_mps, -1e8, 1e8);
        return source;
    };
    numbers_[command.event] = event.hull
                                  ? waves_.add_footprint(move(footprint_of(event, plans_.at(event.hull.get()))))
                                  : waves_.add_source(move(event.push));
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
        if (show_) show_(time_of(tick_));
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
    both.bounds += water.bounds;
    return both;
}

std::vector<EventCommand> event_commands(const EventFile& file, int ticks_per_s) {
    const double rate = ticks_per_s;
    const auto tick_at = [&](double time_s) {
        return static_cast<std::int64_t>(std::ceil(time_s * rate - clock_slack));
    };
    using Kind = EventCommand::Kind;
    std::vector<EventCommand> commands;
    for (std::size_t i = 0; i < file.events.size(); ++i) {
        const WaterEvent& event = file.events[i];
        const std::int64_t begin = tick_at(event.time_s);
        commands.push_back({begin, Kind::push, i});
        if (event.duration_s > 0)
            commands.push_back({std::max(begin + 1, tick_at(event.time_s + event.duration_s)), Kind::remove, i});
    }
    if (commands.empty()) return commands;
    std::sort(commands.begin(), commands.end(), [](const EventCommand& one, const EventCommand& other) {
        return std::tuple(one.tick, one.kind, one.event) < std::tuple(other.tick, other.kind, other.event);
    });
    std::size_t sources = 0, pushes = 0;
    std::int64_t tick = commands.front().tick;
    for (const EventCommand& command : commands) {
        if (std::exchange(tick, command.tick) != command.tick) pushes = 0;
        if (command.kind == Kind::remove)
            --sources;
        else
            ++(file.events[command.event].duration_s > 0 ? sources : pushes);
        if (std::max(sources, pushes) > DynamicWaves::max_disturbances)
            throw InputError("--events has more than " + number_text(DynamicWaves::max_disturbances) +
                             " disturbances at " + number_text(static_cast<double>(tick) / rate) +
                             " s, expected at most that many at once");
    }
    return commands;
}

}  // namespace pelagic::tools
