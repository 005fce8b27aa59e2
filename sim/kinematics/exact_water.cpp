// A batch is processed in chunks. Each block of waves, which fits the first-level cache, is added to
// all points of a chunk.
#include "pelagic/sim/exact_water.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kinematics/wave_lists.hpp"
#include "pelagic/sim/query/point_chunk.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {
namespace {

/// Decay of a point that receives nothing (SumWaterJob).
constexpr float no_waves = 1e30f;

/// Returns the fraction of a turn of a position, in units of 2^-32.
std::uint32_t turn_of(double position_m, double side_m) {
    const double turns = position_m / side_m, within = turns - std::floor(turns);
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(std::floor(within * 0x1p32 + 0.5)));
}

/// The sea whose waves are summed: a regular wave has the harmonic of a surface that is not displaced.
SeaState undisplaced(SeaState sea) {
    if (sea.waves == WaveModel::regular) sea.choppiness = 0;
    return sea;
}

void require_length(const char* name, std::size_t size, std::size_t count, const char* else_accepted) {
    if (size != count)
        throw std::invalid_argument(std::string(name) + " has " + number_text(size) + " elements, expected " +
                                    number_text(count) + else_accepted);
}

/// \param spans  pairs of a name and a span
void require_lengths(std::size_t count, const auto&... spans) {
    ((spans.second.empty() ? void() : require_length(spans.first, spans.second.size(), count, " or none")), ...);
}

constexpr NumericField<ExactWaterOptions> exact_water_field_table[] = {
    // generated from schema/exact_water.toml: table
    {"water_density_kgpm3", &ExactWaterOptions::water_density_kgpm3, 500, 2000, "[500, 2000]"},
    // end of generated
};

void write(std::span<float> to, std::size_t at, double value) {
    if (!to.empty()) to[at] = static_cast<float>(value);
}

}  // namespace

std::span<const NumericField<ExactWaterOptions>> exact_water_fields() { return exact_water_field_table; }

std::string check(const ExactWaterOptions& options) {
    const std::string reason = check_fields(options, exact_water_field_table);
    return reason.empty() ? check(options.water_frame) : reason;
}

/// What an ExactWater shares with those at other times.
struct ExactWater::Waves {
    Waves(const SeaState& asked, const ExactWaterOptions& options)
        : kernels(kernels_for(choose_isa(options.isa))),
          density_kgpm3(options.water_density_kgpm3),
          loop_period_s(asked.loop_period_s) {
        const SeaState sea = undisplaced(asked);
        const std::shared_ptr<Executor> executor = options.executor ? options.executor : make_serial_executor();
        for (const CascadePlan& plan : plan_cascades(sea)) {
            const CascadeWaves waves(sea, plan);
            depth_m = waves.water().depth_m;
            texel_m = plan.grid.side_m / plan.resolution;
            std::vector<LineOfWaves> lines(static_cast<std::size_t>(plan.resolution) / 2);
            JobGraph graph;
            graph.add({.name = "waves", .count = lines.size(), .body = [&](std::size_t begin, std::size_t end) {
                           const DefaultFloatEnvironment environment;
                           for (std::size_t n = begin; n < end; ++n)
                               lines[n] = line_of_waves(sea, waves, static_cast<int>(n));
                       }});
            executor->prepare(graph)->run();
            cascades.emplace_back(plan.grid, lines);
        }
    }

    const Kernels& kernels;
    double density_kgpm3;
    double loop_period_s;
    double depth_m = 0;
    double texel_m = 0;  ///< of the finest cascade
    std::vector<WaveList> cascades;
};

struct ExactWater::Moment {
    Moment(const Waves& waves, const WaterFrame& water) : frame(water) {
        for (const WaveList& cascade : waves.cascades) moved.emplace_back(cascade);
    }
    std::vector<WaveList::Moved> moved;  ///< of each cascade
    WaterFrame frame;
    WaterFrame::Origin origin;
};

/// Points that are processed together. Lives on the stack.
struct ExactWater::Chunk {
    static constexpr std::size_t capacity = 128;

