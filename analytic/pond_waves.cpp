#include "pelagic/analytic/pond_waves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "pelagic/analytic/point_groups.hpp"
#include "pelagic/analytic/pond_terms.hpp"
#include "pelagic/analytic/wave_phase.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double surface_tension_m3ps2 = 7.4e-5;  // of fresh water, divided by its density
constexpr double golden_turns = 0.6180339887498949;
constexpr double min_exp = 0.1353352832366127;    // exp(-2)
constexpr double mean_exp = 0.46575960759364043;  // I0(1) / e
constexpr double shortest_wavelength_m = 1e-3;    // shorter ones are invisible

constexpr std::array fields = {
    NumericField<PondSea>{"octaves", &PondSea::octaves, 1, max_analytic_waves, "1 to 64"},
    NumericField<PondSea>{"height_m", &PondSea::height_m, 0, 10, "(0, 10]", Restriction::above_min},
    NumericField<PondSea>{"wavelength_m", &PondSea::wavelength_m, 0.01, 1000, "[0.01, 1000]"},
    NumericField<PondSea>{"direction_rad", &PondSea::direction_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    NumericField<PondSea>{"growth", &PondSea::growth, 1, 4, "[1, 4]"},
    NumericField<PondSea>{"decay", &PondSea::decay, 0, 1, "(0, 1]", Restriction::above_min},
    NumericField<PondSea>{"drag", &PondSea::drag, 0, 1, "[0, 1]"},
};

double last_wavelength_m(const PondSea& sea) {
    double wavelength_m = sea.wavelength_m;
    for (int i = 1; i < sea.octaves; ++i) wavelength_m /= sea.growth;
    return wavelength_m;
}

/// An interval of a ray, by distance from its origin.
struct Interval {
    double from_m, to_m;
};
/// Returns the interval in which a ray is between two heights; empty if there is none.
std::optional<Interval> between_heights(double y, double direction_y, double lowest, double highest, double reach_m) {
    Interval all{0, reach_m};
    if (direction_y != 0) {
        const double a = (highest - y) / direction_y, b = (lowest - y) / direction_y;
        all = {std::max(0.0, std::min(a, b)), std::min(reach_m, std::max(a, b))};
    } else if (y < lowest || y > highest) {
        return {};
    }
    if (!(all.from_m <= all.to_m)) return {};
    return all;
}

}  // namespace

std::string check(const PondSea& sea) {
    if (const std::string reason = check_fields(sea, fields); !reason.empty()) return reason;
    if (const double last_m = last_wavelength_m(sea); last_m < shortest_wavelength_m)
        return invalid_value_message("the last octave's wavelength_m", last_m,
                                     "0.001 at least: fewer octaves, or less growth");
    return {};
}

double PondOctave::turns_per_m() const {
    return std::sqrt(turns_per_m_x * turns_per_m_x + turns_per_m_z * turns_per_m_z);
}

double ripple_frequency_hz(double turns_per_m) {
    const double k = two_pi * turns_per_m;
    return std::sqrt(gravity_mps2 * k + surface_tension_m3ps2 * k * k * k) / two_pi;
}

double footprint_weight(double wavelength_m, double footprint_m) {
    const double t = std::clamp((2 * footprint_m / wavelength_m - 0.4) / 0.6, 0.0, 1.0);
    return 1 - t * t * (3 - 2 * t);
}

std::vector<PondOctave> octaves_of(const PondSea& sea) {
    const DefaultFloatEnvironment environment;
    double sum = 0, weight = 1;
    for (int i = 0; i < sea.octaves; ++i, weight *= sea.decay) sum += weight;
    std::vector<PondOctave> octaves;
    double wavelength_m = sea.wavelength_m;
    weight = 1;
    for (int i = 0; i < sea.octaves; ++i, weight *= sea.decay, wavelength_m /= sea.growth) {
        const auto [z, x] = det::sine_cosine_of_turns(sea.direction_rad / two_pi + i * golden_turns);
        octaves.push_back({.turns_per_m_x = x / wavelength_m,
                           .turns_per_m_z = z / wavelength_m,
                           .frequency_hz = ripple_frequency_hz(1 / wavelength_m),
                           .phase_turns = i * golden_turns * golden_turns,
                           .height_m = sea.height_m * weight / sum,
                           .drag_m = sea.drag * weight * sea.wavelength_m / two_pi});
    }
    return octaves;
}

PondTerms pond_terms_of(const PondOctave& octave) {
    const double per_m = octave.turns_per_m();
    const auto rounded = [](double value) { return static_cast<float>(value); };
    return {.phase = {octave.turns_per_m_x, octave.turns_per_m_z},
            .direction_x = rounded(octave.turns_per_m_x / per_m),
            .direction_z = rounded(octave.turns_per_m_z / per_m),
            .turns_per_m = rounded(per_m),
            .k = rounded(two_pi * per_m),
            .height = rounded(octave.height_m),
            .drag = rounded(octave.drag_m),
            .frequency = rounded(two_pi * octave.frequency_hz),
            .half_waves_per_m = rounded(2 * per_m)};
}

PondWaves::PondWaves(const PondSea& sea, std::optional<Isa> isa) : PondWaves(isa, octaves_of(checked(sea))) {}

PondWaves PondWaves::of(std::vector<PondOctave> octaves, std::optional<Isa> isa) { return {isa, std::move(octaves)}; }

