// Water inside the interiors of hulls is not drawn. The truth is a ray cast against the mesh, at
// the position of the water that a draw without exclusions leaves in the depth buffer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "pelagic/floating/hull_plan.hpp"
#include "pelagic/gl/errors.hpp"
#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/water/exclusions.hpp"
#include "pelagic/tests/gl_scene.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;
constexpr double hull_length_m = 6.4, hull_beam_m = 2.4, hull_height_m = 1.1;
constexpr int map_columns = 128, map_rows = 48;
constexpr double map_texel_m = 0.05;  // along both axes

class Random {
   public:
    explicit Random(unsigned seed) : bits_(seed) {}
    double operator()(double from, double to) {
        return from + (to - from) * static_cast<double>(bits_()) / 4294967296.0;
    }

   private:
    std::mt19937 bits_;
};

/// The truth: a mesh, in its own axes.
class Truth {
   public:
    explicit Truth(const HullMesh& mesh) : mesh_(mesh) {}

    /// Counts the triangles that a ray meets: an odd number inside.
    bool contains(const glm::dvec3& from) const {
        if (glm::any(glm::lessThan(from, mesh_.lower_m())) || glm::any(glm::greaterThan(from, mesh_.upper_m())))
            return false;
        const glm::dvec3 ray = glm::normalize(glm::dvec3(0.37, 0.81, -0.46));  // along no edge
        bool is_inside = false;
        for (const auto& [a, b, c] : mesh_.triangles()) {
            const glm::dvec3 p = mesh_.vertices()[a], q = mesh_.vertices()[b] - p, r = mesh_.vertices()[c] - p;
            const glm::dvec3 across = glm::cross(ray, r);
            const double twice = glm::dot(q, across);
            if (twice == 0) continue;
            const glm::dvec3 to = from - p, over = glm::cross(to, q);
            const double u = glm::dot(to, across) / twice, v = glm::dot(ray, over) / twice;
            if (u >= 0 && v >= 0 && u + v <= 1 && glm::dot(r, over) / twice > 0) is_inside = !is_inside;
        }
        return is_inside;
    }

    double distance_m(const glm::dvec3& from) const {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : mesh_.triangles())
            least = std::min(least, to_triangle(from, mesh_.vertices()[a], mesh_.vertices()[b], mesh_.vertices()[c]));
        return least;
    }

   private:
    static double to_edge(glm::dvec3 from, glm::dvec3 a, glm::dvec3 b) {
        const double t = glm::dot(from - a, b - a) / glm::dot(b - a, b - a);
        return glm::distance(from, a + std::clamp(t, 0.0, 1.0) * (b - a));
    }
    static double to_triangle(glm::dvec3 from, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        const glm::dvec3 foot = from - glm::dot(from - a, normal) * normal;
        const auto is_left = [&](glm::dvec3 p, glm::dvec3 q) {
            return glm::dot(glm::cross(q - p, foot - p), normal) >= 0;
        };
        if (is_left(a, b) && is_left(b, c) && is_left(c, a)) return std::abs(glm::dot(from - a, normal));
        return std::min({to_edge(from, a, b), to_edge(from, b, c), to_edge(from, c, a)});
    }

    const HullMesh& mesh_;
};

const HullMesh& interior() {
    static const HullMesh mesh = boat_mesh(hull_length_m, hull_beam_m, hull_height_m);
    return mesh;
}

const gl::ExclusionMap& map_of_interior() {
    static const gl::ExclusionMap map(plan_of(interior(), map_columns, map_rows));
    return map;
}

// The map is the mesh but for a cell: linear filtering of the cells' mean heights moves the
// boundary by at most the width of a cell.
TEST(ExclusionMap, IsTheMeshToWithinACell) {
    const Truth truth(interior());
    const gl::ExclusionMap& map = map_of_interior();
    Random random(1);
    int inside = 0, wrong = 0;
    double furthest_m = 0;
    constexpr int points = 20000;
    for (int i = 0; i < points; ++i) {
        const glm::dvec3 at(random(-3.5, 3.5), random(-0.2, 1.4), random(-1.4, 1.4));
        const bool expected = truth.contains(at);
        inside += expected;
        if (map.contains(at) == expected) continue;
        ++wrong;
        furthest_m = std::max(furthest_m, truth.distance_m(at));
    }
    std::printf("%d of %d points inside, %d wrong, at most %.1f mm from the mesh\n", inside, points, wrong,
                1000 * furthest_m);
    EXPECT_GT(inside, points / 10);
    EXPECT_LE(furthest_m, map_texel_m);
}

