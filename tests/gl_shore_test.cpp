// A shore in images: the water has the heights that sim/shore_surface.hpp defines. The cascades are
// attenuated only there, foam comes with the shore's waves, and sand is dark up to the reach of the
// waves. The shores are built by hand, to contain values that are rare in a real one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/packing.hpp>
#include <numbers>
#include <vector>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/gl_scene.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

/// Texels of a shore; change them before the call of view().
struct HandmadeShore {
    HandmadeShore(glm::dvec2 corner_m, int wide, int high, double texel)
        : corner(corner_m), columns(wide), rows(high), texel_m(texel) {
        const std::size_t texels = static_cast<std::size_t>(wide * high);
        depth_m.assign(texels, 10);
        height_m.assign(texels, 0);
        vertical_velocity_mps.assign(texels, 0);
        reach_m.assign(texels, 0);
        weights_rgba8.assign(texels, 0xFFFFFFFFu);
        foam.assign(texels, 0);
    }

    /// Calls what(texel, x, z, part) for each texel; part rises smoothly from 0 on the edges to 1
    /// at `fade_m` inside.
    template <class What>
    void each(double fade_m, const What& what) {
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const int in = std::min({i, j, columns - 1 - i, rows - 1 - j});
                const double part = std::min(in * texel_m / fade_m, 1.0);
                what(static_cast<std::size_t>(j * columns + i), corner.x + i * texel_m, corner.y + j * texel_m,
                     part * part * (3 - 2 * part));
            }
    }

    ShoreSurface view() const {
        const auto [min, max] = std::minmax_element(height_m.begin(), height_m.end());
        return {.columns = columns,
                .rows = rows,
                .texel_m = texel_m,
                .x_m = corner.x,
                .z_m = corner.y,
                .depth_m = depth_m,
                .weights_rgba8 = weights_rgba8,
                .height_m = height_m,
                .vertical_velocity_mps = vertical_velocity_mps,
                .potential_m2ps = vertical_velocity_mps,
                .reach_m = reach_m,
                .foam = foam,
                .bounds = {.height_min_m = *min, .height_max_m = *max}};
    }

    glm::dvec2 corner;
    int columns, rows;
    double texel_m;
    std::vector<float> depth_m, height_m, vertical_velocity_mps, reach_m;
    std::vector<std::uint32_t> weights_rgba8;
    std::vector<std::uint8_t> foam;
};

/// Interpolates bilinearly, as the definition does; returns `beyond` outside.
template <class Texel>
double between(const ShoreSurface& shore, double x, double z, double beyond, const Texel& texel) {
    const double u = (x - shore.x_m) / shore.texel_m, v = (z - shore.z_m) / shore.texel_m;
    if (!(u >= 0 && v >= 0 && u <= shore.columns - 1 && v <= shore.rows - 1)) return beyond;
    const int i = std::min(static_cast<int>(u), shore.columns - 2), j = std::min(static_cast<int>(v), shore.rows - 2);
    const auto at = [&](int column, int row) {
        return texel(static_cast<std::size_t>(row * shore.columns + column));
    };
    return std::lerp(std::lerp(at(i, j), at(i + 1, j), u - i), std::lerp(at(i, j + 1), at(i + 1, j + 1), u - i),
                     v - j);
}

/// Solves the definition: returns the height of the water that is drawn at a position of the world.
double height_drawn_at(const Frame& frame, double x, double z) {
    const ShoreSurface& shore = frame.shore;
    double parts[4];
    for (std::size_t cascade = 0; cascade < 4; ++cascade)
        parts[cascade] = between(shore, x, z, 1.0, [&](std::size_t texel) {
            return static_cast<double>(shore.weights_rgba8[texel] >> 8 * cascade & 255) / 255;
        });
    double reference_x = x, reference_z = z;
    for (int step = 0; step < 60; ++step) {
        double dx = 0, dz = 0;
        for (std::size_t cascade = 0; cascade < frame.cascades.size(); ++cascade) {
            const Displacement way = displacement_of(frame.cascades[cascade], reference_x, reference_z);
            dx += parts[cascade] * way.dx;
            dz += parts[cascade] * way.dz;
        }
        reference_x += 0.7 * (x - dx - reference_x);
        reference_z += 0.7 * (z - dz - reference_z);
    }
    double height = sample(shore, x, z).height_m;
    for (std::size_t cascade = 0; cascade < frame.cascades.size(); ++cascade)
        height += parts[cascade] * displacement_of(frame.cascades[cascade], reference_x, reference_z).height;
    return height;
}

