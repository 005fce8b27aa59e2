// Dynamic waves as C spells it.
#include "pelagic/sim/dynamic_waves.hpp"

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/rain.hpp"

namespace pelagic::capi {
namespace {

static_assert(PELAGIC_DYNAMIC_WAVES_VERLET == static_cast<int>(DynamicWavesStep::verlet));
static_assert(PELAGIC_SHAPE_HULL == static_cast<int>(Disturbance::Shape::hull));
static_assert(PELAGIC_DISTURBANCE_RELAXATION == static_cast<int>(Disturbance::Mode::relaxation) &&
              PELAGIC_DISTURBANCE_IMPULSE == static_cast<int>(Disturbance::Mode::impulse));

/// Throws std::invalid_argument for null, a wrong struct_size and constants that there aren't. Values are for check().
Disturbance disturbance_of(const pelagic_disturbance* pointer, const char* name) {
    const pelagic_disturbance from = read_struct(pointer, name);
    if (from.shape < 0 || from.shape > PELAGIC_SHAPE_HULL)
        reject(invalid_value_message("shape", from.shape, "one of PELAGIC_SHAPE_..."));
    if (from.mode < 0 || from.mode > PELAGIC_DISTURBANCE_IMPULSE)
        reject(invalid_value_message("mode", from.mode, "one of PELAGIC_DISTURB_..."));
    return {.shape = static_cast<Disturbance::Shape>(from.shape),
            .mode = static_cast<Disturbance::Mode>(from.mode),
            .x_m = from.x_m,
            .z_m = from.z_m,
            .radius_m = from.radius_m,
            .length_m = from.length_m,
            .heading_rad = from.heading_rad,
            .height_m = from.height_m,
            .rate_per_s = from.rate_per_s,
            .velocity_x_mps = from.velocity_x_mps,
            .velocity_z_mps = from.velocity_z_mps};
}

const DynamicWavesView& shown_dynamic_waves(const pelagic_ocean& ocean) {
    need_frame(ocean);
    if (!ocean.shown->dynamic_waves)
        reject("the ocean has no dynamic waves, needs pelagic_ocean_options.dynamic_waves");
    return ocean.shown->dynamic_waves;
}

}  // namespace

DynamicWavesOptions dynamic_waves_options_of(const pelagic_dynamic_waves_options* options) {
    const pelagic_dynamic_waves_options from = read_struct(options, "dynamic_waves");
    if (from.step < 0 || from.step > PELAGIC_DYNAMIC_WAVES_VERLET)
        reject(invalid_value_message("dynamic_waves.step", from.step,
                                     "PELAGIC_DYNAMIC_WAVES_SPECTRAL or PELAGIC_DYNAMIC_WAVES_VERLET"));
    const DynamicWavesOptions ours{.step = static_cast<DynamicWavesStep>(from.step),
                                   .resolution = from.resolution,
                                   .side_m = from.side_m,
                                   .ticks_per_s = from.ticks_per_s,
                                   .border_m = from.border_m,
                                   .depth_m = from.depth_m,
                                   .viscosity_m2ps = from.viscosity_m2ps,
                                   .wave_speed_mps = from.wave_speed_mps,
                                   .decay_per_s = from.decay_per_s,
                                   .foam_height_m = from.foam_height_m};
    if (const std::string reason = check(ours); !reason.empty()) reject("dynamic_waves." + reason);
    return ours;
}

}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_dynamic_waves_defaults(pelagic_dynamic_waves_options* options) {
    return guarded([&] {
        struct_bytes(options, "options");
        const DynamicWavesOptions ours;
        pelagic_dynamic_waves_options out{};
        out.step = static_cast<std::int32_t>(ours.step);
        out.resolution = ours.resolution;
        out.ticks_per_s = ours.ticks_per_s;
        out.side_m = ours.side_m;
        out.border_m = ours.border_m;
        out.depth_m = ours.depth_m;
        out.viscosity_m2ps = ours.viscosity_m2ps;
        out.wave_speed_mps = ours.wave_speed_mps;
        out.decay_per_s = ours.decay_per_s;
        out.foam_height_m = ours.foam_height_m;
        write_struct(out, options);
    });
}

