// Light through crests, against docs/images/reference/crest_light.csv: photons traced through a
// train of steep Gerstner waves with the sun behind (crest_light.py there).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/tests/gl_probe.hpp"
#include "pelagic/tests/test_paths.hpp"

namespace pelagic {
namespace {

constexpr double crest_steepness = 0.44;  // amplitude times wave number, as in crest_light.py

struct CrestRow {
    float amplitude_m, sun_deg, eye_deg, height_m, thickness_m;
    glm::vec3 radiance;
    float error_green;
};

std::vector<CrestRow> read_rows() {
    std::ifstream file(in_sources("docs/images/reference/crest_light.csv"));
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line, "water,amplitude_m,sun_deg,eye_deg,height_m,thickness_m,red,green,blue,error_green");
    std::vector<CrestRow> rows;
    while (std::getline(file, line)) {
        for (char& c : line)
            if (c == ',') c = ' ';
        std::istringstream cells(line);
        std::string water;
        CrestRow row{};
        cells >> water >> row.amplitude_m >> row.sun_deg >> row.eye_deg >> row.height_m >> row.thickness_m >>
            row.radiance.r >> row.radiance.g >> row.radiance.b >> row.error_green;
        EXPECT_TRUE(cells) << line;
        EXPECT_EQ(water, gl::default_jerlov_type);
        rows.push_back(row);
    }
    return rows;
}

float radians_of(float degrees) { return degrees * std::numbers::pi_v<float> / 180; }

/// Returns the block of a sea in the light of a sun alone.
gl::SceneBlock crest_block(float sun_deg, float significant_height_m, float gain) {
    gl::SceneBlock block;
    const gl::WaterOptics water = gl::water_optics(gl::default_jerlov_type);
    block.sun = {-std::cos(radians_of(sun_deg)), std::sin(radians_of(sun_deg)), 0, 0};
    block.sun_irradiance = {1, 1, 1, 1};
    block.water_absorption = {water.absorption_per_m, 0};
    block.water_backscattering = {water.backscattering_per_m, 0};
    block.waves.x = significant_height_m;
    gl::place_crest_light(block, gain);
    return block;
}

class GlCrest : public testing::Test {
   protected:
    struct Light {
        glm::vec3 flat, crest;  ///< upwelling() and through_crests()
    };
    /// \param slope  of the surface towards +x, in the plane of sun and eye
    /// \param lip  1 where the crest is about to break
    Light light(gl::SceneBlock block, float slope, float eye_deg, float height_m, float lip = 0) {
        // Members that the two functions do not use carry the arguments.
        block.grid = {slope, radians_of(eye_deg), height_m, lip};
        const std::vector<float> rgba = probe_.ask(block);
        // Halves lose digits of small numbers, so the probe multiplies by 256.
        const auto pixel = [&](std::size_t x) {
            return glm::vec3(rgba[4 * x], rgba[4 * x + 1], rgba[4 * x + 2]) / 256.f;
        };
        return {pixel(0), pixel(GlProbe::side - 1)};
    }