/// A square seen from above through parallel rays, x to the right and z down; points higher than
/// top_m are before the near plane.
struct SquareFromAbove {
    glm::dvec2 middle{};
    double half_m = 20;
    int pixels = 64;

    gl::Eye eye(double top_m) const {
        constexpr double deep_m = 50;
        glm::dmat4 m(0);
        m[0][0] = 1 / half_m;
        m[2][1] = -1 / half_m;
        m[1][2] = -2 / deep_m;
        m[3] = {-middle.x / half_m, middle.y / half_m, 2 * top_m / deep_m - 1, 1};
        return {.clip_from_world = m, .position_m = {middle.x, 30, middle.y}, .viewport = {0, 0, pixels, pixels}};
    }
    double x(int column) const { return middle.x + ((column + 0.5) / pixels * 2 - 1) * half_m; }
    double z(int row) const { return middle.y + ((row + 0.5) / pixels * 2 - 1) * half_m; }
};

class GlShore : public testing::Test {
   protected:
    void draw(GlScene& scene, const SquareFromAbove& square, double top_m = 20) {
        const glm::dvec3 viewer(square.middle.x, 1, square.middle.y);
        const gl::Eye eye = square.eye(top_m);
        const DrawList& list = scene.selection.select(
            {.viewer_m = viewer, .views = {&eye.clip_from_world, 1}, .bounds = {-20, 20, 20, 20}});
        scene.target->clear({1, 0, 1});
        scene.renderer->draw({.eyes = {&eye, 1}, .viewer_m = viewer, .list = &list, .draws_sky = false});
    }
    std::vector<std::uint8_t> image(GlScene& scene, const SquareFromAbove& square) {
        draw(scene, square);
        return scene.target->read();
    }
    /// Returns the difference between the given heights and those of the pixels, found with near
    /// planes that clip what is higher.
    struct Heights {
        double mean_m = 0, worst_m = 0, step_m = 0;
    };
    Heights heights_beside(GlScene& scene, const SquareFromAbove& square, int cuts,
                           const std::vector<double>& exact) {
        const auto [min, max] = std::minmax_element(exact.begin(), exact.end());
        Heights off{.step_m = (*max - *min) / cuts};
        std::vector<double> drawn(exact.size(), *min);
        for (int cut = 0; cut < cuts; ++cut) {
            const double top_m = *min + (cut + 0.5) * off.step_m;
            draw(scene, square, top_m);
            const std::vector<std::uint8_t> rgba = scene.target->read();
            for (std::size_t i = 0; i < drawn.size(); ++i)
                if (rgba[4 * i] == 255 && rgba[4 * i + 1] == 0 && rgba[4 * i + 2] == 255)
                    drawn[i] = top_m + 0.5 * off.step_m;
        }
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            const double difference = std::abs(drawn[i] - exact[i]);
            off.mean_m += difference / static_cast<double>(drawn.size());
            off.worst_m = std::max(off.worst_m, difference);
        }
        std::printf("heights over %.2f m: %.4f m off in the mean, %.3f m at most, of cuts %.3f m apart\n",
                    *max - *min, off.mean_m, off.worst_m, off.step_m);
        return off;
    }
    static GlScene::Options options(int pixels) {
        return {.preset = "storm",
                .quality = "low",
                .resolution = 128,
                .width = pixels,
                .height = pixels,
                .samples = 0,
                .size_m = 1024};
    }
};

/// Returns a frame with four copies of its coarsest cascade, of different sides and rotations. Each
/// is large enough to be visible in the sum, and smooth from vertex to vertex.
class FourLargeCascades {
   public:
    explicit FourLargeCascades(const Frame& of) : frame(of), cascades_(4, of.cascades[0]) {
        for (std::size_t i = 0; i < cascades_.size(); ++i) {
            const double turn = 0.7 * static_cast<double>(i);
            cascades_[i].grid = {1100 + 170.0 * static_cast<double>(i), std::cos(turn), std::sin(turn)};
        }
        frame.cascades = cascades_;
    }
    Frame frame;

