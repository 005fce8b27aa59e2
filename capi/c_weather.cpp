// C interface of forecasts.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_sea.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/statistics.hpp"

namespace pelagic::capi {
namespace {

/// Returns an option whose value 0 means that it is not set.
std::optional<double> unless_0(double value) { return value == 0 ? std::nullopt : std::optional(value); }

SeaChange change_of(const pelagic_change& change) {
    return {.sea = sea_of(change.sea),
            .from_s = change.from_s,
            .over_s = change.over_s,
            .swell_from_m = unless_0(change.swell_from_m)};
}

Forecast forecast_of(const pelagic_forecast* pointer) {
    const pelagic_forecast from = read_struct(pointer, "forecast");
    Forecast forecast{.first = sea_of(from.first), .largest_peak_m = unless_0(from.largest_peak_m)};
    if (from.change_count > 0)
        read_structs(from.changes, from.change_count, "changes",
                     [&](const pelagic_change& change, auto&) { forecast.changes.push_back(change_of(change)); });
    return forecast;
}

}  // namespace
}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_ocean_create_forecast(const pelagic_forecast* forecast, const pelagic_ocean_options* options,
                                             pelagic_ocean** ocean) {
    return guarded([&] {
        pelagic_ocean*& out = needed(ocean, "ocean");
        out = nullptr;
        out = new_ocean(forecast_of(forecast), options);
    });
}

pelagic_status pelagic_ocean_sea(const pelagic_ocean* ocean, pelagic_sea* sea) {
    return guarded([&] {
        need_frame(needed(ocean, "ocean"));
        write_sea(ocean->current->sea, sea);
    });
}

pelagic_status pelagic_forecast_warnings(const pelagic_forecast* forecast, char* text, size_t room, size_t* count) {
    return guarded([&] {
        const Forecast ours = forecast_of(forecast);
        if (const std::string reason = check(ours); !reason.empty()) reject(reason);
        std::vector<std::string> warnings = expected_report_on(ours.first).warnings;
        warnings.push_back(warning_about(ours));
        std::vector<std::uint8_t> lines;
        for (const std::string& warning : warnings) {
            if (warning.empty()) continue;
            if (!lines.empty()) lines.push_back('\n');
            lines.insert(lines.end(), warning.begin(), warning.end());
        }
        lines.push_back(0);
        write_saved(lines, reinterpret_cast<std::uint8_t*>(text), room, count);
    });
}

pelagic_status pelagic_ocean_schedule_change(pelagic_ocean* ocean, const pelagic_change* change) {
    return guarded([&] {
        if (needed(ocean, "ocean").sea_in_flight)
            throw WrongOrder("a sea is being baked; call pelagic_ocean_complete_sea first");
        ocean->ocean.schedule_sea(change_of(read_struct(change, "change")));
    });
}
