// The foam texture as numbers: it repeats without a seam, covers the fraction that a threshold sets
// at every level, and has three scales. These tests need no GL.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "pelagic/gl/water/foam_image.hpp"

namespace pelagic {
namespace {

using gl::FoamImage;
constexpr int foam_side = FoamImage::side;
constexpr std::array layers = {FoamImage::bubbles, FoamImage::lace, FoamImage::streaks};

const FoamImage& image() {
    static const FoamImage made = gl::make_foam_image(*make_serial_executor());
    return made;
}

double rank(FoamImage::Layer layer, int x, int y, int level = 0) {
    return image().texel(level, layer, x, y)[0] / 255.0;
}

/// Returns the mean square step from one column, or row, to the next.
double step(FoamImage::Layer layer, int channel, int from, bool columns) {
    double square = 0;
    for (int i = 0; i < foam_side; ++i) {
        const int a = image().texel(0, layer, columns ? from : i, columns ? i : from)[channel];
        const int b = image().texel(0, layer, columns ? from + 1 : i, columns ? i : from + 1)[channel];
        square += (a - b) * (a - b);
    }
    return square / foam_side;
}

// At a seam the step to the next column would be that of unrelated texels, many times the usual
// step.
TEST(FoamImage, RepeatsWithoutASeam) {
    for (const FoamImage::Layer layer : layers)
        for (int channel = 0; channel < 4; ++channel)
            for (const bool columns : {false, true}) {
                double largest = 0;
                for (int i = 0; i + 1 < foam_side; ++i) largest = std::max(largest, step(layer, channel, i, columns));
                EXPECT_LE(step(layer, channel, foam_side - 1, columns), largest)
                    << "layer " << layer << ", channel " << channel;
            }
}

TEST(FoamImage, CoversTheFractionOfTheThresholdAtEachLevel) {
    for (const FoamImage::Layer layer : layers)
        for (int level = 0; level <= 4; ++level)
            for (const double amount : {0.02, 0.1, 0.3, 0.5, 0.8, 0.97}) {
                const int width = foam_side >> level;
                int covered = 0;
                for (int y = 0; y < width; ++y)
                    for (int x = 0; x < width; ++x) covered += rank(layer, x, y, level) > 1 - amount;
                EXPECT_NEAR(static_cast<double>(covered) / (width * width), amount, 0.01)
                    << "layer " << layer << ", level " << level;
            }
}

/// Returns the variance of `value(x, y)` by waves across the layer, kx + side ky; both from 0 to side
/// / 2, of all four signs.
template <class Value>
std::vector<double> power_of(const Value& value) {
    std::vector<std::complex<double>> turns, lines(foam_side * foam_side);
    for (int i = 0; i < foam_side; ++i) turns.push_back(std::polar(1.0, -2 * std::numbers::pi * i / foam_side));
    for (int y = 0; y < foam_side; ++y)
        for (int k = 0; k < foam_side; ++k)
            for (int x = 0; x < foam_side; ++x)
                lines[static_cast<std::size_t>(y * foam_side + k)] +=
                    turns[static_cast<std::size_t>(k * x % foam_side)] * value(x, y);
    std::vector<double> power(foam_side * foam_side);
    for (int k = 0; k < foam_side; ++k)
        for (int l = 0; l <= foam_side / 2; ++l) {
            std::complex<double> sum = 0;
            for (int y = 0; y < foam_side; ++y)
                sum += turns[static_cast<std::size_t>(l * y % foam_side)] *
                       lines[static_cast<std::size_t>(y * foam_side + k)];
            power[static_cast<std::size_t>(std::min(k, foam_side - k) + foam_side * l)] += std::norm(sum);
        }
    power[0] = 0;
    return power;
}

/// Returns the wavelengths, in metres, above which 10 %, 50 % and 90 % of the variance lie.
/// `waves_per_m(kx, ky)` is 1 / wavelength.
template <class WavesPerMetre>
std::array<double, 3> wavelengths(FoamImage::Layer layer, const char* name, const WavesPerMetre& waves_per_m) {
    const std::vector<double> power = power_of([&](int x, int y) { return rank(layer, x, y); });
    std::vector<std::pair<double, double>> sorted;
    double all = 0;
    for (int i = 0; i < foam_side * foam_side; ++i)
        if (const double p = power[static_cast<std::size_t>(i)]; p > 0) {
            sorted.emplace_back(waves_per_m(i % foam_side, i / foam_side), p);
            all += p;
        }
    std::sort(sorted.begin(), sorted.end());
    std::array<double, 3> found{};
    double before = 0;
    for (const auto& [waves, p] : sorted) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double part = std::array{0.1, 0.5, 0.9}[i] * all;
            if (before < part && before + p >= part) found[i] = 1 / waves;
        }
        before += p;
    }
    std::printf("%s: %.3f, %.3f, %.3f m\n", name, found[0], found[1], found[2]);
    return found;
}

