// The viewer's render scale on machines that are models: a frame costs something, and each pixel something more. No clocks.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "pelagic/viewer/render_scale.hpp"

namespace pelagic {
namespace {

using viewer::RenderScale;

constexpr double goal_ms = 33;

struct Machine {
    double fixed_ms, full_size_ms;  ///< of a frame; of all pixels in full size
    double fine_mesh_ms = 0;        ///< above a scale of 0.43, as the viewer's meshes are
    double noise = 0;               ///< relative, either way
    std::minstd_rand random{1};

    double frame_ms(float scale) {
        const double square = static_cast<double>(scale) * static_cast<double>(scale);
        const double uniform = 2 * static_cast<double>(random()) / 2147483647.0 - 1;
        return (fixed_ms + full_size_ms * square + (scale > 0.43f ? fine_mesh_ms : 0)) * (1 + noise * uniform);
    }
};

/// The scale of each frame.
std::vector<float> run(RenderScale& scale, Machine& machine, int frames) {
    std::vector<float> scales;
    for (int i = 0; i < frames; ++i) {
        scales.push_back(scale.scale());
        scale.follow(machine.frame_ms(scale.scale()));
    }
    return scales;
}

int changes(const std::vector<float>& scales, std::size_t from) {
    int count = 0;
    for (std::size_t i = from + 1; i < scales.size(); ++i) count += scales[i] != scales[i - 1];
    return count;
}

TEST(RenderScale, StaysFullOnAMachineThatIsFastEnough) {
    Machine machine{2, 25};
    RenderScale scale(goal_ms);
    EXPECT_EQ(changes(run(scale, machine, 500), 0), 0);
    EXPECT_EQ(scale.scale(), 1);
}

// Wherever it begins it ends where frames are short enough and the next size has no room, and there it stays.
TEST(RenderScale, FindsASizeAndKeepsIt) {
    for (const double full_size_ms : {50.0, 90.0, 200.0, 420.0})
        for (const std::size_t first : {std::size_t{0}, RenderScale::scales.size() - 1}) {
            Machine machine{3, full_size_ms};
            RenderScale scale(goal_ms, first);
            const std::vector<float> scales = run(scale, machine, 600);
            EXPECT_EQ(changes(scales, 300), 0) << full_size_ms;
            EXPECT_LE(machine.frame_ms(scale.scale()), 1.15 * goal_ms) << full_size_ms;
            // Not needlessly small: two sizes up would be too slow.
            EXPECT_GT(machine.frame_ms(scale.scale() * 1.42f), 0.85 * goal_ms) << full_size_ms;
        }
}

TEST(RenderScale, DoesNotSwingOnNoise) {
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
        Machine machine{3, 120, 0, 0.25, std::minstd_rand(seed)};
        RenderScale scale(goal_ms);
        EXPECT_LE(changes(run(scale, machine, 3000), 1000), 2) << seed;
    }
}

// At the larger size the finer mesh costs more than its pixels say: it is tried ever more rarely.
TEST(RenderScale, LeavesASizeAloneThatCostsMoreThanItsPixels) {
    Machine machine{3, 80, 40};
    RenderScale scale(goal_ms, RenderScale::scales.size() - 1);
    const std::vector<float> scales = run(scale, machine, 20'000);
    // 120 frames double 7.4 times in 20 000; a try is a step up and a step down.
    EXPECT_LE(changes(scales, 1000), 2 * 7);
    EXPECT_LT(scale.scale(), 0.43f);
}

TEST(RenderScale, EscapesFromASlideshowInFourFrames) {
    Machine machine{100, 1900};
    RenderScale scale(goal_ms);
    run(scale, machine, 4);
    EXPECT_LE(scale.scale(), 0.3f);
}

TEST(RenderScale, OneHitchIsNothing) {
    Machine machine{2, 20};
    RenderScale scale(goal_ms);
    run(scale, machine, 100);
    scale.follow(90);
    EXPECT_EQ(changes(run(scale, machine, 50), 0), 0);
    EXPECT_EQ(scale.scale(), 1);
}

TEST(RenderScale, GrowsAgainWhenThereIsRoom) {
    Machine slow{3, 300}, fast{1, 10};
    RenderScale scale(goal_ms);
    run(scale, slow, 100);
    EXPECT_LT(scale.scale(), 0.5f);
    // Sizes that were found too slow open after 120 frames.
    run(scale, fast, 400);
    EXPECT_EQ(scale.scale(), 1);
}

}  // namespace
}  // namespace pelagic
