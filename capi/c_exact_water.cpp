// C interface of the exact sum over waves.
#include "pelagic/capi/c_exact_water.hpp"

#include <cstddef>
#include <memory>

#include "pelagic/capi/c_executor.hpp"
#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_sea.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/c_water_points.hpp"
#include "pelagic/capi/idle_jobs.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/sim/water_jobs.hpp"

struct pelagic_exact_water {
    std::shared_ptr<pelagic::Executor> executor;
    pelagic::ExactWater water;
    mutable pelagic::capi::IdleJobs<pelagic::WaterJobs> idle;
};

namespace pelagic::capi {

ExactWaterOptions exact_water_options_of(const pelagic_exact_water_options& from) {
    ExactWaterOptions to;
    // generated from schema/exact_water.toml: c-reads
    to.water_density_kgpm3 = from.water_density_kgpm3;
    // end of generated
    if (from.water_frame) to.water_frame = water_frame_of(from.water_frame);
    if (from.executor) to.executor = from.executor->executor;
    to.isa = isa_of(from.isa);
    return to;
}

namespace {

SurfaceSamples surface_samples_of(const pelagic_samples& from, std::size_t count) {
    const auto array = arrays_of(count);
    return {.height_m = array(from.height_m),
            .normal_x = array(from.normal_x),
            .normal_y = array(from.normal_y),
            .normal_z = array(from.normal_z),
            .jacobian = array(from.jacobian),
            .velocity_x_mps = array(from.velocity_x_mps),
            .velocity_y_mps = array(from.velocity_y_mps),
            .velocity_z_mps = array(from.velocity_z_mps),
            .error_m = array(from.error_m),
            .converged = array(from.converged),
            .foam = array(from.foam)};
}

}  // namespace
}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_exact_water_create(const pelagic_sea* sea, const pelagic_exact_water_options* options,
                                          pelagic_exact_water** water) {
    return guarded([&] {
        pelagic_exact_water*& out = needed(water, "water");
        out = nullptr;
        const ExactWaterOptions wanted = exact_water_options_of(
            options ? read_struct(options, "options") : pelagic_exact_water_options_make());
        const auto executor = wanted.executor ? wanted.executor : make_serial_executor();
        out = new pelagic_exact_water{executor, ExactWater(sea_of(sea), wanted), {}};
    });
}

void pelagic_exact_water_destroy(pelagic_exact_water* water) { delete water; }

pelagic_status pelagic_exact_water_set_time(pelagic_exact_water* water, double time_s) {
    return guarded([&] { needed(water, "water").water.set_time(time_s); });
}

pelagic_status pelagic_exact_water_set_origin(pelagic_exact_water* water, double x_m, double z_m) {
    return guarded([&] { needed(water, "water").water.set_origin(x_m, z_m); });
}

pelagic_status pelagic_exact_water_sample(const pelagic_exact_water* water, const pelagic_water_points* points,
                                          const pelagic_water_samples* samples) {
    return guarded([&] {
        const pelagic_exact_water& ours = needed(water, "water");
        const pelagic_water_points where = read_struct(points, "points");
        const WaterPoints at = water_points_of(where);
        const WaterSamples to = water_samples_of(read_struct(samples, "samples"), where.count);
        if (where.parallel != 0)
            ours.idle.use(ours.executor, [&](WaterJobs& jobs) { jobs.sample(ours.water, at, to); });
        else
            ours.water.sample(at, to);
    });
}

pelagic_status pelagic_exact_water_sample_surface(const pelagic_exact_water* water, const pelagic_points* points,
                                                  const pelagic_samples* samples) {
    return guarded([&] {
        const pelagic_exact_water& ours = needed(water, "water");
        const pelagic_points where = read_struct(points, "points");
        check_count(where.count);
        const SurfacePoints at{.x = positions_of(where.x, "points.x", where.count),
                               .z = positions_of(where.z, "points.z", where.count),
                               .footprint_m = footprint_of(where.footprint_m)};
        const SurfaceSamples to = surface_samples_of(read_struct(samples, "samples"), where.count);
        if (where.parallel != 0)
            ours.idle.use(ours.executor, [&](WaterJobs& jobs) { jobs.sample_surface(ours.water, at, to); });
        else
            ours.water.sample_surface(at, to);
    });
}