// The sizes that foam_image.hpp states: a wavelength is a bubble, a hole in the lace, or the
// distance between two streaks.
TEST(FoamImage, HasThreeScales) {
    using gl::FoamSizes;
    const auto round = [](double tile_m) { return [=](int kx, int ky) { return std::hypot(kx, ky) / tile_m; }; };
    const auto bubbles = wavelengths(FoamImage::bubbles, "bubbles", round(FoamSizes::bubbles_m));
    EXPECT_LT(bubbles[0], 0.02);
    EXPECT_LT(bubbles[1], 0.008);
    EXPECT_GT(bubbles[2], 0.001);
    const auto lace = wavelengths(FoamImage::lace, "lace", round(FoamSizes::lace_m));
    EXPECT_GT(lace[1], 1);
    EXPECT_GT(lace[0], 10 * lace[2]);  // a decade of sizes at each scale
    const auto across = wavelengths(FoamImage::streaks, "streaks across",
                                    [](int, int ky) { return (ky + 0.01) / FoamSizes::streaks_across_m[0]; });
    const auto along = wavelengths(FoamImage::streaks, "streaks along",
                                   [](int kx, int) { return (kx + 0.01) / FoamSizes::streaks_along_m[0]; });
    EXPECT_LT(across[1], 20);
    EXPECT_GT(across[2], 1);
    EXPECT_GT(along[1], 5 * across[1]);  // streaks are many times as long as their spacing
}

// Walls of equal cells would be a peak of the spectrum: white noise through a filter of one octave
// exceeds its neighbours by far more than 1.5. Octaves below 4 waves hold too few to compare.
TEST(FoamImage, CoverOfLaceHasNoPreferredSize) {
    for (const double amount : {0.2, 0.5, 0.8}) {
        const std::vector<double> power =
            power_of([&](int x, int y) { return rank(FoamImage::lace, x, y) > 1 - amount ? 1.0 : 0.0; });
        std::array<double, 7> octaves{};
        for (int i = 0; i < foam_side * foam_side; ++i)
            if (const double k = std::hypot(i % foam_side, i / foam_side); k >= 1 && k < 128)
                octaves[static_cast<std::size_t>(std::log2(k))] += power[static_cast<std::size_t>(i)];
        for (std::size_t i = 2; i + 1 < octaves.size(); ++i) {
            const double prevails = octaves[i] / std::sqrt(octaves[i - 1] * octaves[i + 1]);
            std::printf("cover %.1f, %d waves: %.2f\n", amount, 1 << i, prevails);
            EXPECT_LT(prevails, 1.5);
        }
    }
}

// Scores of independent samples are added, so each is a standard normal variable at every level.
TEST(FoamImage, HasNormalScores) {
    for (const FoamImage::Layer layer : layers)
        for (int level = 0; level <= 4; ++level) {
            const int width = foam_side >> level;
            double sum = 0, square = 0;
            for (int y = 0; y < width; ++y)
                for (int x = 0; x < width; ++x) {
                    const double score =
                        (image().texel(level, layer, x, y)[3] - 128) / 127.0 * double{FoamImage::largest_score};
                    sum += score / (width * width);
                    square += score * score / (width * width);
                }
            // A byte is 0.025, and scores above 3.2 are cut off.
            EXPECT_NEAR(sum, 0, 0.02) << "layer " << layer << ", level " << level;
            EXPECT_NEAR(square, 1, 0.04) << "layer " << layer << ", level " << level;
        }
}

TEST(FoamImage, DoesNotDependOnTheNumberOfThreads) {
    EXPECT_EQ(gl::make_foam_image(*make_thread_executor(5)).texels, image().texels);
}

}  // namespace
}  // namespace pelagic