   private:
    std::vector<Cascade> cascades_;
};

// Compares the heights of pixels with the definition's: far from the origin, over an edge of the
// rectangle, with weights that vary inside it.
TEST_F(GlShore, WaterHasTheHeightsOfTheDefinition) {
    constexpr int pixels = 40, cuts = 100;
    GlScene scene(options(pixels));
    const glm::dvec2 corner(1e6 + 3.7, -2e6 - 11.2);
    HandmadeShore shore(corner, 36, 30, 8);
    shore.each(32, [&](std::size_t texel, double x, double z, double part) {
        shore.height_m[texel] =
            static_cast<float>(part * std::sin(2 * pi * (x - corner.x) / 90 + (z - corner.y) / 30));
        shore.weights_rgba8[texel] = 0;
        for (std::uint32_t cascade = 0; cascade < 4; ++cascade)
            shore.weights_rgba8[texel] |= static_cast<std::uint32_t>(std::lround(255 * (1 - part / (1 + cascade))))
                                          << 8 * cascade;
    });
    FourLargeCascades large(scene.ocean.frame_at(3));
    large.frame.shore = shore.view();
    scene.renderer->upload(large.frame);
    for (const glm::dvec2 from_corner : {glm::dvec2(130, 110), glm::dvec2(10, 60)}) {
        const SquareFromAbove square{.middle = corner + from_corner, .half_m = 40, .pixels = pixels};
        const Heights off = heights_beside(scene, square, cuts, [&] {
            std::vector<double> exact;
            for (int row = 0; row < pixels; ++row)
                for (int column = 0; column < pixels; ++column)
                    exact.push_back(height_drawn_at(large.frame, square.x(column), square.z(row)));
            return exact;
        }());
        // Clipping alone gives a quarter of a step; triangles between bilinear texels give the
        // rest.
        EXPECT_LT(off.mean_m, 0.75 * off.step_m);
    }
}

// A dynamic-wave grid adds to a shore as it adds to the open sea.
TEST_F(GlShore, DynamicWavesAddToIt) {
    constexpr int pixels = 40, cuts = 60, side = 64;
    GlScene scene(options(pixels));
    HandmadeShore shore({300, -400}, 36, 30, 8);
    shore.each(60, [&](std::size_t texel, double x, double z, double part) {
        shore.height_m[texel] = static_cast<float>(part * std::sin(x / 15 + z / 30));
        shore.weights_rgba8[texel] = static_cast<std::uint32_t>(std::lround(255 * (1 - part))) * 0x01010101u;
    });
    const SquareFromAbove square{.middle = {450, -290}, .half_m = 40, .pixels = pixels};
    FourLargeCascades large(scene.ocean.frame_at(3));
    large.frame.shore = shore.view();
    DynamicWavesView& dynamic_waves = large.frame.dynamic_waves;
    std::vector<float> heights(side * side), rises(heights.size());
    std::vector<std::uint8_t> foam(heights.size());
    dynamic_waves = {.resolution = side,
                     .texel_m = 2,
                     .first_x = 450 / 2 - side / 2,
                     .first_z = -290 / 2 - side / 2,
                     .height_m = heights,
                     .vertical_velocity_mps = rises,
                     .foam = foam,
                     .bounds = {.height_max_m = 3}};
    for (std::int64_t z = dynamic_waves.first_z; z < dynamic_waves.first_z + side; ++z)
        for (std::int64_t x = dynamic_waves.first_x; x < dynamic_waves.first_x + side; ++x) {
            const double from_x = static_cast<double>(2 * x) - 440, from_z = static_cast<double>(2 * z) + 300;
            heights[static_cast<std::size_t>((z & (side - 1)) * side + (x & (side - 1)))] =
                static_cast<float>(3 * std::exp(-(from_x * from_x + from_z * from_z) / 200));
        }
    scene.renderer->upload(large.frame);
    std::vector<double> exact;
    for (int row = 0; row < pixels; ++row)
        for (int column = 0; column < pixels; ++column)
            exact.push_back(height_drawn_at(large.frame, square.x(column), square.z(row)) +
                            sample(dynamic_waves, square.x(column), square.z(row)).height_m);
    const Heights off = heights_beside(scene, square, cuts, exact);
    EXPECT_LT(off.mean_m, 0.75 * off.step_m);
}

