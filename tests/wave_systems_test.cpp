// Wave systems: heights, periods, directions and spreads against integrals in double that share no code
// with the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/shore/shore_waves.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

constexpr double degree = pi / 180;
constexpr double g = oracle::gravity;

// Hasselmann et al. 1973, on omega in units of the peak.
double jonswap_shape(double x, double gamma) {
    const double sigma = x <= 1 ? 0.07 : 0.09;
    return std::pow(x, -5) * std::exp(-1.25 * std::pow(x, -4)) *
           std::pow(gamma, std::exp(-(x - 1) * (x - 1) / (2 * sigma * sigma)));
}

double integral_of_shape(double gamma) {
    double sum = 0;
    for (double log_x = -1.2; log_x < 6; log_x += 1e-3)
        sum += jonswap_shape(std::exp(log_x), gamma) * std::exp(log_x) * 1e-3;
    return sum;
}

double bisect(double low, double high, const std::function<bool(double)>& is_below) {
    for (int i = 0; i < 200; ++i) {
        const double middle = std::sqrt(low * high);
        (is_below(middle) ? low : high) = middle;
    }
    return low;
}

/// alpha and the peak of a JONSWAP sea without a limit of the fetch.
struct Jonswap {
    double peak, alpha, gamma;

    static Jonswap of_fetch(double wind_mps, double fetch_m, double gamma) {
        return {22 * std::cbrt(g * g / (wind_mps * fetch_m)),
                0.076 * std::pow(wind_mps * wind_mps / (fetch_m * g), 0.22), gamma};
    }
    double variance() const { return alpha * g * g / std::pow(peak, 4) * integral_of_shape(gamma); }
    double height() const { return 4 * std::sqrt(variance()); }
};

/// Finds the shape of a system by height or period: the fetch at which JONSWAP's laws give the one that
/// is known.
Jonswap by_height(const WaveSystem& system) {
    const bool is_developed = system.spectrum == SpectrumModel::pierson_moskowitz;
    const double gamma = is_developed ? 1 : system.peak_enhancement, given = 2 * pi / system.peak_period_s;
    const auto at = [&](double fetch_m) {
        if (!is_developed) return Jonswap::of_fetch(system.wind_speed_mps, fetch_m, gamma);
        return Jonswap{1e6 / fetch_m, 0.0081, 1};  // any peak has one fully developed sea
    };
    const double fetch_m = bisect(1e-2, 1e12, [&](double tried) {
        return system.peak_period_s > 0 ? at(tried).peak > given : at(tried).height() < system.height_m;
    });
    Jonswap found = at(fetch_m);
    if (system.height_m > 0) found.alpha *= system.height_m * system.height_m / 16 / found.variance();
    return found;
}

/// U/c of the wind and the fetch that have this peak and this alpha.
double inverse_wave_age(const Jonswap& of) {
    const double wind = bisect(1e-3, 1e4, [&](double tried) {
        const double fetch = g * g * std::pow(22 / of.peak, 3) / tried;
        return Jonswap::of_fetch(tried, fetch, 1).alpha < of.alpha;
    });
    return wind * of.peak / g;
}

/// Energy and directions of a system, by frequency.
struct ModelSystem {
    std::function<double(double)> density;         ///< S(omega) at the sea's depth
    std::function<double(double, double)> spread;  ///< of omega and the angle, not normalised
    double direction_rad, peak;
};

double cosine_2s(double s, double angle) { return std::pow(std::fabs(std::cos(angle / 2)), 2 * s); }

