// C interface of forecasts.
#include <cstddef>
#include <optional>

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_sea.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/forecast.hpp"

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

pelagic_status pelagic_ocean_schedule_change(pelagic_ocean* ocean, const pelagic_change* change) {
    return guarded([&] {
        if (needed(ocean, "ocean").sea_in_flight)
            throw WrongOrder("a sea is being baked; call pelagic_ocean_complete_sea first");
        ocean->ocean.schedule_sea(change_of(read_struct(change, "change")));
    });
}