    std::size_t first = 0, count = 0;
    std::array<bool, capacity> has_sample;
    std::array<double, capacity> x, z;    ///< metres, in the water; 0 without a sample
    std::array<double, capacity> height;  ///< of the surface
    std::array<double, capacity> depth;   ///< s; negative for a point that receives nothing
    /// SumWaterJob::Sum, those of vectors along the world's axes.
    std::array<std::array<double, SumWaterJob::sums>, capacity> sums;

    /// The points in a cascade.
    struct Places {
        Places(const Chunk& chunk, const CascadeGrid& grid) {
            for (std::size_t i = 0; i < chunk.count; ++i) {
                const auto [along, across] = grid.in_cascade(chunk.x[i], chunk.z[i]);
                x[i] = turn_of(along, grid.side_m);
                z[i] = turn_of(across, grid.side_m);
            }
        }
        std::array<std::uint32_t, capacity> x, z;
    };
};

ExactWater::ExactWater(const SeaState& sea, const ExactWaterOptions& options)
    : WaterKinematics(checked(options).water_density_kgpm3, 0) {
    const DefaultFloatEnvironment environment;
    checked(sea);
    if (sea.waves == WaveModel::pond)
        throw std::invalid_argument(
            invalid_value_message("waves", name_of(sea.waves), "spectrum, analytic or regular"));
    waves_ = std::make_shared<const Waves>(sea, options);
    moment_ = std::make_unique<Moment>(*waves_, options.water_frame);
    set_time(0);
}

ExactWater::ExactWater(std::shared_ptr<const Waves> waves, const WaterFrame& water)
    : WaterKinematics(waves->density_kgpm3, 0),
      waves_(std::move(waves)),
      moment_(std::make_unique<Moment>(*waves_, water)) {}

ExactWater::~ExactWater() = default;
ExactWater::ExactWater(ExactWater&&) noexcept = default;
ExactWater& ExactWater::operator=(ExactWater&&) noexcept = default;

double ExactWater::depth_m() const { return waves_->depth_m; }

double ExactWater::floor_m() const { return moment_->origin.y_m - waves_->depth_m; }

std::size_t ExactWater::wave_count() const {
    std::size_t count = 0;
    for (const WaveList& cascade : waves_->cascades) count += cascade.size();
    return count;
}

void ExactWater::set_time(double time_s) {
    const DefaultFloatEnvironment environment(time_s);
    if (!std::isfinite(time_s))
        throw std::invalid_argument(invalid_value_message("time_s", time_s, "a finite number"));
    const LoopFraction fraction = loop_fraction(time_s, waves_->loop_period_s);
    for (std::size_t cascade = 0; cascade < waves_->cascades.size(); ++cascade)
        waves_->kernels.move_waves(waves_->cascades[cascade].move_job(fraction.turns, moment_->moved[cascade]));
    moment_->origin = moment_->frame.origin_at(time_s);
    time_s_ = time_s;
}

void ExactWater::set_origin(double x_m, double z_m) {
    WaterFrame frame = moment_->frame;
    frame.origin_x_m = x_m;
    frame.origin_z_m = z_m;
    require(pelagic::check(frame));
    moment_->frame = frame;
    moment_->origin = frame.origin_at(time_s_);
}

ExactWater ExactWater::at(double time_s) const {
    ExactWater other(waves_, moment_->frame);
    other.set_time(time_s);
    return other;
}

bool ExactWater::has_sample(double x, double z) const {
    const double max_m = max_texels_away * waves_->texel_m;
    return std::fabs(x) <= max_m && std::fabs(z) <= max_m;  // false for NaN
}

void ExactWater::check(const SurfacePoints& points, const SurfaceSamples& samples) const {
    const std::size_t count = points.x.size();
    require_length("z", points.z.size(), count, ", as x has");
    require_lengths(count, std::pair("height_m", samples.height_m), std::pair("normal_x", samples.normal_x),
                    std::pair("normal_y", samples.normal_y), std::pair("normal_z", samples.normal_z),
                    std::pair("jacobian", samples.jacobian), std::pair("velocity_x_mps", samples.velocity_x_mps),
                    std::pair("velocity_y_mps", samples.velocity_y_mps),
                    std::pair("velocity_z_mps", samples.velocity_z_mps), std::pair("error_m", samples.error_m),
                    std::pair("converged", samples.converged));
    if (!samples.foam.empty()) throw std::invalid_argument("exact water has no foam");
    require_footprint(points.footprint_m);
}