std::function<double(double, double)> spreading_of(const WaveSystem& system, const SeaState& sea, double peak,
                                                   double age) {
    age = std::clamp(age, 0.83, 5.0);
    if (system.spread_rad > 0)
        return [s = 2 / (system.spread_rad * system.spread_rad) - 1](double, double angle) {
            return cosine_2s(s, angle);
        };
    switch (system.spreading) {
        case SpreadingModel::paper:
            return [a = sea.wind_alignment](double, double angle) {
                const double along = std::pow(std::fabs(std::cos(angle)), 1 + 5 * a * a);
                return std::cos(angle) < 0 ? along * (0.01 + 0.49 * (1 - a) * (1 - a)) : along;
            };
        case SpreadingModel::cosine_2s:
            return [=](double omega, double angle) {
                return cosine_2s(11.5 * std::pow(age, -2.5) * std::pow(omega / peak, omega <= peak ? 5 : -2.5),
                                 angle);
            };
        case SpreadingModel::hasselmann:
            return [=](double omega, double angle) {
                const double x = omega / peak;
                return cosine_2s(
                    x < 1.05 ? 6.97 * std::pow(x, 4.06) : 9.77 * std::pow(x, -2.33 - 1.45 * (age - 1.17)), angle);
            };
        default:
            return [=](double omega, double angle) {
                const double x = omega / peak;
                const double beta = x >= 1.6    ? std::pow(10, -0.4 + 0.8393 * std::pow(x * x, -0.567))
                                    : x >= 0.95 ? 2.28 * std::pow(x, -1.3)
                                                : 2.61 * std::pow(std::max(x, 0.56), 1.3);
                return std::pow(std::cosh(beta * std::remainder(angle, 2 * pi)), -2);
            };
    }
}

double omega_of(double k, double depth_m) { return std::sqrt(g * k * std::tanh(k * depth_m)); }

/// Kitaigorodskii's factor by definition: k^-3 dk/domega at the depth over that in deep water.
double attenuation(double omega, double depth_m) {
    const auto k_at = [&](double w) { return oracle::wave_number_at(w, depth_m); };
    const double slope = (k_at(omega * 1.0001) - k_at(omega * 0.9999)) / (0.0002 * omega);
    return std::pow(k_at(omega), -3) * slope / (std::pow(omega * omega / g, -3) * 2 * omega / g);
}

ModelSystem model_of(const WaveSystem& system, const SeaState& sea) {
    const bool is_given = system.height_m > 0 || system.peak_period_s > 0;
    Jonswap shape{};
    if (is_given) {
        shape = by_height(system);
    } else if (system.spectrum == SpectrumModel::jonswap) {
        const double grown = 17000 * system.wind_speed_mps * system.wind_speed_mps / g;
        shape = Jonswap::of_fetch(system.wind_speed_mps, std::min(grown, system.fetch_m), system.peak_enhancement);
    } else {  // 0.0081 g^2 w^-5 exp(-0.74 (g/(U w))^4)
        shape = {g / system.wind_speed_mps * std::pow(0.74 / 1.25, 0.25), 0.0081, 1};
    }
    const double age = is_given ? inverse_wave_age(shape) : system.wind_speed_mps * shape.peak / g;
    return {.density =
                [=, depth = sea.depth_m](double omega) {
                    return shape.alpha * g * g * std::pow(shape.peak, -5) *
                           jonswap_shape(omega / shape.peak, shape.gamma) *
                           (is_given || depth > 1000 ? 1 : attenuation(omega, depth));
                },
            .spread = spreading_of(system, sea, shape.peak, age),
            .direction_rad = system.direction_rad,
            .peak = shape.peak};
}

ModelSystem swell_of(const SeaState& sea) {
    const double peak = 2 * pi / sea.swell_period_s;
    return {.density =
                [=, variance = sea.swell_height_m * sea.swell_height_m / 16](double omega) {
                    // Ochi and Hubble 1976, lambda = 3
                    return 4 * variance * std::pow(3.25 * std::pow(peak, 4), 3) / 2 * std::pow(omega, -13) *
                           std::exp(-3.25 * std::pow(peak / omega, 4));
                },
            .spread = [s = 2 / (sea.swell_spread_rad * sea.swell_spread_rad) - 1](
                          double, double angle) { return cosine_2s(s, angle); },
            .direction_rad = sea.swell_direction_rad,
            .peak = peak};
}

std::vector<ModelSystem> models_of(const SeaState& sea) {
    std::vector<ModelSystem> all;
    if (sea.spectrum != SpectrumModel::none)
        all.push_back(model_of({.spectrum = sea.spectrum,
                                .spreading = sea.spreading,
                                .wind_speed_mps = sea.wind_speed_mps,
                                .fetch_m = sea.fetch_m,
                                .height_m = sea.wave_height_m,
                                .peak_period_s = sea.peak_period_s,
                                .peak_enhancement = sea.peak_enhancement,
                                .direction_rad = sea.wind_direction_rad},
                               sea));
    if (sea.swell_height_m > 0) all.push_back(swell_of(sea));
    for (const WaveSystem& system : sea.systems) all.push_back(model_of(system, sea));
    return all;
}

