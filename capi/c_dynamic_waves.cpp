// C interface of dynamic waves.
#include "pelagic/capi/c_dynamic_waves.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "pelagic/capi/c_executor.hpp"
#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::capi {
namespace {

// generated from schema/dynamic_waves.toml: c-checks
static_assert(PELAGIC_DYNAMIC_WAVES_SPECTRAL == static_cast<int>(DynamicWavesStep::spectral));
static_assert(PELAGIC_DYNAMIC_WAVES_VERLET == static_cast<int>(DynamicWavesStep::verlet));
// end of generated
// generated from schema/disturbance.toml: c-checks
static_assert(PELAGIC_SHAPE_GAUSS == static_cast<int>(Disturbance::Shape::gauss));
static_assert(PELAGIC_SHAPE_HULL == static_cast<int>(Disturbance::Shape::hull));
static_assert(PELAGIC_DISTURBANCE_PRESSURE == static_cast<int>(Disturbance::Mode::pressure));
static_assert(PELAGIC_DISTURBANCE_RELAXATION == static_cast<int>(Disturbance::Mode::relaxation));
static_assert(PELAGIC_DISTURBANCE_IMPULSE == static_cast<int>(Disturbance::Mode::impulse));
static_assert(PELAGIC_DISTURBANCE_FOAM == static_cast<int>(Disturbance::Mode::foam));
// end of generated

DynamicWaves& needed_waves(pelagic_dynamic_waves* waves) { return *needed(waves, "waves").waves; }

/// \pre waves is not null
void need_no_frame_of_ocean(const pelagic_dynamic_waves& waves) {
    if (waves.ocean) need_no_frame_in_flight(*waves.ocean);
}

const DynamicWavesView& shown_view(const pelagic_dynamic_waves* waves) {
    const DynamicWavesView& view = needed(waves, "waves").waves->view();
    if (!view)
        throw WrongOrder("there are no waves yet; call pelagic_dynamic_waves_advance or complete a frame first");
    return view;
}

DynamicWaves::Resources resources_of(const pelagic_dynamic_waves_resources* pointer) {
    if (!pointer) return {};
    const pelagic_dynamic_waves_resources from = read_struct(pointer, "resources");
    DynamicWaves::Resources resources;
    if (from.executor) resources.executor = from.executor->executor;
    resources.isa = isa_of(from.isa);
    resources.memory = allocator_of(from.allocate, from.release, from.memory_user);
    return resources;
}

}  // namespace

Disturbance disturbance_of(const pelagic_disturbance* pointer, const char* name) {
    const pelagic_disturbance from = read_struct(pointer, name);
    Disturbance to;
    constexpr std::string_view prefix = "";
    // generated from schema/disturbance.toml: c-reads
    to.shape = enum_of<Disturbance::Shape>(from.shape, prefix, "shape", "one of PELAGIC_SHAPE_...");
    to.mode = enum_of<Disturbance::Mode>(from.mode, prefix, "mode", "one of PELAGIC_DISTURBANCE_...");
    to.x_m = from.x_m;
    to.z_m = from.z_m;
    to.radius_m = from.radius_m;
    to.length_m = from.length_m;
    to.heading_rad = from.heading_rad;
    to.height_m = from.height_m;
    to.rate_per_s = from.rate_per_s;
    to.velocity_x_mps = from.velocity_x_mps;
    to.velocity_z_mps = from.velocity_z_mps;
    // end of generated
    return to;
}

Rain rain_of(const pelagic_rain* rain) {
    const pelagic_rain from = read_struct(rain, "rain");
    Rain to;
    // generated from schema/rain.toml: c-reads
    to.drops_per_m2_s = from.drops_per_m2_s;
    to.radius_m = from.radius_m;
    to.height_m = from.height_m;
    to.seed = from.seed;
    // end of generated
    return to;
}

DynamicWavesOptions dynamic_waves_options_of(const pelagic_dynamic_waves_options* options) {
    const pelagic_dynamic_waves_options from = read_struct(options, "dynamic_waves");
    DynamicWavesOptions to;
    constexpr std::string_view prefix = "dynamic_waves.";
    // generated from schema/dynamic_waves.toml: c-reads
    to.step = enum_of<DynamicWavesStep>(from.step, prefix, "step", "one of PELAGIC_DYNAMIC_WAVES_...");
    to.resolution = from.resolution;
    to.side_m = from.side_m;
    to.ticks_per_s = from.ticks_per_s;
    to.border_m = from.border_m;
    to.depth_m = from.depth_m;
    to.viscosity_m2ps = from.viscosity_m2ps;
    to.wave_speed_mps = from.wave_speed_mps;
    to.decay_per_s = from.decay_per_s;
    to.foam_height_m = from.foam_height_m;
    // end of generated
    if (const std::string reason = check(to); !reason.empty()) reject(std::string(prefix) + reason);
    return to;
}

}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_dynamic_waves_create(const pelagic_dynamic_waves_options* options,
                                            const pelagic_dynamic_waves_resources* resources,
                                            pelagic_dynamic_waves** waves) {
    return guarded([&] {
        pelagic_dynamic_waves*& out = needed(waves, "waves");
        out = nullptr;
        auto own = std::make_unique<DynamicWaves>(dynamic_waves_options_of(options), resources_of(resources));
        DynamicWaves* const made = own.get();
        out = new pelagic_dynamic_waves{std::move(own), made, nullptr};
    });
}

