// Glitter and ripples within 30 m, in images of 480 x 270: sparks lie along the crests of ripples,
// and ripples end at 17 mm.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

constexpr int columns = 480, rows = 270;
constexpr double view_rad = std::numbers::pi / 3;

/// Luminance of a rectangle in stops.
struct Stops {
    std::vector<double> values;
    int width = 0, height = 0;

    double at(int x, int y) const { return values[static_cast<std::size_t>(y * width + x)]; }
};

Stops stops_of(const std::vector<float>& radiance, int top, int bottom, int left, int right) {
    Stops found{{}, right - left, bottom - top};
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
            const float* pixel = &radiance[4 * static_cast<std::size_t>(y * columns + x)];
            found.values.push_back(std::log2(0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2] + 1e-9));
        }
    return found;
}

/// Returns the means of boxes of 2 x 2 values.
Stops halved(const Stops& from) {
    Stops found{{}, from.width / 2, from.height / 2};
    for (int y = 0; y < found.height; ++y)
        for (int x = 0; x < found.width; ++x)
            found.values.push_back((from.at(2 * x, 2 * y) + from.at(2 * x + 1, 2 * y) + from.at(2 * x, 2 * y + 1) +
                                    from.at(2 * x + 1, 2 * y + 1)) / 4);
    return found;
}

double variance_of(const Stops& stops) {
    double sum = 0, squares = 0;
    for (const double v : stops.values) {
        sum += v;
        squares += v * v;
    }
    const auto count = static_cast<double>(stops.values.size());
    return squares / count - sum / count * (sum / count);
}

/// Returns the share of waves of 2 to 4 pixels in the variance of those up to 32 pixels.
double finest_share(const Stops& stops) {
    const Stops second = halved(stops);
    const double all = variance_of(stops);
    return (all - variance_of(second)) / (all - variance_of(halved(halved(halved(second)))));
}

/// Returns the fraction of pixels that are 0.4 stops brighter than all neighbours.
double sparks(const Stops& stops) {
    int found = 0;
    for (int y = 1; y < stops.height - 1; ++y)
        for (int x = 1; x < stops.width - 1; ++x) {
            double most = -1e9;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    if (i != 0 || j != 0) most = std::max(most, stops.at(x + i, y + j));
            found += stops.at(x, y) - most > 0.4;
        }
    return found / static_cast<double>((stops.width - 2) * (stops.height - 2));
}

class GlGlitter : public testing::TestWithParam<const char*> {
   protected:
    static constexpr double eye_m = 3, down = 0.25;  // per metre ahead
    /// Draws a sea towards the sun, which is 29 degrees high.
    static std::vector<float> image(const char* preset) {
        GlScene scene({.preset = preset, .width = columns, .height = rows, .writes = gl::PixelKind::radiance});
        scene.draw({.position_m = {0, eye_m, 0},
                    .target_m = {std::cos(0.7), eye_m - down, std::sin(0.7)},
                    .vertical_view_rad = view_rad},
                   0);
        return scene.target->read_radiance();
    }
};

// From 3.6 to 28 m. Path-traced images of a similar sea have 0.005 of sparks with a mesh of one cell
// a pixel, and 0.03 with finer ripples. Of white noise 0.75 would be at 2 to 4 pixels.
TEST_P(GlGlitter, LiesAlongTheCrestsOfRipples) {
    const Stops glitter = stops_of(image(GetParam()), 100, rows, 120, 360);
    std::printf("%s: %.4f of the pixels are isolated, the share of 2 to 4 pixels is %.3f of %.2f\n", GetParam(),
                sparks(glitter), finest_share(glitter), variance_of(glitter));
    EXPECT_LE(sparks(glitter), 0.008);
    EXPECT_LE(finest_share(glitter), 0.35);
    // It still sparkles: a deviation of 2 stops in the path-traced images.
    EXPECT_GE(variance_of(glitter), 2);
}

INSTANTIATE_TEST_SUITE_P(InWind, GlGlitter, testing::Values("moderate", "rough"));

// A pixel is 2 mm wide, an eighth of the shortest ripple. What is left at 2 to 4 pixels are edges of
// reflections; a path tracer has 0.04.
TEST(GlRipples, EndAt17Millimetres) {
    for (const char* preset : {"calm", "moderate"}) {
        GlScene scene({.preset = preset, .width = columns, .height = rows, .writes = gl::PixelKind::radiance});
        scene.draw({.position_m = {0, 3, 0}, .target_m = {2, 0, -1.5}, .vertical_view_rad = 0.15}, 0);
        const Stops near = stops_of(scene.target->read_radiance(), 0, rows, 0, columns);
        std::printf("%s: the share of 2 to 4 pixels is %.3f of %.3f\n", preset, finest_share(near), variance_of(near));
        EXPECT_LE(finest_share(near), 0.12);
        // Ripples show.
        EXPECT_GE(variance_of(near), 0.02);
    }
}

}  // namespace
}  // namespace pelagic