template <class Points>
void ExactWater::load_positions(const Points& points, Chunk& chunk) const {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const double x = points.x[chunk.first + i] - moment_->origin.x_m;
        const double z = points.z[chunk.first + i] - moment_->origin.z_m;
        chunk.has_sample[i] = has_sample(x, z);
        chunk.x[i] = chunk.has_sample[i] ? x : 0;
        chunk.z[i] = chunk.has_sample[i] ? z : 0;
        chunk.height[i] = chunk.depth[i] = 0;
    }
}

void ExactWater::sum_heights(Chunk& chunk, double footprint_m) const {
    for (std::size_t number = 0; number < waves_->cascades.size(); ++number) {
        const WaveList& cascade = waves_->cascades[number];
        const Chunk::Places places(chunk, cascade.grid());
        cascade.for_each_block(moment_->moved[number], footprint_m, [&](const WaveBlock& waves) {
            waves_->kernels.sum_heights({.waves = waves,
                                         .x = places.x.data(),
                                         .z = places.z.data(),
                                         .points = chunk.count,
                                         .heights = chunk.height.data()});
        });
    }
}

void ExactWater::sum_water(Chunk& chunk, double footprint_m) const {
    using Job = SumWaterJob;
    for (std::size_t i = 0; i < chunk.count; ++i) chunk.sums[i] = {};
    for (std::size_t number = 0; number < waves_->cascades.size(); ++number) {
        const WaveList& cascade = waves_->cascades[number];
        const Chunk::Places places(chunk, cascade.grid());
        const double spacing = two_pi / cascade.grid().side_m;
        std::array<float, Chunk::capacity> decay;
        std::array<std::array<double, Job::sums>, Chunk::capacity> sums;
        for (std::size_t i = 0; i < chunk.count; ++i) {
            decay[i] = chunk.depth[i] < 0 ? no_waves : static_cast<float>(spacing * chunk.depth[i]);
            sums[i] = {};
        }
        cascade.for_each_block(moment_->moved[number], footprint_m, [&](const WaveBlock& waves) {
            waves_->kernels.sum_water({.waves = waves,
                                       .x = places.x.data(),
                                       .z = places.z.data(),
                                       .decay = decay.data(),
                                       .points = chunk.count,
                                       .all = sums.front().data()});
        });
        for (std::size_t i = 0; i < chunk.count; ++i) {
            const auto flow = cascade.grid().in_world(sums[i][Job::along], sums[i][Job::across]);
            const auto slope = cascade.grid().in_world(sums[i][Job::slope_along], sums[i][Job::slope_across]);
            const double added[Job::sums] = {sums[i][Job::head],       flow.along,
                                             flow.across,              sums[i][Job::up],
                                             spacing * slope.along,    spacing * slope.across,
                                             spacing * sums[i][Job::slope_up]};
            for (std::size_t sum = 0; sum < Job::sums; ++sum) chunk.sums[i][sum] += added[sum];
        }
    }
}

