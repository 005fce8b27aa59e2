// Cascades through the C interface: the transform of each cascade, the meaning of
// its texels, and copies to an application's memory. The reference is the surface that the planes
// describe: their Fourier series, summed directly in double.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstring>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "pelagic/tests/capi_cascade_sum.h"
#include "pelagic/tests/capi_sea.hpp"

namespace pelagic {
namespace {

constexpr double pi = std::numbers::pi;

pelagic_ocean_options serial_options(const COceanExecutor& serial) {
    auto options = sized<pelagic_ocean_options>();
    options.executor = serial.get();
    return options;
}

class CInterfaceCascades : public testing::Test {
   protected:
    COceanExecutor serial = executor_of(PELAGIC_EXECUTOR_SERIAL);

    static std::vector<pelagic_cascade> cascades_of(const pelagic_ocean* ocean, const pelagic_frame& frame) {
        std::vector<pelagic_cascade> cascades(static_cast<std::size_t>(frame.cascade_count),
                                              sized<pelagic_cascade>());
        for (std::int32_t i = 0; i < frame.cascade_count; ++i)
            EXPECT_EQ(pelagic_ocean_cascade(ocean, i, &cascades[static_cast<std::size_t>(i)]), PELAGIC_OK)
                << pelagic_last_error();
        return cascades;
    }
};

/// Textures of a frame of N = 32, in the application's memory.
struct ApplicationTextures {
    static constexpr std::size_t texels = 32 * 32, chain = (4 * texels - 1) / 3;
    alignas(64) std::uint16_t halves[4 * texels];
    std::uint32_t slopes[chain], moments[chain];

