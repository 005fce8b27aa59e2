// Spray in images: the light of a ball equals closed forms, wind tears it to shreds, surfaces hide it,
// a depth texture makes it fade, and plumes stand on crests. Spindrift shortens the visibility.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "pelagic/gl/water/spray_image.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;
constexpr int spray_pixels = 128;
/// Looks up, past the sea, which is then not in the image.
const Camera upwards{.position_m = {3, 20, -5}, .target_m = {8, 120, -5}};

glm::dvec3 ahead_of(const Camera& camera, double distance_m) {
    return camera.position_m + distance_m * glm::normalize(camera.target_m - camera.position_m);
}

SprayDroplet droplet_at(const glm::dvec3& place, double radius_m, float opacity) {
    return {
        .x_m = place.x, .y_m = place.y, .z_m = place.z, .radius_m = static_cast<float>(radius_m), .opacity = opacity};
}

/// Radiance of a droplet in front of black, without a sea in the image.
class Sky {
   public:
    explicit Sky(double time_s = 0) : frame_(scene_.ocean.frame_at(time_s)) {}
    std::vector<float> image(const SprayDroplet& droplet, GLuint depth = 0, bool weighs = false) {
        scene_.spray = {.droplets = {&droplet, 1}, .scene_depth = depth};
        scene_.draw(upwards, frame_, false);
        if (!weighs) return scene_.target->read_radiance();
        const gl::Eye eye = gl::eye_of(upwards, {0, 0, spray_pixels, spray_pixels});
        scene_.target->clear();
        scene_.renderer->draw({.eyes = {&eye, 1},
                               .list = &scene_.pass->selection().list(),
                               .draws_sky = false,
                               .exposure = 2,
                               .weighs_samples = true,
                               .spray = scene_.spray});
        return scene_.target->read_radiance();
    }
    GlScene& scene() { return scene_; }

   private:
    GlScene scene_{{.preset = "calm",
                    .quality = "low",
                    .resolution = 64,
                    .width = spray_pixels,
                    .height = spray_pixels,
                    .samples = 0,
                    .writes = gl::PixelKind::radiance}};
    const Frame& frame_;
};

/// Pixels per metre at a distance.
double pixels_per_metre(double distance_m) {
    return 0.5 * spray_pixels / std::tan(0.5 * upwards.vertical_view_rad) / distance_m;
}

struct Green {
    double sum = 0, max = 0;
};
Green green_of(const std::vector<float>& image) {
    Green green;
    for (std::size_t i = 1; i < image.size(); i += 4) {
        green.sum += static_cast<double>(image[i]);
        green.max = std::max(green.max, static_cast<double>(image[i]));
    }
    return green;
}

