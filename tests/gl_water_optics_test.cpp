// The water's optics compared with published values. These tests need no driver.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "pelagic/gl/water/water_optics.hpp"

namespace pelagic {
namespace {

/// Returns the irradiance reflectance just below the surface under a high sun (Kirk 1984: (0.975 -
/// 0.629) bb / a).
glm::vec3 irradiance_reflectance(const gl::WaterOptics& water) {
    return 0.346f * water.backscattering_per_m / water.absorption_per_m;
}

// Jerlov's K at 475 and 550 nm brackets the channels blue (465 nm) and green (549 nm). K follows
// from a and bb as in Morel and Maritorena 2001, whose equation is inverted here.
TEST(WaterOptics, OfJerlovsTypesHaveHisAttenuation) {
    struct Row {
        const char* type;
        float at_450, at_475, at_550;
    };
    for (const Row& row :
         {Row{"I", .0176f, .0184f, .0640f}, Row{"IB", .0355f, .0330f, .0715f}, Row{"II", .0714f, .0620f, .0863f},
          Row{"III", .1381f, .1160f, .1139f}, Row{"1C", .25f, .17f, .12f}, Row{"9C", 1.6f, 1.23f, .63f}}) {
        const gl::WaterOptics water = gl::water_optics(row.type);
        const glm::vec3 reflectance = 0.33f * water.backscattering_per_m / water.absorption_per_m;
        const glm::vec3 attenuation =
            water.absorption_per_m * (1.f + 2.25f * reflectance) / (0.9f * (1.f - reflectance));
        EXPECT_GE(attenuation.b, 0.999f * std::min(row.at_450, row.at_475)) << row.type;
        EXPECT_LE(attenuation.b, 1.001f * std::max(row.at_450, row.at_475)) << row.type;
        EXPECT_NEAR(attenuation.g, row.at_550, 0.02f * row.at_550) << row.type;
    }
}

// The clearest water is blue, coastal water is green, and no water emits light.
TEST(WaterOptics, TurnFromBlueToGreenWithTurbidity) {
    const auto reflectance = [](std::string_view type) { return irradiance_reflectance(gl::water_optics(type)); };
    const glm::vec3 clearest = reflectance("I"), coast = reflectance("5C");
    EXPECT_GT(clearest.b, 4 * clearest.g);
    EXPECT_GT(coast.g, coast.b);
    EXPECT_GT(coast.g, coast.r);
    for (const std::string_view type : gl::jerlov_types()) {
        const gl::WaterOptics water = gl::water_optics(type);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(water.absorption_per_m[c], 0) << type;
            // Even molecules scatter at most half of the light backwards.
            EXPECT_LE(water.backscattering_per_m[c], 0.5f * water.scattering_per_m[c]) << type;
            EXPECT_GT(water.backscattering_per_m[c], 0) << type;
            // measured seas are below it (Morel and Prieur 1977)
            EXPECT_LT(reflectance(type)[c], 0.1f) << type;
        }
    }
    // All ocean water absorbs red first, within metres.
    EXPECT_GT(gl::water_optics("I").absorption_per_m.r, 0.2f);
}

// Published for oceans (Morel and Maritorena 2001): in the blue the irradiance reflectance is 4 to
// 6 % at 0.03 mg/m^3 and 2 to 2.5 % at 1 mg/m^3. At 550 nm it is about 1 % and hardly depends on
// chlorophyll below 0.3.
TEST(WaterOptics, OfChlorophyllHaveTheMeasuredReflectance) {
    const auto at = [](float chlorophyll) {
        return irradiance_reflectance(gl::water_optics_of_chlorophyll(chlorophyll));
    };
    EXPECT_GT(at(0.03f).b, 0.04f);
    EXPECT_LT(at(0.03f).b, 0.06f);
    EXPECT_GT(at(1).b, 0.018f);
    EXPECT_LT(at(1).b, 0.027f);
    EXPECT_NEAR(at(0.1f).g, 0.01f, 0.003f);
    EXPECT_NEAR(at(0.3f).g, 0.01f, 0.003f);
}

TEST(WaterOptics, RejectUnknownWaterTypes) {
    EXPECT_THROW(gl::water_optics("IV"), std::invalid_argument);
    EXPECT_THROW(gl::water_optics(""), std::invalid_argument);
    for (const float chlorophyll : {0.f, -1.f, 31.f, std::nanf("")})
        EXPECT_THROW(gl::water_optics_of_chlorophyll(chlorophyll), std::invalid_argument) << chlorophyll;
}

}  // namespace
}  // namespace pelagic
