// C interface of spray.
#include <string>
#include <vector>

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic::capi {
namespace {

/// Throws std::invalid_argument without spray.
template <class COcean>
COcean& needed_ocean_with_spray(COcean* ocean) {
    COcean& there = needed(ocean, "ocean");
    if (!there.has_spray) reject("the ocean has no spray: it was created without pelagic_ocean_options.spray");
    return there;
}

}  // namespace

SprayEmitter emitter_of(const pelagic_spray_emitter& from) {
    SprayEmitter to;
    // generated from schema/spray_emitter.toml: c-reads
    to.time_s = from.time_s;
    to.x_m = from.x_m;
    to.y_m = from.y_m;
    to.z_m = from.z_m;
    to.extent_m = from.extent_m;
    to.velocity_x_mps = from.velocity_x_mps;
    to.velocity_y_mps = from.velocity_y_mps;
    to.velocity_z_mps = from.velocity_z_mps;
    to.spread_mps = from.spread_mps;
    to.radius_m = from.radius_m;
    to.drop_mm = from.drop_mm;
    to.count = from.count;
    // end of generated
    return to;
}

SprayOptions spray_options_of(const pelagic_spray_options* options) {
    const pelagic_spray_options from = read_struct(options, "spray");
    SprayOptions to;
    // generated from schema/spray_options.toml: c-reads
    to.reach_m = from.reach_m;
    to.amount = from.amount;
    to.seed = from.seed;
    // end of generated
    if (const std::string reason = check(to); !reason.empty()) reject("spray." + reason);
    return to;
}

}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_ocean_set_spray_center(pelagic_ocean* ocean, double x_m, double z_m) {
    return guarded([&] { needed_ocean_with_spray(ocean).ocean.set_spray_center(x_m, z_m); });
}

pelagic_status pelagic_ocean_emit(pelagic_ocean* ocean, const pelagic_spray_emitter* emitters, size_t count) {
    return guarded([&] {
        Ocean& sea = needed_ocean_with_spray(ocean).ocean;
        if (count == 0) return;
        if (count > max_spray_droplets) reject(invalid_value_message("count", count, "[0, 8192]"));
        std::vector<SprayEmitter> ours;
        read_structs(emitters, count, "emitters", [&](const pelagic_spray_emitter& from, const std::string& element) {
            ours.push_back(emitter_of(from));
            if (const std::string reason = check(ours.back()); !reason.empty()) reject(element + "." + reason);
        });
        sea.emit(ours);
    });
}

pelagic_status pelagic_ocean_save_spray(const pelagic_ocean* ocean, uint8_t* bytes, size_t room, size_t* count) {
    return guarded([&] {
        need_no_frame_in_flight(needed_ocean_with_spray(ocean));
        write_saved(ocean->ocean.save_spray(), bytes, room, count);
    });
}

pelagic_status pelagic_ocean_restore_spray(pelagic_ocean* ocean, const uint8_t* bytes, size_t count) {
    return guarded([&] {
        need_no_frame_in_flight(needed_ocean_with_spray(ocean));
        if (count > 0) needed(bytes, "bytes");
        ocean->ocean.restore_spray({bytes, count});
    });
}
