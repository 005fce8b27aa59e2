// In finite depth waves displace water farther horizontally than vertically: orbits are Airy's
// ellipses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tests/oracle/dft.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"

namespace pelagic {
namespace {

using oracle::Complex;
using oracle::ComplexField;
using oracle::wave_number_at;
using std::numbers::pi;

ComplexField transformed(const PlaneView& plane) {
    const int n = plane.resolution;
    ComplexField values;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) values.emplace_back(plane.at(i, j));
    return oracle::forward_fft(values, n);
}

/// The wave vectors of a cascade.
struct CascadeSpectrum {
    explicit CascadeSpectrum(const Cascade& cascade)
        : n(cascade.resolution()), spacing(2 * pi / cascade.grid.side_m), grid(cascade.grid) {}

    /// Calls visit(element, kx, kz) for each wave vector except k = 0, in world axes.
    template <class Visit>
    void each(Visit visit) const {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                if (i == 0 && j == 0) continue;
                const auto [kx, kz] = grid.in_world(oracle::wave_number(static_cast<std::size_t>(i), n) * spacing,
                                                    oracle::wave_number(static_cast<std::size_t>(j), n) * spacing);
                visit(static_cast<std::size_t>(j * n + i), kx, kz);
            }
        }
    }

    int n;
    double spacing;
    CascadeGrid grid;
};

TEST(FiniteDepth, OrbitRatioIsTheHyperbolicCotangentUpToTwenty) {
    for (const double depth : {0.01, 1.0, 6.0, 20.0, 4000.0}) {
        for (double k = 1e-4; k < 1e3; k *= 1.3) {
            const double truth = std::min(20.0, 1 / std::tanh(k * depth));
            EXPECT_NEAR(orbit_ratio(k, depth) / truth, 1, 1e-13) << k << ", " << depth;
            if (k * depth > 20) {
                EXPECT_EQ(orbit_ratio(k, depth), 1) << k << ", " << depth;
            }
        }
    }
}

// The patch is as long as a swell of 12 s, and its shorter waves have other frequencies. At the
// swell's frequency a texel moves on the ellipse of one wave. A deep-water circle would be 2.5
// times too narrow in 6 m depth. Float rounding and the rounding of the frequency to the loop are
// far below the bound of 1 %.
TEST(FiniteDepth, SwellOrbitHasTheAxesOfAiryTheory) {
    for (const double depth : {6.0, 20.0, 4000.0}) {
        const double period_s = 12, k = wave_number_at(2 * pi / period_s, depth);
        Ocean ocean({.resolution = 16,
                     .patch_size_m = 2 * pi / k,
                     .wind_speed_mps = 0.1,
                     .fetch_m = 1,
                     .depth_m = depth,
                     .choppiness = 1,
                     .swell_height_m = 0.3,
                     .swell_period_s = period_s,
                     .swell_spread_rad = pi / 180,
                     .loop_period_s = 5 * period_s},
                    {.executor = make_serial_executor(), .velocities = Velocities::drawn});
        Complex horizontal, up, horizontal_speed, up_speed;
        constexpr int times = 160;
        for (int i = 0; i < times; ++i) {
            const double turns = 5.0 * i / times;
            const Cascade& cascade = ocean.frame_at(turns * period_s).cascades[0];
            const Complex turn = std::polar(1.0 / times, -2 * pi * turns);
            horizontal += turn * static_cast<double>(cascade.dx.at(5, 3));
            up += turn * static_cast<double>(cascade.height.at(5, 3));
            horizontal_speed += turn * static_cast<double>(cascade.velocity_x.at(5, 3));
            up_speed += turn * static_cast<double>(cascade.velocity_y.at(5, 3));
        }
        const double airy = 1 / std::tanh(k * depth);
        ASSERT_GT(std::abs(up), 0.01);
        EXPECT_NEAR(std::abs(horizontal) / std::abs(up), airy, 0.01 * airy) << depth;
        EXPECT_NEAR(std::abs(horizontal_speed) / std::abs(up_speed), airy, 0.01 * airy) << depth;
        EXPECT_NEAR(std::fabs(std::arg(horizontal / up)), pi / 2, 0.01) << "an ellipse, not a line";
    }
}

