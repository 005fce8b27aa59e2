// The display pass and the light meter on images whose pixels are all known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <thread>
#include <vector>

#include "pelagic/gl/display.hpp"
#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/light_meter.hpp"

namespace pelagic {
namespace {

/// An exposure so bright that night vision does not contribute.
constexpr float daylight = gl::sun_illuminance_lx;

class DisplayTest : public testing::Test {
   protected:
    /// Creates a texture of grey radiance, by column and row from below.
    gl::TexturePart image(int width, int height, const std::function<float(int, int)>& radiance) {
        std::vector<float> rgba;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float value = radiance(x, y);
                rgba.insert(rgba.end(), {value, value, value, 1});
            }
        textures_.emplace_back(gl_);
        gl_.BindTexture(GL_TEXTURE_2D, textures_.back().name());
        gl_.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA16F, width, height);
        gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, rgba.data());
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        return {textures_.back().name(), width, height, width, height};
    }
    /// Returns the red channel of each pixel, the upper row first.
    std::vector<std::uint8_t> shown(const gl::TexturePart& radiance, const gl::Look& look, int width, int height) {
        gl::RenderTarget screen(gl_, width, height, 0);
        display_.show(radiance, look, {0, 0, width, height});
        std::vector<std::uint8_t> red;
        const auto rgba = screen.read();
        for (std::size_t i = 0; i < rgba.size(); i += 4) red.push_back(rgba[i]);
        return red;
    }
    /// Returns the sum of the light on a half-float screen, with the tone curve inverted.
    double light_shown(const gl::TexturePart& radiance, float bloom) {
        gl::RenderTarget screen(gl_, radiance.width, radiance.height, 0, gl::PixelKind::radiance);
        display_.show(radiance, {.bloom = bloom, .framebuffer_is_srgb = true},
                      {0, 0, radiance.width, radiance.height});
        double sum = 0;
        const auto rgba = screen.read_radiance();
        for (std::size_t i = 0; i < rgba.size(); i += 4) sum += static_cast<double>(gl::film_input_of(rgba[i]));
        return sum;
    }

    gl::HeadlessContext context_;
    const gl::Functions& gl_ = context_.functions();
    gl::Display display_{gl_};
    gl::LightMeter meter_{gl_};
    std::vector<gl::Texture> textures_;
};