/// Integrals of a system over the waves that a grid holds, and over all waves.
struct Integrals {
    double all = 0, m0 = 0, m2 = 0, x = 0, z = 0;

    void add(const Integrals& other) { all += other.all, m0 += other.m0, m2 += other.m2, x += other.x, z += other.z; }
    double height_m() const { return 4 * std::sqrt(m0); }
    double tm02_s() const { return 2 * pi * std::sqrt(m0 / m2); }
    double direction_rad() const { return std::atan2(z, x); }
    double r1() const { return std::hypot(x, z) / m0; }
    double spread_rad() const { return std::sqrt(2 * (1 - r1())); }
};

/// The waves that cascades hold: a disc, or a square around k = 0 if the side is given.
struct Held {
    double radius, half_side;

    explicit Held(const SeaState& sea) {
        const CascadePlan last = plan_cascades(sea).back();
        radius = last.max_k;
        half_side = sea.patch_size_m > 0 ? (last.resolution / 2 - 0.5) * 2 * pi / last.grid.side_m : 1e9;
    }
    bool has(double k, double angle) const {
        return k < radius && std::max(std::fabs(k * std::cos(angle)), std::fabs(k * std::sin(angle))) < half_side;
    }
};

Integrals integrals_of(const ModelSystem& system, double depth_m, const Held& held) {
    constexpr double step = 0.01;
    constexpr int angles = 180;
    Integrals sum;
    for (double log_x = -1; log_x < 4; log_x += step) {
        const double omega = system.peak * std::exp(log_x), k = oracle::wave_number_at(omega, depth_m);
        const double energy = system.density(omega) * omega * step;
        double all = 0;
        Integrals of;
        for (int i = 0; i < angles; ++i) {
            const double off = 2 * pi * (i + 0.5) / angles, angle = system.direction_rad + off;
            const double here = system.spread(omega, off);
            all += here;
            if (held.has(k, angle)) of.m0 += here, of.x += here * std::cos(angle), of.z += here * std::sin(angle);
        }
        const double scale = energy / all;
        sum.add({energy, of.m0 * scale, of.m0 * scale * omega * omega, of.x * scale, of.z * scale});
    }
    return sum;
}

double peak_period_of(const ModelSystem& system) {
    double best = 0, max = 0;
    for (double x = 0.5; x < 2; x *= 1.0005)
        if (const double here = system.density(system.peak * x); here > max) max = here, best = system.peak * x;
    return 2 * pi / best;
}

double turn_between(double a, double b) { return std::remainder(a - b, 2 * pi); }

class RandomSeas {
   public:
    SeaState next() {
        SeaState sea{.resolution = pick({64, 64, 128}),
                     .wind_speed_mps = between(5, 16),
                     .wind_direction_rad = between(-pi, pi),
                     .fetch_m = 100e3,
                     .depth_m = pick({4000.0, 60.0, 25.0}),
                     .loop_period_s = 3600};
        const int models = pick({0, 1, 2, 3});
        sea.spectrum = models < 2    ? SpectrumModel::none
                       : models == 2 ? SpectrumModel::jonswap
                                     : SpectrumModel::pierson_moskowitz;
        sea.spreading = SpreadingModel::donelan_banner;
        if (models >= 2 && pick({0, 1}) > 0) sea.wave_height_m = between(0.5, 3), sea.peak_period_s = between(4, 9);
        if (pick({0, 1, 2}) == 0)
            sea.swell_height_m = between(0.3, 2), sea.swell_period_s = between(8, 14),
            sea.swell_direction_rad = between(-pi, pi);
        const int count = pick({1, 2, 3, 4, 5, 6, 7, 8});
        for (int i = 0; i < count; ++i) sea.systems.push_back(system());
        if (pick({0, 1, 2}) == 0) sea.patch_size_m = between(4, 6) * longest_m(sea);
        return sea;
    }

