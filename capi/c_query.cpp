#include <limits>

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/surface_ray.hpp"

namespace pelagic::capi {

const Frame& needed_frame(const QueryFrames::Reader& reader, std::uint64_t number) {
    if (reader.frame()) return *reader.frame();
    if (number == 0) throw WrongOrder("there is no frame yet; call pelagic_ocean_complete first");
    throw WrongOrder("frame " + number_text(number) + " is not in memory, expected one of the last two");
}

const SurfaceQuery& needed_query(const pelagic_ocean& ocean, const QueryFrames::Reader& reader, std::uint64_t number) {
    if (!ocean.ocean.contents().queries)
        reject("the ocean cannot be queried: it was created without pelagic_ocean_options.queries");
    needed_frame(reader, number);
    return *reader.query();
}

namespace {

Interpolation interpolation_of(const pelagic_points& points) {
    switch (points.interpolation) {
        case PELAGIC_INTERPOLATION_LINEAR: return Interpolation::linear;
        case PELAGIC_INTERPOLATION_CUBIC: return Interpolation::cubic;
        default:
            reject(invalid_value_message("points.interpolation", points.interpolation,
                                         "PELAGIC_INTERPOLATION_LINEAR (0) or _CUBIC (1)"));
    }
}

double tolerance_of(double tolerance_m, const SurfaceQuery& query) {
    if (tolerance_m == 0) return query.tolerance_m();
    if (!(tolerance_m >= 1e-6 && tolerance_m <= 1000))
        reject(invalid_value_message("tolerance_m", tolerance_m, "0 or [1e-6, 1000]"));
    return tolerance_m;
}

SurfacePoints points_of(const pelagic_points& points) {
    // The largest count whose size in bytes fits ptrdiff_t; no array in memory is larger.
    constexpr std::size_t max = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);
    if (points.count > max)
        reject(invalid_value_message("points.count", points.count, "at most " + number_text(max)));
    if (points.count == 0) return {};
    return {.x = {&needed(points.x, "points.x"), points.count}, .z = {&needed(points.z, "points.z"), points.count}};
}

SurfaceSamples samples_of(const pelagic_samples& samples, std::size_t count) {
    const auto array = [count]<class T>(T* data) { return data ? std::span<T>(data, count) : std::span<T>(); };
    return {.height_m = array(samples.height_m),
            .normal_x = array(samples.normal_x),
            .normal_y = array(samples.normal_y),
            .normal_z = array(samples.normal_z),
            .jacobian = array(samples.jacobian),
            .velocity_x_mps = array(samples.velocity_x_mps),
            .velocity_y_mps = array(samples.velocity_y_mps),
            .velocity_z_mps = array(samples.velocity_z_mps),
            .error_m = array(samples.error_m),
            .converged = array(samples.converged),
            .foam = array(samples.foam)};
}

SurfaceRay ray_of(const pelagic_ray& ray, const Frame& frame) {
    const SurfaceRay ours{.origin_m = {ray.origin_m[0], ray.origin_m[1], ray.origin_m[2]},
                          .direction = {ray.direction[0], ray.direction[1], ray.direction[2]},
                          .reach_m = ray.reach_m};
    if (const std::string reason = check(ours, frame); !reason.empty()) reject("ray." + reason);
    return ours;
}

pelagic_hit c_hit_of(const SurfaceHit& found) {
    pelagic_hit hit{};
    hit.is_hit = 1;
    hit.from_below = found.from_below;
    hit.distance_m = found.distance_m;
    for (std::size_t i = 0; i < 3; ++i) {
        hit.normal[i] = found.normal[i];
        hit.position_m[i] = found.position_m[i];
    }
    return hit;
}

}  // namespace
}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_ocean_query(const pelagic_ocean* ocean, const pelagic_points* points,
                                   const pelagic_samples* samples) {
    return guarded([&] {
        const pelagic_points ours = read_struct(points, "points");
        const QueryFrames::Reader reader(needed(ocean, "ocean").query_frames, ours.frame);
        const SurfaceQuery& original = needed_query(*ocean, reader, ours.frame);
        const SurfaceQuery query(original.frame(), {.tolerance_m = tolerance_of(ours.tolerance_m, original),
                                                  .interpolation = interpolation_of(ours)});
        const SurfacePoints where = points_of(ours);
        const SurfaceSamples to = samples_of(read_struct(samples, "samples"), where.x.size());
        if (ours.parallel != 0)
            ocean->query_batches.sample(ocean->executor, query, where, to);
        else
            query.sample(where, to);
    });
}

pelagic_status pelagic_ocean_first_hit(const pelagic_ocean* ocean, const pelagic_ray* ray, pelagic_hit* hit) {
    return guarded([&] {
        const pelagic_ray theirs = read_struct(ray, "ray");
        const QueryFrames::Reader reader(needed(ocean, "ocean").query_frames, theirs.frame);
        const SurfaceQuery& original = needed_query(*ocean, reader, theirs.frame);
        const SurfaceQuery query(original.frame(), tolerance_of(theirs.tolerance_m, original));
        const SurfaceRay ours = ray_of(theirs, query.frame());
        pelagic_hit& out = needed(hit, "hit");
        const std::optional<SurfaceHit> found = first_hit(query, ours);
        out = found ? c_hit_of(*found) : pelagic_hit{};
    });
}
