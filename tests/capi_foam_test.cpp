// Foam through the C interface, which is optional.
#include <algorithm>
#include <utility>

#include "pelagic/tests/capi_sea.hpp"

namespace pelagic {
namespace {

class CInterfaceFoam : public testing::Test {
   protected:
    COceanExecutor serial = executor_of(PELAGIC_EXECUTOR_SERIAL);

    COcean gale(bool has_foam, std::int32_t cascades = 2) const {
        pelagic_sea sea = stack_sea(cascades);
        sea.wind_speed_mps = 20;
        auto options = sized<pelagic_ocean_options>();
        options.executor = serial.get();
        options.queries = 1;
        options.foam = has_foam;
        return ocean_of(sea, options);
    }
    static std::uint64_t foam_hash(const COcean& ocean) {
        std::uint64_t hash = 0;
        EXPECT_EQ(pelagic_ocean_foam_hash(ocean.get(), &hash), PELAGIC_OK) << pelagic_last_error();
        return hash;
    }
};

TEST_F(CInterfaceFoam, IsInCascades) {
    const COcean ocean = gale(true);
    complete(ocean, 4);
    const std::size_t chain = (4 * 32 * 32 - 1) / 3;
    const COcean one = gale(true, 1);
    complete(one, 4);
    for (const auto& [of, index] : {std::pair{&ocean, 0}, {&ocean, 1}, {&one, 0}}) {
        auto cascade = sized<pelagic_cascade>();
        ASSERT_EQ(pelagic_ocean_cascade(of->get(), index, &cascade), PELAGIC_OK);
        ASSERT_NE(cascade.compression_r8, nullptr);
        EXPECT_GT(*std::max_element(cascade.compression_r8, cascade.compression_r8 + 32 * 32), 100);
        for (const std::uint32_t* image : cascade.snapshots_rgba8) {
            ASSERT_NE(image, nullptr);
            EXPECT_NE(std::count(image, image + chain, image[0]), static_cast<std::ptrdiff_t>(chain));
        }
        EXPECT_GT(cascade.compression_scale, 0);
    }

    float foam = -1;
    const double x = 3;
    auto points = sized<pelagic_points>();
    points.count = 1, points.x = points.z = &x;
    auto samples = sized<pelagic_samples>();
    samples.foam = &foam;
    const COcean without_foam = gale(false, 1);
    complete(without_foam, 4);
    auto cascade = sized<pelagic_cascade>();
    ASSERT_EQ(pelagic_ocean_cascade(without_foam.get(), 0, &cascade), PELAGIC_OK);
    EXPECT_EQ(cascade.compression_r8, nullptr);
    EXPECT_EQ(cascade.snapshots_rgba8[0], nullptr);
    expect_rejected(pelagic_ocean_query(without_foam.get(), &points, &samples), PELAGIC_INVALID_ARGUMENT,
                    "the frame has no foam: the ocean was created without pelagic_ocean_options.foam");
    std::uint64_t hash = 7;
    expect_rejected(pelagic_ocean_foam_hash(without_foam.get(), &hash), PELAGIC_INVALID_ARGUMENT,
                    "the ocean has no foam: it was created without pelagic_ocean_options.foam");
    EXPECT_EQ(hash, 7u);
}

}  // namespace
}  // namespace pelagic
