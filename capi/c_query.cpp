// C interface of queries.
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/c_water_points.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/surface_ray.hpp"

namespace pelagic::capi {

const Frame& needed_frame(const QueryFrames::Reader& reader, std::uint64_t number) {
    if (reader.frame()) return *reader.frame();
    if (number == 0) throw WrongOrder("there is no frame yet; call pelagic_ocean_complete first");
    throw WrongOrder("frame " + number_text(number) + " is not in memory, expected one of the last two");
}

namespace {

void need_queries(const pelagic_ocean& ocean) {
    if (!ocean.ocean.contents().queries)
        reject("the ocean cannot be queried: it was created without pelagic_ocean_options.queries");
}

Interpolation interpolation_of(std::int32_t interpolation) {
    switch (interpolation) {
        case PELAGIC_INTERPOLATION_LINEAR: return Interpolation::linear;
        case PELAGIC_INTERPOLATION_CUBIC: return Interpolation::cubic;
        default:
            reject(invalid_value_message("points.interpolation", interpolation,
                                         "PELAGIC_INTERPOLATION_LINEAR (0) or _CUBIC (1)"));
    }
}

double tolerance_of(double tolerance_m, const pelagic_ocean& ocean) {
    if (tolerance_m == 0) return ocean.query_tolerance_m;
    if (!(tolerance_m >= 1e-6 && tolerance_m <= 1000))
        reject(invalid_value_message("tolerance_m", tolerance_m, "0 or [1e-6, 1000]"));
    return tolerance_m;
}

SurfacePoints points_of(const pelagic_ocean& ocean, const pelagic_points& points) {
    // The largest count whose size in bytes fits ptrdiff_t; no array in memory is larger.
    constexpr std::size_t max = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);
    if (points.count > max)
        reject(invalid_value_message("points.count", points.count, "at most " + number_text(max)));
    const double footprint_m = footprint_of(points.footprint_m);
    if (footprint_m > 0 && !ocean.ocean.contents().depth)
        reject("points.footprint_m needs an ocean that was created with pelagic_ocean_options.depth");
    if (points.count == 0) return {};
    return {.x = {&needed(points.x, "points.x"), points.count},
            .z = {&needed(points.z, "points.z"), points.count},
            .footprint_m = footprint_m};
}

/// Returns the elements [first, first + count) of the arrays.
SurfaceSamples samples_of(const pelagic_samples& samples, std::size_t first, std::size_t count) {
    const auto array = [=]<class T>(T* data) { return data ? std::span<T>(data + first, count) : std::span<T>(); };
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

/// Queries of some points, with the options of `points`.
class PointQuery {
   public:
    /// Throws std::invalid_argument.
    PointQuery(const pelagic_ocean& ocean, const pelagic_points& points, const pelagic_samples& samples)
        : ocean_(ocean),
          options_(query_options_of(ocean, points.tolerance_m, points.interpolation)),
          points_(points_of(ocean, points)),
          samples_(samples),
          is_parallel_(points.parallel != 0) {}
    /// Writes the results of a frame from element `first` on.
    void sample(const Frame& frame, std::size_t first) const {
        const SurfaceQuery query(frame, options_);
        const SurfaceSamples to = samples_of(samples_, first, points_.x.size());
        if (is_parallel_)
            ocean_.idle_queries.use(ocean_.executor,
                                    [&](SurfaceQueryJobs& jobs) { jobs.sample(query, points_, to); });
        else
            query.sample(points_, to);
    }
    std::size_t point_count() const { return points_.x.size(); }

   private:
    const pelagic_ocean& ocean_;
    SurfaceQueryOptions options_;
    SurfacePoints points_;
    pelagic_samples samples_;
    bool is_parallel_;
};

/// The times of frames: those of a series and, unless null, of the frame that it leaves in flight.
struct SeriesTimes {
    std::span<const double> all;
    const double* next_s;
    const double* at(std::size_t i) const { return i < all.size() ? &all[i] : next_s; }
};

SeriesTimes times_of(const double* times_s, std::size_t count, const double* next_s) {
    SeriesTimes times{.all = {}, .next_s = next_s};
    if (count > 0) times.all = {&needed(times_s, "times_s"), count};
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(times_s[i]))
            reject(invalid_value_message("times_s[" + number_text(i) + "]", times_s[i], "a finite number"));
    if (next_s && !std::isfinite(*next_s)) reject(invalid_value_message("next_s", *next_s, "a finite number"));
    return times;
}

/// Starts the first frame, unless it is in flight.
void begin_series(pelagic_ocean& ocean, const SeriesTimes& times) {
    const double* const first_s = times.at(0);
    if (ocean.frame_in_flight && !(first_s && *first_s == ocean.scheduled_s))
        throw WrongOrder("the frame of " + number_text(ocean.scheduled_s) +
                         " s is in flight; call pelagic_ocean_complete first");
    if (first_s && !ocean.frame_in_flight) schedule_frame(ocean, *first_s);
}

/// Samples the frames of a series, of which the first is in flight. Returns the number of the last.
std::uint64_t sample_series(pelagic_ocean& ocean, const SeriesTimes& times, const PointQuery& query) {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < times.all.size(); ++i) {
        number = complete_frame(ocean);
        const Frame& frame = *ocean.current;
        if (const double* const next_s = times.at(i + 1)) schedule_frame(ocean, *next_s);
        query.sample(frame, i * query.point_count());
    }
    return number;
}

