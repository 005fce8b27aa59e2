// Each cascade of a stack, compared with the sum of its waves by definition: rotated grids,
// disjoint bands, separate random numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/spectrum/wave_noise.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

/// One wave of a cascade, with its wave vector in world axes.
struct OracleWave {
    double kx, kz;
    std::complex<double> height;   ///< amplitude h~ at the given time
    std::complex<double> forward;  ///< amplitude of the displacement along k, over the choppiness
};

/// The integral of the spectrum over the band's share of a cell of wave vectors, divided by the
/// area of the cell; sampled at 40 x 40 points.
double energy_of_cell(const SeaState& sea, const CascadePlan& cascade, int m, int n) {
    constexpr int places = 40;
    double sum = 0;
    for (int row = 0; row < places; ++row) {
        for (int column = 0; column < places; ++column) {
            const auto [kx, kz] = cascade.grid.in_world((m + (column + 0.5) / places - 0.5) * cascade.spacing(),
                                                        (n + (row + 0.5) / places - 0.5) * cascade.spacing());
            const double k = std::hypot(kx, kz);
            if (k >= cascade.min_k && k < cascade.max_k) sum += oracle::density(sea, kx, kz);
        }
    }
    return sum / (places * places);
}

double frequency(double k, double loop_period_s) {
    const double omega = std::sqrt(oracle::gravity * k + 0.074 / 1025 * k * k * k);
    return std::max(1.0, std::round(omega * loop_period_s / (2 * pi))) * 2 * pi / loop_period_s;
}

std::vector<OracleWave> oracle_waves_of(const SeaState& sea, const CascadePlan& cascade, double time_s) {
    const int last = cascade.resolution / 2 - 1;
    const auto drawn = [&](int m, int n) {
        const GaussianPair xi = gaussian_pair(sea.seed, cascade.number, m, n);
        return std::complex<double>(xi.re, xi.im) / 2.0 * std::sqrt(energy_of_cell(sea, cascade, m, n)) *
               cascade.spacing();
    };
    std::vector<OracleWave> waves;
    for (int n = -last; n <= last; ++n) {
        for (int m = -last; m <= last; ++m) {
            const auto [kx, kz] = cascade.grid.in_world(m * cascade.spacing(), n * cascade.spacing());
            const double k = std::hypot(kx, kz), reach = cascade.spacing();
            if (k + reach < cascade.min_k || k - reach > cascade.max_k || k == 0) continue;
            const double phase = frequency(k, sea.loop_period_s) * time_s;
            const std::complex<double> along = drawn(m, n) * std::polar(1.0, -phase);
            const std::complex<double> against = std::conj(drawn(-m, -n)) * std::polar(1.0, phase);
            const double lean = std::atan(sea.lean);
            waves.push_back({kx, kz, along + against,
                             std::cos(lean) * std::complex<double>(0, 1) * (along + against) +
                                 std::sin(lean) * (along - against)});
        }
    }
    return waves;
}

