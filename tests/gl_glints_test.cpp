// Counted glints (gl/shaders/glints.glsl): their mean is the smooth lobe, their variance that of a
// count, and both eyes see the same.
#include <gtest/gtest.h>

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
            "    float b = sparkling_glint(at, vec2(0.021, 0.0), vec2(0.0, 0.013), normal, to_eye, 0.008);\n"
            "    result = vec4(b / a, a, 0.0, 1.0);\n");
        const Moments found = moments_of(values, 0);
        std::printf("tilt %.2f: mean %.4f, deviation %.2f\n", tilt, found.mean, std::sqrt(found.variance));
        // Neighbours share facets: a fifth of the values count as independent.
        EXPECT_NEAR(found.mean, 1, 5 * std::sqrt(found.variance * 5 / static_cast<double>(glint_positions))) << tilt;
        EXPECT_GT(found.variance, 0.01) << tilt;
    }
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
