// A batch is processed in chunks. OneCascadeQuery or StackQuery finds the reference points of a
// chunk.
#include "pelagic/sim/surface_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/buffers/shore_at.hpp"
#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/query/query_chunks.hpp"
#include "pelagic/sim/query/water_sampler.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

const Cascade& finest_of(const Frame& frame) {
    if (frame.cascades.empty())
        throw std::invalid_argument("the frame has no cascades, expected a frame of an ocean");
    return frame.cascades.back();
}

bool has_velocity(const SurfaceSamples& samples) {
    return !samples.velocity_x_mps.empty() || !samples.velocity_y_mps.empty() || !samples.velocity_z_mps.empty();
}

bool has_normal(const SurfaceSamples& samples) {
    return !samples.normal_x.empty() || !samples.normal_y.empty() || !samples.normal_z.empty();
}

/// Returns only the outputs that the samples need.
SampleSurfaceJob::Outputs outputs_of(const SurfaceSamples& samples, PointChunk& chunk) {
    const bool has_slopes = has_normal(samples) || !samples.jacobian.empty();
    SampleSurfaceJob::Outputs out = {};
    if (has_slopes || !samples.height_m.empty()) out.height = chunk.height;
    if (has_slopes) {
        out.normal_x = chunk.normal_x;
        out.normal_y = chunk.normal_y;
        out.normal_z = chunk.normal_z;
        out.jacobian = chunk.jacobian;
    }
    if (has_velocity(samples)) {
        out.velocity_x = chunk.velocity_x;
        out.velocity_y = chunk.velocity_y;
        out.velocity_z = chunk.velocity_z;
    }
    return out;
}

}  // namespace

SurfaceQuery::SurfaceQuery(const Frame& frame, const SurfaceQueryOptions& options)
    : kernels_(&kernels_for(frame.isa)),
      frame_(frame),
      origin_(frame.water_frame.origin_at(frame.time_s)),
      bounds_(frame.bounds),
      texel_m_(finest_of(frame).texel_m()),
      options_(options),
      tolerance_m_(static_cast<float>(options.tolerance_m)) {
    if (!(options.tolerance_m > 0))
        throw std::invalid_argument(
            invalid_value_message("tolerance_m", options.tolerance_m, "a number above 0"));
    for (const Cascade& cascade : frame.cascades)
        if (cascade.folds.empty() && cascade.contraction.empty())
            throw std::invalid_argument(
                "the frame cannot be queried: the ocean was created without OceanOptions::queries");
    for (float FrameBounds::*const height : {&FrameBounds::height_min_m, &FrameBounds::height_max_m})
        bounds_.*height = static_cast<float>(static_cast<double>(bounds_.*height) + origin_.y_m);
}

SurfaceQuery SurfaceQuery::with(Interpolation interpolation) const {
    SurfaceQuery other = *this;
    other.options_.interpolation = interpolation;
    return other;
}

void SurfaceQuery::check(const SurfaceSamples& wanted) const {
    if (has_velocity(wanted) && !has_velocities())
        throw std::invalid_argument(
            "the frame has no velocities: the ocean was created without OceanOptions::velocities");
    if (!wanted.foam.empty() && !has_foam())
        throw std::invalid_argument("the frame has no foam: the ocean was created without OceanOptions::foam");
}

void SurfaceQuery::check(const SurfacePoints& points, const SurfaceSamples& wanted) const {
    const std::size_t count = points.x.size();
    const auto need = [count](const char* name, std::size_t size, const char* else_accepted) {
        if (size != count)
            throw std::invalid_argument(std::string(name) + " has " + number_text(size) + " elements, expected " +
                                        number_text(count) + else_accepted);
    };
    const auto need_room = [&](const char* name, const auto& span) {
        if (!span.empty()) need(name, span.size(), " or none");
    };
    need("z", points.z.size(), ", as x has");
    need_room("height_m", wanted.height_m);
    need_room("normal_x", wanted.normal_x);
    need_room("normal_y", wanted.normal_y);
    need_room("normal_z", wanted.normal_z);
    need_room("jacobian", wanted.jacobian);
    need_room("velocity_x_mps", wanted.velocity_x_mps);
    need_room("velocity_y_mps", wanted.velocity_y_mps);
    need_room("velocity_z_mps", wanted.velocity_z_mps);
    need_room("error_m", wanted.error_m);
    need_room("converged", wanted.converged);
    need_room("foam", wanted.foam);
    check(wanted);
    require_footprint(points.footprint_m);
    if (points.footprint_m > 0 && !frame_.cascades.front().water.has_depth() && frame_.sea.waves != WaveModel::pond)
        throw std::invalid_argument(
            "footprint_m needs water below the surface: the ocean was created without OceanOptions::depth");
}