// The library averages a cell over 8 x 8 points where the edge of a band cuts it, and over 4 x 4
// points elsewhere near k = 0. All waves of so small a coarsest cascade are on the flank below the
// peak, where the spectrum doubles within a cell: energies are within 5 % there, amplitudes within
// half of that. A wrong sign, rotation or random number would give an error of 100 %.
TEST(CascadeStack, EachCascadeIsTheSumOfItsWaves) {
    const SeaState sea{
        .cascades = 3, .resolution = 32, .wind_direction_rad = 0.7, .choppiness = 0.9, .lean = 0.3, .seed = 5};
    const double time_s = 12.34;
    Ocean ocean(sea, {.executor = make_serial_executor()});
    const Frame& frame = ocean.frame_at(time_s);
    const std::vector<CascadePlan> plans = plan_cascades(sea);
    ASSERT_EQ(frame.cascades.size(), 3u);
    std::mt19937 random(3);
    for (std::size_t number = 0; number < plans.size(); ++number) {
        const Cascade& cascade = frame.cascades[number];
        EXPECT_EQ(cascade.grid.side_m, plans[number].grid.side_m);
        EXPECT_EQ(cascade.grid.is_rotated(), number > 0);
        const std::vector<OracleWave> waves = oracle_waves_of(sea, plans[number], time_s);
        double off = 0, all = 0;
        for (int texel = 0; texel < 40; ++texel) {
            const int i = static_cast<int>(random() % 32), j = static_cast<int>(random() % 32);
            const auto [x, z] = cascade.grid.in_world(i * cascade.texel_m(), j * cascade.texel_m());
            double height = 0, dx = 0, dz = 0;
            for (const OracleWave& wave : waves) {
                const std::complex<double> here = wave.height * std::polar(1.0, wave.kx * x + wave.kz * z);
                const double k = std::hypot(wave.kx, wave.kz);
                height += here.real();
                const double moved = (wave.forward * std::polar(1.0, wave.kx * x + wave.kz * z)).real();
                dx += sea.choppiness * wave.kx / k * moved;
                dz += sea.choppiness * wave.kz / k * moved;
            }
            const double d[] = {cascade.height.at(i, j) - height, cascade.dx.at(i, j) - dx, cascade.dz.at(i, j) - dz};
            for (const double part : d) off += part * part;
            all += height * height + dx * dx + dz * dz;
        }
        ASSERT_GT(all, 0);
        EXPECT_LT(std::sqrt(off / all), 0.03) << "cascade " << number;
        RecordProperty("off_" + std::to_string(number), std::to_string(std::sqrt(off / all)));
    }
}

std::size_t octave(double k) { return static_cast<std::size_t>(std::log2(k) + 20); }

/// For each octave, the fraction of a cell's energy that comes from it. The wave at the cell's
/// centre represents the share of the whole cell that is in the band.
std::map<std::size_t, double> octaves_of_cell(const CascadeWaves& waves, int m, int n) {
    constexpr int places = 12;
    const CascadePlan& cascade = waves.cascade();
    std::map<std::size_t, double> parts;
    double all = 0;
    for (int row = 0; row < places; ++row) {
        for (int column = 0; column < places; ++column) {
            const double k =
                cascade.spacing() * std::hypot(m + (column + 0.5) / places - 0.5, n + (row + 0.5) / places - 0.5);
            if (k < cascade.min_k || k >= cascade.max_k) continue;
            const double energy = waves.spectrum().radial_density(k) / k;
            parts[octave(k)] += energy;
            all += energy;
        }
    }
    for (auto& [of, part] : parts) part /= all > 0 ? all : 1;
    return parts;
}

