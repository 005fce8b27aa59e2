// Camera exposure as numbers. These tests need no GL.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "pelagic/gl/exposure.hpp"

namespace pelagic {
namespace {

/// Cells of an image, each of one luminance, cd/m^2.
std::vector<gl::MeteredCell> cells(std::vector<std::pair<int, double>> counts) {
    std::vector<gl::MeteredCell> all;
    for (const auto& [count, luminance] : counts)
        all.insert(all.end(), static_cast<std::size_t>(count),
                   {static_cast<float>(std::log2(luminance)), static_cast<float>(std::log2(luminance))});
    return all;
}

/// Returns the displayed value of a luminance in a metered image.
double shown(double luminance, float ev) {
    return static_cast<double>(gl::shown_by_film(static_cast<float>(luminance) * gl::exposure_of_ev(ev, 1)));
}

TEST(Film, CurveIsMonotonicAndInvertible) {
    float last = -1;
    for (float scene = 0.001f; scene < 1000; scene *= 1.01f) {
        const float value = gl::shown_by_film(scene);
        EXPECT_GE(value, last);
        last = value;
        if (value > 0.001f && value < 0.99f) {
            EXPECT_NEAR(gl::film_input_of(value) / scene, 1, 1e-3);
        }
    }
}

/// Stephen Hill's fit of the Academy's curve for grey (2016), in double.
double filmic_curve(double scene) {
    return (scene * (scene + 0.0245786) - 0.000090537) / (scene * (0.983729 * scene + 0.4329510) + 0.238081);
}

// Far below 0.25 a luminance y is shown as the curve shows 0.25 (y / 0.25)^0.75, and far above
// unchanged. The factor (1 + (0.25 / y)^2)^(1/8) between them is 1.001 too large at 0.023, and
// 1.002 at 2.
TEST(Film, LiftsShadowsOnly) {
    for (const double scene : {1e-3, 5e-3, 0.023})
        EXPECT_NEAR(gl::shown_by_film(static_cast<float>(scene)), filmic_curve(0.25 * std::pow(scene / 0.25, 0.75)),
                    1e-4)
            << scene;
    for (const double scene : {2.0, 8.0})
        EXPECT_NEAR(gl::shown_by_film(static_cast<float>(scene)), filmic_curve(scene), 1e-3) << scene;
}

// Published exposures, ISO 100 (ANSI PH2.7-1973): sunlit landscapes of about 4000 cd/m^2 are EV 15.
TEST(Metering, UniformViewIsMiddleGreyAtThePublishedEv) {
    EXPECT_NEAR(gl::metered_ev(cells({{100, 4096}}), 1), 15, 1e-3);
    EXPECT_NEAR(gl::metered_ev(cells({{100, 32768}}), 1), 18, 1e-3);
    for (const double luminance : {4000.0, 9000.0, 30000.0})
        EXPECT_NEAR(shown(luminance, gl::metered_ev(cells({{64, luminance}}), 1)), 0.18, 1e-3) << luminance;
}

TEST(Metering, HalfDarkHalfLightCountsAsTheirGeometricMean) {
    EXPECT_NEAR(gl::metered_ev(cells({{50, 1500}, {50, 13500}}), 1), gl::metered_ev(cells({{1, 4500}}), 1), 1e-3);
}

TEST(Metering, DoesNotDependOnTheUnit) {
    std::vector<gl::MeteredCell> relative = cells({{50, 100.0 / 133100}, {50, 900.0 / 133100}});
    EXPECT_NEAR(gl::metered_ev(relative, 133100), gl::metered_ev(cells({{50, 100}, {50, 900}}), 1), 1e-3);
}

TEST(Metering, ProtectsHighlights) {
    const float plain = gl::metered_ev(cells({{100, 5000}}), 1);
    // One cell in a hundred may be overexposed: only the average counts.
    EXPECT_NEAR(gl::metered_ev(cells({{990, 5000}, {10, 5e5}}), 1), plain + std::log2(std::pow(100, 0.01)), 2e-3);
    // Five such cells are shown as bright, not white.
    const double bright = 5000 * 20;
    EXPECT_NEAR(shown(bright, gl::metered_ev(cells({{95, 5000}, {5, bright}}), 1)), 0.9, 2e-3);
    // The other cells stay visible: half of them at 0.065 or more, and all of them at most 1.5
    // stops below their average.
    EXPECT_NEAR(shown(5000, gl::metered_ev(cells({{95, 5000}, {5, 5e7}}), 1)), 0.065, 1e-3);
    const double average = 0.71 * std::log2(20'000) + 0.24 * std::log2(1200) + 0.05 * std::log2(5e7);
    EXPECT_NEAR(gl::metered_ev(cells({{71, 20'000}, {24, 1200}, {5, 5e7}}), 1), average + 3 + 1.5, 2e-3);
}

// A third of the view is bright sky over dark water; the average alone would show the water as
// 0.02.
TEST(Metering, KeepsHalfOfTheViewVisible) {
    const auto view = cells({{60, 200}, {40, 40'000}});
    // slightly dim: 1600 cd/m^2 in the mean
    EXPECT_GE(shown(200, gl::metered_ev(view, 1)), 0.0649 * 0.9);
}

// Three tenths of the view are water in the shade of waves. They are shown as at least 0.035,
// unless that takes more than a stop.
TEST(Metering, KeepsDarkWaterReadable) {
    for (const double dark : {1500.0, 1000.0, 50.0}) {
        const float ev = gl::metered_ev(cells({{30, dark}, {30, 5000}, {40, 40'000}}), 1);
        const double average = 0.3 * std::log2(dark) + 0.3 * std::log2(5000) + 0.4 * std::log2(40'000);
        EXPECT_GE(ev, average + 3 - 1 - 1e-3) << dark;
        if (dark >= 1000) {
            EXPECT_GE(shown(dark, ev), 0.0349) << dark;
        }
    }
}

// Krawczyk et al. 2005 show the dark as 0.03; by day a camera shows middle grey. The transition is
// monotonic: a brighter view is never shown darker, nor with a longer exposure. A storm at noon is
// not exposed as dusk.
TEST(Metering, NightIsShownDark) {
    EXPECT_NEAR(shown(2e-3, gl::metered_ev(cells({{10, 2e-3}}), 1)), 0.0305, 1e-3);
    EXPECT_GT(shown(500, gl::metered_ev(cells({{10, 500}}), 1)), 0.16);
    EXPECT_LT(shown(3, gl::metered_ev(cells({{10, 3}}), 1)), 0.12);
    double last_shown = 0;
    float last_ev = -100;
    for (double luminance = 1e-3; luminance < 1e5; luminance *= 1.1) {
        const float ev = gl::metered_ev(cells({{10, luminance}}), 1);
        EXPECT_GE(shown(luminance, ev), last_shown - 1e-4) << luminance;
        EXPECT_GT(ev, last_ev) << luminance;
        last_shown = shown(luminance, ev);
        last_ev = ev;
    }
}

TEST(Metering, IsFiniteForAnyShaderOutput) {
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    const float dark = gl::metered_ev(std::vector<gl::MeteredCell>{}, 1);
    EXPECT_TRUE(std::isfinite(dark));
    EXPECT_EQ(gl::metered_ev(std::vector<gl::MeteredCell>{{-infinity, -infinity}, {nan, nan}, {infinity, 0}}, 1),
              dark);
    EXPECT_EQ(gl::metered_ev(cells({{1, 1e-9}}), 1), dark);
    EXPECT_EQ(gl::metered_ev(cells({{1, 1e12}}), 1), gl::max_ev);
}

TEST(Following, DoesNotDependOnTheFrameRate) {
    const double part = 1 - std::exp(-1.0);  // 63 %
    for (const int frames : {1, 7, 24, 1000}) {
        gl::FollowedExposure up, down;
        up.follow(10, 0);
        down.follow(10, 0);
        for (int i = 0; i < frames; ++i) {
            up.follow(14, gl::FollowedExposure::to_brighter_s / frames);
            down.follow(6, gl::FollowedExposure::to_darker_s / frames);
        }
        // The error of a thousand roundings of a float near 10 is 1e-3.
        EXPECT_NEAR(up.ev(), 10 + 4 * part, 1e-3) << frames;
        EXPECT_NEAR(down.ev(), 10 - 4 * part, 1e-3) << frames;
    }
}

}  // namespace
}  // namespace pelagic
