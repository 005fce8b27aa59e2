#include "pelagic/sim/water_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "pelagic/sim/buffers/shore_at.hpp"
#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/query/query_chunks.hpp"
#include "pelagic/sim/query/water_sampler.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

using Vector3 = std::array<double, 3>;

void put(std::span<float> to, std::size_t i, double value) {
    if (!to.empty()) to[i] = static_cast<float>(value);
}

}  // namespace

WaterQuery::WaterQuery(const Frame& frame, const WaterQueryOptions& options)
    : WaterKinematics(options.water_density_kgpm3, frame.time_s), surface_(frame, options.surface) {
    for (const Cascade& cascade : frame.cascades)
        if (!cascade.water.has_depth() && frame.sea.waves != WaveModel::pond)
            throw std::invalid_argument(
                "the frame has no water below its surface: the ocean was created without OceanOptions::depth");
}

void WaterQuery::sample(const WaterPoints& points, const WaterSamples& samples) const {
    require_valid(points, samples);
    const DefaultFloatEnvironment environment;
    const Frame& frame = surface_.frame();
    const std::span<const Cascade> cascades = frame.cascades;
    const WaterFrame::Origin& origin = surface_.origin_;
    const Interpolation interpolation = surface_.options_.interpolation;
    const double water_m = frame.sea.depth_m, pascals_per_m = water_density_kgpm3() * gravity_mps2;
    const bool has_slopes = !samples.acceleration_x_mps2.empty() || !samples.acceleration_z_mps2.empty();
    const WaterDerivatives wanted = has_slopes                             ? WaterDerivatives::all
                                    : !samples.acceleration_y_mps2.empty() ? WaterDerivatives::down
                                                                           : WaterDerivatives::none;
    std::array<SurfaceTexels, max_cascades> planes;
    std::transform(cascades.begin(), cascades.end(), planes.begin(), texels_of);
    // the coarsest cascades, which hold waves as long as the footprint
    std::size_t held = cascades.size();
    if (points.whole_cascades)
        while (held > 1 && cascades[held - 1].water.longest_wave_m < points.footprint_m) --held;
    const bool is_filtered = points.footprint_m > 0 && !points.whole_cascades && cascades[0].water.has_depth();
    std::array<LevelSums, max_cascades> at_surface;
    if (is_filtered)
        for (std::size_t t = 0; t < held; ++t) at_surface[t] = sums_without(cascades[t], points.footprint_m);
    surface_.for_each_chunk({points.x, points.z}, [&](const auto& query, PointChunk& chunk, bool) {
        SampleSurfaceJob::Outputs outputs{};
        outputs.height = chunk.height;
        query.read(outputs, chunk);
        for (std::size_t i = 0; i < chunk.count; ++i) {
            const std::size_t at = chunk.first + i;
            const auto weight = [&](std::size_t cascade) {
                return frame.shore ? static_cast<double>(chunk.weight[cascade][i]) : 1.0;
            };
            if (!surface_.has_sample(points.x[at] - origin.x_m, points.z[at] - origin.z_m) ||
                !std::isfinite(points.y[at])) {
                for (const std::span<float> values :
                     {samples.depth_m, samples.pressure_pa, samples.velocity_x_mps, samples.velocity_y_mps,
                      samples.velocity_z_mps, samples.acceleration_x_mps2, samples.acceleration_y_mps2,
                      samples.acceleration_z_mps2})
                    if (!values.empty()) values[at] = no_sample;
                continue;
            }
            // What does not decrease with depth: dynamic waves and a shore.
            double level_m = 0;
            for (std::size_t t = 0; t < cascades.size(); ++t)
                level_m += weight(t) * static_cast<double>(cascades[t].level_m);
            Vector3 velocity{frame.water_frame.current_x_mps, 0, frame.water_frame.current_z_mps}, gradient{};
            double other_m = 0, dynamic_m = 0;
            if (frame.dynamic_waves) {
                const DynamicWavesSample waves = pelagic::sample(frame.dynamic_waves, chunk.x[i], chunk.z[i]);
                dynamic_m = waves.height_m;
                velocity[1] += waves.vertical_velocity_mps;
                gradient[0] += waves.slope_x;
                gradient[2] += waves.slope_z;
            }
            if (frame.shore) {
                const ShoreAt shore(frame.shore, chunk.x[i], chunk.z[i]);
                if (shore.is_within()) {
                    const ShoreAt::Cubic height = shore.cubic(frame.shore.height_m);
                    const auto [x_mps, z_mps] = shore.velocity();
                    other_m += height.value;
                    gradient[0] += height.along_x;
                    gradient[2] += height.along_z;
                    velocity[0] += x_mps;
                    velocity[1] += shore.cubic(frame.shore.vertical_velocity_mps).value;
                    velocity[2] += z_mps;
                }
            }
            double waves_m = static_cast<double>(chunk.height[i]) - level_m,
                   height_m = static_cast<double>(chunk.height[i]) + other_m;
            for (std::size_t t = held; t < cascades.size(); ++t) {
                const ReferenceCell at_rest = query.reference_cell(t, chunk, i);
                const HeadSample surface = surface_head(planes[t], cascades[t].level_m, at_rest, interpolation);
                const double left_out = weight(t) * static_cast<double>(surface.value);
                height_m -= left_out;
                waves_m -= left_out;
            }
            for (std::size_t t = 0; is_filtered && t < held; ++t) {
                const ReferenceCell at_rest = query.reference_cell(t, chunk, i);
                const HeadSample surface = surface_head(planes[t], cascades[t].level_m, at_rest, interpolation);
                const WaterMotion kept = motion_of(cascades[t], at_surface[t], at_rest, surface, false);
                const double left_out = weight(t) * static_cast<double>(surface.value - kept.head.value);
                height_m -= left_out;
                waves_m -= left_out;
            }
            // The cascades' waves do not feel the hollow that a hull presses into dynamic waves.
            const double y = points.y[at] - origin.y_m, depth_m = height_m + dynamic_m - y;
            const double stretched_m = std::clamp(
                (height_m - y) * (water_m / std::max(water_m + height_m, 0.01 * water_m)), 0.0, water_m);
            // At the surface and above it the head is its height.
            const bool is_below = stretched_m > 0 || is_filtered || wanted != WaterDerivatives::none;
            double head_m = is_below ? 0 : waves_m;
            for (std::size_t t = 0; t < held; ++t) {
                const Cascade& cascade = cascades[t];
                const ReferenceCell at_rest = query.reference_cell(t, chunk, i);
                if (!is_below && cascade.water.has_depth()) {
                    const std::array<float, 3> at_surface = surface_velocity(cascade, at_rest);
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        velocity[axis] += weight(t) * static_cast<double>(at_surface[axis]);
                    continue;
                }
                const HeadSample surface = surface_head(planes[t], cascade.level_m, at_rest, interpolation);
                // the waves of a pond have no levels
                const WaterMotion motion =
                    is_filtered ? motion_of(cascade, sums_below(cascade, at_surface[t], stretched_m), at_rest,
                                            surface, has_slopes)
                    : cascade.water.has_depth() ? motion_at(cascade, stretched_m, at_rest, surface, wanted)
                        : WaterMotion{.velocity_mps = {}, .head = surface};
                head_m += weight(t) * static_cast<double>(motion.head.value);
                for (std::size_t axis = 0; axis < 3; ++axis)
                    velocity[axis] += weight(t) * static_cast<double>(motion.velocity_mps[axis]);
                gradient[1] -= weight(t) * static_cast<double>(motion.head.down);
                if (!has_slopes) continue;
                const auto [x, z] = cascade.grid.in_world(static_cast<double>(motion.head.along) / cascade.texel_m(),
                                                          static_cast<double>(motion.head.across) / cascade.texel_m());
                gradient[0] += weight(t) * x;
                gradient[2] += weight(t) * z;
            }
            put(samples.depth_m, at, depth_m);
            // The sum is the depth at the surface, without rounding errors of the waves' sums.
            put(samples.pressure_pa, at, pascals_per_m * (depth_m + (head_m - waves_m)));
            put(samples.velocity_x_mps, at, velocity[0]);
            put(samples.velocity_y_mps, at, velocity[1]);
            put(samples.velocity_z_mps, at, velocity[2]);
            put(samples.acceleration_x_mps2, at, -gravity_mps2 * gradient[0]);
            put(samples.acceleration_y_mps2, at, -gravity_mps2 * gradient[1]);
            put(samples.acceleration_z_mps2, at, -gravity_mps2 * gradient[2]);
        }
    });
}

}  // namespace pelagic
