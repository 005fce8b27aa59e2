// C interface: checks of options without objects.
#include <string>
#include <string_view>

#include "pelagic/capi/c_dynamic_waves.hpp"
#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_sea.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/c_wave_input.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic::capi {
namespace {

std::string check_each_wave(const AnalyticSea& sea) {
    for (const AnalyticWave& wave : sea.waves)
        if (std::string reason = check_fields(wave, analytic_wave_fields()); !reason.empty()) return reason;
    return {};
}

/// Returns the first invalid value, or an empty string. Throws std::invalid_argument for another
/// type, and as the conversion of the struct.
std::string check_options(std::string_view type, const void* options) {
    if (type == "pelagic_dynamic_waves_options") {
        dynamic_waves_options_of(static_cast<const pelagic_dynamic_waves_options*>(options));
        return {};
    }
    if (type == "pelagic_disturbance")
        return check(disturbance_of(static_cast<const pelagic_disturbance*>(options), "disturbance"));
    if (type == "pelagic_rain")
        return check_fields(rain_of(static_cast<const pelagic_rain*>(options)), rain_fields());
    if (type == "pelagic_ripple") return check(ripple_of(static_cast<const pelagic_ripple*>(options)));
    if (type == "pelagic_waves") return check_each_wave(waves_of(static_cast<const pelagic_waves*>(options)));
    if (type == "pelagic_shore_options") {
        shore_options_of(static_cast<const pelagic_shore_options*>(options));
        return {};
    }
    if (type == "pelagic_spray_options") {
        spray_options_of(static_cast<const pelagic_spray_options*>(options));
        return {};
    }
    if (type == "pelagic_spray_emitter")
        return check(emitter_of(read_struct(static_cast<const pelagic_spray_emitter*>(options), "emitter")));
    if (type == "pelagic_wave_system")
        return check_wave_system(
            wave_system_of(needed(static_cast<const pelagic_wave_system*>(options), "system"), ""));
    reject(invalid_value_message("type", type, "the name of a struct of options"));
}

}  // namespace
}  // namespace pelagic::capi

pelagic_status pelagic_options_check(const char* type, const void* options) {
    using namespace pelagic::capi;
    return guarded([&] {
        if (const std::string reason = check_options(&needed(type, "type"), options); !reason.empty()) reject(reason);
    });
}