   private:
    GlProbe probe_{
        gl::Surface::open,
        {"mirror.glsl", "water_light.glsl", "water.glsl"},
        "    vec3 normal = normalize(vec3(-grid.x, 1.0, 0.0)), to_eye = vec3(cos(grid.y), sin(grid.y), 0.0);\n"
        "    vec3 light = gl_FragCoord.x < 64.0 ? upwelling(normal, to_eye)\n"
        "                                       : through_crests(normal, to_eye, grid.z, grid.w);\n"
        "    result = vec4(256.0 * light, 1.0);"};
};

/// Returns the slope of the face away from the sun of a Gerstner wave.
float slope_at(float height_over_amplitude) {
    const double cosine = height_over_amplitude, sine = std::sqrt(1 - cosine * cosine);
    return static_cast<float>(-crest_steepness * sine / (1 - crest_steepness * cosine));
}

// 135 points of faces from below the still-water level to near the crest, where the wave is 0.6 to
// 26 m thick. The bound is a requirement, because the shader knows neither the length of the wave
// nor its back. The reference's standard error is added: below 9 %, but 13 to 19 % in three rows.
// Red light below the middle of waves of 4 m is below a tenth of the rest, and upwelling() alone
// exceeds it, so the bound is that of green and of luminance.
TEST_F(GlCrest, IsWithinThirtyPercentOfTracedPhotons) {
    const auto luminance = [](const glm::vec3& light) {
        return glm::dot(light, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    };
    double sum = 0;
    float thinnest_m = 100, thickest_m = 0;
    const std::vector<CrestRow> rows = read_rows();
    ASSERT_EQ(rows.size(), 135u);
    for (const CrestRow& row : rows) {
        // The standard deviation of the heights of a wave of amplitude A is A / sqrt(2).
        const gl::SceneBlock block = crest_block(row.sun_deg, 4 * row.amplitude_m / std::numbers::sqrt2_v<float>, 1);
        const Light found = light(block, slope_at(row.height_m / row.amplitude_m), row.eye_deg, row.height_m);
        const glm::vec3 all = found.flat + found.crest;
        const float bound = 0.3f + row.error_green / row.radiance.g;
        const float green = all.g / row.radiance.g, of_luminance = luminance(all) / luminance(row.radiance);
        for (const float ratio : {green, of_luminance})
            EXPECT_NEAR(ratio, 1, bound) << row.amplitude_m << " m, sun " << row.sun_deg << ", eye " << row.eye_deg
                                         << ", height " << row.height_m << " m";
        sum += std::log(of_luminance);
        thinnest_m = std::min(thinnest_m, row.thickness_m);
        thickest_m = std::max(thickest_m, row.thickness_m);
    }
    const double mean = std::exp(sum / static_cast<double>(rows.size()));
    std::printf("crests of %.1f to %.1f m: %.3f of the traced luminance\n", static_cast<double>(thinnest_m),
                static_cast<double>(thickest_m), mean);
    EXPECT_NEAR(mean, 1, 0.05);  // the fit's error is 2 %
    EXPECT_LT(thinnest_m, 1);
    EXPECT_GT(thickest_m, 20);
}

TEST_F(GlCrest, AddsNothingToAFlatSeaAndToFacesThatFaceTheSun) {
    for (const float sun_deg : {2.f, 10.f, 40.f, 89.f})
        for (const float eye_deg : {1.f, 10.f, 60.f, 90.f})
            for (const float slope : {0.f, 0.3f})
                EXPECT_EQ(light(crest_block(sun_deg, 2, 10), slope, eye_deg, 0.5f).crest, glm::vec3(0))
                    << sun_deg << ", " << eye_deg << ", " << slope;
}

// The traced waves are round. In the top fifth of a wave that is about to break, the lip is thin and
// full of bubbles: it passes at least twice the light of half its height, a requirement.
TEST_F(GlCrest, LipPassesTwiceTheLightOfHalfItsHeight) {
    for (const float amplitude_m : {0.5f, 1.5f, 4.f})
        for (const float sun_deg : {5.f, 10.f, 20.f, 40.f}) {
            const gl::SceneBlock block = crest_block(sun_deg, 4 * amplitude_m / std::numbers::sqrt2_v<float>, 1);
            const glm::vec3 lip = light(block, slope_at(0.9f), 10, 0.9f * amplitude_m, 1).crest;
            const glm::vec3 half = light(block, slope_at(0.5f), 10, 0.5f * amplitude_m, 0).crest;
            EXPECT_GE(lip.g, 2 * half.g) << amplitude_m << " m, sun " << sun_deg;
        }
}

TEST_F(GlCrest, IsProportionalToTheGain) {
    const glm::vec3 once = light(crest_block(20, 4, 1), -0.4f, 10, 1).crest;
    const glm::vec3 thrice = light(crest_block(20, 4, 3), -0.4f, 10, 1).crest;
    const glm::vec3 none = light(crest_block(20, 4, 0), -0.4f, 10, 1).crest;
    for (int c = 0; c < 3; ++c) {
        EXPECT_GT(once[c], 0);
        EXPECT_NEAR(thrice[c], 3 * once[c], 3e-3f * once[c]);  // halves have steps of 1e-3
        EXPECT_EQ(none[c], 0);
    }
}

}  // namespace
}  // namespace pelagic