void ExactWater::sample(const WaterPoints& points, const WaterSamples& samples) const {
    using Job = SumWaterJob;
    const DefaultFloatEnvironment environment;
    require_valid(points, samples);
    const bool has_motion = [&] {
        for (const auto& span :
             {samples.pressure_pa, samples.velocity_x_mps, samples.velocity_y_mps, samples.velocity_z_mps,
              samples.acceleration_x_mps2, samples.acceleration_y_mps2, samples.acceleration_z_mps2})
            if (!span.empty()) return true;
        return false;
    }();
    const double floor_m = waves_->depth_m;
    const WaterFrame& frame = moment_->frame;
    const double footprint_m = points.whole_cascades ? 0 : points.footprint_m;
    Chunk chunk;
    for (; chunk.first < points.x.size(); chunk.first += chunk.count) {
        chunk.count = std::min(Chunk::capacity, points.x.size() - chunk.first);
        load_positions(points, chunk);
        sum_heights(chunk, footprint_m);
        for (std::size_t i = 0; i < chunk.count; ++i) {
            const double y = points.y[chunk.first + i] - moment_->origin.y_m, below = chunk.height[i] - y;
            chunk.has_sample[i] = chunk.has_sample[i] && std::isfinite(y);
            // A trough below the floor has no water.
            const bool is_water = chunk.has_sample[i] && floor_m + chunk.height[i] > 0;
            chunk.depth[i] = is_water ? floor_m * std::max(below, 0.0) / (floor_m + chunk.height[i]) : -1;
        }
        if (has_motion) sum_water(chunk, footprint_m);
        for (std::size_t i = 0; i < chunk.count; ++i) {
            const std::size_t at = chunk.first + i;
            const double y = points.y[at] - moment_->origin.y_m;
            if (!chunk.has_sample[i]) {
                for (const auto& span :
                     {samples.depth_m, samples.pressure_pa, samples.velocity_x_mps, samples.velocity_y_mps,
                      samples.velocity_z_mps, samples.acceleration_x_mps2, samples.acceleration_y_mps2,
                      samples.acceleration_z_mps2})
                    if (!span.empty()) span[at] = no_sample;
                continue;
            }
            write(samples.depth_m, at, chunk.height[i] - y);
            if (!has_motion) continue;
            const std::array<double, Job::sums>& sums = chunk.sums[i];
            const bool is_water = chunk.depth[i] >= 0;
            write(samples.pressure_pa, at,
                  is_water ? waves_->density_kgpm3 * gravity_mps2 * (sums[Job::head] - y) : 0);
            write(samples.velocity_x_mps, at, is_water ? sums[Job::along] + frame.current_x_mps : 0);
            write(samples.velocity_y_mps, at, sums[Job::up]);
            write(samples.velocity_z_mps, at, is_water ? sums[Job::across] + frame.current_z_mps : 0);
            write(samples.acceleration_x_mps2, at, gravity_mps2 * sums[Job::slope_along]);
            write(samples.acceleration_y_mps2, at, 0 - gravity_mps2 * sums[Job::slope_up]);
            write(samples.acceleration_z_mps2, at, gravity_mps2 * sums[Job::slope_across]);
        }
    }
}

void ExactWater::sample_surface(const SurfacePoints& points, const SurfaceSamples& samples) const {
    using Job = SumWaterJob;
    const DefaultFloatEnvironment environment;
    check(points, samples);
    const WaterFrame& frame = moment_->frame;
    Chunk chunk;
    for (; chunk.first < points.x.size(); chunk.first += chunk.count) {
        chunk.count = std::min(Chunk::capacity, points.x.size() - chunk.first);
        load_positions(points, chunk);
        sum_water(chunk, points.footprint_m);
        for (std::size_t i = 0; i < chunk.count; ++i) {
            const std::size_t at = chunk.first + i;
            const bool has_sample = chunk.has_sample[i];
            const auto put = [&](std::span<float> to, double value) {
                if (!to.empty()) to[at] = has_sample ? static_cast<float>(value) : no_sample;
            };
            const std::array<double, Job::sums>& sums = chunk.sums[i];
            const double slope_x = 0 - sums[Job::slope_along], slope_z = 0 - sums[Job::slope_across];
            const double length = std::sqrt(1 + slope_x * slope_x + slope_z * slope_z);
            put(samples.height_m, sums[Job::head] + moment_->origin.y_m);
            put(samples.normal_x, 0 - slope_x / length);
            put(samples.normal_y, 1 / length);
            put(samples.normal_z, 0 - slope_z / length);
            put(samples.jacobian, 1);
            put(samples.velocity_x_mps, sums[Job::along] + frame.current_x_mps);
            put(samples.velocity_y_mps, sums[Job::up]);
            put(samples.velocity_z_mps, sums[Job::across] + frame.current_z_mps);
            if (!samples.error_m.empty())
                samples.error_m[at] = has_sample ? 0 : std::numeric_limits<float>::infinity();
            if (!samples.converged.empty()) samples.converged[at] = has_sample;
        }
    }
}

}  // namespace pelagic
