// Shores through the C interface: bit-identical to those of the C++ interface.
#include <algorithm>
#include <limits>
#include <string>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/capi_sea.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

class CInterfaceShore : public testing::Test {
   protected:
    CInterfaceShore() {
        ours = beach(400, 300, 12, 40, 10);
        ours.corner_x_m = -90;
        ours.corner_z_m = 30;
        ours.resolution = 64;
        ours.swash_m = 0.1;
    }
    pelagic_shore_options shore() const {
        auto options = pelagic_shore_options_make();
        options.columns = ours.columns;
        options.rows = ours.rows;
        options.heights_m = ours.heights_m.data();
        options.corner_x_m = ours.corner_x_m;
        options.corner_z_m = ours.corner_z_m;
        options.metres_per_sample = ours.metres_per_sample;
        options.resolution = ours.resolution;
        options.swash_m = ours.swash_m;
        return options;
    }
    pelagic_ocean_options with(const pelagic_shore_options* wanted) const {
        auto options = pelagic_ocean_options_make();
        options.executor = serial.get();
        options.queries = 1;
        options.shore = wanted;
        return options;
    }
    std::string refused(const pelagic_shore_options& wanted, const pelagic_sea& sea = stack_sea(2)) const {
        const pelagic_ocean_options options = with(&wanted);
        pelagic_ocean* made = nullptr;
        EXPECT_EQ(pelagic_ocean_create(&sea, &options, &made), PELAGIC_INVALID_ARGUMENT);
        EXPECT_EQ(made, nullptr);
        return pelagic_last_error();
    }

    COceanExecutor serial = executor_of(PELAGIC_EXECUTOR_SERIAL);
    ShoreOptions ours;
};

TEST_F(CInterfaceShore, IsBitIdenticalToTheCppInterface) {
    const pelagic_shore_options options = shore();
    const COcean ocean = ocean_of(stack_sea(2), with(&options));
    complete(ocean, 3.25);
    Ocean expected({.cascades = 2, .resolution = 32},
                   {.executor = make_serial_executor(), .queries = true, .shore = ours});
    const Frame& frame = expected.frame_at(3.25);

    EXPECT_EQ(hash_of(ocean.get(), PELAGIC_HASH_SHORE), shore_hash_of(frame));
    pelagic_shore_surface surface{};
    ASSERT_EQ(pelagic_ocean_shore(ocean.get(), &surface), PELAGIC_OK);
    EXPECT_EQ(surface.columns, frame.shore.columns);
    EXPECT_EQ(surface.rows, frame.shore.rows);
    EXPECT_EQ(surface.texel_m, frame.shore.texel_m);
    EXPECT_EQ(surface.x_m, -90);
    EXPECT_EQ(surface.z_m, 30);
    EXPECT_EQ(surface.weights_change_per_m, frame.shore.weights_change_per_m);
    EXPECT_EQ(surface.height_max_m, frame.shore.bounds.height_max_m);
    EXPECT_EQ(surface.height_min_m, frame.shore.bounds.height_min_m);
    const auto same = [](const auto* found, auto all) { return std::equal(all.begin(), all.end(), found); };
    EXPECT_TRUE(same(surface.depth_m, frame.shore.depth_m));
    EXPECT_TRUE(same(surface.weights_rgba8, frame.shore.weights_rgba8));
    EXPECT_TRUE(same(surface.height_m, frame.shore.height_m));
    EXPECT_TRUE(same(surface.vertical_velocity_mps, frame.shore.vertical_velocity_mps));
    EXPECT_TRUE(same(surface.potential_m2ps, frame.shore.potential_m2ps));
    EXPECT_TRUE(same(surface.reach_m, frame.shore.reach_m));
    EXPECT_TRUE(same(surface.foam, frame.shore.foam));
}

TEST_F(CInterfaceShore, ASwashOf0IsDerived) {
    auto options = pelagic_shore_options_make();
    EXPECT_EQ(options.swash_m, 0);
    options = shore();
    options.swash_m = 0;
    const COcean ocean = ocean_of(stack_sea(2), with(&options));
    complete(ocean, 3.25);
    const std::uint64_t hash = hash_of(ocean.get(), PELAGIC_HASH_SHORE);
    for (const double swash_m : {-1.0, 0.0}) {
        ours.swash_m = swash_m;
        Ocean expected({.cascades = 2, .resolution = 32}, {.executor = make_serial_executor(), .shore = ours});
        EXPECT_EQ(hash == shore_hash_of(expected.frame_at(3.25)), swash_m == -1) << swash_m;
    }
}

TEST_F(CInterfaceShore, InvalidOptionsAreNamed) {
    pelagic_shore_options wrong = shore();
    wrong.columns = 1;
    EXPECT_EQ(refused(wrong), "shore.columns is 1, expected 2 to 4096");
    wrong = shore();
    wrong.heights_m = nullptr;
    EXPECT_EQ(refused(wrong), "shore.heights_m is NULL, expected a pointer");
    wrong = shore();
    wrong.swash_m = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refused(wrong), "shore.swash_m nan is out of range (0, 10], or 0: derived");
    EXPECT_EQ(refused(shore(), small_sea()),
              "cascades is 1, expected 2 to 4 where there is a shore, which takes the coarsest cascade's waves");

    const COcean open = ocean_of(stack_sea(2), with(nullptr));
    pelagic_shore_surface surface{};
    EXPECT_EQ(pelagic_ocean_shore(open.get(), &surface), PELAGIC_WRONG_ORDER);
    complete(open, 0);
    EXPECT_EQ(pelagic_ocean_shore(open.get(), &surface), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(std::string(pelagic_last_error()),
              "the ocean has no shore: it was created without pelagic_ocean_options.shore");
}

}  // namespace
}  // namespace pelagic