// The cascades together hold the variance of height and of slope, and of each octave, once each,
// for any number of cascades.
TEST(CascadeStack, BandsCoverTheWaveNumbersOnce) {
    for (const double wind_speed_mps : {3.0, 12.0, 25.0}) {
        for (const auto& [cascades, resolution] : {std::pair{1, 256}, {2, 128}, {3, 64}, {3, 128}, {4, 128}}) {
            const SeaState sea{.cascades = cascades, .resolution = resolution, .wind_speed_mps = wind_speed_mps};
            const std::vector<CascadePlan> plans = plan_cascades(sea);
            ASSERT_EQ(static_cast<int>(plans.size()), cascades);
            EXPECT_EQ(plans.front().min_k, 0);
            std::vector<double> held(40), model(40);
            for (std::size_t i = 0; i < plans.size(); ++i) {
                const CascadePlan& cascade = plans[i];
                const double texels = 2 * pi / cascade.max_k / (cascade.grid.side_m / resolution);
                EXPECT_GE(texels, 3 - 1e-9);
                if (i > 0) {
                    EXPECT_EQ(cascade.min_k, plans[i - 1].max_k);
                    EXPECT_GE(cascade.min_k / cascade.spacing(), 6 - 1e-9);
                }
                const CascadeWaves waves(sea, cascade);
                for (int n = 0; n < resolution / 2; ++n) {
                    for (int m = n == 0 ? 1 : 0; m < resolution / 2; ++m) {
                        const auto [plus, minus] = waves.variances(m, n);
                        double energy = 2 * (plus.along + plus.against);
                        if (m > 0 && n > 0) energy += 2 * (minus.along + minus.against);
                        for (const auto& [of, part] : octaves_of_cell(waves, m, n)) held[of] += part * energy;
                    }
                }
                // Integral of the model over the band: midpoint rule in log k, in steps of 0.1 %.
                for (double k = std::max(cascade.min_k, 1e-5); k < cascade.max_k; k *= 1.001) {
                    const double next = std::min(k * 1.001, cascade.max_k), middle = (k + next) / 2;
                    model[octave(middle)] += waves.spectrum().radial_density(middle) * (next - k);
                }
            }
            const double all = std::accumulate(model.begin(), model.end(), 0.0);
            EXPECT_NEAR(std::accumulate(held.begin(), held.end(), 0.0) / all, 1, 0.01)
                << wind_speed_mps << " m/s, " << cascades << " of " << resolution;
            double slopes_held = 0, slopes_model = 0;
            for (std::size_t i = 0; i < held.size(); ++i) {
                const double k = std::exp2(static_cast<double>(i) - 19.5);
                slopes_held += k * k * held[i], slopes_model += k * k * model[i];
                if (model[i] < 1e-3 * all) continue;
                EXPECT_NEAR(held[i] / model[i], 1, 0.02)
                    << "octave from k = " << std::exp2(static_cast<double>(i) - 20) << ", " << wind_speed_mps
                    << " m/s, " << cascades << " of " << resolution;
            }
            EXPECT_NEAR(slopes_held / slopes_model, 1, 0.01) << wind_speed_mps << " m/s, " << cascades;
        }
    }
}

/// Correlation of the heights of two points that are (x, z) apart, averaged over time and position,
/// from the amplitudes drawn for this seed.
double correlation_at_lag(const std::vector<CascadeWaves>& cascades, double x, double z) {
    double together = 0, all = 0;
    for (const CascadeWaves& waves : cascades) {
        const CascadePlan& cascade = waves.cascade();
        const int half = cascade.resolution / 2;
        for (int n = 0; n < half; ++n) {
            for (int m = n == 0 ? 1 : -half + 1; m < half; ++m) {
                const auto [kx, kz] = cascade.grid.in_world(m * cascade.spacing(), n * cascade.spacing());
                const OppositeWaves pair = waves.pair(m, n).plus;
                together += pair.realised_square() * std::cos(kx * x + kz * z);
                all += pair.realised_square();
            }
        }
    }
    return together / all;
}

double largest_correlation(SeaState sea) {
    std::vector<CascadeWaves> cascades;
    for (const CascadePlan& cascade : plan_cascades(sea)) cascades.emplace_back(sea, cascade);
    double max = 0;
    for (double lag_m = 200; lag_m <= 900; lag_m += 50)
        for (int direction = 0; direction < 8; ++direction) {
            const double angle = direction * pi / 8;
            max = std::max(max, correlation_at_lag(cascades, lag_m * std::cos(angle), lag_m * std::sin(angle)));
        }
    return max;
}

// A sea must show no repeated pattern from above. A single cascade of 250 m repeats completely
// after 250 m.
TEST(CascadeStack, HeightsDoNotRepeatWithin900Metres) {
    SeaState sea = sea_preset_named("moderate")->sea;
    // only long waves matter here; the side of the coarsest cascade does not change
    sea.resolution = 64;
    const double stack = largest_correlation(sea);
    EXPECT_LT(stack, 0.25);
    sea.patch_size_m = 250;
    EXPECT_GT(largest_correlation(sea), 0.99);
    RecordProperty("stack", std::to_string(stack));
}

}  // namespace
}  // namespace pelagic