TEST(ExclusionMap, NamesAnInvalidPlan) {
    const HullPlan good = plan_of(interior(), 8, 4);
    EXPECT_EQ(gl::ExclusionMap::check(good), "");
    HullPlan plan = good;
    plan.columns = 0;
    EXPECT_EQ(gl::ExclusionMap::check(plan), "HullPlan::columns 0 is out of range [1, 1024]");
    plan = good;
    plan.low_m.pop_back();
    EXPECT_EQ(gl::ExclusionMap::check(plan), "HullPlan::low_m has 31 elements, expected columns x rows, 32");
    plan = good;
    plan.high_m[3] = NAN;
    EXPECT_EQ(gl::ExclusionMap::check(plan), "HullPlan::high_m has an element that is not finite");
    plan = good;
    plan.beam_m = 0;
    EXPECT_EQ(gl::ExclusionMap::check(plan), "HullPlan::beam_m is 0, expected above 0 and finite");
    plan = good;
    plan.coverage.assign(32, 0);
    EXPECT_EQ(gl::ExclusionMap::check(plan), "HullPlan covers no cell with a height above 0");
    EXPECT_THROW(gl::ExclusionMap{plan}, std::invalid_argument);
}

/// A framebuffer of which depths can be read.
class DepthTarget {
   public:
    DepthTarget(const gl::Functions& gl, int width, int height)
        : width_(width), height_(height), gl_(gl), depth_(gl), colour_(gl), drawn_(gl), bytes_(gl), packed_(gl) {
        const gl::GlStateGuard keep(gl);
        gl.BindTexture(GL_TEXTURE_2D, depth_.name());
        gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, width, height);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        for (const auto& [texture, framebuffer] : {std::pair(&colour_, &drawn_), {&bytes_, &packed_}}) {
            gl.BindTexture(GL_TEXTURE_2D, texture->name());
            gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, width, height);
            gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer->name());
            gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture->name(), 0);
        }
        gl.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
        program_ = gl.CreateProgram();
        add(GL_VERTEX_SHADER,
            "#version 300 es\nvoid main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, "
            "0.0, 1.0); }\n");
        add(GL_FRAGMENT_SHADER,
            "#version 300 es\nprecision highp float;\nprecision highp int;\nuniform highp sampler2D depth;\n"
            "out vec4 bytes;\nvoid main() {\n"
            "uint bits = floatBitsToUint(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r);\n"
            "bytes = vec4(bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u, bits >> 24) / 255.0;\n}\n");
        gl.LinkProgram(program_);
    }
    ~DepthTarget() { gl_.DeleteProgram(program_); }

    void clear() const {
        gl_.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
        gl_.ClearColor(0, 0, 0, 0);
        gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }
    void bind() const { gl_.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name()); }

    /// Returns the depths of all pixels, the lower row first.
    std::vector<float> depths() const {
        const gl::GlStateGuard keep(gl_);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, packed_.name());
        gl_.Viewport(0, 0, width_, height_);
        gl_.BindTexture(GL_TEXTURE_2D, depth_.name());
        gl_.UseProgram(program_);
        gl_.DrawArrays(GL_TRIANGLES, 0, 3);
        return read<float>();
    }
    /// Returns the RGBA8 colours of all pixels, the lower row first.
    std::vector<std::uint32_t> colours() const {
        bind();
        return read<std::uint32_t>();
    }

   private:
    template <class Pixel>
    std::vector<Pixel> read() const {
        std::vector<Pixel> pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
        gl_.Finish();
        gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        EXPECT_EQ(gl_.GetError(), static_cast<GLenum>(GL_NO_ERROR));
        return pixels;
    }
    void add(GLenum kind, const char* text) const {
        const GLuint shader = gl_.CreateShader(kind);
        gl_.ShaderSource(shader, 1, &text, nullptr);
        gl_.CompileShader(shader);
        gl_.AttachShader(program_, shader);
        gl_.DeleteShader(shader);
    }

    int width_, height_;
    const gl::Functions& gl_;
    gl::Texture depth_, colour_;
    gl::Framebuffer drawn_;
    gl::Texture bytes_;
    gl::Framebuffer packed_;
    GLuint program_ = 0;
};