void SurfaceQuery::sample(const SurfacePoints& points, const SurfaceSamples& samples) const {
    check(points, samples);
    const DefaultFloatEnvironment environment;
    const bool is_filtered = points.footprint_m > 0 && frame_.cascades.front().water.has_depth();
    const bool has_drawn = !is_filtered && frame_.cascades.front().velocity_y.data != nullptr;
    std::array<LevelSums, max_cascades> sums;
    for (std::size_t t = 0; is_filtered && t < frame_.cascades.size(); ++t)
        sums[t] = sums_without(frame_.cascades[t], points.footprint_m);
    for_each_chunk(points, [&](const auto& query, PointChunk& chunk, bool all_have_samples) {
        SampleSurfaceJob::Outputs outputs = outputs_of(samples, chunk);
        if (!has_drawn) outputs.velocity_x = outputs.velocity_y = outputs.velocity_z = nullptr;
        if (is_filtered)
            read_without(std::span(sums).first(frame_.cascades.size()), query, chunk);
        else
            query.read(outputs, chunk);
        if (!is_filtered && !has_drawn && has_velocity(samples)) read_water_velocities(query, chunk);
        if (!samples.foam.empty()) {
            const std::span<float> foam = samples.foam.subspan(chunk.first, chunk.count);
            if (cascades_have_foam())
                query.read_foam(chunk, foam);
            else
                std::fill(foam.begin(), foam.end(), 0.f);
        }
        write_samples(samples, chunk);
        if (frame_.dynamic_waves || frame_.shore) add_dynamic_waves_and_shore(samples, chunk);
        if (frame_.water_frame != WaterFrame{}) move_to_world(samples, chunk);
        if (!all_have_samples) remove_missing(points, samples, chunk);
    });
}

/// Reads the water's own velocity at the surface.
template <class Query>
void SurfaceQuery::read_water_velocities(const Query& query, PointChunk& chunk) const {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        std::array<float, 3> sum{};
        for (std::size_t cascade = 0; cascade < frame_.cascades.size(); ++cascade) {
            const std::array<float, 3> v =
                surface_velocity(frame_.cascades[cascade], query.reference_cell(cascade, chunk, i));
            const float weight = frame_.shore ? chunk.weight[cascade][i] : 1;
            for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += weight * v[axis];
        }
        chunk.velocity_x[i] = sum[0];
        chunk.velocity_y[i] = sum[1];
        chunk.velocity_z[i] = sum[2];
    }
}

template <class Query>
void SurfaceQuery::read_without(std::span<const LevelSums> sums, const Query& query, PointChunk& chunk) const {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        double height_m = 0, slope_x = 0, slope_z = 0;
        std::array<float, 3> velocity{};
        for (std::size_t t = 0; t < sums.size(); ++t) {
            const Cascade& cascade = frame_.cascades[t];
            if (sums[t].is_zero) continue;
            const ReferenceCell at = query.reference_cell(t, chunk, i);
            const HeadSample surface = surface_head(texels_of(cascade), cascade.level_m, at, options_.interpolation);
            const WaterMotion motion = motion_of(cascade, sums[t], at, surface, true);
            const float weight = frame_.shore ? chunk.weight[t][i] : 1;
            const auto slope = cascade.grid.in_world(static_cast<double>(motion.head.along) / cascade.texel_m(),
                                                     static_cast<double>(motion.head.across) / cascade.texel_m());
            height_m += static_cast<double>(weight) * (static_cast<double>(cascade.level_m) +
                                                       static_cast<double>(motion.head.value));
            slope_x += static_cast<double>(weight) * slope.along;
            slope_z += static_cast<double>(weight) * slope.across;
            for (std::size_t axis = 0; axis < 3; ++axis) velocity[axis] += weight * motion.velocity_mps[axis];
        }
        const double length = std::sqrt(1 + slope_x * slope_x + slope_z * slope_z);
        chunk.height[i] = static_cast<float>(height_m);
        chunk.normal_x[i] = static_cast<float>(0 - slope_x / length);
        chunk.normal_y[i] = static_cast<float>(1 / length);
        chunk.normal_z[i] = static_cast<float>(0 - slope_z / length);
        chunk.jacobian[i] = 1;
        chunk.velocity_x[i] = velocity[0];
        chunk.velocity_y[i] = velocity[1];
        chunk.velocity_z[i] = velocity[2];
    }
}

bool SurfaceQuery::has_sample(double x, double z) const {
    const double max_m = max_texels_away * texel_m_;
    return std::fabs(x) <= max_m && std::fabs(z) <= max_m;  // false for NaN
}

bool SurfaceQuery::load_positions(const SurfacePoints& points, PointChunk& chunk) const {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        chunk.x[i] = points.x[chunk.first + i] - origin_.x_m;
        chunk.z[i] = points.z[chunk.first + i] - origin_.z_m;
    }
    std::fill(chunk.x + chunk.count, chunk.x + chunk.padded, 0.0);
    std::fill(chunk.z + chunk.count, chunk.z + chunk.padded, 0.0);
    bool all_have_samples = true;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        if (has_sample(chunk.x[i], chunk.z[i])) continue;
        chunk.x[i] = chunk.z[i] = 0;
        all_have_samples = false;
    }
    return all_have_samples;
}

