// Heights and slopes of small water as its shaders compute them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "pelagic/gl/water/scene_block.hpp"
#include "pelagic/tests/gl_probe.hpp"

namespace pelagic {
namespace {

/// Evaluates gl/shaders/small_water.glsl at positions within 100 m.
class Probe : public GlProbe {
   public:
    Probe(gl::Surface surface, const std::string& body)
        : GlProbe(surface, {"waves.glsl", "small_water.glsl", "small_surface.glsl"},
                  "vec2 at = gl_FragCoord.xy * vec2(0.737, 0.913);\n" + body) {}
};

gl::SceneBlock small_water_block(gl::Surface surface, double time_s = 3, glm::dvec2 viewer = {0, 0}) {
    gl::SeaFacts facts;
    facts.sea.wind_speed_mps = 4;
    facts.surface = surface;
    facts.time_s = time_s;
    gl::SceneBlock block;
    gl::place_small_water(block, facts, viewer, viewer);
    return block;
}

/// Returns the mean square of a channel.
double mean_square(const std::vector<float>& rgba, std::size_t channel) {
    double sum = 0;
    for (std::size_t i = channel; i < rgba.size(); i += 4) sum += double{rgba[i]} * double{rgba[i]};
    return sum / (GlProbe::side * GlProbe::side);
}

const char* sum_of(gl::Surface surface) {
    return surface == gl::Surface::pond ? "#define SUM(at, apart) sum_of_pond_waves(at, apart)\n"
                                        : "#define SUM(at, apart) sum_of_octaves(at, apart, 1.0)\n";
}

class SmallWater : public testing::TestWithParam<gl::Surface> {};

// Central differences over 0.2 mm, computed beside the slopes because the target holds half floats.
// Covers warped ridges and waves that drag others.
TEST_P(SmallWater, HasTheSlopesOfItsHeights) {
    Probe probe(GetParam(), std::string(sum_of(GetParam())) + R"(
    const float e = 1e-4;
    vec2 near = at * 0.05;
    vec2 differences = vec2(SUM(near + vec2(e, 0.0), 0.0).height - SUM(near - vec2(e, 0.0), 0.0).height,
                            SUM(near + vec2(0.0, e), 0.0).height - SUM(near - vec2(0.0, e), 0.0).height) / (2.0 * e);
    vec2 gradient = SUM(near, 0.0).gradient;
    result = vec4(100.0 * (gradient - differences), gradient);
)");
    const std::vector<float> rgba = probe.ask(small_water_block(GetParam()));
    const double error = std::sqrt(mean_square(rgba, 0) + mean_square(rgba, 1)) / 100;
    const double slope = std::sqrt(mean_square(rgba, 2) + mean_square(rgba, 3));
    std::printf("slopes of %.4f, off by %.5f\n", slope, error);
    EXPECT_GT(slope, 0.05);
    // Float heights of half a metre give differences over 0.2 mm a precision of 0.0003; ridges bend
    // within millimetres. A missing term, for example that of the warp, gives an error of a tenth
    // of the slope or more.
    EXPECT_LT(error, 0.03 * slope);
}

// Waves smaller than a pixel count as roughness: the total mean square slope does not depend on the
// distance.
TEST_P(SmallWater, KeepsItsMeanSquareSlopeAtAnyDistance) {
    double near = 0;
    for (const double apart_m : {0.0, 0.02, 0.1, 0.4, 1.5, 50.0}) {
        Probe probe(GetParam(), std::string(sum_of(GetParam())) + "    Bumps b = SUM(at, " + std::to_string(apart_m) +
                                    ");\n    result = vec4(b.gradient, sqrt(b.unresolved), 1.0);\n");
        const std::vector<float> rgba = probe.ask(small_water_block(GetParam()));
        const double shown = mean_square(rgba, 0) + mean_square(rgba, 1), left = mean_square(rgba, 2);
        std::printf("pixels of %.2f m: %.5f shown, %.5f left\n", apart_m, shown, left);
        if (apart_m == 0) {
            near = shown;
            EXPECT_LT(left, 0.001 * near);
        }
        // Warp and drag make slopes slightly larger where waves gather; independent waves would
        // have equal slopes within 3 % here.
        EXPECT_NEAR((shown + left) / near, 1, 0.1);
        if (apart_m == 50) {
            EXPECT_LT(shown, 0.001 * near);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SmallWater, testing::Values(gl::Surface::lake, gl::Surface::coast, gl::Surface::pond),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

// The water is the same near the world's origin, far from it, and one loop later.
TEST(SmallWater, DoesNotDependOnTheReferencePosition) {
    for (const gl::Surface surface : {gl::Surface::lake, gl::Surface::pond}) {
        const std::string body =
            std::string(sum_of(surface)) + "    result = vec4(SUM(at * 0.1 - origin, 0.0).gradient, 0.0, 1.0);\n";
        const auto slopes = [&](double time_s, const char* viewer, glm::dvec2 at) {
            return Probe(surface, "    const vec2 origin = " + std::string(viewer) + ";\n" + body)
                .ask(small_water_block(surface, time_s, at));
        };
        const auto a = slopes(3, "vec2(0.0)", {0, 0}), b = slopes(3, "vec2(8.0, -5.0)", {8, -5});
        const auto later = slopes(3 + SeaState{}.loop_period_s, "vec2(0.0)", {0, 0});
        double difference = 0, loop = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            difference += std::abs(a[i] - b[i]);
            loop += std::abs(a[i] - later[i]);
        }
        EXPECT_LT(difference / static_cast<double>(a.size()), 1e-4);
        EXPECT_LT(loop / static_cast<double>(a.size()), 1e-4);
        EXPECT_GT(mean_square(a, 0), 1e-3);
    }
}

/// Returns the river's flow at this fraction of its first cycle.
gl::SceneBlock river_at(double cycles) { return small_water_block(gl::Surface::river, cycles * 2.5); }

// A copy of the bumps restarts at another position when its cycle ends, at weight 0. Between
// restarts the steepness is constant.
TEST(SmallRiver, FlowsWithoutJumpsOrPulses) {
    Probe probe(gl::Surface::river, "    result = vec4(flowing_bumps(at * 0.1, 0.0).gradient, 0.0, 1.0);\n");
    const auto step = [&](double from, double to) {
        const auto a = probe.ask(river_at(from)), b = probe.ask(river_at(to));
        double square = 0;
        for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(a[i] - b[i], 2);
        return std::sqrt(square / (GlProbe::side * GlProbe::side));
    };
    // The first copy restarts at 1, the second at 0.5.
    for (const double wrap : {0.5, 1.0}) {
        const double across = step(wrap - 1e-5, wrap + 1e-5), beside = step(wrap + 0.2, wrap + 0.20002);
        std::printf("across %.1f: %.5f, beside it %.5f\n", wrap, across, beside);
        EXPECT_LT(across, 2 * beside);
    }
    const auto steepness = [&](double cycles) {
        const auto a = probe.ask(river_at(cycles));
        return mean_square(a, 0) + mean_square(a, 1);
    };
    // Without the root of the sum of squares the value would fall to half where both copies have
    // equal weight.
    EXPECT_NEAR(steepness(0.75) / steepness(1.0), 1, 0.15);
}

TEST(SmallRiver, RejectsAnIncompleteFlow) {
    gl::FlowMap map = gl::winding_channel();
    EXPECT_EQ(check(map), "");
    map.velocities.pop_back();
    EXPECT_EQ(check(map), "velocities has 131071 bytes, expected 2 side^2 = 131072");
    map.side = 0;
    EXPECT_EQ(check(map), "side is 0, expected 1 to 4096");
}

}  // namespace
}  // namespace pelagic
