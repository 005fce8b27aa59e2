// The formula of accumulated foam, compared with simulated foam on sums of many waves in time.
#include "pelagic/sim/foam/accumulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

constexpr double foam_tick_s = 0.19;
/// Contraction of the water by one deviation of z, about that of the default sea.
constexpr double contracts = 0.2;

double fraction_above(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }

/// Waves of equal energy at random frequencies from 0.5 to 1.5 times `frequency_radps`; standard
/// deviation 1.
class RandomWaves {
   public:
    RandomWaves(double frequency_radps, unsigned seed) {
        std::mt19937 random(seed);
        const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
        for (int wave = 0; wave < 48; ++wave) {
            const double omega = frequency_radps * (0.5 + uniform());
            waves_.push_back(std::polar(std::sqrt(2.0 / 48), 6.283185307 * uniform()));
            turns_.push_back(std::polar(1.0, omega * foam_tick_s));
            rate_ += omega * omega / 48;
        }
    }

    double rate_radps() const { return std::sqrt(rate_); }
    /// Correlation of the sum with itself a number of ticks ago.
    double correlation(double ticks) const {
        double sum = 0;
        for (const std::complex<double>& turn : turns_) sum += std::cos(ticks * std::arg(turn)) / 48;
        return sum;
    }
    double next() {
        double sum = 0;
        for (std::size_t i = 0; i < waves_.size(); ++i) {
            sum += waves_[i].real();
            // Written in components, because the product of std::complex checks for infinities.
            const double re = waves_[i].real(), im = waves_[i].imag(), c = turns_[i].real(), s = turns_[i].imag();
            waves_[i] = {re * c - im * s, re * s + im * c};
        }
        return sum;
    }

   private:
    std::vector<std::complex<double>> waves_, turns_;
    double rate_ = 0;
};

TEST(FoamAccumulation, CoverMatchesTheFormula) {
    for (const double frequency_radps : {0.37, 1.05, 3.7}) {
        for (const double level : {1.5, 2.5}) {
            if (is_sanitized && (frequency_radps != 1.05 || level != 1.5)) continue;
            double measured = 0, expected = 0, measured_area = 0, expected_area = 0;
            const int seas = 150, ticks = 2000;
            for (unsigned sea = 0; sea < seas; ++sea) {
                RandomWaves waves(frequency_radps, sea);
                FoamAccumulation::Contraction contraction;
                for (std::size_t tick = 0; tick < contraction.size(); ++tick)
                    contraction[tick] = contracts * waves.correlation(static_cast<double>(tick));
                double foam = 0, sum = 0, sum_of_area = 0;
                for (int tick = -30; tick < ticks; ++tick) {
                    const double z = waves.next(), source = 0.5 + (z - level) / FoamAccumulation::ramp_deviations;
                    foam = std::max(std::clamp(source, 0.0, 1.0), foam - 1 / FoamAccumulation::fading_ticks);
                    if (tick < 0) continue;
                    sum += foam;
                    sum_of_area += (1 - contracts * z) * foam;
                }
                const FoamAccumulation formula(waves.rate_radps(), foam_tick_s);
                measured += sum / ticks / seas;
                measured_area += sum_of_area / ticks / seas;
                expected += formula.cover(level) / seas;
                expected_area += formula.cover_of_area(level, contraction) / seas;
            }
            // Crossings come in groups, which the formula neglects: the ratio is 0.93 for rare
            // crossings of short waves, and 1.05 otherwise.
            EXPECT_NEAR(measured / expected, 1, 0.1) << frequency_radps << " rad/s, level " << level;
            EXPECT_NEAR(measured_area / measured, expected_area / expected, 0.03)
                << frequency_radps << " rad/s, level " << level;
        }
    }
}

TEST(FoamAccumulation, CoverOfStaticWavesEqualsTheSource) {
    for (const double level : {1.0, 2.0, 3.0, 4.0}) {
        double source = 0;
        for (int i = 0; i < 1000; ++i)
            source += fraction_above(level + FoamAccumulation::ramp_deviations * ((i + 0.5) / 1000 - 0.5)) / 1000;
        // The formula takes crossings as independent, so some coincide: half of a twentieth, which
        // is the ramp's share at level 1.
        const FoamAccumulation foam(1e-6, foam_tick_s);
        EXPECT_NEAR(foam.cover(level) / source, 1, 0.025) << level;
        // That of the area counts crossings from below only.
        EXPECT_NEAR(foam.cover_of_area(level, {}) / source, 1, 0.005) << level;
    }
}

TEST(FoamAccumulation, LevelInvertsCover) {
    for (double frequency_radps = 0.01; frequency_radps < 60; frequency_radps *= 3)
        for (double cover = 1e-12; cover <= 0.4; cover *= 3) {
            const FoamAccumulation foam(frequency_radps, foam_tick_s);
            // That of the light winds in which whitecaps are rare. The largest z of a rough sea is
            // where it folds over itself.
            FoamAccumulation::Contraction contraction;
            for (std::size_t tick = 0; tick < contraction.size(); ++tick)
                contraction[tick] = 0.05 * std::cos(static_cast<double>(tick) * foam_tick_s * frequency_radps);
            const double level = foam.level_of_area(cover, contraction);
            EXPECT_NEAR(foam.cover_of_area(level, contraction) / cover, 1, 2e-3) << frequency_radps << " rad/s";
            EXPECT_GT(foam.cover_of_area(level - 0.1, contraction), cover);
        }
}

}  // namespace
}  // namespace pelagic