    pelagic_texture_targets targets(std::uint32_t cascade_count, const std::uint32_t (&offset)[12]) {
        auto out = sized<pelagic_texture_targets>();
        out.cascade_count = cascade_count;
        out.displacement_rgba16f = halves;
        for (int level = 0; level < 6; ++level) {
            out.slopes_rgba8[level] = slopes + offset[level];
            out.moments_rgba8[level] = moments + offset[level];
        }
        return out;
    }
};

TEST_F(CInterfaceCascades, TexturesOnlyAreBitIdenticalAndHaveNoPlanes) {
    pelagic_ocean_options options = serial_options(serial);
    const COcean usual = ocean_of(stack_sea(3), serial.get());
    options.textures_only = 1;
    const COcean textures = ocean_of(stack_sea(3), options);
    const auto expected = cascades_of(usual.get(), complete(usual, 4));
    const auto cascades = cascades_of(textures.get(), complete(textures, 4));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(cascades[i].height.data, nullptr);
        EXPECT_EQ(std::memcmp(cascades[i].displacement_rgba16f, expected[i].displacement_rgba16f, 8 * 32 * 32), 0);
        EXPECT_EQ(std::memcmp(cascades[i].slopes_rgba8, expected[i].slopes_rgba8, 4 * 32 * 32), 0);
        EXPECT_EQ(std::memcmp(&cascades[i].bounds, &expected[i].bounds, sizeof expected[i].bounds), 0);
    }
    options.queries = 1;
    const pelagic_sea sea = stack_sea(3);
    pelagic_ocean* made = nullptr;
    expect_rejected(pelagic_ocean_create(&sea, &options, &made),
                    "queries cannot be combined with an ocean without planes");
}

TEST_F(CInterfaceCascades, TexturesAreWrittenToTheApplicationsMemory) {
    const COcean usual = ocean_of(stack_sea(3), serial.get()), elsewhere = ocean_of(stack_sea(3), serial.get());
    const pelagic_frame frame = complete(usual, 4);
    const std::vector<pelagic_cascade> expected = cascades_of(usual.get(), frame);
    std::vector<ApplicationTextures> memory(3);
    std::vector<pelagic_texture_targets> targets;
    for (std::size_t i = 0; i < 3; ++i)
        targets.push_back(memory[i].targets(i == 0 ? 3 : 0, expected[i].level_offset));

    auto shown = sized<pelagic_frame>();
    ASSERT_EQ(pelagic_ocean_schedule_into(elsewhere.get(), 4, targets.data()), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(pelagic_ocean_schedule_into(elsewhere.get(), 5, targets.data()), PELAGIC_WRONG_ORDER);
    ASSERT_EQ(pelagic_ocean_complete(elsewhere.get(), &shown), PELAGIC_OK) << pelagic_last_error();
    const std::vector<pelagic_cascade> cascades = cascades_of(elsewhere.get(), shown);
    EXPECT_EQ(shown.displacement_rgba16f, nullptr);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(std::memcmp(memory[i].halves, expected[i].displacement_rgba16f, sizeof memory[i].halves), 0) << i;
        EXPECT_EQ(std::memcmp(memory[i].slopes, expected[i].slopes_rgba8, sizeof memory[i].slopes), 0) << i;
        EXPECT_EQ(std::memcmp(memory[i].moments, expected[i].moments_rgba8, sizeof memory[i].moments), 0) << i;
        EXPECT_TRUE(!cascades[i].displacement_rgba16f && !cascades[i].slopes_rgba8 && !cascades[i].moments_rgba8);
    }

    targets[0].cascade_count = 2;
    expect_rejected(pelagic_ocean_schedule_into(elsewhere.get(), 5, targets.data()),
                    "targets.cascade_count is 2, expected 3, with as many structs one after the other");
    targets[0].cascade_count = 3;
    targets[1].moments_rgba8[2] = nullptr;
    expect_rejected(pelagic_ocean_schedule_into(elsewhere.get(), 5, targets.data()),
                    "targets: moments_rgba8 lacks level 2, expected 6 levels");
    expect_rejected(pelagic_ocean_schedule_into(elsewhere.get(), 5, nullptr), "targets is NULL, expected a pointer");
}

bool is_same(const pelagic_plane& a, const pelagic_plane& b) {
    return a.data == b.data && a.resolution == b.resolution && a.block_columns == b.block_columns &&
           a.row_stride == b.row_stride && a.block_stride == b.block_stride;
}

TEST_F(CInterfaceCascades, TheFrameHoldsItsCoarsestCascade) {
    const COcean ocean = ocean_of(stack_sea(3), serial.get());
    auto info = sized<pelagic_ocean_info>();
    ASSERT_EQ(pelagic_ocean_describe(ocean.get(), &info), PELAGIC_OK);
    EXPECT_EQ(info.cascade_count, 3);
    EXPECT_EQ(info.resolution, 32);
    const pelagic_frame frame = complete(ocean, 3);
    ASSERT_EQ(frame.cascade_count, 3);
    const std::vector<pelagic_cascade> cascades = cascades_of(ocean.get(), frame);
    EXPECT_EQ(frame.resolution, 32);
    EXPECT_EQ(frame.patch_size_m, cascades[0].side_m);
    EXPECT_EQ(frame.displacement_rgba16f, cascades[0].displacement_rgba16f);
    EXPECT_TRUE(is_same(frame.dx, cascades[0].dx) && is_same(frame.height, cascades[0].height) &&
                is_same(frame.dz, cascades[0].dz) && is_same(frame.velocity_x, cascades[0].velocity_x) &&
                is_same(frame.velocity_y, cascades[0].velocity_y) &&
                is_same(frame.velocity_z, cascades[0].velocity_z));
    EXPECT_NE(frame.velocity_x.data, nullptr);
    EXPECT_EQ(frame.gradient_rgba8, nullptr);
    EXPECT_EQ(frame.gradient_levels, 0);
    EXPECT_GT(frame.roughness, 0);
    EXPECT_LE(frame.roughness, 1);
    pelagic_bounds sum{};
    for (std::size_t i = 0; i < 3; ++i) {
        const pelagic_cascade& cascade = cascades[i];
        EXPECT_EQ(cascade.resolution, 32);
        EXPECT_NEAR(cascade.cosine * cascade.cosine + cascade.sine * cascade.sine, 1, 1e-15);
        if (i > 0) {
            EXPECT_LT(cascade.side_m, cascades[i - 1].side_m);
            EXPECT_NE(cascade.sine, cascades[i - 1].sine);
        }
        EXPECT_EQ(cascade.gradient_rgba8, nullptr);
        ASSERT_EQ(cascade.levels, 6);
        std::uint32_t offset = 0;
        for (int level = 0; level < 6; ++level) {
            EXPECT_EQ(cascade.level_offset[level], offset);
            offset += 1024u >> 2 * level;
        }
        const auto highest = [&](const pelagic_plane& plane, double sign) {
            float max = -1e9f;
            for (int texel = 0; texel < 1024; ++texel)
                max = std::max(max, static_cast<float>(sign) * texel_of(plane, texel % 32, texel / 32));
            return max;
        };
        EXPECT_EQ(cascade.bounds.height_max_m, highest(cascade.height, 1));
        EXPECT_EQ(cascade.bounds.height_min_m, -highest(cascade.height, -1));
        EXPECT_EQ(cascade.bounds.horizontal_x_max_m, std::max(highest(cascade.dx, 1), highest(cascade.dx, -1)));
        EXPECT_EQ(cascade.bounds.horizontal_z_max_m, std::max(highest(cascade.dz, 1), highest(cascade.dz, -1)));
        sum.height_min_m += cascade.bounds.height_min_m;
        sum.height_max_m += cascade.bounds.height_max_m;
        sum.horizontal_x_max_m += cascade.bounds.horizontal_x_max_m;
        sum.horizontal_z_max_m += cascade.bounds.horizontal_z_max_m;
    }
    EXPECT_FLOAT_EQ(frame.bounds.height_min_m, sum.height_min_m);
    EXPECT_FLOAT_EQ(frame.bounds.height_max_m, sum.height_max_m);
    EXPECT_FLOAT_EQ(frame.bounds.horizontal_x_max_m, sum.horizontal_x_max_m);
    EXPECT_FLOAT_EQ(frame.bounds.horizontal_z_max_m, sum.horizontal_z_max_m);
}

TEST_F(CInterfaceCascades, OptionsSelectTheDataOfACascade) {
    for (const bool is_asked : {false, true}) {
        pelagic_ocean_options options = serial_options(serial);
        options.slopes = options.gradients = is_asked;
        const COcean one = ocean_of(small_sea(32), options), two = ocean_of(stack_sea(2), options);
        const pelagic_frame frame = complete(one, 1), stack = complete(two, 1);
        const std::vector<pelagic_cascade> alone = cascades_of(one.get(), frame),
                                           cascades = cascades_of(two.get(), stack);
        ASSERT_EQ(alone.size(), 1u);
        EXPECT_EQ(alone[0].side_m, 250);
        EXPECT_EQ(alone[0].cosine, 1);
        EXPECT_EQ(alone[0].sine, 0);
        EXPECT_EQ(frame.gradient_levels, 6);
        EXPECT_NE(frame.gradient_rgba8, nullptr);
        EXPECT_EQ(alone[0].gradient_rgba8, frame.gradient_rgba8);
        EXPECT_EQ(std::memcmp(alone[0].level_offset, frame.gradient_offset, sizeof frame.gradient_offset), 0);
        EXPECT_EQ(alone[0].slopes_rgba8 != nullptr, is_asked);
        EXPECT_EQ(alone[0].moments_rgba8 != nullptr, is_asked);
        EXPECT_EQ(stack.gradient_levels, is_asked ? 6 : 0);
        for (const pelagic_cascade& cascade : cascades) {
            EXPECT_EQ(cascade.gradient_rgba8 != nullptr, is_asked);
            EXPECT_NE(cascade.slopes_rgba8, nullptr);
            EXPECT_NE(cascade.moments_rgba8, nullptr);
            EXPECT_EQ(cascade.velocity_y.data, nullptr);
        }
    }
}

TEST_F(CInterfaceCascades, AnInvalidCascadeIndexIsNamed) {
    const COcean one = ocean_of(small_sea(), serial.get()), two = ocean_of(stack_sea(2), serial.get());
    complete(one, 0), complete(two, 0);
    pelagic_cascade cascade, untouched;
    std::memset(&cascade, 0xAB, sizeof cascade);
    cascade.struct_size = sizeof cascade;
    std::memcpy(&untouched, &cascade, sizeof cascade);
    expect_rejected(pelagic_ocean_cascade(one.get(), 1, &cascade), "index is 1, expected 0");
    expect_rejected(pelagic_ocean_cascade(two.get(), 2, &cascade), "index is 2, expected 0 to 1");
    expect_rejected(pelagic_ocean_cascade(two.get(), -1, &cascade), "index is -1, expected 0 to 1");
    expect_rejected(pelagic_ocean_cascade(two.get(), INT32_MIN, &cascade), "index is -2147483648, expected 0 to 1");
    EXPECT_EQ(std::memcmp(&cascade, &untouched, sizeof cascade), 0);
    const pelagic_sea lone = small_sea(32), more = stack_sea(3);
    expect_rejected(pelagic_ocean_schedule_sea(two.get(), &lone),
                    "cascades is 1, expected 2, as the ocean was built");
    expect_rejected(pelagic_ocean_schedule_sea(two.get(), &more),
                    "cascades is 3, expected 2, as the ocean was built");
}

TEST_F(CInterfaceCascades, CascadesBelongToTheFrameCompletedLast) {
    const COcean ocean = ocean_of(stack_sea(2), serial.get());
    const pelagic_frame first = complete(ocean, 1);
    const pelagic_cascade before = cascades_of(ocean.get(), first)[1];
    const float height = texel_of(before.height, 3, 4);
    ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 2), PELAGIC_OK);
    EXPECT_TRUE(is_same(cascades_of(ocean.get(), first)[1].height, before.height)) << "while the next is computed";
    auto second = sized<pelagic_frame>();
    ASSERT_EQ(pelagic_ocean_complete(ocean.get(), &second), PELAGIC_OK);
    EXPECT_NE(texel_of(cascades_of(ocean.get(), second)[1].height, 3, 4), height);
    EXPECT_EQ(texel_of(before.height, 3, 4), height) << "views of the frame before are still valid";

    // The new sea's cascades have different sides; the current frame still shows the old sea.
    pelagic_sea storm = stack_sea(2);
    storm.wind_speed_mps = 25;
    ASSERT_EQ(pelagic_ocean_schedule_sea(ocean.get(), &storm), PELAGIC_OK);
    ASSERT_EQ(pelagic_ocean_complete_sea(ocean.get()), PELAGIC_OK);
    EXPECT_EQ(cascades_of(ocean.get(), second)[0].side_m, first.patch_size_m);
    const pelagic_frame third = complete(ocean, 3);
    EXPECT_GT(third.patch_size_m, first.patch_size_m);
    EXPECT_EQ(cascades_of(ocean.get(), third)[0].side_m, third.patch_size_m);
}