PondWaves::PondWaves(std::optional<Isa> isa, std::vector<PondOctave> octaves)
    : octaves_(std::move(octaves)), height_m_(0) {
    if (octaves_.empty() || octaves_.size() > max_analytic_waves)
        throw std::invalid_argument(invalid_value_message("octaves", octaves_.size(), "1 to 64"));
    const DefaultFloatEnvironment environment;
    kernels_ = &analytic_kernels_for(choose_isa(isa));
    double max_turns_per_m = 0;
    for (const PondOctave& octave : octaves_) {
        terms_.push_back(pond_terms_of(octave));
        height_m_ += octave.height_m;
        max_turns_per_m = std::max(max_turns_per_m, octave.turns_per_m());
    }
    shortest_m_ = 1 / max_turns_per_m;
}

PondWaves::~PondWaves() = default;
PondWaves::PondWaves(PondWaves&&) noexcept = default;
PondWaves& PondWaves::operator=(PondWaves&&) noexcept = default;

double PondWaves::lowest_m() const { return height_m_ * (min_exp - mean_exp); }
double PondWaves::highest_m() const { return height_m_ * (1 - mean_exp); }

void PondWaves::sample(double time_s, const AnalyticPoints& points, const PondSamples& samples,
                       std::span<const float> footprint_m) const {
    need_finite_time(time_s);
    if (!footprint_m.empty() && footprint_m.size() != points.x.size())
        throw std::invalid_argument("footprint_m differs in length from the points, expected as many or none");
    const DefaultFloatEnvironment environment(time_s);
    std::array<double, max_analytic_waves> starts;
    for (std::size_t i = 0; i < terms_.size(); ++i)
        starts[i] = turns_at_origin(octaves_[i].phase_turns, octaves_[i].frequency_hz, time_s);

    const OutputArrays<6> arrays{
        samples.height_m,      samples.normal_x, samples.normal_y, samples.normal_z, samples.vertical_velocity_mps,
        samples.slope_variance};
    const bool slopes = arrays.has_any(1, 6);
    for_each_group(points.x, points.z, arrays, analytic_group, [&](const PointGroup<6>& group) {
        float* const* out = group.outputs.data();
        float tail[analytic_group];
        const float* footprint = footprint_m.empty() ? nullptr : footprint_m.data() + group.first;
        if (footprint && group.first + group.count > footprint_m.size()) {
            for (std::size_t i = 0; i < analytic_group; ++i)
                tail[i] = footprint_m[std::min(group.first + i, footprint_m.size() - 1)];
            footprint = tail;
        }
        PondJob job{.octaves = terms_.data(),
                    .starts = starts.data(),
                    .octave_count = static_cast<int>(terms_.size()),
                    .count = group.count,
                    .x = group.x,
                    .z = group.z,
                    .footprint = footprint,
                    .out = {.height = out[0]}};
        if (slopes) job.out = {out[0], out[1], out[2], out[3], out[4], out[5]};
        kernels_->pond(job);
    });
}

std::optional<PondHit> PondWaves::first_hit(double time_s, std::array<double, 3> origin_m,
                                            std::array<double, 3> direction, double reach_m) const {
    const DefaultFloatEnvironment environment(time_s, origin_m, direction, reach_m);
    const auto [dx, dy, dz] = direction;
    const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
    if (!(length > 0 && std::isfinite(length)))
        throw std::invalid_argument(
            invalid_value_message("direction's length", length, "a finite number above 0"));
    for (const double number : {origin_m[0], origin_m[1], origin_m[2], reach_m})
        if (!std::isfinite(number))
            throw std::invalid_argument(invalid_value_message("origin_m or reach_m", number, "a finite number"));
    const std::array<double, 3> unit{dx / length, dy / length, dz / length};
    const auto along = [&](double distance_m, std::size_t axis) { return origin_m[axis] + distance_m * unit[axis]; };

    constexpr std::size_t sample_count = analytic_group;
    /// Returns the first of `sample_count` positions, `step_m` apart after `from_m`, that is under
    /// water.
    const auto first_under = [&](double from_m, double step_m) -> std::optional<std::size_t> {
        double x[sample_count], z[sample_count];
        float height[sample_count];
        for (std::size_t i = 0; i < sample_count; ++i) {
            const double distance_m = from_m + step_m * static_cast<double>(i + 1);
            x[i] = along(distance_m, 0);
            z[i] = along(distance_m, 2);
        }
        sample(time_s, {x, z}, {.height_m = height});
        for (std::size_t i = 0; i < sample_count; ++i)
            if (along(from_m + step_m * static_cast<double>(i + 1), 1) <= height[i]) return i;
        return {};
    };

    const std::optional<Interval> interval = between_heights(origin_m[1], unit[1], lowest_m(), highest_m(), reach_m);
    if (!interval) return {};
    double from_m = interval->from_m, step_m = shortest_m_ / 8;
    std::optional<std::size_t> under;
    while (!(under = first_under(from_m, step_m))) {
        from_m += step_m * static_cast<double>(sample_count);
        if (from_m >= interval->to_m) return {};
    }
    // The crossing is within one step: divide the step into sixteen, repeatedly.
    for (const double enough_m = std::max(1e-6, 1e-12 * from_m);;) {
        from_m += step_m * static_cast<double>(*under);
        if (step_m <= enough_m) break;
        step_m /= static_cast<double>(sample_count);
        under = first_under(from_m, step_m);
        if (!under) under = sample_count - 1;  // rounding: the end of the step is under water
    }
    const double distance_m = from_m + step_m / 2;
    if (distance_m > interval->to_m) return {};
    return PondHit{distance_m, {along(distance_m, 0), along(distance_m, 1), along(distance_m, 2)}};
}

}  // namespace pelagic