   private:
    template <class Value>
    Value pick(std::initializer_list<Value> of) {
        return of.begin()[random_() % of.size()];
    }
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(random_() % 100000) / 1e5);
    }

    WaveSystem system() {
        WaveSystem of{
            .spectrum = pick({SpectrumModel::jonswap, SpectrumModel::jonswap, SpectrumModel::pierson_moskowitz}),
            .spreading = pick({SpreadingModel::paper, SpreadingModel::cosine_2s, SpreadingModel::hasselmann,
                               SpreadingModel::donelan_banner}),
            .wind_speed_mps = between(5, 14),
            .peak_enhancement = between(1, 7),
            .direction_rad = between(-pi, pi)};
        const int given = pick({0, 1, 2, 3, 3, 3});
        if (given & 1) of.height_m = between(0.2, 2);
        if (given & 2) of.peak_period_s = between(4, 14);
        if (pick({0, 1}) > 0) of.spread_rad = between(12, 50) * degree;
        return of;
    }

    static double longest_m(const SeaState& sea) {
        double longest = 0;
        for (const ModelSystem& system : models_of(sea))
            longest = std::max(longest, 2 * pi / oracle::wave_number_at(system.peak, sea.depth_m));
        return longest;
    }

    std::mt19937 random_{5};
};

void expect_system(const SystemReport& report, const ModelSystem& model, const Integrals& integrals, double kept) {
    EXPECT_NEAR(report.significant_wave_height_m / (std::sqrt(kept) * integrals.height_m()), 1, 0.005);
    EXPECT_NEAR(report.peak_period_s / peak_period_of(model), 1, 0.005);
    EXPECT_LT(std::fabs(turn_between(report.expected_directions.mean_rad, integrals.direction_rad())), 0.5 * degree);
    EXPECT_NEAR(report.expected_directions.spread_rad / integrals.spread_rad(), 1, 0.01);
}

TEST(WaveSystems, OfRandomSeasMatchNumericalIntegrals) {
    RandomSeas seas;
    for (int number = 0; number < 40; ++number) {
        const SeaState sea = seas.next();
        ASSERT_EQ(check(sea), "");
        const Held held(sea);
        const std::vector<ModelSystem> models = models_of(sea);
        std::vector<Integrals> each;
        Integrals sum;
        for (const ModelSystem& model : models) {
            each.push_back(integrals_of(model, sea.depth_m, held));
            sum.add(each.back());
        }
        const double kept = std::min(1.0, std::pow(0.6 * sea.depth_m, 2) / 16 / sum.all);
        const SeaReport report = expected_report_on(sea);
        SCOPED_TRACE("sea " + std::to_string(number) + ", N " + std::to_string(sea.resolution) + ", depth " +
                     std::to_string(sea.depth_m) + ", side " + std::to_string(plan_cascades(sea)[0].grid.side_m));
        std::vector<SystemReport> reports;
        if (report.wind_sea) reports.push_back(*report.wind_sea);
        if (report.swell) reports.push_back(*report.swell);
        for (const SystemReport& system : report.systems) reports.push_back(system);
        ASSERT_EQ(reports.size(), models.size());
        for (std::size_t i = 0; i < models.size(); ++i) {
            if (each[i].m0 < 0.9 * each[i].all) continue;  // most of the system is shorter than the texels
            SCOPED_TRACE("system " + std::to_string(i) + ", peak " + std::to_string(2 * pi / models[i].peak) + " s");
            expect_system(reports[i], models[i], each[i], kept);
        }
        EXPECT_NEAR(report.expected.significant_wave_height_m / (std::sqrt(kept) * sum.height_m()), 1, 0.005);
        EXPECT_NEAR(report.expected_periods.tm02_s / sum.tm02_s(), 1, 0.005);
        EXPECT_NEAR(report.expected_directions.spread_rad / sum.spread_rad(), 1, 0.01);
        const double turned = turn_between(report.expected_directions.mean_rad, sum.direction_rad());
        EXPECT_LT(std::fabs(turned) * sum.r1(), 0.2 * degree) << "waves all round have no direction";
    }
}