// Compares a shore that an ocean computed with the queries, on a beach with runup and in the open
// sea.
TEST_F(GlShore, WaterHasTheQueriedHeights) {
    constexpr int pixels = 40, cuts = 60;
    GlScene::Options moderate = options(pixels);
    moderate.preset = "moderate";
    moderate.resolution = 64;
    moderate.quality = "high";
    GlScene scene(moderate);
    ShoreOptions shore = beach(600, 400, 8, 100, 5);
    shore.corner_x_m = 2000;
    shore.corner_z_m = -700;
    shore.resolution = 128;
    Ocean ocean(sea_named("moderate", 64), {.queries = true, .slopes = true, .shore = shore});
    ASSERT_EQ(ocean.cascade_count(), scene.ocean.cascade_count());
    const Frame& frame = ocean.frame_at(12);
    scene.renderer->upload(frame);
    const SurfaceQuery query(frame);
    std::array<Heights, 2> off;
    for (const double from_corner : {350.0, -300.0}) {
        const SquareFromAbove square{.middle = {2000 + from_corner, -500}, .half_m = 20, .pixels = pixels};
        std::vector<double> x, z;
        for (int row = 0; row < pixels; ++row)
            for (int column = 0; column < pixels; ++column) {
                x.push_back(square.x(column));
                z.push_back(square.z(row));
            }
        std::vector<float> heights(x.size());
        query.sample({x, z}, {.height_m = heights});
        off[from_corner < 0] = heights_beside(scene, square, cuts, {heights.begin(), heights.end()});
    }
    // Waves of a texel or two are shorter than the spacing of vertices, at a shore as elsewhere.
    EXPECT_LT(off[1].mean_m, 0.03);
    EXPECT_LT(off[0].mean_m, 1.3 * off[1].mean_m);
}

/// Returns the frame without the waves and the foam of a cascade.
class WithoutCascade {
   public:
    WithoutCascade(const Frame& of, std::size_t missing)
        : frame(of),
          cascades_(of.cascades.begin(), of.cascades.end()),
          halves_(of.cascades[0].displacement_rgba16f.size()),
          slopes_(of.cascades[0].slopes_rgba8.size(), 0x80808080u),
          moments_(slopes_.size(), 0x80000080u) {
        Cascade& cascade = cascades_[missing];
        cascade.displacement_rgba16f = halves_;
        cascade.slopes_rgba8 = slopes_;
        cascade.moments_rgba8 = moments_;
        cascade.compression_scale = 0;
        cascade.snapshots_rgba8 = {};
        cascade.snapshots_version = {};
        cascade.slope_variance = 0;
        frame.cascades = cascades_;
    }
    Frame frame;

   private:
    std::vector<Cascade> cascades_;
    std::vector<std::uint16_t> halves_;
    std::vector<std::uint32_t> slopes_, moments_;
};

int largest_difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

