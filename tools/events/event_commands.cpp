#include "pelagic/tools/events/event_commands.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

/// Fraction of a tick by which a time that is meant to be a tick's own may be rounded up.
constexpr double clock_slack = 0x1p-16;

}  // namespace

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