// Height and period are those of the system in water of any depth, without breaking.
TEST(WaveSystems, HaveTheirHeightAndPeriodAtAnyDepth) {
    for (const double depth : {4000.0, 30.0, 8.0}) {
        const SeaState sea{.spectrum = SpectrumModel::none,
                           .depth_m = depth,
                           .systems = {{.height_m = 1.5, .peak_period_s = 9, .peak_enhancement = 5}}};
        const SeaReport report = expected_report_on(sea);
        EXPECT_NEAR(report.expected.model_significant_wave_height_m.value(), 1.5, 1.5e-4) << depth;
        EXPECT_NEAR(report.expected.peak_period_s, 9, 1e-3) << depth;
        EXPECT_NEAR(report.expected.peak_wavelength_m, 2 * pi / oracle::wave_number_at(2 * pi / 9, depth), 0.1)
            << depth;
        EXPECT_EQ(report.warnings, std::vector<std::string>{}) << depth;
    }
}

// The wind sea and a system of its options are one sea.
TEST(WaveSystems, OfTheWindSeasOptionsAreTheWindSea) {
    const auto systems = [](const SeaState& of) {
        SeaState sea = of;
        sea.spectrum = SpectrumModel::none;
        sea.wave_height_m = sea.peak_period_s = 0;
        sea.fetch_m = SeaState{}.fetch_m;
        sea.systems = {{.spectrum = of.spectrum,
                        .spreading = of.spreading,
                        .wind_speed_mps = of.wind_speed_mps,
                        .fetch_m = of.fetch_m,
                        .height_m = of.wave_height_m,
                        .peak_period_s = of.peak_period_s,
                        .direction_rad = of.wind_direction_rad}};
        return sea;
    };
    for (const SeaState& sea :
         {SeaState{.spreading = SpreadingModel::hasselmann, .wind_direction_rad = 1, .fetch_m = 40e3, .depth_m = 20},
          SeaState{.spectrum = SpectrumModel::phillips, .wind_speed_mps = 7},
          SeaState{.spectrum = SpectrumModel::pierson_moskowitz,
                   .spreading = SpreadingModel::cosine_2s,
                   .wave_height_m = 2},
          SeaState{.wind_speed_mps = 9, .peak_period_s = 6}}) {
        const CascadePlan plan{.grid = {.side_m = 600}, .resolution = 64};
        const CascadeWaves own(sea, plan), listed(systems(sea), plan);
        for (int m = 1; m < 20; ++m) EXPECT_EQ(own.amplitude(m, 2), listed.amplitude(m, 2)) << m;
    }
}

// Of a JONSWAP sea in deep water, the height alone gives its period and the period alone its height.
TEST(WaveSystems, GrowAsJonswapsLawsSay) {
    for (const double wind : {6.0, 12.0, 25.0}) {
        const SeaState by_fetch{.wind_speed_mps = wind, .fetch_m = 60e3};
        const ExpectedWaves waves = expected_waves(by_fetch);
        const double height = waves.model_significant_wave_height_m.value(), period = waves.peak_period_s;
        EXPECT_NEAR(expected_waves({.wind_speed_mps = wind, .wave_height_m = height}).peak_period_s / period, 1,
                    1e-4);
        EXPECT_NEAR(expected_waves({.wind_speed_mps = wind, .peak_period_s = period})
                            .model_significant_wave_height_m.value() /
                        height,
                    1, 1e-4);
    }
    const SeaState developed{.spectrum = SpectrumModel::pierson_moskowitz, .wind_speed_mps = 11};
    const ExpectedWaves waves = expected_waves(developed);
    SeaState of_period = developed;
    of_period.wind_speed_mps = 5;  // has no effect on the waves
    of_period.peak_period_s = waves.peak_period_s;
    EXPECT_NEAR(expected_waves(of_period).model_significant_wave_height_m.value() /
                    waves.model_significant_wave_height_m.value(),
                1, 1e-4);
}

const SeaState crossing_seas{
    .resolution = 64,
    .wind_speed_mps = 9,
    .wind_direction_rad = 0.5,
    .swell_height_m = 1,
    .swell_direction_rad = 2,
    .loop_period_s = 3600,
    .systems = {
        {.height_m = 1.4, .peak_period_s = 10, .direction_rad = -1, .spread_rad = 0.35},
        {.spreading = SpreadingModel::donelan_banner, .height_m = 0.9, .peak_period_s = 5, .direction_rad = 3}}};