pelagic_status pelagic_disturbance_defaults(pelagic_disturbance* disturbance) {
    return guarded([&] {
        struct_bytes(disturbance, "disturbance");
        const Disturbance ours;
        pelagic_disturbance out{};
        out.shape = static_cast<std::int32_t>(ours.shape);
        out.mode = static_cast<std::int32_t>(ours.mode);
        out.radius_m = ours.radius_m;
        out.length_m = ours.length_m;
        out.rate_per_s = ours.rate_per_s;
        write_struct(out, disturbance);
    });
}

pelagic_status pelagic_ocean_disturb(pelagic_ocean* ocean, const pelagic_disturbance* disturbance) {
    return guarded([&] { needed(ocean, "ocean").ocean.disturb(disturbance_of(disturbance, "disturbance")); });
}

pelagic_status pelagic_ocean_add_source(pelagic_ocean* ocean, const pelagic_disturbance* source, uint32_t* number) {
    return guarded([&] {
        Ocean& sea = needed(ocean, "ocean").ocean;
        std::uint32_t& out = needed(number, "number");
        out = sea.add_source(disturbance_of(source, "source"));
    });
}

pelagic_status pelagic_ocean_set_source(pelagic_ocean* ocean, uint32_t number, const pelagic_disturbance* source) {
    return guarded([&] { needed(ocean, "ocean").ocean.set_source(number, disturbance_of(source, "source")); });
}

pelagic_status pelagic_ocean_remove_source(pelagic_ocean* ocean, uint32_t number) {
    return guarded([&] { needed(ocean, "ocean").ocean.remove_source(number); });
}

pelagic_status pelagic_ocean_follow(pelagic_ocean* ocean, double x_m, double z_m) {
    return guarded([&] { needed(ocean, "ocean").ocean.follow(x_m, z_m); });
}

pelagic_status pelagic_rain_defaults(pelagic_rain* rain) {
    return guarded([&] {
        struct_bytes(rain, "rain");
        const Rain ours;
        pelagic_rain out{};
        out.seed = ours.seed;
        out.drops_per_m2_s = ours.drops_per_m2_s;
        out.radius_m = ours.radius_m;
        out.height_m = ours.height_m;
        write_struct(out, rain);
    });
}

pelagic_status pelagic_ocean_set_rain(pelagic_ocean* ocean, const pelagic_rain* rain) {
    return guarded([&] {
        const pelagic_rain from = read_struct(rain, "rain");
        needed(ocean, "ocean")
            .ocean.set_rain({.drops_per_m2_s = from.drops_per_m2_s,
                             .radius_m = from.radius_m,
                             .height_m = from.height_m,
                             .seed = from.seed});
    });
}

pelagic_status pelagic_ocean_dynamic_waves(const pelagic_ocean* ocean, pelagic_dynamic_waves_view* surface) {
    return guarded([&] {
        const DynamicWavesView& dynamic_waves = shown_dynamic_waves(needed(ocean, "ocean"));
        struct_bytes(surface, "surface");
        pelagic_dynamic_waves_view out{};
        out.resolution = dynamic_waves.resolution;
        out.first_x = dynamic_waves.first_x;
        out.first_z = dynamic_waves.first_z;
        out.texel_m = dynamic_waves.texel_m;
        out.height_m = dynamic_waves.height_m.data();
        out.vertical_velocity_mps = dynamic_waves.vertical_velocity_mps.data();
        out.foam = dynamic_waves.foam.data();
        out.height_min_m = dynamic_waves.height_min_m;
        out.height_max_m = dynamic_waves.height_max_m;
        write_struct(out, surface);
    });
}

pelagic_status pelagic_ocean_dynamic_waves_hash(const pelagic_ocean* ocean, uint64_t* hash) {
    return guarded([&] {
        shown_dynamic_waves(needed(ocean, "ocean"));
        needed(hash, "hash") = dynamic_waves_hash_of(*ocean->shown);
    });
}

pelagic_status pelagic_ocean_save_water(const pelagic_ocean* ocean, uint8_t* bytes, size_t room, size_t* count) {
    return guarded([&] {
        need_no_frame_in_flight(needed(ocean, "ocean"));
        write_saved(ocean->ocean.saved_water(), bytes, room, count);
    });
}

pelagic_status pelagic_ocean_restore_water(pelagic_ocean* ocean, const uint8_t* bytes, size_t count) {
    return guarded([&] {
        need_no_frame_in_flight(needed(ocean, "ocean"));
        if (count > 0) needed(bytes, "bytes");
        ocean->ocean.restore_water({bytes, count});
    });
}
