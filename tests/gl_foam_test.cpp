// Foam in images: its brightness, and its coverage from near and far.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

/// A square of sea under the white sky, with any foam.
class FoamScene : public GlScene {
   public:
    explicit FoamScene(std::string_view preset)
        : GlScene({.preset = preset,
                   .quality = "low",
                   .width = 16,
                   .height = 16,
                   .samples = 1,
                   .writes = gl::PixelKind::radiance,
                   .foam = true}) {
        renderer->set_sky(white_sky());
    }

    const Frame& frame() { return ocean.frame_at(3); }

    /// Returns the frame with this foam everywhere: the whole sea broke some time ago. Without a
    /// value, the frame has no snapshots.
    Frame frame_with(std::optional<float> foam) {
        Frame changed = frame();
        cascades_.assign(changed.cascades.begin(), changed.cascades.end());
        broken_.assign(cascades_[0].snapshots_rgba8[0].size(), 0xFFFFFFFF);
        still_.assign(broken_.size(), 0x60606060);  // 96 is nearly no compression
        for (Cascade& cascade : cascades_) {
            cascade.compression_scale = 0;
            for (std::size_t image = 0; image < SnapshotFoam::images; ++image) {
                std::span<const std::uint32_t>& chain = cascade.snapshots_rgba8[image];
                if (!foam)
                    chain = {};
                else if (!chain.empty())
                    chain = &cascade == cascades_.data() ? broken_ : still_;
                cascade.snapshots_version[image] = ++version_;
            }
        }
        changed.foam.level = 2;
        changed.foam.age.fill(1 - foam.value_or(0));
        changed.cascades = cascades_;
        return changed;
    }

   private:
    std::vector<Cascade> cascades_;
    std::vector<std::uint32_t> broken_, still_;
    std::uint64_t version_ = std::uint64_t{1} << 63;  ///< unlike those of an ocean
};

/// Returns the mean foam over a square of reference points around the origin.
double cover_by_queries(const Frame& frame, double side_m) {
    constexpr int points = 700;
    const FoamSampler foam(frame);
    double sum = 0;
    for (int row = 0; row < points; ++row)
        for (int column = 0; column < points; ++column)
            sum += double{foam.at(((column + 0.5) / points - 0.5) * side_m, ((row + 0.5) / points - 0.5) * side_m)};
    return sum / (points * points);
}

double mean(const std::vector<float>& light) {
    double sum = 0;
    for (const float each : light) sum += each;
    return sum / static_cast<double>(light.size());
}

/// Returns the value that this fraction of all pixels exceeds.
float brighter_than(std::vector<float> light, double part) {
    std::sort(light.begin(), light.end());
    return light[static_cast<std::size_t>((1 - part) * static_cast<double>(light.size() - 1))];
}

// Fresh thick foam reflects at most 0.7 of white light (Whitlock et al. 1982). All ages reflect 0.22
// in the mean (Koepke 1984), so foam of 2.1 s, near its end, reflects less than that, and more than
// the bubbles below it alone, 0.11. Under a sky of radiance 1 these reflectances are radiances.
TEST(GlFoam, IsAsBrightAsFoamUnderAWhiteSky) {
    constexpr int pixels = 256;
    FoamScene rough("rough");
    const std::vector<float> thick = rough.light_from_above(rough.frame_with(1.f), pixels, 60);
    std::printf("thick foam: %.3f, the brightest pixel %.3f\n", brighter_than(thick, 0.5), brighter_than(thick, 0));
    EXPECT_GT(brighter_than(thick, 0.5), 0.5);
    EXPECT_LE(brighter_than(thick, 0), 0.72);

    // A coverage of 0.25 everywhere, the rest of foam from breaking 2.1 s ago.
    const std::vector<float> thin = rough.light_from_above(rough.frame_with(0.25f), pixels, 60);
    std::printf("thin foam: %.3f, water %.3f\n", brighter_than(thin, 0.05), brighter_than(thin, 0.95));
    EXPECT_GT(brighter_than(thin, 0.05), 0.11);
    EXPECT_LT(brighter_than(thin, 0.05), 0.22);
    EXPECT_LT(brighter_than(thin, 0.95), 0.15);
}

TEST(GlFoam, IsAbsentWithoutSnapshots) {
    FoamScene rough("rough");
    EXPECT_EQ(rough.light_from_above(rough.frame_with({}), 64, 100),
              rough.light_from_above(rough.frame_with(0.f), 64, 100));
}

// Where snapshots give a fraction of the surface, lace covers that fraction: pixels of a decimetre
// at least half as bright as foam.
TEST(GlFoam, CoversTheFractionOfTheSnapshots) {
    constexpr int pixels = 512;
    FoamScene rough("rough");
    for (const float wanted : {0.2f, 0.4f, 0.6f}) {
        const std::vector<float> none = rough.light_from_above(rough.frame_with({}), pixels, 50);
        const std::vector<float> some = rough.light_from_above(rough.frame_with(wanted), pixels, 50);
        const float foam = brighter_than(some, 0.05);
        int covered = 0;
        for (std::size_t i = 0; i < some.size(); ++i) covered += some[i] > 0.5f * (foam + none[i]);
        const double cover = static_cast<double>(covered) / static_cast<double>(some.size());
        std::printf("foam of %.2f: %.3f of the pixels are covered\n", double{wanted}, cover);
        EXPECT_NEAR(cover, double{wanted}, 0.05);
    }
}

// The light that whitecaps add, per unit of foam that queries return. From far away, a pixel holds
// many whitecaps and uses the foam filter. The light there equals that from near, where each
// whitecap is resolved.
TEST(GlFoam, CoverageIsEqualFromNearAndFar) {
    for (const char* preset : {"rough", "storm"}) {
        FoamScene scene(preset);
        const auto light_of_cover = [&](int pixels, double side_m) {
            const double all = mean(scene.light_from_above(scene.frame(), pixels, side_m));
            const double water = mean(scene.light_from_above(scene.frame_with({}), pixels, side_m));
            const double cover = cover_by_queries(scene.frame(), side_m);
            std::printf("%s, %g m: foam covers %.4f and adds %.4f to the mean radiance\n", preset, side_m, cover,
                        all - water);
            EXPECT_GT(cover, 0.005);
            return (all - water) / cover;
        };
        const double near = light_of_cover(768, 250), middle = light_of_cover(512, 1000),
                     far = light_of_cover(128, 2000);
        std::printf("  for each part: %.3f in pixels of 0.3 m, %.3f of 2 m, %.3f of 16 m\n", near, middle, far);
        // Measured 1.19, 1.21 and 1.00, 0.95. At white crests the displacement compresses the
        // water, so near foam is narrower than undisplaced.
        EXPECT_NEAR(middle / near, 1, 0.3) << preset;
        EXPECT_NEAR(far / near, 1, 0.3) << preset;
    }
}

}  // namespace
}  // namespace pelagic