class GlExclusion : public testing::Test {
   protected:
    // All tests share a scene, because compiling its shaders takes longer than a test.
    static void SetUpTestSuite() {
        shared_ = std::make_unique<GlScene>(GlScene::Options{.preset = "storm",
                                                             .quality = "low",
                                                             .resolution = 64,
                                                             .cascades = 1,
                                                             .width = 8,
                                                             .height = 8,
                                                             .samples = 0,
                                                             .size_m = 512,
                                                             .shading = gl::Shading::headset,
                                                             .lens_may_dip = true});
    }
    static void TearDownTestSuite() { shared_.reset(); }
    GlExclusion() { scene_.renderer->set_exclusion_maps({&map_of_interior(), 1}); }

    const Frame& upload(double time_s) {
        const Frame& frame = scene_.ocean.frame_at(time_s);
        scene_.renderer->upload(frame);
        return frame;
    }

    /// Selects patches for eyes; the result is valid until the next call.
    gl::DrawInput input_for(const Frame& frame, std::span<const gl::Eye> eyes, const glm::dvec3& viewer_m) {
        std::vector<glm::dmat4> views;
        for (const gl::Eye& eye : eyes) views.push_back(eye.clip_from_world);
        const DrawList& list =
            scene_.selection.select({.viewer_m = viewer_m, .views = views, .bounds = frame.bounds});
        return {.eyes = eyes, .viewer_m = viewer_m, .list = &list, .draws_sky = false};
    }

    const Truth truth_{interior()};
    static inline std::unique_ptr<GlScene> shared_;
    GlScene& scene_ = *shared_;
};

/// A camera and one or two boats at random in the waves.
struct Pose {
    Camera camera;
    std::vector<gl::Exclusion> boats;

    bool contains(const Truth& truth, const glm::dvec3& world_m) const {
        return std::any_of(boats.begin(), boats.end(),
                           [&](const gl::Exclusion& boat) { return truth.contains(boat.in_hull(world_m)); });
    }
    double distance_m(const Truth& truth, const glm::dvec3& world_m) const {
        double least = std::numeric_limits<double>::infinity();
        for (const gl::Exclusion& boat : boats) least = std::min(least, truth.distance_m(boat.in_hull(world_m)));
        return least;
    }
};

glm::dquat random_orientation(Random& random) {
    return glm::angleAxis(random(-pi, pi), glm::dvec3(0, 1, 0)) *
           glm::angleAxis(random(-0.6, 0.6), glm::dvec3(1, 0, 0)) *
           glm::angleAxis(random(-0.6, 0.6), glm::dvec3(0, 0, 1));
}

double height_at(const SurfaceQuery& water, double x, double z) {
    float height = 0;
    water.sample({{&x, 1}, {&z, 1}}, {.height_m = {&height, 1}});
    return static_cast<double>(height);
}

/// From the air, from the cockpit and from within the water in turn; each fourth pose has two boats
/// whose boxes overlap.
Pose random_pose(int number, const SurfaceQuery& water, Random& random) {
    Pose pose;
    const double x = random(-200, 200), z = random(-200, 200);
    const glm::dvec3 at(x, height_at(water, x, z) - random(0.2, 1.0), z);
    pose.boats.push_back({.position_m = at, .orientation = random_orientation(random)});
    if (number % 4 == 3)
        pose.boats.push_back({.position_m = at + glm::dvec3(random(-1, 1), random(-0.3, 0.3), random(-1, 1)),
                              .orientation = random_orientation(random)});
    const double azimuth = random(-pi, pi), elevation = random(0.1, 1.1);
    const glm::dvec3 out(std::cos(azimuth) * std::cos(elevation), std::sin(elevation),
                         std::sin(azimuth) * std::cos(elevation));
    const glm::dvec3 middle = at + glm::dvec3(0, 0.5, 0);
    if (number % 3 == 1) {
        const glm::dvec3 seat(random(-0.3, 0.2) * hull_length_m, random(0.6, 0.95) * hull_height_m,
                              random(-0.2, 0.2) * hull_beam_m);
        pose.camera.position_m = at + pose.boats[0].orientation * seat;
        pose.camera.target_m = pose.camera.position_m - out;
    } else if (number % 3 == 2) {
        pose.camera.position_m = middle + random(2, 8) * (out - glm::dvec3(0, 2 * out.y, 0));
        pose.camera.target_m = middle;
    } else {
        pose.camera.position_m = middle + random(2.5, 14) * out;
        pose.camera.target_m = middle + glm::dvec3(random(-0.5, 0.5), 0, random(-0.5, 0.5));
    }
    return pose;
}