// A cascade of weight zero is drawn as if it had no waves and no foam, in every tier: its
// displacement, slopes, roughness and whitecaps vanish together. Weights that are changed in memory
// are uploaded; unchanged ones are not.
TEST_F(GlShore, CascadeOfWeightZeroIsNotDrawn) {
    constexpr int pixels = 40;
    for (const gl::Shading shading : {gl::Shading::headset, gl::Shading::medium, gl::Shading::high}) {
        GlScene::Options with_foam = options(pixels);
        with_foam.shading = shading;
        with_foam.foam = true;
        GlScene scene(with_foam);
        ASSERT_EQ(scene.ocean.cascade_count(), 4u);
        const Frame& frame = scene.ocean.frame_at(5);
        HandmadeShore shore({-200, -200}, 81, 81, 5);
        const SquareFromAbove square{.middle = {0, 0}, .half_m = 12, .pixels = pixels};
        scene.renderer->upload(frame);
        const std::vector<std::uint8_t> all = image(scene, square);
        for (std::size_t missing = 0; missing < 4; ++missing) {
            const WithoutCascade less(frame, missing);
            scene.renderer->upload(less.frame);
            const std::vector<std::uint8_t> wanted = image(scene, square);

            shore.each(50, [&](std::size_t texel, double, double, double part) {
                shore.weights_rgba8[texel] = part < 1 ? 0xFFFFFFFFu : ~(0xFFu << 8 * missing);
            });
            Frame shown = frame;
            shown.shore = shore.view();
            scene.renderer->upload(shown);
            // Without the frame's textures, of which one set may lack snapshots that the other has.
            const auto bytes_of_shore = [&] {
                return scene.renderer->statistics().upload_bytes - scene.renderer->textures().uploaded_bytes();
            };
            const std::size_t first_bytes = bytes_of_shore();
            const std::vector<std::uint8_t> held_back = image(scene, square);
            // Another program may round differently, and the slope of the sun's reflection is
            // steep.
            EXPECT_LE(largest_difference(held_back, wanted), 3) << name_of(shading) << ", cascade " << missing;
            EXPECT_GT(largest_difference(held_back, all), 12) << name_of(shading) << ", cascade " << missing;

            scene.renderer->upload(shown);
            EXPECT_EQ(first_bytes - bytes_of_shore(), 4 * shore.weights_rgba8.size());
        }
    }
}

// Outside the rectangle the sea is unchanged, even if weights, waves and foam extend to the
// rectangle's edge.
TEST_F(GlShore, ChangesNothingOutsideItsRectangle) {
    constexpr int pixels = 64;
    GlScene scene(options(pixels));
    const Frame& frame = scene.ocean.frame_at(5);
    const SquareFromAbove square{.middle = {500, -300}, .half_m = 60, .pixels = pixels};
    HandmadeShore shore(square.middle + glm::dvec2(0, -200), 41, 81, 5);
    shore.each(10, [&](std::size_t texel, double x, double z, double part) {
        shore.height_m[texel] = static_cast<float>(2 * part * std::sin(x / 3 + z / 5));
        shore.weights_rgba8[texel] = static_cast<std::uint32_t>(std::lround(255 * (1 - part))) * 0x01010101u;
        shore.foam[texel] = static_cast<std::uint8_t>(std::lround(200 * part));
    });
    scene.renderer->upload(frame);
    const std::vector<std::uint8_t> open = image(scene, square);
    Frame shown = frame;
    shown.shore = shore.view();
    scene.renderer->upload(shown);
    const std::vector<std::uint8_t> with_shore = image(scene, square);
    // A storm's water is displaced by up to 5 m, and vertices are 4 m apart.
    int beside = 0, within = 0, different = 0;
    for (int row = 0; row < pixels; ++row)
        for (int column = 0; column < pixels; ++column) {
            const std::size_t at = 4 * static_cast<std::size_t>(row * pixels + column);
            const int difference = std::abs(open[at + 1] - with_shore[at + 1]);
            if (square.x(column) < shore.corner.x - 10) {
                ++beside;
                EXPECT_LE(difference, 2) << column << ", " << row;
            } else if (square.x(column) > shore.corner.x + 10) {
                ++within;
                different += difference > 10;
            }
        }
    EXPECT_GT(beside, pixels * pixels / 3);
    EXPECT_GT(within, pixels * pixels / 3);
    EXPECT_GT(different, within * 9 / 10);

    // Two eyes with equal views give equal images.
    scene.resize(2 * pixels, pixels);
    gl::Eye left = square.eye(20), right = left;
    right.viewport.x = pixels;
    const gl::Eye eyes[] = {left, right};
    const glm::dvec3 viewer(square.middle.x, 1, square.middle.y);
    const DrawList& list = scene.selection.select({.viewer_m = viewer});
    scene.target->clear();
    scene.renderer->draw({.eyes = eyes, .viewer_m = viewer, .list = &list, .draws_sky = false});
    const std::vector<std::uint8_t> both = scene.target->read();
    int apart = 0;
    for (std::size_t row = 0; row < pixels; ++row)
        for (std::size_t byte = 0; byte < 4 * pixels; ++byte) {
            const std::uint8_t* const start = &both[row * 8 * pixels + byte];
            apart = std::max(apart, std::abs(start[0] - start[4 * pixels]));
        }
    EXPECT_LE(apart, 2);
}