void pelagic_dynamic_waves_destroy(pelagic_dynamic_waves* waves) {
    if (waves && waves->own) delete waves;
}

pelagic_status pelagic_ocean_dynamic_waves(pelagic_ocean* ocean, pelagic_dynamic_waves** waves) {
    return guarded([&] {
        pelagic_dynamic_waves*& out = needed(waves, "waves");
        out = nullptr;
        needed(ocean, "ocean").ocean.dynamic_waves();  // throws without dynamic waves
        out = &ocean->dynamic_waves;
    });
}

pelagic_status pelagic_dynamic_waves_add_impulse(pelagic_dynamic_waves* waves,
                                                 const pelagic_disturbance* disturbance) {
    return guarded([&] { needed_waves(waves).add_impulse(disturbance_of(disturbance, "disturbance")); });
}

pelagic_status pelagic_dynamic_waves_add_source(pelagic_dynamic_waves* waves, const pelagic_disturbance* source,
                                                uint32_t* number) {
    return guarded([&] {
        DynamicWaves& ours = needed_waves(waves);
        std::uint32_t& out = needed(number, "number");
        out = ours.add_source(disturbance_of(source, "source"));
    });
}

pelagic_status pelagic_dynamic_waves_set_source(pelagic_dynamic_waves* waves, uint32_t number,
                                                const pelagic_disturbance* source) {
    return guarded([&] { needed_waves(waves).set_source(number, disturbance_of(source, "source")); });
}

pelagic_status pelagic_dynamic_waves_remove_source(pelagic_dynamic_waves* waves, uint32_t number) {
    return guarded([&] { needed_waves(waves).remove_source(number); });
}

pelagic_status pelagic_dynamic_waves_set_center(pelagic_dynamic_waves* waves, double x_m, double z_m) {
    return guarded([&] { needed_waves(waves).set_center(x_m, z_m); });
}

pelagic_status pelagic_dynamic_waves_set_current(pelagic_dynamic_waves* waves, double x_mps, double z_mps) {
    return guarded([&] { needed_waves(waves).set_current(x_mps, z_mps); });
}

pelagic_status pelagic_dynamic_waves_advance(pelagic_dynamic_waves* waves, double time_s) {
    return guarded([&] {
        DynamicWaves& ours = needed_waves(waves);
        if (waves->ocean)
            throw WrongOrder("an ocean advances these waves, expected waves of pelagic_dynamic_waves_create");
        if (!std::isfinite(time_s)) reject(invalid_value_message("time_s", time_s, "a finite number"));
        ours.advance(time_s);
    });
}

pelagic_status pelagic_dynamic_waves_set_rain(pelagic_dynamic_waves* waves, const pelagic_rain* rain) {
    return guarded([&] {
        const Rain ours = rain_of(rain);
        needed_waves(waves).set_rain(ours);
    });
}

pelagic_status pelagic_dynamic_waves_get_view(const pelagic_dynamic_waves* waves, pelagic_dynamic_waves_view* view) {
    return guarded([&] {
        const DynamicWavesView& ours = shown_view(waves);
        pelagic_dynamic_waves_view& out = needed(view, "view");
        out.resolution = ours.resolution;
        out.first_x = ours.first_x;
        out.first_z = ours.first_z;
        out.texel_m = ours.texel_m;
        out.height_m = ours.height_m.data();
        out.vertical_velocity_mps = ours.vertical_velocity_mps.data();
        out.foam = ours.foam.data();
        out.height_min_m = ours.bounds.height_min_m;
        out.height_max_m = ours.bounds.height_max_m;
    });
}

pelagic_status pelagic_dynamic_waves_hash(const pelagic_dynamic_waves* waves, uint64_t* hash) {
    return guarded([&] {
        const DynamicWavesView& view = shown_view(waves);
        needed(hash, "hash") = hash_of(view);
    });
}

pelagic_status pelagic_dynamic_waves_save_state(const pelagic_dynamic_waves* waves, uint8_t* bytes, size_t room,
                                                size_t* count) {
    return guarded([&] {
        need_no_frame_of_ocean(needed(waves, "waves"));
        write_saved(waves->waves->save_state(), bytes, room, count);
    });
}

pelagic_status pelagic_dynamic_waves_restore_state(pelagic_dynamic_waves* waves, const uint8_t* bytes, size_t count) {
    return guarded([&] {
        need_no_frame_of_ocean(needed(waves, "waves"));
        if (count > 0) needed(bytes, "bytes");
        waves->waves->restore_state({bytes, count});
    });
}