// ---- Meaning of texels ------------------------------------------------------------

/// A plane as the sum of its waves.
class Series {
   public:
    explicit Series(const pelagic_plane& plane) : n_(plane.resolution), half_(n_ / 2) {
        const auto rows = static_cast<std::size_t>(n_);
        std::vector<std::complex<double>> half_done(rows * rows);
        amplitudes_.resize(rows * rows);
        for (int j = 0; j < n_; ++j)
            for (int m = 0; m < n_; ++m)
                for (int i = 0; i < n_; ++i)
                    half_done[index(m, j)] +=
                        static_cast<double>(texel_of(plane, i, j)) * turned(-i * (m - half_)) / (1.0 * n_ * n_);
        for (int m = 0; m < n_; ++m)
            for (int n = 0; n < n_; ++n)
                for (int j = 0; j < n_; ++j)
                    amplitudes_[index(m, n)] += half_done[index(m, j)] * turned(-j * (n - half_));
    }

    struct Value {
        /// derivatives by u and v, of period 1 each, follow the value
        double value, along, across;
    };
    Value at(double u, double v) const {
        Value sum{};
        // Waves are three texels or longer, so the first row and column, of wavelength 2, are
        // empty.
        for (int n = 1; n < n_; ++n) {
            for (int m = 1; m < n_; ++m) {
                const std::complex<double> wave =
                    amplitudes_[index(m, n)] * std::polar(1.0, 2 * pi * ((m - half_) * u + (n - half_) * v));
                sum.value += wave.real();
                sum.along -= 2 * pi * (m - half_) * wave.imag();
                sum.across -= 2 * pi * (n - half_) * wave.imag();
            }
        }
        return sum;
    }