int quarter_octave(double k) { return static_cast<int>(std::floor(4 * std::log2(k))); }

/// Calls add(k, part) for points of a cell, with the part of the cell's energy that each point has.
void for_parts_of_cell(const CascadeWaves& waves, int m, int n, const std::function<void(double, double)>& add) {
    const CascadePlan& plan = waves.cascade();
    const int points = std::hypot(m, n) < 20 ? 8 : 2;
    std::vector<std::pair<double, double>> parts;
    double all = 0;
    for (int i = 0; i < points * points; ++i) {
        const double along = m + (i % points + 0.5) / points - 0.5, across = n + (i / points + 0.5) / points - 0.5;
        const double k = plan.spacing() * std::hypot(along, across);
        if (k < plan.min_k || k >= plan.max_k) continue;
        const auto [kx, kz] = plan.grid.in_world(along * plan.spacing(), across * plan.spacing());
        const auto both = waves.spectrum().amplitude_variances(waves.spectrum().shell(k), kx, kz);
        parts.emplace_back(k, both.along + both.against);
        all += parts.back().second;
    }
    for (const auto& [k, part] : parts) add(k, part / all);
}

// A cell that an edge of a quarter octave cuts is divided as the energy of the model is.
TEST(WaveSystems, CascadesHoldEachQuarterOctaveOnce) {
    for (const int cascades : {2, 4}) {
        SeaState sea = crossing_seas;
        sea.cascades = cascades;
        const std::vector<CascadePlan> plans = plan_cascades(sea);
        std::map<int, double> held, model;
        for (const CascadePlan& plan : plans) {
            const CascadeWaves waves(sea, plan);
            const auto add = [&](int m, int n, const OppositeDensities& of) {
                if (!(of.along + of.against > 0)) return;
                for_parts_of_cell(waves, m, n, [&](double k, double part) {
                    held[quarter_octave(k)] += 2 * (of.along + of.against) * part;
                });
            };
            for (int n = 0; n < sea.resolution / 2; ++n)
                for (int m = n == 0 ? 1 : 0; m < sea.resolution / 2; ++m) {
                    const auto [plus, minus] = waves.variances(m, n);
                    add(m, n, plus);
                    if (m > 0 && n > 0) add(-m, n, minus);
                }
        }
        // The model, by the integrals over frequency.
        double all = 0;
        for (const ModelSystem& system : models_of(sea))
            for (double omega = 0.05; omega < 60; omega *= 1.0005) {
                const double k = oracle::wave_number_at(omega, sea.depth_m),
                             energy = system.density(omega) * omega * 0.0005;
                if (k < plans.back().max_k) model[quarter_octave(k)] += energy;
                all += energy;
            }
        for (const auto& [octave, energy] : model) {
            if (energy < 1e-3 * all || quarter_octave(plans.back().max_k) == octave) continue;
            EXPECT_NEAR(held[octave] / energy, 1, 0.05) << "from k = " << std::exp2(octave / 4.0) << ", " << cascades;
        }
    }
}

// The mean over seeds of the realised variance is the expected one, within three standard errors.
TEST(WaveSystems, RealisedHeightsAreTheExpectedOnesOverSeeds) {
    SeaState sea = crossing_seas;
    double sum = 0, squares = 0;
    constexpr int seeds = 24;
    std::vector<double> of_systems(2);
    SeaReport report;
    for (int seed = 1; seed <= seeds; ++seed) {
        sea.seed = static_cast<std::uint32_t>(seed);
        report = report_on(sea);
        const double variance = std::pow(report.realised_significant_wave_height_m, 2);
        sum += variance / seeds;
        squares += variance * variance / seeds;
        for (std::size_t i = 0; i < 2; ++i)
            of_systems[i] += std::pow(report.systems[i].realised_significant_wave_height_m, 2) / seeds;
    }
    const double error = std::sqrt((squares - sum * sum) / (seeds - 1));
    EXPECT_NEAR(sum, std::pow(report.expected.significant_wave_height_m, 2), 3 * error);
    // A narrow system has fewer waves: its variance varies more than that of the whole sea.
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(std::sqrt(of_systems[i]) / report.systems[i].significant_wave_height_m, 1, 0.1) << i;
}

