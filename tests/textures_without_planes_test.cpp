// Frames without planes (OceanOptions::planes) have the textures, foam and bounds of frames with
// planes, to the bit. The reference is the path with planes, whose golden hashes other tests check.
#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/tests/application_jobs.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/emulated.hpp"
#include "pelagic/tests/golden.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

SeaState textured_sea(int cascades, int n) {
    return cascades == 1 ? SeaState{.resolution = n, .patch_size_m = 250, .wind_direction_rad = 1, .choppiness = 1}
                         : SeaState{.cascades = cascades, .resolution = n, .choppiness = 1};
}

template <class T>
bool are_identical(std::span<const T> a, std::span<const T> b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

/// Returns the first output in which the frames differ, or an empty string.
std::string difference(const Frame& a, const Frame& b) {
    for (std::size_t i = 0; i < a.cascades.size(); ++i) {
        const Cascade &one = a.cascades[i], &other = b.cascades[i];
        const std::string cascade = " of cascade " + std::to_string(i);
        if (!are_identical(one.displacement_rgba16f, other.displacement_rgba16f))
            return "displacement_rgba16f" + cascade;
        if (!are_identical(one.gradient_rgba8, other.gradient_rgba8)) return "gradient_rgba8" + cascade;
        if (!are_identical(one.slopes_rgba8, other.slopes_rgba8)) return "slopes_rgba8" + cascade;
        if (!are_identical(one.moments_rgba8, other.moments_rgba8)) return "moments_rgba8" + cascade;
        if (std::memcmp(&one.bounds, &other.bounds, sizeof one.bounds) != 0) return "bounds" + cascade;
        if (one.slope_variance != other.slope_variance) return "slope_variance" + cascade;
    }
    if (std::memcmp(&a.bounds, &b.bounds, sizeof a.bounds) != 0) return "bounds";
    return foam_hash_of(a) == foam_hash_of(b) ? "" : "foam";
}

/// Computes frames with and without planes, forwards, backwards and within a tick of foam, and
/// compares them.
void expect_identical_textures(const SeaState& sea, const OceanOptions& options) {
    OceanOptions without = options;
    without.planes = false;
    Ocean reference(sea, {.executor = make_serial_executor(),
                          .isa = options.isa,
                          .gradients = options.gradients,
                          .slopes = options.slopes,
                          .foam = options.foam});
    Ocean ocean(sea, without);
    for (const double time_s : {12.34, 12.36, 12.6, 3.0}) {
        const Frame& frame = ocean.frame_at(time_s);
        EXPECT_EQ(difference(reference.frame_at(time_s), frame), "") << "at " << time_s << " s";
        for (const Cascade& cascade : frame.cascades) {
            EXPECT_EQ(cascade.height.data, nullptr);
            EXPECT_EQ(cascade.resolution(), resolution_of(sea));
        }
    }
}

class TexturesWithoutPlanesOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(, TexturesWithoutPlanesOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(TexturesWithoutPlanesOnEachIsa, AreThoseOfFramesWithPlanes) {
    for (const int cascades : {1, 4})
        for (const int n : {16, 32, 64, 128, 256, 512, 1024}) {
            // Larger sizes run no other jobs.
            if ((is_sanitized || is_emulated) && n > 256) break;
            if (cascades > 1 && (n < 64 || n > 512)) continue;
            for (const bool foam : {false, true}) {
                if (foam && n > 512) continue;  // 16 ticks of the warm-up take seconds
                SCOPED_TRACE(std::to_string(cascades) + " x " + std::to_string(n) + (foam ? " with foam" : ""));
                expect_identical_textures(textured_sea(cascades, n),
                                          {.executor = make_serial_executor(), .isa = GetParam(), .foam = foam});
            }
        }
}

TEST_P(TexturesWithoutPlanesOnEachIsa, AreThoseOfFramesWithPlanesInBothSetsOfMaps) {
    for (const int cascades : {1, 4})
        for (const int n : {128, 256})
            expect_identical_textures(
                textured_sea(cascades, n),
                {.executor = make_serial_executor(), .isa = GetParam(), .gradients = true, .slopes = true});
}

TEST(TexturesWithoutPlanes, DoNotDependOnTheExecutor) {
    if (is_emulated) GTEST_SKIP() << "threads are those of the host";
    for (const auto& [name, executor] : applications())
        for (const int cascades : {1, 4})
            for (const int n : {128, 256})
                for (const bool foam : {false, true}) {
                    SCOPED_TRACE(name + ", " + std::to_string(cascades) + " x " + std::to_string(n));
                    expect_identical_textures(textured_sea(cascades, n), {.executor = executor, .foam = foam});
                }
}

TEST(TexturesWithoutPlanes, AreThoseOfPondAndAnalyticWaves) {
    for (const WaveModel waves : {WaveModel::pond, WaveModel::analytic})
        expect_identical_textures({.waves = waves, .resolution = 256, .choppiness = 1},
                                  {.executor = make_serial_executor()});
}

TEST(TexturesWithoutPlanes, AreIdenticalDuringASeaStateTransition) {
    const SeaState calm = textured_sea(1, 256);
    SeaState rough = calm;
    rough.wind_speed_mps = calm.wind_speed_mps + 4;
    const Forecast forecast{.first = calm, .changes = {{.sea = rough, .from_s = 1, .over_s = 10}}};
    Ocean with(forecast, {.executor = make_serial_executor()});
    Ocean without(forecast, {.executor = make_serial_executor(), .planes = false});
    for (const double time_s : {0.0, 4.0, 20.0})
        EXPECT_EQ(difference(with.frame_at(time_s), without.frame_at(time_s)), "") << time_s;
}

TEST(TexturesWithoutPlanes, HaveTheGoldenHashes) {
    GoldenRows rows("texture");
    for (const int cascades : {1, 4})
        for (const int n : {128, 256, 512}) {
            Ocean ocean(textured_sea(cascades, n), {.executor = make_serial_executor(), .planes = false});
            rows.row(std::to_string(cascades) + "x" + std::to_string(n), {hash_of(ocean.frame_at(12.34))});
        }
    rows.expect();
}

TEST(TexturesWithoutPlanes, TakeLessMemory) {
    for (const int cascades : {1, 4}) {
        const SeaState sea = textured_sea(cascades, 256);
        const Ocean with(sea, {.executor = make_serial_executor()});
        const Ocean without(sea, {.executor = make_serial_executor(), .planes = false});
        // Of two sets of planes of 12 bytes a texel, one working buffer of 12 bytes remains.
        const std::size_t texels = static_cast<std::size_t>(cascades) * 256 * 256;
        EXPECT_LT(without.memory_bytes() + 11 * texels, with.memory_bytes());
    }
}

std::string refusal_of(const OceanOptions& options) {
    return message_of([&] { Ocean(textured_sea(4, 64), options); });
}

TEST(TexturesWithoutPlanes, AreRefusedTogetherWithWhatNeedsPlanes) {
    const std::string refused = " cannot be combined with an ocean without planes";
    EXPECT_EQ(refusal_of({.queries = true, .planes = false}), "queries" + refused);
    EXPECT_EQ(refusal_of({.velocities = Velocities::drawn, .planes = false}), "velocities" + refused);
    EXPECT_EQ(refusal_of({.dynamic_waves = DynamicWavesOptions{}, .planes = false}), "dynamic_waves" + refused);
    EXPECT_EQ(refusal_of({.shore = ShoreOptions{}, .planes = false}), "shore" + refused);
    EXPECT_EQ(refusal_of({.inputs = {nullptr}, .planes = false}), "inputs" + refused);
    EXPECT_EQ(refusal_of({.executor = make_serial_executor(), .foam = true, .planes = false}), "");
}

TEST(TexturesWithoutPlanes, HaveNoMeasuredWaveHeight) {
    Ocean ocean(textured_sea(1, 64), {.executor = make_serial_executor(), .planes = false});
    EXPECT_THROW(measured_significant_wave_height_m(ocean.frame_at(1)), std::invalid_argument);
}

TEST(TexturesWithoutPlanes, CopyOnlyTextures) {
    Ocean ocean(textured_sea(1, 64), {.executor = make_serial_executor(), .planes = false});
    const Frame& frame = ocean.frame_at(1);
    std::vector<float> plane(64 * 64);
    std::vector<std::uint16_t> halves(4 * 64 * 64);
    copy_frame(frame, FrameBuffers{.displacement_rgba16f = halves});
    EXPECT_TRUE(are_identical<std::uint16_t>(halves, frame.cascades[0].displacement_rgba16f));
    const std::string refused = "height is requested, but the ocean was created without planes";
    EXPECT_EQ(message_of([&] { copy_frame(frame, FrameBuffers{.height = plane}); }), refused);
    EXPECT_EQ(message_of([&] { ocean.frame_at(2, FrameBuffers{.height = plane}); }), refused);
    EXPECT_THROW(copy_plane(frame.cascades[0].height, plane), std::invalid_argument);
    EXPECT_THROW(copy_compression(frame.cascades[0], plane), std::invalid_argument);
}

TEST(TexturesWithoutPlanes, AreWrittenToMemoryOfTheApplication) {
    const SeaState sea = textured_sea(1, 256);
    Ocean with(sea, {.executor = make_serial_executor()});
    Ocean without(sea, {.executor = make_serial_executor(), .planes = false});
    AlignedBuffer<std::uint16_t> halves(4 * 256 * 256);
    AlignedBuffer<std::uint32_t> chain(mip_offset(256, mip_levels(256)));
    const TextureTargets targets{.displacement_rgba16f = halves.data(),
                                 .gradient_rgba8 = chain_in(chain.data(), 256)};
    without.schedule(2, {&targets, 1});
    without.complete();
    const Cascade& expected = with.frame_at(2).cascades[0];
    EXPECT_TRUE(
        are_identical(expected.displacement_rgba16f, std::span<const std::uint16_t>(halves.data(), halves.size())));
    EXPECT_TRUE(are_identical(expected.gradient_rgba8, std::span<const std::uint32_t>(chain.data(), chain.size())));
}

}  // namespace
}  // namespace pelagic