/// Returns the green radiance of the pixels for which which(column, row) is true.
template <class Which>
double mean_green(const std::vector<float>& rgba, int pixels, const Which& which) {
    double sum = 0;
    int count = 0;
    for (int row = 0; row < pixels; ++row)
        for (int column = 0; column < pixels; ++column)
            if (which(column, row)) {
                sum += static_cast<double>(rgba[4 * static_cast<std::size_t>(row * pixels + column) + 1]);
                ++count;
            }
    return count > 0 ? sum / count : -1;
}

// Thick foam reflects at most 0.7 of white light (Whitlock et al. 1982). Water seen from above
// reflects 0.02, plus the light from below the surface.
TEST_F(GlShore, FoamOfTheShoreIsWhite) {
    constexpr int pixels = 64;
    GlScene::Options radiance = options(pixels);
    radiance.preset = "calm";
    radiance.writes = gl::PixelKind::radiance;
    for (const gl::Shading shading : {gl::Shading::headset, gl::Shading::high}) {
        radiance.shading = shading;
        GlScene scene(radiance);
        scene.renderer->set_sky(white_sky());
        Frame frame = scene.ocean.frame_at(5);
        const SquareFromAbove square{.middle = {500, -300}, .half_m = 20, .pixels = pixels};
        HandmadeShore shore(square.middle - 100.0, 41, 41, 5);
        shore.each(50, [&](std::size_t texel, double x, double, double part) {
            shore.foam[texel] = part == 1 && x > square.middle.x ? 255 : 0;
        });
        frame.shore = shore.view();
        scene.renderer->upload(frame);
        draw(scene, square);
        const std::vector<float> rgba = scene.target->read_radiance();
        const double white = mean_green(rgba, pixels, [&](int column, int) { return column > pixels / 2 + 10; });
        const double water = mean_green(rgba, pixels, [&](int column, int) { return column < pixels / 2 - 10; });
        std::printf("foam %.3f, water %.3f\n", white, water);
        EXPECT_GT(white, 0.45) << name_of(shading);
        EXPECT_LT(white, 0.75) << name_of(shading);
        EXPECT_LT(water, 0.15) << name_of(shading);
    }
}

/// A sky that is black except for a quarter at the zenith, which is bright where x, or else z, is
/// positive.
gl::Sky half_bright_sky(bool along_x) {
    gl::Sky sky = white_sky();
    sky.sky_irradiance = glm::vec3(0);
    std::size_t texel = 0;
    for (int level = 0; level < sky.levels; ++level)
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < 16 >> level; ++row)
                for (int column = 0; column < 16 >> level; ++column, texel += 4) {
                    // OpenGL's third face is +y: x along its rows and z along its columns.
                    const bool is_bright = face == 2 && (along_x ? column : row) >= 8 >> level;
                    for (std::size_t channel = 0; channel < 3; ++channel)
                        sky.texels[texel + channel] = glm::packHalf1x16(is_bright ? 100 : 0);
                }
    return sky;
}

// From above, a slope of 0.3 reflects the direction 33 degrees from the zenith, down the slope.
TEST_F(GlShore, WavesReflectAccordingToTheirSlopes) {
    constexpr int pixels = 24;
    GlScene::Options radiance = options(pixels);
    radiance.preset = "calm";
    radiance.writes = gl::PixelKind::radiance;
    for (const gl::Shading shading : {gl::Shading::headset, gl::Shading::high}) {
        radiance.shading = shading;
        GlScene scene(radiance);
        Frame frame = scene.ocean.frame_at(5);
        const SquareFromAbove square{.middle = {-300, 70}, .half_m = 6, .pixels = pixels};
        HandmadeShore shore(square.middle - 100.0, 41, 41, 5);
        for (const bool along_x : {true, false}) {
            scene.renderer->set_sky(half_bright_sky(along_x));
            std::array<double, 2> green{};
            for (const double slope : {-0.3, 0.3}) {
                shore.each(50, [&](std::size_t texel, double x, double z, double part) {
                    const double way = along_x ? x - square.middle.x : z - square.middle.y;
                    shore.height_m[texel] = static_cast<float>(part * std::clamp(slope * way, -5.0, 5.0));
                    shore.weights_rgba8[texel] = part < 1 ? 0xFFFFFFFFu : 0;
                });
                frame.shore = shore.view();
                scene.renderer->upload(frame);
                draw(scene, square);
                green[slope > 0] = mean_green(scene.target->read_radiance(), pixels, [](int, int) { return true; });
            }
            // Fresnel's 0.02 of 100; a fifth of it is allowed for rough water and the air.
            EXPECT_NEAR(green[0], 2, 0.5) << name_of(shading) << (along_x ? ", x" : ", z");
            EXPECT_LT(green[1], 0.2) << name_of(shading) << (along_x ? ", x" : ", z");
        }
    }
}

