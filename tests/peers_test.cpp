// The benchmark's peers compared with Pelagic's frames: implementations whose speed is compared
// must compute the same sea.
#include <gtest/gtest.h>
#include <half.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "pelagic/bench/peers/fftw_frame.hpp"
#include "pelagic/bench/peers/kiss_frame.hpp"
#include "pelagic/bench/peers/paper_frame.hpp"
#include "pelagic/bench/peers/scalar_half.hpp"
#include "pelagic/bench/peers/scalar_query.hpp"
#include "pelagic/sim/ocean.hpp"

namespace pelagic::peers {
namespace {

enum Component { component_dx, component_height, component_dz };

/// The only place that depends on how a Frame stores its planes.
float plane_value(const Frame& frame, Component component, int i, int j) {
    const PlaneView* planes[] = {&frame.cascades[0].dx, &frame.cascades[0].height, &frame.cascades[0].dz};
    return planes[component]->at(i, j);
}

std::span<const float> plane_of(const PeerFrame& frame, Component component) {
    const std::span<const float> planes[] = {frame.dx, frame.height, frame.dz};
    return planes[component];
}

struct Case {
    std::string name;
    SeaState sea;
    double time_s;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

/// Winds across both axes, so that a wrong sign or swapped axes cause a failure. Waves of peers have
/// no lean and no level.
std::vector<Case> cases() {
    return {
        {"N32", {.resolution = 32, .patch_size_m = 250, .wind_direction_rad = 2.5, .lean = 0}, 1.5},
        {"N64", {.resolution = 64, .patch_size_m = 250, .wind_direction_rad = -1, .lean = 0}, 143.7},
        {"N64_choppy_and_shallow",
         {.resolution = 64,
          .patch_size_m = 37.3,
          .wind_speed_mps = 6,
          .depth_m = 5,
          .choppiness = 1,
          .lean = 0,
          .roughness = 0.4},
         -3},
        {"N256", {.resolution = 256, .patch_size_m = 250, .lean = 0}, 12.34},
        {"N256_breaking",
         {.spectrum = SpectrumModel::phillips_paper,
          .resolution = 256,
          .patch_size_m = 50,
          .wind_speed_mps = 25,
          .wind_direction_rad = 0.6,
          .choppiness = 1},
         77},
    };
}

template <class LibraryFrameType>
std::unique_ptr<LibraryFrame> frame_with(const SeaState& sea, FieldArrangement arrangement) {
    return std::make_unique<LibraryFrameType>(sea, choose_isa(), arrangement);
}

enum class Peer { paper, fftw_packed, fftw_separate, kiss_packed, kiss_separate };

class PeerOf : public testing::TestWithParam<std::tuple<Peer, Case>> {
   protected:
    PeerOf() : ocean_(one().sea, {.executor = make_serial_executor()}), ours_(ocean_.frame_at(one().time_s)) {
        SeaState sea = one().sea;
        sea.roughness = ours_.statistics.roughness;  // peers use only a given roughness
        switch (std::get<Peer>(GetParam())) {
            case Peer::paper: paper_.emplace(sea); break;
            case Peer::fftw_packed: library_ = frame_with<FftwFrame>(sea, FieldArrangement::packed); break;
            case Peer::fftw_separate: library_ = frame_with<FftwFrame>(sea, FieldArrangement::separate); break;
            case Peer::kiss_packed: library_ = frame_with<KissFrame>(sea, FieldArrangement::packed); break;
            case Peer::kiss_separate: library_ = frame_with<KissFrame>(sea, FieldArrangement::separate); break;
        }
        theirs_ = paper_ ? paper_->frame_at(one().time_s) : library_->frame_at(one().time_s);
    }

    const Case& one() const { return std::get<Case>(GetParam()); }
    /// Returns what our component has besides waves.
    float level_of(int component) const { return component == component_height ? ours_.cascades[0].level_m : 0; }
    int resolution() const { return one().sea.resolution; }
    std::size_t texel(int i, int j) const { return static_cast<std::size_t>(j) * resolution() + i; }