// Adds dynamic waves and a shore, which are functions of the world position. With the cascades'
// normal n and the slopes s of dynamic waves and shore, the normal of the sum is along (n_x - n_y
// s_x, n_y, n_z - n_y s_z).
void SurfaceQuery::add_dynamic_waves_and_shore(const SurfaceSamples& samples, const PointChunk& chunk) const {
    const auto add = [](std::span<float> to, std::size_t i, double more) {
        if (!to.empty()) to[i] = static_cast<float>(static_cast<double>(to[i]) + more);
    };
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const std::size_t at = chunk.first + i;
        DynamicWavesSample dynamic_waves = pelagic::sample(frame_.dynamic_waves, chunk.x[i], chunk.z[i]);
        if (frame_.shore) {
            const ShoreAt shore(frame_.shore, chunk.x[i], chunk.z[i]);
            if (shore.is_within()) {
                const ShoreAt::Cubic height = shore.cubic(frame_.shore.height_m);
                dynamic_waves.height_m += height.value;
                dynamic_waves.slope_x += height.along_x;
                dynamic_waves.slope_z += height.along_z;
                if (has_velocity(samples)) {
                    dynamic_waves.vertical_velocity_mps += shore.cubic(frame_.shore.vertical_velocity_mps).value;
                    const auto [x_mps, z_mps] = shore.velocity();
                    add(samples.velocity_x_mps, at, x_mps);
                    add(samples.velocity_z_mps, at, z_mps);
                }
                if (!samples.foam.empty()) dynamic_waves.foam = std::max(dynamic_waves.foam, shore.foam());
            }
        }
        add(samples.height_m, at, dynamic_waves.height_m);
        add(samples.velocity_y_mps, at, dynamic_waves.vertical_velocity_mps);
        if (!samples.foam.empty())
            samples.foam[at] = std::max(samples.foam[at], static_cast<float>(dynamic_waves.foam));
        if (!has_normal(samples) || (dynamic_waves.slope_x == 0 && dynamic_waves.slope_z == 0)) continue;
        const double y = static_cast<double>(chunk.normal_y[i]);
        const double x = static_cast<double>(chunk.normal_x[i]) - y * dynamic_waves.slope_x;
        const double z = static_cast<double>(chunk.normal_z[i]) - y * dynamic_waves.slope_z;
        const double length = std::sqrt(x * x + y * y + z * z);
        if (!(length > 0)) continue;
        if (!samples.normal_x.empty()) samples.normal_x[at] = static_cast<float>(x / length);
        if (!samples.normal_y.empty()) samples.normal_y[at] = static_cast<float>(y / length);
        if (!samples.normal_z.empty()) samples.normal_z[at] = static_cast<float>(z / length);
    }
}

void SurfaceQuery::move_to_world(const SurfaceSamples& samples, const PointChunk& chunk) const {
    const auto add = [&](std::span<float> to, double more) {
        if (to.empty() || more == 0) return;
        for (float& value : to.subspan(chunk.first, chunk.count))
            value = static_cast<float>(static_cast<double>(value) + more);
    };
    add(samples.height_m, origin_.y_m);
    add(samples.velocity_x_mps, frame_.water_frame.current_x_mps);
    add(samples.velocity_z_mps, frame_.water_frame.current_z_mps);
}

void SurfaceQuery::write_samples(const SurfaceSamples& samples, const PointChunk& chunk) const {
    const auto copy = [&](std::span<float> to, const float* from) {
        if (!to.empty()) std::memcpy(to.data() + chunk.first, from, chunk.count * sizeof(float));
    };
    copy(samples.height_m, chunk.height);
    copy(samples.normal_x, chunk.normal_x);
    copy(samples.normal_y, chunk.normal_y);
    copy(samples.normal_z, chunk.normal_z);
    copy(samples.jacobian, chunk.jacobian);
    copy(samples.velocity_x_mps, chunk.velocity_x);
    copy(samples.velocity_y_mps, chunk.velocity_y);
    copy(samples.velocity_z_mps, chunk.velocity_z);
    copy(samples.error_m, chunk.error);
    if (!samples.converged.empty())
        for (std::size_t i = 0; i < chunk.count; ++i)
            samples.converged[chunk.first + i] = chunk.error[i] <= tolerance_m_;
}

void SurfaceQuery::remove_missing(const SurfacePoints& points, const SurfaceSamples& samples,
                                  const PointChunk& chunk) const {
    for (std::size_t at = chunk.first; at < chunk.first + chunk.count; ++at) {
        if (has_sample(points.x[at] - origin_.x_m, points.z[at] - origin_.z_m)) continue;
        for (const std::span<float> values :
             {samples.height_m, samples.normal_x, samples.normal_y, samples.normal_z, samples.jacobian,
              samples.velocity_x_mps, samples.velocity_y_mps, samples.velocity_z_mps, samples.foam})
            if (!values.empty()) values[at] = no_sample;
        if (!samples.error_m.empty()) samples.error_m[at] = std::numeric_limits<float>::infinity();
        if (!samples.converged.empty()) samples.converged[at] = 0;
    }
}

}  // namespace pelagic