// Sand rises from the water along x. It is dark up to the reach of the waves, which is higher in
// one half of the image than in the other.
TEST_F(GlShore, SandIsDarkUpToTheReachOfWaves) {
    constexpr int pixels = 96;
    GlScene::Options radiance = options(pixels);
    radiance.preset = "calm";
    radiance.writes = gl::PixelKind::radiance;
    GlScene scene(radiance);
    scene.renderer->set_sky(white_sky());
    const SquareFromAbove square{.middle = {-700, 900}, .half_m = 20, .pixels = pixels};
    ShoreOptions beach{.columns = 41,
                       .rows = 41,
                       .corner_x_m = square.middle.x - 100,
                       .corner_z_m = square.middle.y - 100,
                       .metres_per_sample = 5};
    const auto ground = [&](double x) { return 1 + (x - square.middle.x) / 16; };
    for (int i = 0; i < beach.columns * beach.rows; ++i)
        beach.heights_m.push_back(static_cast<float>(ground(beach.corner_x_m + 5 * (i % beach.columns))));
    const gl::SeaFloor floor = gl::floor_of(beach);
    EXPECT_EQ(gl::check(floor), "");
    EXPECT_NEAR(floor.height_at(square.middle.x + 7, square.middle.y - 3), ground(square.middle.x + 7), 1e-6);
    scene.renderer->set_floor(floor);

    Frame frame = scene.ocean.frame_at(5);
    HandmadeShore shore(square.middle - 100.0, 41, 41, 5);
    const auto reach = [&](double z) { return z < square.middle.y ? 0.5 : 1.4; };
    shore.each(20, [&](std::size_t texel, double, double z, double part) {
        shore.reach_m[texel] = static_cast<float>(part * reach(z));
        shore.weights_rgba8[texel] = part > 0 ? 0 : 0xFFFFFFFFu;
    });
    frame.shore = shore.view();
    scene.renderer->upload(frame);
    draw(scene, square);
    const std::vector<float> rgba = scene.target->read_radiance();
    // Reach is interpolated bilinearly between the halves, and the edge is 8 cm of height wide.
    const auto above_reach = [&](int column, int row) {
        return std::abs(square.z(row) - square.middle.y) < 6 ? 0.0 : ground(square.x(column)) - reach(square.z(row));
    };
    const auto is_wet = [&](int column, int row) {
        return above_reach(column, row) < -0.05 && ground(square.x(column)) > 0.05;
    };
    const auto is_dry = [&](int column, int row) { return above_reach(column, row) > 0.15; };
    const double wet = mean_green(rgba, pixels, is_wet), dry = mean_green(rgba, pixels, is_dry);
    const double bound = 0.5 * (wet + dry);
    int wrong = 0, all = 0;
    for (int row = 0; row < pixels; ++row)
        for (int column = 0; column < pixels; ++column) {
            const double green = static_cast<double>(rgba[4 * static_cast<std::size_t>(row * pixels + column) + 1]);
            if (is_wet(column, row)) ++all, wrong += green > bound;
            if (is_dry(column, row)) ++all, wrong += green < bound;
        }
    std::printf("sand: wet %.3f, dry %.3f, %d of %d pixels on the wrong side\n", wet, dry, wrong, all);
    // Lobell and Asner 2002: wet sand is about half as bright as dry sand.
    EXPECT_LT(wet, 0.75 * dry);
    EXPECT_GT(all, pixels * pixels / 2);
    EXPECT_LT(wrong, all / 50);
}

}  // namespace
}  // namespace pelagic