// Every wave of a sea without lean separately: D = i choppiness coth(k d) k/|k| h, and the equivalent
// for velocities.
TEST(FiniteDepth, EachWavesHorizontalDisplacementMatchesAiryTheory) {
    for (const double depth : {6.0, 20.0, 4000.0}) {
        const SeaState sea{.cascades = 2, .resolution = 64, .depth_m = depth, .choppiness = 0.8, .lean = 0};
        Ocean ocean(sea, {.executor = make_serial_executor(), .velocities = Velocities::drawn});
        for (const Cascade& cascade : ocean.frame_at(3.7).cascades) {
            const ComplexField h = transformed(cascade.height), dx = transformed(cascade.dx),
                               dz = transformed(cascade.dz);
            const ComplexField up = transformed(cascade.velocity_y), vx = transformed(cascade.velocity_x),
                               vz = transformed(cascade.velocity_z);
            double max = 0, max_up = 0;
            for (const Complex& wave : h) max = std::max(max, std::abs(wave));
            for (const Complex& wave : up) max_up = std::max(max_up, std::abs(wave));
            int seen = 0;
            CascadeSpectrum(cascade).each([&](std::size_t at, double kx, double kz) {
                const double k = std::hypot(kx, kz), airy = sea.choppiness / std::tanh(k * depth);
                // smaller waves are dominated by float rounding
                if (std::abs(h[at]) > 0.01 * max) {
                    EXPECT_NEAR(std::abs((kx * dx[at] + kz * dz[at]) / k) / std::abs(h[at]), airy, 0.001 * airy);
                    ++seen;
                }
                if (std::abs(up[at]) > 0.01 * max_up) {
                    EXPECT_NEAR(std::abs((kx * vx[at] + kz * vz[at]) / k) / std::abs(up[at]), airy, 0.001 * airy);
                }
            });
            EXPECT_GT(seen, 20);
        }
    }
}

// Derivatives of the frames' displacements, exact by their transforms, averaged over several times
// of a loop.
TEST(FiniteDepth, ReportedConvergenceVarianceMatchesTheFrames) {
    for (const auto& [depth, lean] : {std::pair(6.0, 0.0), {20.0, 0.6}, {4000.0, 0.0}}) {
        const SeaState sea{.resolution = 64, .depth_m = depth, .lean = lean, .swell_height_m = 1};
        const SeaReport report = report_on(sea);
        Ocean ocean(sea, {.executor = make_serial_executor()});
        double measured = 0;
        constexpr int times = 8;
        for (int i = 0; i < times; ++i) {
            for (const Cascade& cascade : ocean.frame_at(17.3 * i).cascades) {
                const ComplexField dx = transformed(cascade.dx), dz = transformed(cascade.dz);
                CascadeSpectrum(cascade).each([&](std::size_t at, double kx, double kz) {
                    measured += std::norm(kx * dx[at] + kz * dz[at]) / times;
                });
            }
        }
        EXPECT_NEAR(report.realised_convergence_variance / measured, 1, 0.02) << depth;
        EXPECT_NEAR(report.expected_convergence_variance / measured, 1, 0.06) << depth << ": all seeds, not this one";
        double slopes = 0;
        for (const CascadeSlopes& cascade : report.cascades) slopes += cascade.slopes.total();
        const double circles = sea.choppiness * sea.choppiness * slopes;
        if (depth == 6) {
            EXPECT_GT(report.expected_convergence_variance / circles, 1.05);
        } else if (depth == 4000) {
            EXPECT_NEAR(report.expected_convergence_variance / circles, 1, 1e-9);
        }
    }
}

// Bytes of slope maps cover four standard deviations; 6 of 100,000 values of a Gaussian are beyond.
TEST(FiniteDepth, SlopeMapsAreRarelyClampedAtAnyDepth) {
    const auto cut = [](double depth) {
        Ocean ocean({.resolution = 64,
                     .wind_speed_mps = 2,
                     .fetch_m = 500,
                     .depth_m = depth,
                     .choppiness = 1,
                     .swell_height_m = 0.2,
                     .swell_period_s = 14},
                    {.executor = make_serial_executor(), .slopes = true});
        std::size_t values = 0, at_end = 0;
        for (const Cascade& cascade : ocean.frame_at(1).cascades) {
            for (const std::uint32_t texel : cascade.level_of(cascade.slopes_rgba8, 0)) {
                for (const unsigned shift : {16u, 24u}) {  // D_xx, D_zz
                    const int byte = static_cast<int>(texel >> shift & 0xFF);
                    at_end += byte <= 1 || byte == 255;
                    ++values;
                }
            }
        }
        return static_cast<double>(at_end) / static_cast<double>(values);
    };
    EXPECT_LT(cut(1.5), 1e-3);
    EXPECT_LT(cut(4000), 1e-3);
}

}  // namespace
}  // namespace pelagic