/// Radiance of an opaque droplet: 35 % of sunlight by the phase function of Cornette and Shanks
/// 1992 with g = 0.76, 65 % equally in all directions, and skylight from the upper half and a tenth
/// of it from the sea. Air adds nothing over some metres.
double closed_form() {
    const gl::Sky& sky = test_sky();
    const glm::dvec3 ray = glm::normalize(upwards.target_m - upwards.position_m);
    const double cosine = glm::dot(ray, glm::dvec3(sky.sun_direction)), g = 0.76;
    const double phase = 3 / (8 * pi) * (1 - g * g) * (1 + cosine * cosine) /
                         ((2 + g * g) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    return static_cast<double>(sky.sun_irradiance.y) * (0.35 * phase + 0.65 / (4 * pi)) +
           static_cast<double>(sky.sky_irradiance.y) * 0.55 / pi;
}

// The opacity is (1 - q)^2 of that at the middle, q = (r / radius)^2, with the integral pi / 3
// radius^2. Pixels sample it to 1 % over a radius of 20 pixels; haze over 12 m and the nearest
// pixel's distance to the middle change it by less than 1 %.
TEST(GlSpray, HasTheLightOfTheClosedForm) {
    Sky sky;
    constexpr double distance_m = 12;
    const double radius_m = 20 / pixels_per_metre(distance_m);
    const Green green = green_of(sky.image(droplet_at(ahead_of(upwards, distance_m), radius_m, 0.5f)));
    EXPECT_NEAR(green.max, 0.5 * closed_form(), 0.02 * 0.5 * closed_form());
    EXPECT_NEAR(green.sum, pi / 3 * 20 * 20 * 0.5 * closed_form(), 0.03 * pi / 3 * 20 * 20 * 0.5 * closed_form());
}

// Motion blur spreads a droplet along its path of 1/40 s and conserves its light.
TEST(GlSpray, IsBlurredAlongItsMotion) {
    Sky sky;
    constexpr double distance_m = 12;
    const double radius_m = 8 / pixels_per_metre(distance_m);
    SprayDroplet droplet = droplet_at(ahead_of(upwards, distance_m), radius_m, 0.5f);
    const Green still = green_of(sky.image(droplet));
    droplet.velocity_z_mps = static_cast<float>(2 * radius_m * 40);  // a path of two radii
    const Green moving = green_of(sky.image(droplet));
    EXPECT_NEAR(moving.sum, still.sum, 0.03 * still.sum);
    EXPECT_NEAR(moving.max, still.max / 2, 0.03 * still.max);
}

// A droplet of a tenth of a pixel is drawn as 0.75 pixels wide with the same light. The mean over
// places within a pixel is exact, except for the few places that are drawn here.
TEST(GlSpray, KeepsItsLightWhereItIsSmallerThanAPixel) {
    Sky sky;
    constexpr double distance_m = 40;
    const double pixel_m = 1 / pixels_per_metre(distance_m), expected = pi / 3 * 0.1 * 0.1 * closed_form();
    const glm::dvec3 middle = ahead_of(upwards, distance_m), across(0, 0, pixel_m);
    const glm::dvec3 along = glm::cross(glm::normalize(upwards.target_m - upwards.position_m), across);
    double sum = 0;
    constexpr int places = 5;  // along both axes of a pixel
    for (int i = 0; i < places * places; ++i) {
        const glm::dvec3 place = middle + (i % places + 0.3) / places * across + (i / places + 0.3) / places * along;
        sum += green_of(sky.image(droplet_at(place, 0.1 * pixel_m, 1))).sum / (places * places);
    }
    EXPECT_NEAR(sum, expected, 0.1 * expected);
}

// With weighted samples a pixel's colour is its sum divided by the sum of the weights, which
// remains in alpha. An opaque middle is that of the droplet alone.
TEST(GlSpray, IsEqualWithWeightedSamples) {
    Sky sky;
    const double radius_m = 20 / pixels_per_metre(12);
    const std::vector<float> image = sky.image(droplet_at(ahead_of(upwards, 12), radius_m, 1), 0, true);
    const std::size_t middle = (std::size_t{spray_pixels} * spray_pixels / 2 + spray_pixels / 2) * 4;
    ASSERT_GT(image[middle + 3], 0);
    EXPECT_LT(image[middle + 3], 1);
    EXPECT_NEAR(image[middle + 1] / image[middle + 3], closed_form(), 0.02 * closed_form());
}

/// A droplet that has flown for half a second, to the right of the image, and its image.
SprayDroplet old_droplet(double age_s, float opacity) {
    SprayDroplet droplet = droplet_at(ahead_of(upwards, 12), 8 / pixels_per_metre(12), opacity);
    droplet.age_s = static_cast<float>(age_s);
    droplet.velocity_z_mps = 15;
    return droplet;
}

/// Moments of an image's green light.
struct Spread {
    double sum = 0, middle_x = 0, middle_y = 0, along = 0, across = 0;
};
Spread spread_of(const std::vector<float>& image) {
    Spread spread;
    const auto add = [&](auto of) {
        for (int y = 0; y < spray_pixels; ++y)
            for (int x = 0; x < spray_pixels; ++x)
                of(x, y, static_cast<double>(image[static_cast<std::size_t>(y * spray_pixels + x) * 4 + 1]));
    };
    add([&](int x, int y, double light) {
        spread.sum += light;
        spread.middle_x += x * light;
        spread.middle_y += y * light;
    });
    spread.middle_x /= spread.sum;
    spread.middle_y /= spread.sum;
    add([&](int x, int y, double light) {
        spread.along += light * (x - spread.middle_x) * (x - spread.middle_x) / spread.sum;
        spread.across += light * (y - spread.middle_y) * (y - spread.middle_y) / spread.sum;
    });
    return spread;
}

// The image of a disc, drawn out or not, is equal to itself after half a turn about its middle. In a
// shred a quarter of the light has no counterpart. A path of 15 m/s in 1/40 s alone lengthens a card of
// 1.3 m by a seventh.
TEST(GlSpray, IsTornAlongTheWindAfterHalfASecond) {
    Sky sky;
    for (const double age_s : {0.45, 0.5, 0.61}) {
        const std::vector<float> image = sky.image(old_droplet(age_s, 0.1f));
        const Spread spread = spread_of(image);
        ASSERT_GT(spread.sum, 0);
        EXPECT_GT(std::sqrt(spread.along / spread.across), 1.25) << age_s;
        double unmatched = 0;
        const int twice_x = static_cast<int>(std::lround(2 * spread.middle_x)),
                  twice_y = static_cast<int>(std::lround(2 * spread.middle_y));
        const auto at = [&](int x, int y) {
            const bool is_inside = std::min(x, y) >= 0 && std::max(x, y) < spray_pixels;
            return is_inside ? static_cast<double>(image[static_cast<std::size_t>(y * spray_pixels + x) * 4 + 1]) : 0;
        };
        for (int y = 0; y < spray_pixels; ++y)
            for (int x = 0; x < spray_pixels; ++x) unmatched += std::max(at(x, y) - at(twice_x - x, twice_y - y), 0.);
        EXPECT_GT(unmatched / spread.sum, 0.25) << age_s;
    }
}

// 10 ms later a droplet is the same shred, and another droplet is another. Both ages are beyond the
// quarter of a second in which it is torn.
TEST(GlSpray, KeepsItsShredWhileItFlies) {
    Sky now, later(0.01);
    const auto change = [&](double age_s) {
        const std::vector<float> a = now.image(old_droplet(0.5, 0.1f)), b = later.image(old_droplet(age_s, 0.1f));
        double sum = 0;
        for (std::size_t i = 1; i < a.size(); i += 4) sum += std::abs(static_cast<double>(a[i] - b[i]));
        return sum / green_of(a).sum;
    };
    EXPECT_LT(change(0.51), 0.02);
    EXPECT_GT(change(0.5123), 0.2);
}

// A shred has the light of a ball: pi / 12 of the square. Bytes round by 1/510 at most, which is 1.5 %
// of the mean of half of pi / 12, and less on average.
TEST(GlSpray, ShredsHaveTheMeanOfABallAndNoRim) {
    const gl::SprayImage image = gl::make_spray_image();
    constexpr int side = gl::SprayImage::side;
    for (int layer = 0; layer < gl::SprayImage::layers; ++layer) {
        const std::uint8_t* const texels = image.level(0) + static_cast<std::ptrdiff_t>(layer) * side * side;
        double sum = 0;
        for (int i = 0; i < side * side; ++i) {
            const double texel = static_cast<double>(gl::SprayImage::scale) * texels[i] / 255;
            sum += texel;
            const int x = i % side, y = i / side;
            if (std::min(x, y) == 0 || std::max(x, y) == side - 1) {
                EXPECT_EQ(texel, 0) << x << ", " << y;
            }
        }
        EXPECT_NEAR(sum / (side * side), pi / 12, 0.015 * pi / 12) << layer;
    }
}

// A black droplet ahead shows the air before it: the sky's colour at the horizon times 1 - T. With
// contrast falling to 2 % (Koschmieder 1924), the visibility 2 m above the sea is moderate (2 to 5
// nautical miles) in Beaufort 9, poor (1 km to 2 nautical miles) in 10 and 11, and very poor in 12, by
// the terms of the Met Office's marine forecasts. From 60 m it is at least twice that.
TEST(GlSpray, SpindriftShortensTheVisibilityNearTheSurfaceFromBeaufort9On) {
    const auto visibility_m = [](std::string_view preset, double height_m) {
        GlScene scene({.preset = preset,
                       .quality = "low",
                       .width = 16,
                       .height = 16,
                       .samples = 0,
                       .writes = gl::PixelKind::radiance,
                       .shading = gl::Shading::headset,
                       .lens_may_dip = true});
        gl::Sky sky = even_sky(1);
        sky.sun_direction = {0, 1, 0};
        scene.renderer->set_sky(sky);
        const Frame& frame = scene.ocean.frame_at(0);
        // over a trough, so that no wave hides the droplet, which is larger than the view
        std::array<double, 200> x, z{};
        std::array<float, 200> water_m;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = 2 * static_cast<double>(i);
        SurfaceQuery(frame).sample({x, z}, {.height_m = water_m});
        const double lowest_x_m =
            x[static_cast<std::size_t>(std::min_element(water_m.begin(), water_m.end()) - water_m.begin())];
        constexpr double distance_m = 3;
        const Camera camera{.position_m = {lowest_x_m, height_m, 0}, .target_m = {lowest_x_m + 1, height_m, 0}};
        const SprayDroplet droplet = droplet_at(ahead_of(camera, distance_m), 400, 1);
        scene.spray.droplets = {&droplet, 1};
        scene.draw(camera, frame, false);
        const double seen = static_cast<double>(scene.target->read_radiance()[(8 * 16 + 8) * 4 + 1]);
        return -std::log(0.02) * distance_m / -std::log(1 - seen);
    };
    constexpr double mile_m = 1852;
    const double haze_m = visibility_m("beaufort-8", 2);
    EXPECT_GT(haze_m, 5 * mile_m);
    EXPECT_NEAR(visibility_m("calm", 2) / haze_m, 1, 0.01) << "no spindrift below";
    const double nine = visibility_m("beaufort-9", 2), ten = visibility_m("beaufort-10", 2),
                 eleven = visibility_m("beaufort-11", 2), twelve = visibility_m("beaufort-12", 2);
    EXPECT_LT(nine, 5 * mile_m);
    EXPECT_GT(nine, 2 * mile_m);
    EXPECT_LT(ten, 2 * mile_m);
    EXPECT_GT(eleven, 1000);
    EXPECT_LT(eleven, ten);
    EXPECT_LT(twelve, 1000);
    EXPECT_GT(visibility_m("beaufort-10", 60), 2 * ten);
}

/// A connected patch of breaking water.
using Crest = std::vector<glm::dvec3>;

/// Finds patches of at least 3 m^2 in a grid of 1 m, within 8 to 150 m and the view of a camera.
std::vector<Crest> breaking_crests(const Frame& frame, const Camera& camera, double horizontal_view_rad,
                                   std::vector<float>& height_m) {
    constexpr int side = 300, half = side / 2;
    std::vector<double> x, z;
    for (int i = 0; i < side * side; ++i) {
        x.push_back(i % side - half + 0.5);
        z.push_back(i / side - half + 0.5);
    }
    height_m.resize(x.size());
    std::vector<float> foam(x.size());
    SurfaceQuery(frame).sample({x, z}, {.height_m = height_m, .foam = foam});
    const glm::dvec3 to_target = camera.target_m - camera.position_m;
    const double middle_rad = std::atan2(to_target.z, to_target.x);
    std::vector<bool> waits(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double away_m = std::hypot(x[i], z[i]);
        // Foam of 1 is breaking now (snapshot_foam.hpp).
        waits[i] = foam[i] >= 0.95f && away_m > 8 && away_m < 150 &&
                   std::abs(std::remainder(std::atan2(z[i], x[i]) - middle_rad, 2 * pi)) < horizontal_view_rad / 2;
    }
    std::vector<Crest> crests;
    for (int first = 0; first < side * side; ++first) {
        Crest crest;
        std::vector<int> open = {first};
        while (!open.empty()) {
            const int i = open.back();
            open.pop_back();
            if (i < 0 || i >= side * side || !waits[static_cast<std::size_t>(i)]) continue;
            const auto at = static_cast<std::size_t>(i);
            waits[at] = false;
            crest.emplace_back(x[at], height_m[at], z[at]);
            // The grid's rim is more than 150 m away at its ends only, and waits nowhere else.
            for (const int step : {-side - 1, -side, -side + 1, -1, 1, side - 1, side, side + 1})
                open.push_back(i + step);
        }
        if (crest.size() >= 3) crests.push_back(crest);
    }
    return crests;
}

// From 10 m above the water, of the crests whose view no nearer wave hides. A plume is a column of
// pixels as high as 0.5 m there, within 2 m above the crest, that spray changes by 0.3 stops. 11 % had
// one when only droplets within 80 m were drawn, as discs of their own size.
TEST(GlSpray, StandsOnAQuarterOfTheBreakingCrestsAtBeaufort10) {
    constexpr int width = 480, height = 270;
    GlScene scene({.preset = "beaufort-10",
                   .quality = "low",
                   .width = width,
                   .height = height,
                   .samples = 0,
                   .writes = gl::PixelKind::radiance,
                   .shading = gl::Shading::headset,
                   .foam = true,
                   .lens_may_dip = true});
    constexpr double time_s = 20;
    Ocean air(sea_named("beaufort-10"), {.spray = gl::drawn_spray});
    const Frame& frame = scene.ocean.frame_at(time_s);
    std::vector<float> height_m;
    Camera camera{.position_m = {0, 10, 0}, .target_m = {60, 6, 60}};
    const double horizontal_rad = 2 * std::atan(std::tan(camera.vertical_view_rad / 2) * width / height);
    const std::vector<Crest> crests = breaking_crests(frame, camera, 0.95 * horizontal_rad, height_m);
    const auto water_m = [&](double x_m, double z_m) {
        const int column = static_cast<int>(std::floor(x_m)) + 150, row = static_cast<int>(std::floor(z_m)) + 150;
        return static_cast<double>(height_m[static_cast<std::size_t>(row * 300 + column)]);
    };
    const double below_eye_m = water_m(0, 0);
    camera.position_m.y += below_eye_m;
    camera.target_m.y += below_eye_m;
    const auto light = [&](std::span<const SprayDroplet> droplets) {
        scene.spray.droplets = droplets;
        scene.draw(camera, frame);
        return scene.target->read_radiance();
    };
    const auto droplets = air.frame_at(time_s).droplets;
    EXPECT_LE(droplets.size(), 8192u);
    const std::vector<float> with = light(droplets), without = light({});
    const gl::Eye eye = gl::eye_of(camera, {0, 0, width, height});
    /// Returns column and row of a point, from the top left.
    const auto pixel_of = [&](const glm::dvec3& point) {
        const glm::dvec4 clip = eye.clip_from_world * glm::dvec4(point, 1);
        return glm::dvec2(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w) * glm::dvec2(width, height);
    };
    const auto is_hidden = [&](const glm::dvec3& point) {
        for (int step = 1; step < 60; ++step) {
            const glm::dvec3 at = glm::mix(camera.position_m, point + glm::dvec3(0, 0.3, 0), 0.97 * step / 60);
            if (water_m(at.x, at.z) > at.y) return true;
        }
        return false;
    };
    const auto has_plume = [&](const glm::dvec3& point) {
        const glm::dvec2 low = pixel_of(point), high = pixel_of(point + glm::dvec3(0, 0.5, 0));
        const int column = static_cast<int>(low.x), needed = static_cast<int>(std::ceil(low.y - high.y));
        if (column < 0 || column >= width) return false;
        int found = 0;
        for (int row = static_cast<int>(low.y); row >= low.y - 4 * (low.y - high.y) && found < needed; --row) {
            if (row < 0 || row >= height) return false;
            // Rows of the image begin at the top.
            const std::size_t at = static_cast<std::size_t>(row * width + column) * 4 + 1;
            found = std::abs(std::log2(with[at] / without[at])) >= 0.3f ? found + 1 : 0;
        }
        return found >= needed;
    };
    int visible = 0, plumes = 0;
    for (const Crest& crest : crests) {
        bool is_visible = false, carries = false;
        for (const glm::dvec3& point : crest)
            if (!is_hidden(point)) {
                is_visible = true;
                carries = carries || has_plume(point);
            }
        visible += is_visible;
        plumes += is_visible && carries;
    }
    RecordProperty("visible", visible);
    RecordProperty("plumes", plumes);
    EXPECT_GE(visible, 20);
    EXPECT_GE(plumes, 0.25 * visible) << visible;
}

TEST(GlSpray, IsHiddenBelowTheWater) {
    GlScene scene({.preset = "calm",
                   .quality = "low",
                   .resolution = 64,
                   .width = spray_pixels,
                   .height = spray_pixels,
                   .samples = 0});
    const Camera camera{.position_m = {0, 6, 0}, .target_m = {10, 0, 0}};
    const Frame& frame = scene.ocean.frame_at(0);
    const std::vector<std::uint8_t> without = scene.image(camera, frame);
    const auto with = [&](double y_m) {
        const SprayDroplet droplet = droplet_at({10, y_m, 0}, 0.5, 0.8f);
        scene.spray.droplets = {&droplet, 1};
        return scene.image(camera, frame);
    };
    EXPECT_EQ(with(-3), without);
    EXPECT_NE(with(1), without);
}

/// A depth texture that shows a plane at a distance from the eye.
class Plane {
   public:
    Plane(const gl::Functions& gl, const gl::Eye& eye, const glm::dvec3& place) : texture(gl) {
        const glm::dvec4 clip = eye.clip_from_world * glm::dvec4(place, 1);
        const auto depth = static_cast<std::uint32_t>((0.5 + 0.5 * clip.z / clip.w) * 4294967295.0);
        const std::array<std::uint32_t, 4> texels = {depth, depth, depth, depth};
        gl.BindTexture(GL_TEXTURE_2D, texture.name());
        gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT24, 2, 2);
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 2, 2, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, texels.data());
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    gl::Texture texture;
};

// A droplet whose middle is in a surface shows half of its light, and one that is a radius in front
// of it shows all. Depths of 24 bits resolve 1e-3 m at 12 m, where the radius is about 2 m.
TEST(GlSpray, FadesAtTheSurfacesOfADepthTexture) {
    Sky sky;
    const gl::Eye eye = gl::eye_of(upwards, {0, 0, spray_pixels, spray_pixels});
    const double radius_m = 20 / pixels_per_metre(12);
    const SprayDroplet droplet = droplet_at(ahead_of(upwards, 12), radius_m, 0.5f);
    const double all = green_of(sky.image(droplet)).sum;
    const auto light_before = [&](double surface_m) {
        const Plane plane(sky.scene().gl(), eye, ahead_of(upwards, surface_m));
        return green_of(sky.image(droplet, plane.texture.name())).sum / all;
    };
    EXPECT_NEAR(light_before(12 + 1.05 * radius_m), 1, 0.01);
    EXPECT_NEAR(light_before(12), 0.5, 0.01);
    EXPECT_NEAR(light_before(12 - 1.05 * radius_m), 0, 0.01);
}

}  // namespace
}  // namespace pelagic