TEST(WaveSystems, AreNotedWhereTheGridCannotHoldThem) {
    const auto note = [](const SeaState& sea) {
        for (const std::string& warning : warnings_about(sea))
            if (warning.starts_with("the waves of the grid differ")) return warning;
        return std::string();
    };
    SeaState sea = crossing_seas;
    sea.resolution = 128;
    EXPECT_EQ(note(sea), "");
    sea.systems = {{.height_m = 1, .peak_period_s = 14, .direction_rad = 0.1, .spread_rad = 1 * degree}};
    EXPECT_NE(note(sea).find("system 1"), std::string::npos) << note(sea);
    EXPECT_NE(note(sea).find("spread"), std::string::npos) << note(sea);
    EXPECT_NE(note(sea).find("instead of 1 degrees"), std::string::npos) << note(sea);
}

std::string refused(const std::function<void(SeaState&)>& change) {
    SeaState sea = crossing_seas;
    change(sea);
    return check(sea);
}

TEST(WaveSystems, BadInputIsRejectedWithOneLine) {
    EXPECT_EQ(check(crossing_seas), "");
    EXPECT_EQ(refused([](SeaState& sea) { sea.systems[1].height_m = -1; }),
              "systems[1].height_m -1 is out of range (0, 30], or 0: by the wind");
    EXPECT_EQ(refused([](SeaState& sea) { sea.systems[0].peak_period_s = 0.5; }),
              "systems[0].peak_period_s 0.5 is out of range [1, 40], or 0: by the wind");
    EXPECT_EQ(refused([](SeaState& sea) { sea.systems[0].spread_rad = 2; }),
              "systems[0].spread_rad 2 is out of range [pi/180, 4 pi/9], or 0: by the spreading model");
    EXPECT_EQ(refused([](SeaState& sea) { sea.systems[0].fetch_m = 5e3; }),
              "systems[0].fetch_m is 5000, expected none beside height_m");
    EXPECT_EQ(refused([](SeaState& sea) { sea.systems[0].spectrum = SpectrumModel::none; }),
              "systems[0].spectrum is none, expected phillips, pierson-moskowitz or jonswap");
    EXPECT_EQ(refused([](SeaState& sea) { sea.systems[0].spectrum = SpectrumModel::phillips; }),
              "systems[0].height_m is 1.4, expected 0 where the spectrum is phillips");
    EXPECT_EQ(refused([](SeaState& sea) { sea.peak_period_s = 6, sea.fetch_m = 5e3; }),
              "fetch_m is 5000, expected none beside peak_period_s");
    EXPECT_EQ(refused([](SeaState& sea) { sea.spectrum = SpectrumModel::none, sea.wave_height_m = 1; }),
              "wave_height_m is 1, expected 0 where the spectrum is none");
    EXPECT_EQ(refused([](SeaState& sea) { sea.spectrum = SpectrumModel::phillips_paper, sea.swell_height_m = 0; }),
              "the number of systems is 2, expected 0 where the spectrum is phillips-paper");
    EXPECT_EQ(refused([](SeaState& sea) { sea.waves = WaveModel::analytic, sea.swell_height_m = 0; }),
              "the number of systems is 2, expected 0 where waves is analytic");
    EXPECT_EQ(check({.spectrum = SpectrumModel::none}),
              "spectrum is none, expected a swell or a system with it, or another spectrum");
    SeaState full = crossing_seas;
    while (full.systems.size() < max_wave_systems) full.systems.push_back({});
    EXPECT_EQ(check(full), "");
    EXPECT_THROW(full.systems.push_back({}), std::length_error);
}

OceanOptions serial_options() { return {.executor = make_serial_executor()}; }

