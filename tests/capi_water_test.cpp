// The C interface of water below the surface: equal to WaterQuery, for any frame in memory.
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/water_query.hpp"
#include "pelagic/tests/capi_sea.hpp"

namespace pelagic {
namespace {

struct Points {
    std::vector<double> x, y, z;
    explicit Points(int count) {
        for (int i = 0; i < count; ++i) {
            x.push_back(7.3 * i - 90);
            y.push_back(1.5 - 0.37 * (i % 50) * (i % 50));
            z.push_back(31 - 3.1 * i);
        }
    }
    pelagic_water_points c() const {
        auto points = pelagic_water_points_make();
        points.count = x.size();
        points.x = x.data(), points.y = y.data(), points.z = z.data();
        return points;
    }
};

/// Results of all kinds, as bits.
class Water {
   public:
    explicit Water(std::size_t count) : of_(8, std::vector<float>(count)) {}
    pelagic_water_samples c() {
        auto samples = pelagic_water_samples_make();
        samples.depth_m = of_[0].data(), samples.pressure_pa = of_[1].data();
        samples.velocity_x_mps = of_[2].data(), samples.velocity_y_mps = of_[3].data();
        samples.velocity_z_mps = of_[4].data(), samples.acceleration_x_mps2 = of_[5].data();
        samples.acceleration_y_mps2 = of_[6].data(), samples.acceleration_z_mps2 = of_[7].data();
        return samples;
    }
    WaterSamples cpp() { return {of_[0], of_[1], of_[2], of_[3], of_[4], of_[5], of_[6], of_[7]}; }
    std::vector<std::uint32_t> bits(std::size_t point) const {
        std::vector<std::uint32_t> bits;
        for (const auto& values : of_) bits.push_back(std::bit_cast<std::uint32_t>(values[point]));
        return bits;
    }
    bool operator==(const Water& other) const {
        for (std::size_t i = 0; i < of_[0].size(); ++i)
            if (bits(i) != other.bits(i)) return false;
        return true;
    }

