// Tests the viewer's render scale and shading on modelled machines: a frame has a fixed cost and a
// cost per pixel. No clock is read.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "pelagic/viewer/render_scale.hpp"

namespace pelagic {
namespace {

using viewer::RenderScale;
using viewer::RenderStep;

constexpr double goal_ms = 33;

struct Machine {
    double fixed_ms, full_size_ms;  ///< cost of a frame; cost of all pixels at full size
    /// extra cost at scales above 0.43, where the viewer's meshes are finer
    double fine_mesh_ms = 0;
    double noise = 0;  ///< relative, in both directions
    std::array<double, 3> cost_ratio = RenderScale::cost_ratio;
    std::minstd_rand random{1};

    double frame_ms(RenderStep step) {
        const float scale = step.scale;
        const double square = static_cast<double>(scale) * static_cast<double>(scale) *
                              cost_ratio[static_cast<std::size_t>(step.shading)];
        const double uniform = 2 * static_cast<double>(random()) / 2147483647.0 - 1;
        return (fixed_ms + full_size_ms * square + (scale > 0.43f ? fine_mesh_ms : 0)) * (1 + noise * uniform);
    }
};

/// Returns the step of each frame.
std::vector<RenderStep> run(RenderScale& scale, Machine& machine, int frames) {
    std::vector<RenderStep> steps;
    for (int i = 0; i < frames; ++i) {
        steps.push_back(scale.step());
        scale.follow(machine.frame_ms(scale.step()));
    }
    return steps;
}

int changes(const std::vector<RenderStep>& scales, std::size_t from) {
    int count = 0;
    for (std::size_t i = from + 1; i < scales.size(); ++i) count += scales[i] != scales[i - 1];
    return count;
}

TEST(RenderScale, StaysFullOnAMachineThatIsFastEnough) {
    Machine machine{2, 25};
    RenderScale scale(goal_ms);
    EXPECT_EQ(changes(run(scale, machine, 500), 0), 0);
    EXPECT_EQ(scale.step(), (RenderStep{1, gl::Shading::high}));
}

// From any first scale it reaches a size whose frames meet the goal and whose next larger size
// would not, and keeps it.
TEST(RenderScale, FindsASizeAndKeepsIt) {
    for (const double full_size_ms : {50.0, 90.0, 200.0, 420.0})
        for (const float first : {1.f, 0.25f}) {
            Machine machine{3, full_size_ms};
            RenderScale scale(goal_ms, gl::Shading::high, first);
            const std::vector<RenderStep> scales = run(scale, machine, 600);
            EXPECT_EQ(changes(scales, 300), 0) << full_size_ms;
            EXPECT_LE(machine.frame_ms(scale.step()), 1.15 * goal_ms) << full_size_ms;
            // The size is not smaller than needed: two sizes up would be too slow.
            EXPECT_GT(machine.frame_ms({scale.step().scale * 1.42f, gl::Shading::high}), 0.85 * goal_ms)
                << full_size_ms;
        }
}

// The resolution is reduced first, down to half the side lengths. Slower machines get simpler
// shading before fewer pixels.
TEST(RenderScale, SimplifiesShadingBelowHalfTheSideLengths) {
    for (const double full_size_ms : {60.0, 110.0, 150.0, 200.0, 330.0, 480.0, 700.0})
        for (const float first : {1.f, 0.25f}) {
            Machine machine{3, full_size_ms};
            RenderScale scale(goal_ms, {}, first);
            EXPECT_EQ(changes(run(scale, machine, 900), 450), 0) << full_size_ms;
            const RenderStep step = scale.step();
            EXPECT_LE(machine.frame_ms(step), 1.15 * goal_ms) << full_size_ms;
            if (step.scale > 0.5f) {
                EXPECT_EQ(step.shading, gl::Shading::high) << full_size_ms;
            }
            if (step.scale < 0.5f) {
                EXPECT_NE(step.shading, gl::Shading::high) << full_size_ms;
            }
            // The shading is not simpler than needed: high shading at half the side lengths would
            // be too slow.
            if (step.shading != gl::Shading::high) {
                EXPECT_GT(machine.frame_ms({0.5f, gl::Shading::high}), 0.85 * goal_ms) << full_size_ms;
            }
        }
}

// If simpler shading saves nothing, because vertices or the sky dominate, it is not tried
// repeatedly.
TEST(RenderScale, DoesNotOscillateIfShadingSavesNothing) {
    for (const double full_size_ms : {100.0, 140.0, 200.0, 300.0}) {
        Machine machine{3, full_size_ms, 0, 0.1, {1, 1, 1}};
        RenderScale scale(goal_ms);
        // A step that was too slow is not tried for 120 frames, then 240 and so on: 7 tries in 20
        // 000 frames.
        EXPECT_LE(changes(run(scale, machine, 20'000), 1000), 2 * 7) << full_size_ms;
        EXPECT_LE(machine.frame_ms(scale.step()), 1.15 * 1.1 * goal_ms) << full_size_ms;
    }
}

TEST(RenderScale, KeepsAFixedShading) {
    for (const gl::Shading shading : {gl::Shading::headset, gl::Shading::medium, gl::Shading::high}) {
        Machine machine{3, 900};
        RenderScale scale(goal_ms, shading);
        for (const RenderStep& step : run(scale, machine, 300)) EXPECT_EQ(step.shading, shading);
        EXPECT_LT(scale.step().scale, 0.5f);
    }
}

TEST(RenderScale, DoesNotOscillateOnNoise) {
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
        Machine machine{3, 120, 0, 0.25, RenderScale::cost_ratio, std::minstd_rand(seed)};
        RenderScale scale(goal_ms);
        EXPECT_LE(changes(run(scale, machine, 3000), 1000), 2) << seed;
    }
}

// At the larger size the finer mesh costs more than the pixel count predicts, so the size is tried
// less and less often.
TEST(RenderScale, AvoidsASizeThatCostsMoreThanItsPixels) {
    Machine machine{3, 80, 40};
    RenderScale scale(goal_ms, gl::Shading::high, 0.25f);
    const std::vector<RenderStep> scales = run(scale, machine, 20'000);
    // 120 frames double 7.4 times in 20 000. Each try is a step up and a step down.
    EXPECT_LE(changes(scales, 1000), 2 * 7);
    EXPECT_LT(scale.step().scale, 0.43f);
}

TEST(RenderScale, RecoversFromVeryLongFramesInFourFrames) {
    Machine machine{100, 1900};
    RenderScale scale(goal_ms);
    run(scale, machine, 4);
    EXPECT_LE(scale.step().scale, 0.3f);
}

TEST(RenderScale, IgnoresOneLongFrame) {
    Machine machine{2, 20};
    RenderScale scale(goal_ms);
    run(scale, machine, 100);
    scale.follow(90);
    EXPECT_EQ(changes(run(scale, machine, 50), 0), 0);
    EXPECT_EQ(scale.step(), (RenderStep{1, gl::Shading::high}));
}

TEST(RenderScale, GrowsAgainWhenFramesAreShort) {
    Machine slow{3, 300}, fast{1, 10};
    RenderScale scale(goal_ms);
    run(scale, slow, 100);
    EXPECT_LT(scale.step().scale, 0.5f);
    // Sizes that were too slow may be tried again after 120 frames.
    run(scale, fast, 400);
    EXPECT_EQ(scale.step(), (RenderStep{1, gl::Shading::high}));
}

}  // namespace
}  // namespace pelagic