// The energy of a transition is (1 - s) E0 + s E1, s = 1/2 in the middle.
TEST(WaveSystems, TakePartInTransitions) {
    SeaState calm = crossing_seas;
    calm.systems.clear();
    calm.swell_height_m = 0;
    const Forecast forecast{.first = calm, .changes = {{.sea = crossing_seas, .from_s = 10, .over_s = 20}}};
    ASSERT_EQ(check(forecast), "");
    Ocean ocean(forecast, serial_options());
    const auto energy_at = [&](double time_s) {
        return std::pow(ocean.frame_at(time_s).statistics.significant_wave_height_m, 2);
    };
    const double before = energy_at(0), after = energy_at(40);
    EXPECT_NEAR(energy_at(20), (before + after) / 2, 1e-9 * after);
    EXPECT_NEAR(std::sqrt(after), expected_waves(crossing_seas).significant_wave_height_m, 0.005 * std::sqrt(after));
    EXPECT_EQ(ocean.frame_at(12).sea.systems.size(), 0u);
    EXPECT_EQ(ocean.frame_at(28).sea.systems.size(), 2u);
}

// Without a swell of the options, the longest system is the one that arrives.
TEST(WaveSystems, ArriveFromAfarLongestFirst) {
    SeaState calm{.resolution = 64, .wind_speed_mps = 4, .loop_period_s = 3600};
    SeaState later = calm;
    later.systems = {{.height_m = 2, .peak_period_s = 14}, {.height_m = 1, .peak_period_s = 7}};
    const Forecast forecast{.first = calm,
                            .changes = {{.sea = later, .from_s = 0, .over_s = 600, .swell_from_m = 1e5}}};
    ASSERT_EQ(check(forecast), "");
    // In deep water the group velocity is g T / 4 pi: 1.5 periods of 14 s begin, a third ends.
    const auto travel_s = [](double period_s) { return 1e5 * 4 * pi / (g * period_s); };
    EXPECT_NEAR(forecast.changes[0].end_s(), 600 + travel_s(14 / 3.0) - travel_s(21), 1);
    Ocean ocean(forecast, serial_options());
    const double long_waves = travel_s(14) - travel_s(21) + 600, all = forecast.changes[0].end_s() + 1;
    const double half_way = ocean.frame_at(long_waves).statistics.significant_wave_height_m;
    EXPECT_GT(half_way, 1);
    EXPECT_GT(ocean.frame_at(all).statistics.significant_wave_height_m, half_way);
}

// The long waves of a shore have the energy and the directions of the systems around their peaks.
TEST(WaveSystems, ComeToAShore) {
    const SeaState sea{.spectrum = SpectrumModel::none,
                       .resolution = 64,
                       .depth_m = 30,
                       .systems = {{.height_m = 1, .peak_period_s = 14, .direction_rad = -1, .spread_rad = 0.2},
                                   {.height_m = 2, .peak_period_s = 8, .direction_rad = 2.5, .spread_rad = 0.2}}};
    const CascadePlan coarsest = plan_cascades(sea).front();
    std::array<Integrals, 2> found, expected;
    const auto add = [](std::array<Integrals, 2>& to, double omega, const Integrals& of) {
        const double period = 2 * pi / omega;
        if (period > 12.5) to[0].add(of);
        if (period > 7 && period < 9) to[1].add(of);
    };
    for (const ShoreWave& wave : shore_waves(sea, coarsest)) {
        const double energy = wave.amplitude_m * wave.amplitude_m / 2;
        add(found, wave.omega, {0, energy, 0, energy * wave.along_x, energy * wave.along_z});
    }
    for (const ModelSystem& system : models_of(sea))
        for (double omega = 0.2; omega_of(coarsest.max_k, sea.depth_m) > omega; omega *= 1.001) {
            const double energy = system.density(omega) * omega * 0.001, along = energy * (1 - 0.2 * 0.2 / 2);
            add(expected, omega,
                {0, energy, 0, along * std::cos(system.direction_rad), along * std::sin(system.direction_rad)});
        }
    for (std::size_t i = 0; i < 2; ++i) {
        // Each wave has the same energy, and few waves are of one system.
        EXPECT_NEAR(found[i].m0 / expected[i].m0, 1, 0.25) << i;
        EXPECT_NEAR(found[i].direction_rad(), expected[i].direction_rad(), 0.15) << i;
        EXPECT_NEAR(found[i].spread_rad(), expected[i].spread_rad(), 0.15) << i;
    }
}

}  // namespace
}  // namespace pelagic