/// Completes the frame in flight after an error, which it keeps.
void abandon_series(pelagic_ocean& ocean) noexcept {
    try {
        if (ocean.frame_in_flight) complete_frame(ocean);
    } catch (...) {  // the first error is the one to report
    }
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

SurfaceQueryOptions query_options_of(const pelagic_ocean& ocean, double tolerance_m, std::int32_t interpolation) {
    return {.tolerance_m = tolerance_of(tolerance_m, ocean), .interpolation = interpolation_of(interpolation)};
}

const SurfaceQuery& needed_query(const pelagic_ocean& ocean, const QueryFrames::Reader& reader, std::uint64_t number) {
    need_queries(ocean);
    needed_frame(reader, number);
    return *reader.query();
}

}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_ocean_query(const pelagic_ocean* ocean, const pelagic_points* points,
                                   const pelagic_samples* samples) {
    return guarded([&] {
        const pelagic_points where = read_struct(points, "points");
        const QueryFrames::Reader reader(needed(ocean, "ocean").query_frames, where.frame);
        const Frame& frame = needed_query(*ocean, reader, where.frame).frame();
        PointQuery(*ocean, where, read_struct(samples, "samples")).sample(frame, 0);
    });
}

pelagic_status pelagic_ocean_query_series(pelagic_ocean* ocean, const double* times_s, size_t time_count,
                                          const double* next_s, const pelagic_points* points,
                                          const pelagic_samples* samples, pelagic_frame* frame) {
    return guarded([&] {
        need_queries(needed(ocean, "ocean"));
        const pelagic_points where = read_struct(points, "points");
        if (where.frame != 0) reject(invalid_value_message("points.frame", where.frame, "0"));
        const PointQuery query(*ocean, where, read_struct(samples, "samples"));
        const SeriesTimes times = times_of(times_s, time_count, next_s);
        begin_series(*ocean, times);
        try {
            const std::uint64_t number = sample_series(*ocean, times, query);
            if (frame && number != 0) *frame = c_frame_of(*ocean, number);
        } catch (...) {
            abandon_series(*ocean);
            throw;
        }
    });
}

pelagic_status pelagic_ocean_first_hit(const pelagic_ocean* ocean, const pelagic_ray* ray, pelagic_hit* hit) {
    return guarded([&] {
        const pelagic_ray theirs = read_struct(ray, "ray");
        const QueryFrames::Reader reader(needed(ocean, "ocean").query_frames, theirs.frame);
        const SurfaceQuery& original = needed_query(*ocean, reader, theirs.frame);
        const SurfaceQuery query(original.frame(), tolerance_of(theirs.tolerance_m, *ocean));
        const SurfaceRay ours = ray_of(theirs, query.frame());
        pelagic_hit& out = needed(hit, "hit");
        const std::optional<SurfaceHit> found = first_hit(query, ours);
        out = found ? c_hit_of(*found) : pelagic_hit{};
    });
}
