// C interface of forecasts.
#include <cstddef>

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_sea.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/forecast.hpp"

namespace pelagic::capi {
namespace {

/// Converts a change. Throws std::invalid_argument for null and a wrong struct_size. check() checks
/// the values.
SeaChange change_of(const pelagic_change* pointer, const char* name) {
    const pelagic_change change = read_struct(pointer, name);
    return {.sea = sea_of(change.sea),
            .from_s = change.from_s,
            .over_s = change.over_s,
            .swell_from_m = change.swell_from_m};
}

Forecast forecast_of(const pelagic_forecast* pointer) {
    const pelagic_forecast from = read_struct(pointer, "forecast");
    Forecast forecast{.first = sea_of(from.first), .largest_peak_m = from.largest_peak_m};
    if (from.change_count == 0) return forecast;
    const std::size_t bytes = struct_bytes(from.changes, "changes");
    if (bytes % alignof(pelagic_change) != 0)
        reject(invalid_value_message("changes.struct_size", bytes,
                                     number_text(sizeof(pelagic_change)) + ", the size of the struct"));
    for (std::size_t i = 0; i < from.change_count; ++i) {
        const auto* const at =
            reinterpret_cast<const pelagic_change*>(reinterpret_cast<const unsigned char*>(from.changes) + i * bytes);
        const std::string name = "changes[" + number_text(i) + "]";
        if (at->struct_size != bytes)
            reject(invalid_value_message(name + ".struct_size", at->struct_size,
                                         number_text(bytes) + ", as the first's"));
        forecast.changes.push_back(change_of(at, name.c_str()));
    }
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
        ocean->ocean.schedule_sea(change_of(change, "change"));
    });
}