// A pixel is expected to keep its water unless that lies inside a mesh; water that then shows from
// further away has to lie outside, too. A wrong pixel is within a cell and a pixel of the boundary
// if its water, or that of one of its eight neighbours, is within a cell of the mesh.
TEST_F(GlExclusion, LeavesOutTheWaterInAnOpenBoatInAStorm) {
    constexpr int side = 44, across = 10, up = 5, width = across * side, height = up * side;
    constexpr int frames = is_sanitized ? 4 : 10;
    const DepthTarget plain(scene_.gl(), width, height), dry(scene_.gl(), width, height);
    Random random(2);
    int pixels = 0, left_out = 0, wrong = 0;
    double furthest_m = 0;
    for (int n = 0; n < frames; ++n) {
        const Frame& frame = upload(3.7 * n);
        plain.clear();
        dry.clear();
        std::vector<Pose> poses;
        std::vector<glm::dmat4> world_from_clip;
        for (int i = 0; i < across * up; ++i) {
            const Pose& pose = poses.emplace_back(random_pose(i, SurfaceQuery(frame), random));
            const gl::Eye eye = gl::eye_of(pose.camera, {i % across * side, i / across * side, side, side});
            world_from_clip.push_back(glm::inverse(eye.clip_from_world));
            gl::DrawInput input = input_for(frame, {&eye, 1}, pose.camera.position_m);
            plain.bind();
            scene_.renderer->draw(input);
            input.exclusions = pose.boats;
            dry.bind();
            scene_.renderer->draw(input);
        }
        const std::vector<float> before = plain.depths(), after = dry.depths();
        for (int i = 0; i < across * up; ++i) {
            const int left = i % across * side, bottom = i / across * side;
            const auto index = [&](int x, int y) {
                return static_cast<std::size_t>((bottom + y) * width + left + x);
            };
            const auto position = [&](int x, int y, float depth) {
                const glm::dvec4 clip(2 * (x + 0.5) / side - 1, 2 * (y + 0.5) / side - 1,
                                      2 * static_cast<double>(depth) - 1, 1);
                const glm::dvec4 at = world_from_clip[static_cast<std::size_t>(i)] * clip;
                return glm::dvec3(at) / at.w;
            };
            const Pose& pose = poses[static_cast<std::size_t>(i)];
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    ++pixels;
                    const float first = before[index(x, y)], shown = after[index(x, y)];
                    const bool is_inside = first < 1 && pose.contains(truth_, position(x, y, first));
                    left_out += is_inside;
                    bool is_right = is_inside ? shown > first : shown == first;
                    if (shown > first && shown < 1)
                        is_right = is_right && !pose.contains(truth_, position(x, y, shown));
                    if (is_right) continue;
                    ++wrong;
                    double nearest_m = pose.distance_m(truth_, position(x, y, shown));
                    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, side - 1); ++j)
                        for (int k = std::max(x - 1, 0); k <= std::min(x + 1, side - 1); ++k)
                            nearest_m =
                                std::min(nearest_m, pose.distance_m(truth_, position(k, j, before[index(k, j)])));
                    furthest_m = std::max(furthest_m, nearest_m);
                }
        }
    }
    std::printf("%d pixels, %d left out, %d wrong, at most %.1f mm from the mesh\n", pixels, left_out, wrong,
                1000 * furthest_m);
    EXPECT_GT(left_out, pixels / 10);
    EXPECT_LE(furthest_m, map_texel_m);
    // 354 pixels are wrong, and 765 with boats half a cell further forward.
    EXPECT_LT(wrong, pixels / 2000);
}