   private:
    std::size_t index(int m, int n) const { return static_cast<std::size_t>(n * n_ + m); }
    std::complex<double> turned(int texels) const { return std::polar(1.0, 2 * pi * (texels % n_) / n_); }
    int n_, half_;
    std::vector<std::complex<double>> amplitudes_;
};

/// The surface of a cascade's waves.
class ExactCascade {
   public:
    explicit ExactCascade(const pelagic_cascade& cascade)
        : cascade_(cascade), dx_(cascade.dx), height_(cascade.height), dz_(cascade.dz) {}

    struct Derivatives {
        double by_x, by_z;
    };
    /// h_x, h_z, D_xx, D_zz, D_xz, D_zx.
    std::array<double, 6> slopes(double x, double z) const {
        const auto [h_x, h_z] = derivatives(height_, x, z);
        const auto [d_xx, d_xz] = derivatives(dx_, x, z);
        const auto [d_zx, d_zz] = derivatives(dz_, x, z);
        return {h_x, h_z, d_xx, d_zz, d_xz, d_zx};
    }

   private:
    Derivatives derivatives(const Series& series, double x, double z) const {
        const double c = cascade_.cosine, s = cascade_.sine, side_m = cascade_.side_m;
        const auto [value, along, across] = series.at((c * x + s * z) / side_m, (c * z - s * x) / side_m);
        return {(c * along - s * across) / side_m, (s * along + c * across) / side_m};
    }

