// Counted glints (gl/shaders/glints.glsl): their mean is the smooth lobe, their variance that of a
// count, and both eyes see the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/gl_probe.hpp"

namespace pelagic {
namespace {

constexpr std::size_t glint_positions = std::size_t{GlProbe::side} * GlProbe::side;

/// Evaluates glints at positions 0.37 m apart, so that each has facets of its own.
class GlGlints : public testing::Test {
   protected:
    static gl::SceneBlock block_at(glm::dvec3 viewer_m) {
        Ocean ocean({.cascades = 1, .resolution = 16}, {.executor = make_serial_executor(), .slopes = true});
        const DrawList list;
        return gl::scene_block_of({.eyes = {}, .viewer_m = viewer_m, .list = &list}, gl::facts_of(ocean.frame_at(0)),
                                  {}, {});
    }
    /// Returns `result` of each position `at`.
    static std::vector<float> counted(const std::string& body, glm::dvec3 viewer_m = {12.5, 2, -700.25}) {
        GlProbe probe(gl::Surface::open, {"mirror.glsl", "glints.glsl"},
                      "    vec2 at = floor(gl_FragCoord.xy) * 0.37;\n" + body);
        return probe.ask(block_at(viewer_m));
    }
};

struct Moments {
    double mean = 0, variance = 0;
};

Moments moments_of(const std::vector<float>& values, std::size_t channel) {
    double sum = 0, squares = 0;
    for (std::size_t i = channel; i < values.size(); i += 4) {
        sum += values[i];
        squares += double{values[i]} * values[i];
    }
    const auto count = static_cast<double>(glint_positions);
    return {sum / count, squares / count - sum / count * (sum / count)};
}

// Sixteen facets reflect with the probability p = mean / 16 each: the count is binomial. Relative
// to its mean its variance is (1 - p) / mean; for many glints it is Poisson's, 1 / mean.
TEST_F(GlGlints, HaveTheMeanAndTheVarianceOfACount) {
    for (const double mean : {0.2, 0.5, 1.0, 2.0, 4.0, 12.0, 50.0}) {
        const std::vector<float> values =
            counted("    float a = counted_glints(at, vec2(0.013, 0.0), vec2(0.0, 0.04), " + std::to_string(mean) +
                    ");\n    result = vec4(a);\n");
        const Moments found = moments_of(values, 0);
        const double variance = (mean < 5 ? 1 - mean / 16 : 1) / mean;
        std::printf("%4.1f glints: mean %.4f, variance %.4f of %.4f\n", mean, found.mean, found.variance, variance);
        // Five standard errors of a mean of 16,384 independent values.
        EXPECT_NEAR(found.mean, 1, 5 * std::sqrt(variance / static_cast<double>(glint_positions))) << mean;
        // Samples of a footprint that share a cell add up to a tenth.
        EXPECT_GE(found.variance, 0.92 * variance) << mean;
        EXPECT_LE(found.variance, 1.18 * variance) << mean;
    }
}

// The lobe's tail has less than one glint in a pixel.
TEST_F(GlGlints, HaveTheMeanOfTheSmoothLobe) {
    for (const double tilt : {0.0, 0.05, 0.1, 0.15}) {
        const std::vector<float> values = counted(
            "    vec3 to_eye = normalize(vec3(-0.9, 0.4, 0.1)), tilted = normalize(sun.xyz + to_eye);\n"
            "    vec3 normal = normalize(tilted + vec3(0.0, 0.0, " + std::to_string(tilt) + "));\n"
            "    at = gl_FragCoord.xy * vec2(0.021, 0.013);\n"
            "    float a = glint(normal, to_eye, 0.008);\n"
            "    float b = sparkling_glint(at, vec2(0.021, 0.0), vec2(0.0, 0.013), normal, to_eye, 0.008, 0.008);\n"
            "    result = vec4(b / a, a, 0.0, 1.0);\n");
        const Moments found = moments_of(values, 0);
        std::printf("tilt %.2f: mean %.4f, deviation %.2f\n", tilt, found.mean, std::sqrt(found.variance));
        // Neighbours share facets: a fifth of the values count as independent.
        EXPECT_NEAR(found.mean, 1, 5 * std::sqrt(found.variance * 5 / static_cast<double>(glint_positions))) << tilt;
        EXPECT_GT(found.variance, 0.01) << tilt;
    }
}

// The area of a footprint grows with the third power of the distance, and the deviation of a count
// falls with its root: by 1.48 for a factor of 1.3. Ten per cent are left for the sample.
TEST_F(GlGlints, ChangeSlowlyWithTheDistance) {
    double before = 0;
    for (double distance_m = 8; distance_m < 25; distance_m *= 1.3) {
        // Pixels of 480 x 270 over 60 degrees, from 3 m.
        const double wide = distance_m * 0.0043, length = wide * distance_m / 3;
        const std::vector<float> values = counted(
            "    vec3 to_eye = normalize(vec3(-0.9, 0.4, 0.1)), tilted = normalize(sun.xyz + to_eye);\n"
            "    vec3 normal = normalize(tilted + vec3(0.0, 0.0, 0.35));\n"
            "    float b = sparkling_glint(at * 7.0, vec2(" + std::to_string(wide) + ", 0.0), vec2(0.0, " +
            std::to_string(length) + "), normal, to_eye, 0.015, 0.006);\n"
            "    result = vec4(b / glint(normal, to_eye, 0.015));\n");
        const double deviation = std::sqrt(moments_of(values, 0).variance);
        std::printf("%.1f m: deviation %.3f\n", distance_m, deviation);
        if (before > 0) {
            EXPECT_NEAR(before / deviation, 1.3, 0.33) << distance_m;
        }
        before = deviation;
    }
}

// Rows of the probe are footprints over a factor of two, as rows of an image are. At no row do many
// positions change their glints at once.
TEST_F(GlGlints, ChangeNowhereAlongARow) {
    const auto at_rows = [](double row) {
        return counted("    vec2 size = vec2(0.02, 0.06) * exp2((gl_FragCoord.y + " + std::to_string(row) +
                       ") / 128.0);\n    at.y = 3.0 * fract(0.618 * at.x / 0.37);\n"
                       "    float a = counted_glints(at, vec2(size.x, 0.0), vec2(0.0, size.y), 2.0);\n"
                       "    result = vec4(a);\n");
    };
    const std::vector<float> here = at_rows(0), next = at_rows(1);
    double most = 0, all = 0;
    for (int row = 0; row < GlProbe::side; ++row) {
        int changed = 0;
        for (int x = 0; x < GlProbe::side; ++x) {
            const auto i = 4 * static_cast<std::size_t>(row * GlProbe::side + x);
            changed += std::abs(here[i] - next[i]) > 0.02;
        }
        most = std::max(most, changed / double{GlProbe::side});
        all += changed / double{GlProbe::side} / GlProbe::side;
    }
    std::printf("%.3f of a row's glints change, at most %.3f\n", all, most);
    EXPECT_GT(all, 0.005);
    // Binomial with a mean of some per cent; a common change would be most of a row.
    EXPECT_LE(most, 0.25);
}

// Eyes are 64 mm apart. At 10 m that changes a slope by 0.003, and with it the probability by 3 %,
// and the footprint by less than 0.1 %.
TEST_F(GlGlints, AreTheSameForBothEyes) {
    const auto of_eye = [](double x_m, const char* change) {
        return counted("    at.x -= " + std::to_string(x_m) + ";\n    float change = " + change +
                           ";\n    float a = counted_glints(at, vec2(0.045, 0.0) * change, vec2(0.0, 0.14), 1.0);\n"
                           "    result = vec4(a);\n",
                       {3000.0 + x_m, 1.6, 40});
    };
    const std::vector<float> left = of_eye(0, "1.0"), right = of_eye(0.064, "1.001");
    std::size_t same = 0;
    for (std::size_t i = 0; i < left.size(); i += 4) same += std::abs(left[i] - right[i]) < 0.02;
    std::printf("%.3f of the positions have the same glints\n", static_cast<double>(same) / glint_positions);
    EXPECT_GE(static_cast<double>(same), 0.98 * glint_positions);
}

}  // namespace
}  // namespace pelagic