// From a metre below the water, an eye in a boat looks down. Outside, it would see water only.
TEST_F(GlExclusion, KeepsEachEyeInACockpitDry) {
    constexpr int side = 32;
    const DepthTarget target(scene_.gl(), 2 * side, side);
    const Frame& frame = upload(1);
    const glm::dvec3 seat(10, height_at(SurfaceQuery(frame), 10, 20) - 1, 20);
    const gl::Exclusion boat{.position_m = seat - glm::dvec3(0, 0.6 * hull_height_m, 0)};
    const auto wet_pixels = [&](const glm::dvec3& left, const glm::dvec3& right,
                                std::span<const gl::Exclusion> exclusions) {
        std::array<gl::Eye, 2> eyes;
        for (int i = 0; i < 2; ++i) {
            const glm::dvec3 at = i == 0 ? left : right;
            eyes[static_cast<std::size_t>(i)] =
                gl::eye_of({.position_m = at, .target_m = at - glm::dvec3(0.1, 1, 0)}, {i * side, 0, side, side});
        }
        // The surface is behind the eyes. Its programs for a wet lens take seconds to compile.
        DrawList below;
        below.grid.vertices = 2;
        gl::DrawInput input{.eyes = eyes, .viewer_m = seat, .list = &below, .draws_sky = false};
        input.camera_water_plane = gl::camera_water_plane(SurfaceQuery(frame), seat);
        input.exclusions = exclusions;
        target.clear();
        scene_.renderer->draw(input);
        const std::vector<std::uint32_t> colours = target.colours();
        std::array<int, 2> wet{};
        for (std::size_t i = 0; i < colours.size(); ++i) wet[i / side % 2] += colours[i] >> 24 != 0;
        return wet;
    };
    constexpr int all = side * side;
    const glm::dvec3 half(0, 0, 0.032), outside(0, 0, 2);
    using Wet = std::array<int, 2>;
    EXPECT_EQ(wet_pixels(seat - half, seat + half, {}), (Wet{all, all}));
    EXPECT_EQ(wet_pixels(seat - half, seat + half, {&boat, 1}), (Wet{0, 0}));
    EXPECT_EQ(wet_pixels(seat, seat + outside, {&boat, 1}), (Wet{0, all}));
    EXPECT_EQ(wet_pixels(seat + outside, seat, {&boat, 1}), (Wet{all, 0}));
}

TEST_F(GlExclusion, RejectsAnInvalidListAndDrawsOn) {
    const Frame& frame = upload(1);
    const DepthTarget target(scene_.gl(), 8, 8);
    target.clear();
    const Camera camera{.position_m = {0, 30, 0}, .target_m = {10, 0, 0}};
    const gl::Eye eye = gl::eye_of(camera, {0, 0, 8, 8});
    gl::DrawInput input = input_for(frame, {&eye, 1}, camera.position_m);
    const auto message_for = [&](const std::vector<gl::Exclusion>& exclusions) {
        input.exclusions = exclusions;
        return message_of([&] { scene_.renderer->draw(input); });
    };
    EXPECT_EQ(message_for(std::vector<gl::Exclusion>(9)), "DrawInput::exclusions has 9 elements, expected at most 8");
    EXPECT_EQ(message_for({{.map = 1}}),
              "DrawInput::exclusions[0].map is 1, expected less than the number of maps, 1");
    EXPECT_EQ(message_for({{}, {.position_m = {0, NAN, 0}}}), "DrawInput::exclusions[1].position_m is not finite");
    EXPECT_EQ(message_for({{.orientation = {0, 0, 0, 0}}}),
              "DrawInput::exclusions[0].orientation is not a unit quaternion");
    const std::vector<gl::ExclusionMap> too_many(gl::max_exclusion_maps + 1, map_of_interior());
    EXPECT_THROW(scene_.renderer->set_exclusion_maps(too_many), std::invalid_argument);
    EXPECT_EQ(message_for(std::vector<gl::Exclusion>(8)), "");
    scene_.renderer->set_exclusion_maps({});
    EXPECT_EQ(message_for({{}}), "DrawInput::exclusions[0].map is 0, expected less than the number of maps, 0");
}

// Only patches that may reach an interior use the program that discards pixels.
TEST_F(GlExclusion, CostsNoDrawWhereNoBoatIs) {
    const Frame& frame = upload(1);
    const DepthTarget target(scene_.gl(), 8, 8);
    target.clear();
    const Camera camera{.position_m = {0, 3, 0}, .target_m = {100, 0, 0}};
    const gl::Eye eye = gl::eye_of(camera, {0, 0, 8, 8});
    gl::DrawInput input = input_for(frame, {&eye, 1}, camera.position_m);
    const int calls = scene_.renderer->draw(input).sea_calls;
    const gl::Exclusion behind{.position_m = {-200, 0, 0}}, ahead{.position_m = {30, 0, 0}};
    input.exclusions = {&behind, 1};
    EXPECT_EQ(scene_.renderer->draw(input).sea_calls, calls);
    input.exclusions = {&ahead, 1};
    const int with_boat = scene_.renderer->draw(input).sea_calls;
    std::printf("%d draw calls, %d with a boat\n", calls, with_boat);
    EXPECT_GT(with_boat, calls);
    EXPECT_LE(with_boat, calls + 4);  // a boat lies on at most four patches
}

}  // namespace
}  // namespace pelagic