    pelagic_cascade cascade_;
    Series dx_, height_, dz_;
};

double degrees_between(const double (&a)[3], const double (&b)[3]) {
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    return std::atan2(std::sqrt(x * x + y * y + z * z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / pi;
}

// Bounds as in slopes_test.cpp: the rms error of the summed texture is within 2 degrees for normals
// and 0.03 for Jacobians.
TEST_F(CInterfaceCascades, DecodedSlopesSumToTheSurfacesSlopes) {
    pelagic_sea sea = stack_sea(4, 64);
    sea.wind_direction_rad = 0.7;
    const COcean ocean = ocean_of(sea, serial.get());
    const pelagic_frame frame = complete(ocean, 5);
    const std::vector<pelagic_cascade> cascades = cascades_of(ocean.get(), frame);
    const std::vector<ExactCascade> exact_cascades(cascades.begin(), cascades.end());
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-3000, 3000);
    double normal_squares = 0, jacobian_squares = 0, slope_squares = 0, jacobian_variance = 0, curl = 0, shear = 0;
    constexpr int points = 60;
    for (int p = 0; p < points; ++p) {
        const double x = place(random), z = place(random);
        double sum[8] = {}, exact[8] = {}, normal[3], exact_normal[3];
        for (std::size_t t = 0; t < cascades.size(); ++t) {
            add_slopes(&cascades[t], x, z, sum);
            const std::array<double, 6> slopes = exact_cascades[t].slopes(x, z);
            for (std::size_t i = 0; i < 5; ++i) exact[i] += slopes[i];
            curl += (slopes[4] - slopes[5]) * (slopes[4] - slopes[5]);
            shear += slopes[4] * slopes[4];
        }
        normal_of_slopes(sum, normal);
        normal_of_slopes(exact, exact_normal);
        const double across[3] = {exact[4], exact[1], 1 + exact[3]}, along[3] = {1 + exact[2], exact[0], exact[4]};
        EXPECT_NEAR(exact_normal[0], across[1] * along[2] - across[2] * along[1], 1e-12) << "the tangents' product";
        EXPECT_NEAR(exact_normal[1], across[2] * along[0] - across[0] * along[2], 1e-12);
        EXPECT_NEAR(exact_normal[2], across[0] * along[1] - across[1] * along[0], 1e-12);
        const double degrees = degrees_between(normal, exact_normal);
        normal_squares += degrees * degrees / points;
        jacobian_squares += (normal[1] - exact_normal[1]) * (normal[1] - exact_normal[1]) / points;
        jacobian_variance += (exact_normal[1] - 1) * (exact_normal[1] - 1) / points;
        slope_squares += (exact[0] * exact[0] + exact[1] * exact[1]) / points;
        for (const int variance : {5, 6}) EXPECT_GE(sum[variance], 0);
    }
    // Horizontal displacement is along the wave vector, so dDx/dz = dDz/dx. A wrong sign of one
    // axis would break this equality.
    EXPECT_LT(curl, 1e-8 * shear);
    EXPECT_GT(slope_squares, 0.01) << "the normal turns by 6 degrees, thrice the bound";
    EXPECT_GT(jacobian_variance, 0.06 * 0.06) << "twice the bound";
    EXPECT_LE(std::sqrt(normal_squares), 2);
    EXPECT_LE(std::sqrt(jacobian_squares), 0.03);
    RecordProperty("normal_rms_deg", std::to_string(std::sqrt(normal_squares)));
    RecordProperty("jacobian_rms", std::to_string(std::sqrt(jacobian_squares)));
    RecordProperty("slope_squares", std::to_string(slope_squares));
    RecordProperty("jacobian_variance", std::to_string(jacobian_variance));
}

/// The cascade, reduced to one level of its slopes.
pelagic_cascade level_of(pelagic_cascade cascade, int level) {
    cascade.slopes_rgba8 += cascade.level_offset[level];
    cascade.moments_rgba8 += cascade.level_offset[level];
    cascade.resolution >>= level;
    return cascade;
}

// Over a whole cascade the mean slope is zero, and the last level is one texel of the whole: the
// variance between the texels of a finer level becomes variance within it. The sum is taken from
// level 1, because level 0 is sharpened for the filter (docs/theory.md).
TEST_F(CInterfaceCascades, TheLastLevelHasZeroSlopeAndTheTotalVariance) {
    const COcean ocean = ocean_of(stack_sea(3), serial.get());
    for (const pelagic_cascade& cascade : cascades_of(ocean.get(), complete(ocean, 3))) {
        double whole[8] = {};
        const pelagic_cascade last = level_of(cascade, cascade.levels - 1), first = level_of(cascade, 1);
        ASSERT_EQ(last.resolution, 1);
        add_slopes(&last, 0, 0, whole);
        for (int i = 0; i < 5; ++i)
            EXPECT_LT(std::fabs(whole[i]), 0.501 * cascade.slope_range / 127) << "half a step";
        double squares[3] = {};
        for (int texel = 0; texel < 256; ++texel) {
            pelagic_cascade one = first;
            one.slopes_rgba8 += texel, one.moments_rgba8 += texel, one.resolution = 1;
            double sum[8] = {};
            add_slopes(&one, 0, 0, sum);
            squares[0] += (sum[0] * sum[0] + sum[5]) / 256;
            squares[1] += (sum[1] * sum[1] + sum[6]) / 256;
            squares[2] += (sum[0] * sum[1] + sum[7]) / 256;
        }
        EXPECT_GT(squares[0], 10 * cascade.variance_range / 255);
        // Half a step of the last texel, plus the mean rounding error of all other texels.
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(whole[5 + i], squares[i], 0.6 * cascade.variance_range / 127) << i;
    }
}

/// A plane of the cascade at reference position (x, z), bilinearly interpolated as pelagic.h
/// specifies.
double bilinear(const pelagic_cascade& cascade, const pelagic_plane& plane, double x, double z) {
    const double u = (cascade.cosine * x + cascade.sine * z) / cascade.side_m * cascade.resolution;
    const double v = (cascade.cosine * z - cascade.sine * x) / cascade.side_m * cascade.resolution;
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v)), mask = cascade.resolution - 1;
    const double a = u - i, b = v - j;
    const auto texel = [&](int right, int below) { return texel_of(plane, (i + right) & mask, (j + below) & mask); };
    return (1 - b) * ((1 - a) * texel(0, 0) + a * texel(1, 0)) + b * ((1 - a) * texel(0, 1) + a * texel(1, 1));
}

