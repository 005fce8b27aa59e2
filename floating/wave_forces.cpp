#include "pelagic/floating/wave_forces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "pelagic/simd/direction.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Returns the forces of a row of the table at a heading, by a cubic through the four headings around it (Catmull
/// and Rom's tangents, of central differences); linear with fewer than 4 headings.
ForceTable::Forces at_heading(const ForceTable& table, std::size_t row, double heading_rad) {
    const auto known = static_cast<std::ptrdiff_t>(table.heading_rad.size());
    // Headings beyond both ends are those a turn away.
    const auto turn_of = [&](std::ptrdiff_t i) { return i < 0 ? (i + 1) / known - 1 : i / known; };
    const auto heading = [&](std::ptrdiff_t i) {
        return table.heading_rad[static_cast<std::size_t>(i - turn_of(i) * known)] +
               two_pi * static_cast<double>(turn_of(i));
    };
    const auto at = [&](std::ptrdiff_t i) -> const ForceTable::Forces& {
        return table.forces[row * static_cast<std::size_t>(known) + static_cast<std::size_t>(i - turn_of(i) * known)];
    };
    std::ptrdiff_t i = -1;
    while (i + 1 < known && heading(i + 1) <= heading_rad) ++i;
    const double x0 = heading(i - 1), x1 = heading(i), x2 = heading(i + 1), x3 = heading(i + 2);
    const double t = (heading_rad - x1) / (x2 - x1);
    ForceTable::Forces result;
    for (std::size_t mode = 0; mode < 6; ++mode) {
        const auto part = [&](auto component) {
            const double p1 = component(at(i)[mode]), p2 = component(at(i + 1)[mode]);
            if (known < 4) return p1 + t * (p2 - p1);
            const double p0 = component(at(i - 1)[mode]), p3 = component(at(i + 2)[mode]);
            const double m1 = (p2 - p0) / (x2 - x0) * (x2 - x1), m2 = (p3 - p1) / (x3 - x1) * (x2 - x1);
            return p1 + t * (m1 + t * (3 * (p2 - p1) - 2 * m1 - m2 + t * (m1 + m2 - 2 * (p2 - p1))));
        };
        result[mode] = {part([](const std::complex<double>& c) { return c.real(); }),
                        part([](const std::complex<double>& c) { return c.imag(); })};
    }
    return result;
}

}  // namespace

std::string WaveForces::check(const ForceTable& table) {
    if (table.omega_radps.empty() || table.omega_radps.size() > max_wamit_frequencies)
        return invalid_value_message("the number of frequencies of the force table", table.omega_radps.size(),
                                     "1 to " + number_text(max_wamit_frequencies));
    if (table.heading_rad.empty() || table.heading_rad.size() > 2 * max_wamit_headings)
        return invalid_value_message("the number of headings of the force table", table.heading_rad.size(),
                                     "1 to " + number_text(2 * max_wamit_headings));
    if (table.forces.size() != table.omega_radps.size() * table.heading_rad.size())
        return invalid_value_message("the number of forces of the force table", table.forces.size(),
                                     number_text(table.omega_radps.size() * table.heading_rad.size()));
    for (std::size_t i = 0; i < table.omega_radps.size(); ++i)
        if (!(table.omega_radps[i] > (i > 0 ? table.omega_radps[i - 1] : 0) && table.omega_radps[i] <= 1e4))
            return invalid_value_message("omega_radps[" + number_text(i) + "]", table.omega_radps[i],
                                         "increasing frequencies in (0, 1e4] rad/s");
    for (std::size_t i = 0; i < table.heading_rad.size(); ++i)
        if (!(table.heading_rad[i] >= 0 && table.heading_rad[i] < two_pi &&
              (i == 0 || table.heading_rad[i] > table.heading_rad[i - 1])))
            return invalid_value_message("heading_rad[" + number_text(i) + "]", table.heading_rad[i],
                                         "increasing headings in [0, 2 pi)");
    for (const ForceTable::Forces& forces : table.forces)
        for (const std::complex<double>& force : forces)
            if (!(std::fabs(force.real()) <= 1e15 && std::fabs(force.imag()) <= 1e15))
                return "a force of the force table is out of range [-1e15, 1e15]";
    return {};
}