    double largest(Component component) const {
        double max = 0;
        for (int j = 0; j < resolution(); ++j)
            for (int i = 0; i < resolution(); ++i)
                max = std::max(max, std::fabs(static_cast<double>(plane_value(ours_, component, i, j))));
        return max;
    }

    Ocean ocean_;
    std::optional<PaperFrame> paper_;
    std::unique_ptr<LibraryFrame> library_;
    const Frame& ours_;
    PeerFrame theirs_;
};

std::string name_of_peer(Peer peer) {
    switch (peer) {
        case Peer::paper: return "paper";
        case Peer::fftw_packed: return "fftw_packed";
        case Peer::fftw_separate: return "fftw_separate";
        case Peer::kiss_packed: return "kiss_packed";
        case Peer::kiss_separate: return "kiss_separate";
    }
    return {};
}

INSTANTIATE_TEST_SUITE_P(Seas, PeerOf,
                         testing::Combine(testing::Values(Peer::paper, Peer::fftw_packed, Peer::fftw_separate,
                                                          Peer::kiss_packed, Peer::kiss_separate),
                                          testing::ValuesIn(cases())),
                         [](const auto& test) {
                             return name_of_peer(std::get<Peer>(test.param)) + "_" + std::get<Case>(test.param).name;
                         });

// Both sum N^2 waves in floats. The paper's radix 2 rounds in each of its 2 log2 N stages and in
// each twiddle, a polynomial of a 24-bit angle. A few units of 6e-8 each give about 5e-7 of the
// largest value. 1e-5 has a margin for other compilers and seas, and is far below the effect of a
// wrong sign or axis.
constexpr double plane_tolerance = 1e-5;

TEST_P(PeerOf, PlanesMatchPelagics) {
    for (const Component component : {component_dx, component_height, component_dz}) {
        double error = 0;
        for (int j = 0; j < resolution(); ++j)
            for (int i = 0; i < resolution(); ++i)
                error = std::max(error, std::fabs(static_cast<double>(plane_of(theirs_, component)[texel(i, j)] +
                                                                      level_of(component)) -
                                                  plane_value(ours_, component, i, j)));
        EXPECT_LE(error, plane_tolerance * largest(component)) << "component " << component;
        RecordProperty("relative_error_of_" + std::to_string(component),
                       std::to_string(error / largest(component) * 1e9) + "e-9");
    }
}

// Values on either side of a rounding boundary differ by a step. Smoothness is infinitely steep at
// a length of one, where an error of some 1e-7 in the lengths alone is up to half a step: hence two
// steps in rare cases.
TEST_P(PeerOf, GradientBytesAreWithinOneStepOfPelagics) {
    ASSERT_EQ(theirs_.rgba8.size(), ours_.cascades[0].gradient_rgba8.size());
    std::size_t beyond_one = 0;
    for (std::size_t i = 0; i < theirs_.rgba8.size(); ++i) {
        for (int shift = 0; shift < 32; shift += 8) {
            const int theirs = theirs_.rgba8[i] >> shift & 0xFF;
            const int ours = ours_.cascades[0].gradient_rgba8[i] >> shift & 0xFF;
            ASSERT_LE(std::abs(theirs - ours), 2) << "texel " << i << " of the chain, bit " << shift;
            if (std::abs(theirs - ours) > 1) ++beyond_one;
        }
    }
    EXPECT_LE(static_cast<double>(beyond_one), 0.001 * 4 * static_cast<double>(theirs_.rgba8.size()));
}

float value_of_half(std::uint16_t bits) {
    Imath::half half;
    half.setBits(bits);
    return half;
}

/// Returns the distance from |value|, rounded to a half, to the next larger half.
double step_of_half(float value) {
    const auto bits = static_cast<std::uint16_t>(Imath::half(std::fabs(value)).bits());
    return static_cast<double>(value_of_half(static_cast<std::uint16_t>(bits + 1))) - value_of_half(bits);
}

// The bound is one step of a half, because both may round across a boundary, plus the planes'
// difference, which near zero is many steps of a half.
TEST_P(PeerOf, HalvesAreWithinOneStepOfPelagics) {
    const double tolerance[] = {plane_tolerance * largest(component_dx), plane_tolerance * largest(component_height),
                                plane_tolerance * largest(component_dz), 0};
    ASSERT_EQ(theirs_.rgba16f.size(), ours_.cascades[0].displacement_rgba16f.size());
    for (std::size_t i = 0; i < theirs_.rgba16f.size(); ++i) {
        const float theirs = value_of_half(theirs_.rgba16f[i]);
        const float ours = value_of_half(ours_.cascades[0].displacement_rgba16f[i]);
        ASSERT_NEAR(theirs + level_of(static_cast<int>(i % 4)), ours,
                    std::max(step_of_half(theirs), step_of_half(ours)) + tolerance[i % 4])
            << "half " << i % 4 << " of texel " << i / 4;
    }
}

// A byte of J is 127.5 (J + 1). J is below 0, and normals point down, where the surface is overturned;
// J is clamped to 1 in stretched troughs.
TEST(PeerCases, IncludeABreakingSea) {
    PaperFrame paper(cases().back().sea);
    const PeerFrame& frame = paper.frame_at(cases().back().time_s);
    std::size_t overturned = 0, clamped = 0;
    for (const std::uint32_t texel : frame.rgba8) {
        const std::uint32_t jacobian = texel >> 16 & 255;
        overturned += jacobian < 127;
        clamped += jacobian == 255;
    }
    EXPECT_GT(overturned, 100u);
    EXPECT_GT(clamped, 100u);
}

TEST(ScalarQuery, IsBitIdenticalToTheLibrarysQueries) {
    for (const int n : {64, 256}) {
        Ocean ocean({.resolution = n, .patch_size_m = 250, .choppiness = 1},
                    {.executor = make_serial_executor(), .queries = true});
        const Frame& frame = ocean.frame_at(3);
        std::mt19937 random(n);
        std::uniform_real_distribution<double> anywhere(-500, 500);
        std::vector<double> x(5000), z(5000);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = anywhere(random), z[i] = anywhere(random);
        std::vector<float> height(5000), normal_x(5000), normal_y(5000), normal_z(5000), error(5000);
        SurfaceQuery(frame).sample(
            {x, z},
            {.height_m = height, .normal_x = normal_x, .normal_y = normal_y, .normal_z = normal_z, .error_m = error});
        for (std::size_t i = 0; i < x.size(); ++i) {
            const ScalarSample sample = scalar_query(frame, x[i], z[i]);
            ASSERT_EQ(sample.height_m, height[i]);
            ASSERT_EQ(sample.normal_x, normal_x[i]);
            ASSERT_EQ(sample.normal_y, normal_y[i]);
            ASSERT_EQ(sample.normal_z, normal_z[i]);
            ASSERT_EQ(sample.error_m, error[i]);
        }
    }
}

// OpenEXR rounds with Imath's half: to nearest even.
TEST(ScalarHalf, RoundsAsImathDoes) {
    std::mt19937 random(1);
    std::vector<float> values = {0.f,        -0.f,       1.f,       65504.f,  65519.996f, 65520.f,
                                 -65520.f,   1e10f,      0x1p-14f,  0x1p-15f, 0x1p-24f,   0x1p-25f,
                                 0x1.8p-24f, 0x1.8p-25f, 0x1p-126f, 0x1p-140f};
    for (int i = 0; i < 1000000; ++i) {
        const auto bits = static_cast<std::uint32_t>(random());
        const auto value = std::bit_cast<float>(bits);
        if (!std::isnan(value)) values.push_back(value);
    }
    for (std::uint32_t bits = 0; bits < 0x7C00; ++bits) {
        // Midpoints between neighbours, where the rule for ties decides.
        const float here = value_of_half(static_cast<std::uint16_t>(bits));
        const float next = value_of_half(static_cast<std::uint16_t>(bits + 1));
        if (!std::isinf(next)) values.push_back(here + (next - here) / 2);
    }
    for (const float value : values) ASSERT_EQ(half_of(value), Imath::half(value).bits()) << value;
}

}  // namespace
}  // namespace pelagic::peers