// Without folds there is one surface point above each position, and a query finds it.
TEST_F(CInterfaceCascades, AQueryReturnsTheDisplacedSumOfCascades) {
    pelagic_sea sea = stack_sea(3);
    sea.choppiness = 0.3;
    const COcean ocean = ocean_of(sea, serial.get());
    const pelagic_frame frame = complete(ocean, 2);
    const std::vector<pelagic_cascade> cascades = cascades_of(ocean.get(), frame);
    constexpr std::size_t count = 200;
    std::vector<double> x(count), z(count), heights(count);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> place(-3000, 3000);
    for (std::size_t p = 0; p < count; ++p) {
        const double reference_x = place(random), reference_z = place(random);
        x[p] = reference_x, z[p] = reference_z;
        for (const pelagic_cascade& cascade : cascades) {
            x[p] += bilinear(cascade, cascade.dx, reference_x, reference_z);
            z[p] += bilinear(cascade, cascade.dz, reference_x, reference_z);
            heights[p] += bilinear(cascade, cascade.height, reference_x, reference_z);
        }
    }
    std::vector<float> found(count);
    auto asked = sized<pelagic_points>();
    asked.count = count, asked.x = x.data(), asked.z = z.data();
    auto samples = sized<pelagic_samples>();
    samples.height_m = found.data();
    ASSERT_EQ(pelagic_ocean_query(ocean.get(), &asked, &samples), PELAGIC_OK) << pelagic_last_error();
    for (std::size_t p = 0; p < count; ++p) EXPECT_NEAR(found[p], heights[p], 1e-3) << "the query's tolerance";
}