   private:
    std::vector<std::vector<float>> of_;
};

pelagic_ocean_options with_depth() {
    auto options = pelagic_ocean_options_make();
    options.queries = options.depth = 1;
    return options;
}

TEST(CInterfaceWater, EqualsWaterQuery) {
    const Points points(600);
    const COcean ocean = ocean_of(stack_sea(3), with_depth());
    Ocean ours({.cascades = 3, .resolution = 32},
               {.executor = make_serial_executor(), .queries = true, .depth = true});
    const Frame& frame = ours.frame_at(7);
    complete(ocean, 7);
    for (const std::int32_t interpolation : {PELAGIC_INTERPOLATION_LINEAR, PELAGIC_INTERPOLATION_CUBIC})
        for (const double footprint_m : {0.0, 40.0})
            for (const std::int32_t parallel : {0, 1}) {
                Water c(points.x.size()), cpp(points.x.size());
                pelagic_water_points where = points.c();
                where.interpolation = interpolation, where.parallel = parallel;
                where.footprint_m = footprint_m, where.tolerance_m = 0.01, where.water_density_kgpm3 = 1000;
                const pelagic_water_samples to = c.c();
                ASSERT_EQ(pelagic_ocean_sample_water(ocean.get(), &where, &to), PELAGIC_OK) << pelagic_last_error();
                WaterQuery(frame, {.surface = {.tolerance_m = 0.01,
                                               .interpolation = interpolation == PELAGIC_INTERPOLATION_CUBIC
                                                                    ? Interpolation::cubic
                                                                    : Interpolation::linear},
                                   .water_density_kgpm3 = 1000})
                    .sample({points.x, points.y, points.z, footprint_m}, cpp.cpp());
                EXPECT_EQ(c, cpp) << interpolation << " " << footprint_m << " " << parallel;
            }
}

TEST(CInterfaceWater, SurfacesLeaveOutWavesAsSurfaceQueryDoes) {
    const Points points(600);
    const COcean ocean = ocean_of(stack_sea(3), with_depth());
    Ocean ours({.cascades = 3, .resolution = 32},
               {.executor = make_serial_executor(), .queries = true, .depth = true});
    const Frame& frame = ours.frame_at(7);
    complete(ocean, 7);
    auto where = pelagic_points_make();
    where.count = points.x.size(), where.x = points.x.data(), where.z = points.z.data(), where.footprint_m = 25;
    std::vector<float> c(points.x.size()), cpp(points.x.size()), all(points.x.size());
    auto to = pelagic_samples_make();
    to.height_m = c.data();
    ASSERT_EQ(pelagic_ocean_query(ocean.get(), &where, &to), PELAGIC_OK) << pelagic_last_error();
    SurfaceQuery(frame).sample({points.x, points.z, 25}, {.height_m = cpp});
    SurfaceQuery(frame).sample({points.x, points.z}, {.height_m = all});
    EXPECT_EQ(c, cpp);
    EXPECT_NE(c, all);
    where.footprint_m = -1;
    expect_rejected(pelagic_ocean_query(ocean.get(), &where, &to), "points.footprint_m is -1, expected 0 or more");
    where.footprint_m = 1;
    auto options = with_depth();
    options.depth = 0;
    const COcean shallow = ocean_of(small_sea(), options);
    complete(shallow, 0);
    expect_rejected(pelagic_ocean_query(shallow.get(), &where, &to),
                    "points.footprint_m needs an ocean that was created with pelagic_ocean_options.depth");
}

TEST(CInterfaceWater, IsThatOfAFrameByItsNumber) {
    const Points points(20);
    const COcean ocean = ocean_of(stack_sea(2), with_depth());
    Water first(20), again(20), next(20);
    const pelagic_water_samples to_first = first.c(), to_again = again.c(), to_next = next.c();
    pelagic_water_points where = points.c();
    expect_rejected(pelagic_ocean_sample_water(ocean.get(), &where, &to_first), PELAGIC_WRONG_ORDER,
                    "there is no frame yet; call pelagic_ocean_complete first");
    where.frame = complete(ocean, 1).number;
    ASSERT_EQ(pelagic_ocean_sample_water(ocean.get(), &where, &to_first), PELAGIC_OK) << pelagic_last_error();
    complete(ocean, 2);
    ASSERT_EQ(pelagic_ocean_sample_water(ocean.get(), &where, &to_again), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(again, first);
    const pelagic_water_points newest = points.c();
    ASSERT_EQ(pelagic_ocean_sample_water(ocean.get(), &newest, &to_next), PELAGIC_OK) << pelagic_last_error();
    EXPECT_FALSE(next == first);
    complete(ocean, 3);
    expect_rejected(pelagic_ocean_sample_water(ocean.get(), &where, &to_again), PELAGIC_WRONG_ORDER,
                    "frame 1 is not in memory, expected one of the last two");
}

TEST(CInterfaceWater, PositionsThatAreNotFiniteHaveTheQuietNan) {
    const COcean ocean = ocean_of(stack_sea(2), with_depth());
    complete(ocean, 0);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr std::array<double, 4> x = {nan, 0, 0, 0}, y = {-1, infinity, -1, -1}, z = {0, 0, -infinity, 0};
    auto where = pelagic_water_points_make();
    where.count = 4, where.x = x.data(), where.y = y.data(), where.z = z.data();
    Water water(4);
    const pelagic_water_samples to = water.c();
    ASSERT_EQ(pelagic_ocean_sample_water(ocean.get(), &where, &to), PELAGIC_OK) << pelagic_last_error();
    for (const std::size_t i : {0, 1, 2}) EXPECT_EQ(water.bits(i), std::vector(8, 0x7fc00000u)) << i;
    for (const std::uint32_t value : water.bits(3)) EXPECT_NE(value, 0x7fc00000u);
}

TEST(CInterfaceWater, ErrorsAreOneLine) {
    const Points points(4);
    Water water(4);
    const pelagic_water_samples to = water.c();
    const pelagic_water_points where = points.c();
    auto options = with_depth();
    const COcean ocean = ocean_of(small_sea(), options);
    options.depth = 0;
    const COcean shallow = ocean_of(small_sea(), options);
    const COcean plain = ocean_of(small_sea(), pelagic_ocean_options_make());
    for (const COcean* const each : {&ocean, &shallow, &plain}) complete(*each, 0);
    expect_rejected(pelagic_ocean_sample_water(shallow.get(), &where, &to),
                    "the ocean has no water below its surface: it was created without pelagic_ocean_options.depth");
    expect_rejected(pelagic_ocean_sample_water(plain.get(), &where, &to),
                    "the ocean cannot be queried: it was created without pelagic_ocean_options.queries");
    expect_rejected(pelagic_ocean_sample_water(nullptr, &where, &to), "ocean is NULL, expected a pointer");
    expect_rejected(pelagic_ocean_sample_water(ocean.get(), nullptr, &to), "points is NULL, expected a pointer");
    expect_rejected(pelagic_ocean_sample_water(ocean.get(), &where, nullptr), "samples is NULL, expected a pointer");
    const auto rejects = [&](auto change, const std::string& line) {
        pelagic_water_points bad = points.c();
        change(bad);
        expect_rejected(pelagic_ocean_sample_water(ocean.get(), &bad, &to), line);
    };
    const double deep = -4001;
    rejects([&](auto& bad) { bad.count = 1, bad.y = &deep; },
            "y[0] is -4001, expected at least -4000, the sea floor");
    rejects([](auto& bad) { bad.z = nullptr; }, "points.z is NULL, expected a pointer");
    rejects([](auto& bad) { bad.interpolation = 2; },
            "points.interpolation is 2, expected PELAGIC_INTERPOLATION_LINEAR (0) or _CUBIC (1)");
    rejects([](auto& bad) { bad.footprint_m = -1; }, "points.footprint_m is -1, expected 0 or more");
    rejects([](auto& bad) { bad.water_density_kgpm3 = 5; }, "water_density_kgpm3 5 is out of range [500, 2000]");
    rejects([](auto& bad) { bad.tolerance_m = 1e-9; }, "tolerance_m is 1e-09, expected 0 or [1e-6, 1000]");
}

}  // namespace
}  // namespace pelagic
