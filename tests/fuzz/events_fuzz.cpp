// Event files of random bytes: the parser returns valid disturbances or throws a one-line error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "pelagic/tools/events/event_file.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace {

void must(bool is_so) {
    if (!is_so) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pelagic::tools;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const EventFile file = parse_events("events.csv", text);
        must(!file.events.empty() && file.text == text);
        for (const WaterEvent& event : file.events) {
            must(check(event.push).empty());
            must(event.time_s >= -1e9 && event.time_s <= 1e9 && event.duration_s >= 0 && event.duration_s <= 86400);
            must(event.time_s >= file.first_s());
        }
    } catch (const InputError& error) {
        const std::string_view what = error.what();
        must(what.starts_with("events.csv") &&
             (what.find("expected") != std::string_view::npos ||
              what.find("out of range") != std::string_view::npos) &&
             what.size() < 300);
        must(what.find('\n') == std::string_view::npos);
    }
    return 0;
}