// ---- An application's memory ------------------------------------------------------

/// All data of a cascade of a stack.
struct StackArrays {
    explicit StackArrays(std::size_t side)
        : planes(6, std::vector<float>(side * side)), halves(4 * side * side), chain((4 * side * side - 1) / 3) {
        slopes = moments = gradients = chain;
    }
    pelagic_frame_buffers view() {
        auto buffers = sized<pelagic_frame_buffers>();
        buffers.plane_count = planes[0].size();
        buffers.dx = planes[0].data(), buffers.height = planes[1].data(), buffers.dz = planes[2].data();
        buffers.velocity_x = planes[3].data();
        buffers.velocity_y = planes[4].data();
        buffers.velocity_z = planes[5].data();
        buffers.rgba16f_count = halves.size();
        buffers.displacement_rgba16f = halves.data();
        buffers.rgba8_count = buffers.slopes_count = chain.size();
        buffers.gradient_rgba8 = gradients.data();
        buffers.slopes_rgba8 = slopes.data();
        buffers.moments_rgba8 = moments.data();
        return buffers;
    }
    bool operator==(const StackArrays&) const = default;

    std::vector<std::vector<float>> planes;
    std::vector<std::uint16_t> halves;
    std::vector<std::uint32_t> chain, gradients, slopes, moments;
};