double encoded(double linear) {
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

TEST_F(DisplayTest, ShowsTheFilmCurveInSrgb) {
    // One stop a column, from far below to far above white.
    const auto at = [](int x) { return static_cast<float>(std::exp2(x - 10)); };
    const auto pixels = shown(image(18, 1, [&](int x, int) { return at(x); }), {.exposure = 0.5f}, 18, 1);
    for (int x = 0; x < 18; ++x) {
        // The tolerance is half a step of rounding and half a step of dithering. The curve's
        // matrices are rounded to 5 digits.
        EXPECT_NEAR(pixels[static_cast<std::size_t>(x)],
                    encoded(static_cast<double>(gl::shown_by_film(0.5f * at(x)))), 1.1)
            << x;
        if (x > 0) {
            EXPECT_GE(pixels[static_cast<std::size_t>(x)], pixels[static_cast<std::size_t>(x - 1)]);
        }
    }
}

// A gradient of three 8-bit steps over 240 pixels. Without dithering it shows four bands; with
// dithering each column's mean follows the gradient.
TEST_F(DisplayTest, DitheringLeavesNoBands) {
    constexpr int width = 240, height = 256;
    const auto slope = [](int x) {
        return 0.11f * (1 + 0.1f * static_cast<float>(x) / width);  // about 66 to 69 of 255
    };
    const auto pixels = shown(image(width, height, [&](int x, int) { return slope(x); }), {}, width, height);
    double worst = 0, worst_undithered = 0;
    for (int x = 0; x < width; ++x) {
        double mean = 0;
        for (int y = 0; y < height; ++y) mean += pixels[static_cast<std::size_t>(y * width + x)];
        mean /= height;
        // Half floats are rounded to 1/2048.
        const double meant = encoded(static_cast<double>(gl::shown_by_film(slope(x))));
        worst = std::max(worst, std::abs(mean - meant));
        worst_undithered = std::max(worst_undithered, std::abs(std::round(meant) - meant));
    }
    EXPECT_GT(worst_undithered, 0.45);
    // Rounding of half floats is 0.04 of a step there, 256 samples of uniform noise 0.02; the rest
    // is rounding inside the curve.
    EXPECT_LT(worst, 0.12);
}

TEST_F(DisplayTest, BloomConservesLight) {
    const auto grey = image(96, 64, [](int, int) { return 0.2f; });
    EXPECT_NEAR(light_shown(grey, 1) / light_shown(grey, 0), 1, 2e-3);
    // A bright square in the dark, so far from the borders that little light spreads beyond them.
    const auto lamp =
        image(256, 256, [](int x, int y) { return std::abs(x - 128) < 4 && std::abs(y - 128) < 4 ? 8.f : 0.01f; });
    const double all = light_shown(lamp, 0);
    // The widest level reaches the border; light that would leave the image returns into it.
    EXPECT_NEAR(light_shown(lamp, 1) / all, 1, 0.03);
    const auto sharp = shown(lamp, {}, 256, 256), soft = shown(lamp, {.bloom = 0.5f}, 256, 256);
    EXPECT_GT(soft[128 * 256 + 138], sharp[128 * 256 + 138] + 5);
}

TEST_F(DisplayTest, NightVisionIsBlueInTheDarkAndOffByDay) {
    gl::RenderTarget screen(gl_, 1, 1, 0);
    const auto grey = image(1, 1, [](int, int) { return 0.3f; });
    const auto rgb = [&](float luminance_of_unit) {
        screen.bind();
        display_.show(grey, {.luminance_of_unit = luminance_of_unit}, {0, 0, 1, 1});
        return screen.read();
    };
    const auto day = rgb(daylight), night = rgb(1e-3f);
    EXPECT_NEAR(day[0], day[2], 1);
    EXPECT_GT(night[2], night[0] + 5);
}

// Any region of the texture may be used, and texels outside it must not contribute.
TEST_F(DisplayTest, ShowsOnlyTheUsedRegion) {
    gl::TexturePart part = image(64, 64, [](int x, int y) { return x < 33 && y < 21 ? 0.2f : 900.f; });
    part.width = 33;
    part.height = 21;
    const auto alone = image(33, 21, [](int, int) { return 0.2f; });
    EXPECT_EQ(shown(part, {.bloom = 0.5f}, 100, 50), shown(alone, {.bloom = 0.5f}, 100, 50));
    for (const gl::MeteredCell& cell : meter_.measure(part)) EXPECT_NEAR(cell.log2_of_mean, std::log2(0.2f), 1e-2);
}

TEST_F(DisplayTest, MeterMeasuresEachCellOfTheImage) {
    // The left half is dark and the right half bright. In the upper half the columns alternate, and
    // a cell of several columns averages them.
    const auto radiance = [](int x, int y) { return y >= 144 ? (x % 2 ? 1.f : 4.f) : x < 256 ? 0.25f : 2.f; };
    const auto cells = meter_.measure(image(512, 288, radiance));
    ASSERT_EQ(cells.size(), static_cast<std::size_t>(gl::LightMeter::columns * gl::LightMeter::rows));
    const auto cell = [&](int x, int y) { return cells[static_cast<std::size_t>(y * gl::LightMeter::columns + x)]; };
    // A half float of a logarithm near 1 has a precision of 1e-3.
    EXPECT_NEAR(cell(3, 3).mean_of_log2, -2, 2e-3);
    EXPECT_NEAR(cell(120, 3).log2_of_mean, 1, 2e-3);
    EXPECT_NEAR(cell(60, 60).log2_of_mean, std::log2(2.5f), 2e-3);
}

TEST_F(DisplayTest, NonBlockingMeterGivesTheSameValues) {
    const auto picked = image(200, 100, [](int x, int y) { return 0.01f * static_cast<float>(x + y + 1); });
    const auto waited = meter_.measure(picked);
    EXPECT_FALSE(meter_.finished());
    meter_.start(picked);
    std::optional<std::vector<gl::MeteredCell>> seen;
    for (int i = 0; i < 6000 && !seen; ++i) {
        seen = meter_.finished();
        if (!seen) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(seen);
    for (std::size_t i = 0; i < waited.size(); ++i) EXPECT_EQ((*seen)[i].mean_of_log2, waited[i].mean_of_log2);
    EXPECT_FALSE(meter_.finished());
}

}  // namespace
}  // namespace pelagic
