// Event files of random bytes: the parser returns valid disturbances or throws a one-line error.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "pelagic/tests/fuzz/fuzz.hpp"
#include "pelagic/tools/events/event_file.hpp"
#include "pelagic/tools/text/errors.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pelagic::tools;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const EventFile file = parse_events("events.csv", text);
        pelagic::must(!file.events.empty() && file.text == text);
        for (const WaterEvent& event : file.events) {
            pelagic::must(check(event.push).empty());
            pelagic::must(event.time_s >= -1e9 && event.time_s <= 1e9);
            pelagic::must(event.duration_s >= 0 && event.duration_s <= 86400);
            pelagic::must(event.time_s >= file.first_s());
        }
    } catch (const InputError& error) {
        pelagic::must_be_a_line_about("events.csv", error.what());
    }
    return 0;
}