TEST_F(CInterfaceCascades, ACopyWritesEachCascadeToItsOwnBuffers) {
    pelagic_ocean_options options = serial_options(serial);
    options.velocities = options.gradients = 1;
    const COcean ocean = ocean_of(stack_sea(3), options);
    std::vector<StackArrays> arrays(3, StackArrays(32)), computed = arrays;
    std::vector<pelagic_frame_buffers> copies, to;
    for (StackArrays& cascade : arrays) copies.push_back(cascade.view());
    for (StackArrays& cascade : computed) to.push_back(cascade.view());
    copies[0].cascade_count = to[0].cascade_count = 3;

    const pelagic_frame frame = complete(ocean, 4);
    ASSERT_EQ(pelagic_ocean_copy(ocean.get(), copies.data()), PELAGIC_OK) << pelagic_last_error();
    pelagic_bounds bounds{};
    ASSERT_EQ(pelagic_ocean_frame_at(ocean.get(), 4, to.data(), &bounds), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(arrays, computed);
    EXPECT_EQ(std::memcmp(&bounds, &frame.bounds, sizeof bounds), 0);
    const std::vector<pelagic_cascade> cascades = cascades_of(ocean.get(), frame);
    for (std::size_t t = 0; t < 3; ++t) {
        const pelagic_cascade& cascade = cascades[t];
        const StackArrays& copy = arrays[t];
        const pelagic_plane* planes[6] = {&cascade.dx,         &cascade.height,     &cascade.dz,
                                          &cascade.velocity_x, &cascade.velocity_y, &cascade.velocity_z};
        for (std::size_t p = 0; p < 6; ++p)
            for (int texel = 0; texel < 1024; ++texel)
                ASSERT_EQ(copy.planes[p][static_cast<std::size_t>(texel)],
                          texel_of(*planes[p], texel % 32, texel / 32));
        EXPECT_EQ(std::memcmp(cascade.displacement_rgba16f, copy.halves.data(), 2 * copy.halves.size()), 0);
        EXPECT_EQ(std::memcmp(cascade.gradient_rgba8, copy.gradients.data(), 4 * copy.chain.size()), 0);
        EXPECT_EQ(std::memcmp(cascade.slopes_rgba8, copy.slopes.data(), 4 * copy.chain.size()), 0);
        EXPECT_EQ(std::memcmp(cascade.moments_rgba8, copy.moments.data(), 4 * copy.chain.size()), 0);
    }
    EXPECT_NE(arrays[0], arrays[1]);
}

// Before the first complete(), the current frame is that of frame_at(), also for cascades.
TEST_F(CInterfaceCascades, CascadesOfFrameAtAreAvailableBeforeTheFirstComplete) {
    const COcean ocean = ocean_of(stack_sea(2), serial.get());
    pelagic_frame_buffers nothing[2] = {sized<pelagic_frame_buffers>(), sized<pelagic_frame_buffers>()};
    nothing[0].cascade_count = 2;
    ASSERT_EQ(pelagic_ocean_frame_at(ocean.get(), 4, nothing, nullptr), PELAGIC_OK) << pelagic_last_error();
    auto cascade = sized<pelagic_cascade>();
    ASSERT_EQ(pelagic_ocean_cascade(ocean.get(), 1, &cascade), PELAGIC_OK) << pelagic_last_error();
    const COcean other = ocean_of(stack_sea(2), serial.get());
    const pelagic_cascade expected = cascades_of(other.get(), complete(other, 4))[1];
    EXPECT_EQ(std::memcmp(cascade.slopes_rgba8, expected.slopes_rgba8, 4 * 1024), 0);
}

TEST_F(CInterfaceCascades, UnsuitableBuffersAreNamed) {
    const COcean ocean = ocean_of(stack_sea(2), serial_options(serial));
    complete(ocean, 0);
    std::vector<StackArrays> arrays(2, StackArrays(32));
    const auto expect_line = [&](const std::string& line, void (*change)(pelagic_frame_buffers*)) {
        pelagic_frame_buffers buffers[2] = {arrays[0].view(), arrays[1].view()};
        buffers[0].cascade_count = 2;
        for (pelagic_frame_buffers& cascade : buffers)
            cascade.gradient_rgba8 = nullptr, cascade.velocity_x = cascade.velocity_y = cascade.velocity_z = nullptr;
        change(buffers);
        if (line.empty()) {
            EXPECT_EQ(pelagic_ocean_copy(ocean.get(), buffers), PELAGIC_OK) << pelagic_last_error();
            return;
        }
        const std::vector<StackArrays> before = arrays;
        expect_rejected(pelagic_ocean_copy(ocean.get(), buffers), line);
        expect_rejected(pelagic_ocean_frame_at(ocean.get(), 1, buffers, nullptr), line);
        EXPECT_EQ(arrays, before) << "nothing was written";
    };
    const std::string size = std::to_string(sizeof(pelagic_frame_buffers));
    const std::string odd = std::to_string(sizeof(pelagic_frame_buffers) - 1);
    expect_line("buffers[1].struct_size is 0, expected " + size + ", as the first's",
                [](auto* buffers) { buffers[1].struct_size = 0; });
    expect_line("buffers.struct_size is " + odd + ", expected " + size + ", the size of the struct",
                [](auto* buffers) { buffers[0].struct_size -= 1; });
    expect_line("buffers[1].cascade_count is 2, expected 0", [](auto* buffers) { buffers[1].cascade_count = 2; });
    for (const std::uint32_t count : {0u, 1u, 3u}) {
        pelagic_frame_buffers alone = arrays[0].view();  // no struct follows it
        alone.cascade_count = count;
        expect_rejected(pelagic_ocean_copy(ocean.get(), &alone),
                        "buffers.cascade_count is " + std::to_string(count) +
                            ", expected 2, with as many structs one after the other");
    }
    expect_line("height has 1023 elements, expected 1024",
                [](auto* buffers) { buffers[1].plane_count = 1023, buffers[1].dx = nullptr; });
    expect_line("slopes_rgba8 has 1 elements, expected 1365", [](auto* buffers) { buffers[1].slopes_count = 0; });
    expect_line("moments_rgba8 has 1366 elements, expected 1365",
                [](auto* buffers) { buffers[0].slopes_count = 1366, buffers[0].slopes_rgba8 = nullptr; });
    static float room[1024];
    static std::uint32_t chain[1365];
    expect_line("velocity_z is requested, but the ocean was created without velocities",
                [](auto* buffers) { buffers[1].velocity_z = room; });
    expect_line("gradient_rgba8 is requested, but the ocean was created without gradients",
                [](auto* buffers) { buffers[1].gradient_rgba8 = chain; });
    expect_line("", [](auto*) {});

    const COcean one = ocean_of(small_sea(32), serial_options(serial));
    complete(one, 0);
    auto buffers = sized<pelagic_frame_buffers>();
    buffers.slopes_rgba8 = chain, buffers.slopes_count = 1365;
    expect_rejected(pelagic_ocean_copy(one.get(), &buffers),
                    "slopes_rgba8 is requested, but the ocean was created without slopes");
}

}  // namespace
}  // namespace pelagic