std::string WaveForces::check(std::span<const WaveComponent> waves) {
    if (waves.size() > 1'000'000)
        return invalid_value_message("the number of waves", waves.size(), "at most 1000000");
    for (const WaveComponent& wave : waves) {
        if (!(wave.amplitude_m >= 0 && wave.amplitude_m <= 1e3))
            return invalid_value_message("amplitude_m", wave.amplitude_m, "[0, 1000] m");
        if (!(wave.omega_radps >= 0 && wave.omega_radps <= 1e4))
            return invalid_value_message("omega_radps", wave.omega_radps, "[0, 1e4] rad/s");
        if (!(std::fabs(wave.kx_radpm) <= 1e6 && std::fabs(wave.kz_radpm) <= 1e6 && std::fabs(wave.phase_rad) <= 1e6))
            return "kx_radpm, kz_radpm or phase_rad of a wave is out of range [-1e6, 1e6]";
    }
    return {};
}

ForceTable WaveForces::at_each_heading(const ForceTable& table) {
    const DefaultFloatEnvironment environment;
    ForceTable result{.omega_radps = table.omega_radps, .heading_rad = {}, .forces = {}};
    for (std::size_t h = 0; h < headings; ++h) result.heading_rad.push_back(two_pi * static_cast<double>(h) / headings);
    for (std::size_t row = 0; row < table.omega_radps.size(); ++row)
        for (const double heading : result.heading_rad) result.forces.push_back(at_heading(table, row, heading));
    return environment.result(std::move(result));
}

WaveForces::WaveForces(const ForceTable& table, std::span<const WaveComponent> waves, double share) {
    const DefaultFloatEnvironment environment(share);
    require(check(table));
    require(check(waves));
    if (!(share >= 0 && share <= 1)) require(invalid_value_message("share", share, "[0, 1]"));
    std::vector<std::size_t> order(waves.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (waves[a].amplitude_m != waves[b].amplitude_m) return waves[a].amplitude_m > waves[b].amplitude_m;
        return a < b;
    });
    double all = 0, kept = 0, with_forces = 0;
    for (const std::size_t i : order) all += waves[i].amplitude_m * waves[i].amplitude_m;
    const std::vector<double>& omega = table.omega_radps;
    for (const std::size_t i : order) {
        if (kept >= share * all) break;
        const WaveComponent& wave = waves[i];
        kept += wave.amplitude_m * wave.amplitude_m;
        if (wave.omega_radps > omega.back()) continue;
        with_forces += wave.amplitude_m * wave.amplitude_m;
        std::size_t below = 0;
        while (below + 1 < omega.size() && omega[below + 1] < wave.omega_radps) ++below;
        const std::size_t above = std::min(below + 1, omega.size() - 1);
        const double fraction =
            above > below ? std::clamp((wave.omega_radps - omega[below]) / (omega[above] - omega[below]), 0.0, 1.0) : 0;
        waves_.push_back({wave, angle_of(wave.kx_radpm, wave.kz_radpm) / two_pi});
        for (std::size_t h = 0; h < headings; ++h) {
            const double heading = two_pi * static_cast<double>(h) / headings;
            const ForceTable::Forces low = at_heading(table, below, heading), high = at_heading(table, above, heading);
            for (std::size_t mode = 0; mode < 6; ++mode) {
                const auto mixed = [&](double a, double b) {
                    forces_.push_back(static_cast<float>(wave.amplitude_m * (a + fraction * (b - a))));
                };
                mixed(low[mode].real(), high[mode].real());
                mixed(low[mode].imag(), high[mode].imag());
            }
        }
    }
    kept_share_ = all > 0 ? with_forces / all : 1;
}

Vector6 WaveForces::force(double x_m, double z_m, double heading_rad, double time_s) const {
    const DefaultFloatEnvironment environment(x_m, z_m, heading_rad, time_s);
    Vector6 sum{};
    const float* forces = forces_.data();
    for (const Wave& wave : waves_) {
        const double phase =
            wave.of.omega_radps * time_s - wave.of.kx_radpm * x_m - wave.of.kz_radpm * z_m - wave.of.phase_rad;
        const auto [sine, cosine] = det::sine_cosine_of_turns(phase / two_pi);
        double relative = wave.direction_turns - heading_rad / two_pi;
        relative = (relative - std::floor(relative)) * headings;
        const auto before = std::min(static_cast<std::size_t>(relative), headings - 1);
        const double fraction = relative - static_cast<double>(before);
        const float *a = forces + 12 * before, *b = forces + 12 * ((before + 1) % headings);
        for (std::size_t mode = 0; mode < 6; ++mode) {
            const auto mixed = [&](std::size_t i) {
                return static_cast<double>(a[i]) + fraction * (static_cast<double>(b[i]) - static_cast<double>(a[i]));
            };
            sum[mode] += mixed(2 * mode) * cosine - mixed(2 * mode + 1) * sine;
        }
        forces += 12 * headings;
    }
    return environment.result(sum);
}

}  // namespace pelagic
