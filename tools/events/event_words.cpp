#include "pelagic/tools/events/event_words.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

/// Of a tick: a time that is meant to be a tick's own may be rounded up.
constexpr double clock_slack = 0x1p-16;
/// What an ocean takes for a tick, pushes and sources each.
constexpr std::size_t most_at_once = 4096;

}  // namespace

std::vector<EventWord> event_words(const EventFile& file, int ticks_per_s) {
    const double rate = ticks_per_s;
    const auto tick_at = [&](double time_s) {
        return static_cast<std::int64_t>(std::ceil(time_s * rate - clock_slack));
    };
    using What = EventWord::What;
    std::vector<EventWord> words;
    for (std::size_t i = 0; i < file.events.size(); ++i) {
        const WaterEvent& event = file.events[i];
        const std::int64_t begin = tick_at(event.time_s);
        words.push_back({begin, What::push, i});
        if (event.duration_s > 0)
            words.push_back({std::max(begin + 1, tick_at(event.time_s + event.duration_s)), What::remove, i});
    }
    std::sort(words.begin(), words.end(), [](const EventWord& one, const EventWord& other) {
        return std::tuple(one.tick, one.what, one.event) < std::tuple(other.tick, other.what, other.event);
    });
    std::size_t sources = 0, pushes = 0;
    std::int64_t tick = words.front().tick;
    for (const EventWord& word : words) {
        if (std::exchange(tick, word.tick) != word.tick) pushes = 0;
        if (word.what == What::remove)
            --sources;
        else
            ++(file.events[word.event].duration_s > 0 ? sources : pushes);
        if (std::max(sources, pushes) > most_at_once)
            throw InputError("--events has more than " + number_text(most_at_once) + " pushes at " +
                             number_text(static_cast<double>(tick) / rate) + " s, needs at most that many at once");
    }
    return words;
}

}  // namespace pelagic::tools
