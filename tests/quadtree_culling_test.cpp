// Culling compared with every triangle of the displaced mesh, clipped by the view volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/quadtree_scene.hpp"

namespace pelagic {
namespace {

#if defined(NDEBUG)
constexpr int view_count = 1000;
#else
constexpr int view_count = 24;
#endif

/// Interpolates a frame's displacement between its texels.
class FrameSea {
   public:
    explicit FrameSea(const Frame& frame) : frame_(frame) {}

    glm::dvec3 operator()(glm::dvec2 rest) const {
        const Displacement d = displacement_of(frame_, rest.x, rest.y);
        return {d.dx, d.height, d.dz};
    }
    FrameBounds bounds() const { return frame_.bounds; }

   private:
    const Frame& frame_;
};

/// The range of a projection's depth. The volume is clipped with exactly these planes.
struct Projection {
    glm::dmat4 matrix;
    bool zero_to_one;
};

/// A projection with reversed depth and an infinite far plane: z = near / distance, from 1 down to
/// 0.
glm::dmat4 reversed_infinite(double fov, double aspect, double near) {
    const double f = 1 / std::tan(fov / 2);
    glm::dmat4 m(0);
    m[0][0] = f / aspect;
    m[1][1] = f;
    m[2][3] = -1;
    m[3][2] = near;
    return m;
}

Projection random_projection(Random& random, int number) {
    const double fov = random.between(0.4, 1.9), aspect = random.between(0.5, 2.2), near = random.between(0.05, 1);
    const double far = random.between(200, 6000);
    const auto lopsided = [&](double low, double high) { return near * random.between(low, high); };
    switch (number % 7) {
        case 0: return {glm::perspectiveRH_NO(fov, aspect, near, far), false};
        case 1: return {glm::perspectiveRH_ZO(fov, aspect, near, far), true};
        case 2:  // an eye of a headset
            return {glm::frustumRH_NO(lopsided(-1.4, -0.7), lopsided(0.6, 1.1), lopsided(-1.3, -0.8),
                                      lopsided(0.8, 1.2), near, far),
                    false};
        case 3: return {glm::infinitePerspective(fov, aspect, near), false};
        case 4: return {reversed_infinite(fov, aspect, near), true};
        case 5:  // reversed depth: near and far are swapped
            return {glm::perspectiveRH_ZO(fov, aspect, far, near), true};
        default:  // a view for shadows
            return {glm::orthoRH_ZO(-300.0, 200.0, -150.0, 250.0, 0.1, far), true};
    }
}

glm::dmat4 random_camera(Random& random, glm::dvec3 eye) {
    const double heading = random.between(0, 2 * std::numbers::pi), pitch = random.between(-1.4, 0.6);
    const glm::dvec3 forward(std::cos(pitch) * std::cos(heading), std::sin(pitch),
                             std::cos(pitch) * std::sin(heading));
    const double roll = random.between(-0.4, 0.4);
    const glm::dvec3 up = glm::dvec3(glm::rotate(glm::dmat4(1), roll, forward) * glm::dvec4(0, 1, 0, 0));
    return glm::lookAtRH(eye, eye + forward, up);
}

/// Returns whether a part of the triangle lies in the clip volume: whether Sutherland and Hodgman's
/// clipping leaves a polygon.
bool is_visible(const std::array<glm::dvec4, 3>& triangle, bool zero_to_one) {
    using Distance = double (*)(const glm::dvec4&);
    const Distance near = zero_to_one ? Distance([](const glm::dvec4& p) { return p.z; })
                                      : Distance([](const glm::dvec4& p) { return p.w + p.z; });
    const std::array<Distance, 6> inside = {[](const glm::dvec4& p) { return p.w + p.x; },
                                            [](const glm::dvec4& p) { return p.w - p.x; },
                                            [](const glm::dvec4& p) { return p.w + p.y; },
                                            [](const glm::dvec4& p) { return p.w - p.y; },
                                            near,
                                            [](const glm::dvec4& p) { return p.w - p.z; }};
    for (const Distance distance : inside)
        if (distance(triangle[0]) < 0 && distance(triangle[1]) < 0 && distance(triangle[2]) < 0) return false;
    std::vector<glm::dvec4> polygon(triangle.begin(), triangle.end()), cut;
    for (const Distance distance : inside) {
        cut.clear();
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const glm::dvec4 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
            const double da = distance(a), db = distance(b);
            if (da >= 0) cut.push_back(a);
            if ((da >= 0) != (db >= 0)) cut.push_back(a + (b - a) * (da / (da - db)));
        }
        polygon.swap(cut);
        if (polygon.size() < 3) return false;
    }
    return true;
}

/// Returns which patches of an unculled list have a visible triangle.
std::vector<bool> truly_visible(const DrawList& list, const PatchMesh& mesh, const FrameSea& sea,
                                const std::vector<std::pair<glm::dmat4, bool>>& seen_by) {
    std::vector<bool> visible(list.instances.size(), false);
    std::vector<glm::dvec4> clip;
    for (const DrawBatch& batch : list.batches) {
        const PatchMesh::Range range = mesh.ranges[batch.stitches];
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            const std::vector<glm::dvec3> at = patch_positions(list.grid, list.instances[i], sea);
            for (const auto& [clip_from_world, zero_to_one] : seen_by) {
                clip.clear();
                for (const glm::dvec3& p : at) clip.push_back(clip_from_world * glm::dvec4(p, 1));
                for (std::uint32_t k = range.first; k < range.first + range.count && !visible[i]; k += 3)
                    visible[i] = is_visible(
                        {clip[mesh.indices[k]], clip[mesh.indices[k + 1]], clip[mesh.indices[k + 2]]}, zero_to_one);
            }
        }
    }
    return visible;
}

class Culling : public testing::Test {
   protected:
    /// The patches that a worst view keeps are few, and depend on the sea's crests: a given sea,
    /// not the default one.
    explicit Culling(const SeaState& sea = {.spreading = SpreadingModel::paper,
                                            .resolution = 64,
                                            .patch_size_m = 250,
                                            .wind_speed_mps = 18,
                                            .loop_period_s = 200})
        : ocean_(sea, {.executor = make_serial_executor()}), sea_(ocean_.frame_at(7.5)) {
        for (const Cascade& cascade : ocean_.complete().cascades) level_m_ += static_cast<double>(cascade.level_m);
    }

    /// Compares one selection with the expected visibility, and counts.
    void compare(const QuadtreeOptions& options, glm::dvec3 viewer,
                 const std::vector<std::pair<glm::dmat4, bool>>& seen_by) {
        Selection everything(options), culled(options), wider(options);
        const DrawList& all = everything.select({.viewer_m = viewer});
        std::vector<glm::dmat4> matrices;
        for (const auto& view : seen_by) matrices.push_back(view.first);
        const DrawList& kept =
            culled.select({.viewer_m = viewer,
                           .views = matrices,
                           .bounds = sea_.bounds(),
                           .depth = seen_by[0].second ? ClipDepth::zero_to_one : ClipDepth::minus_one_to_one});
        // Without a depth range culling keeps all of these patches, and possibly more.
        std::set<std::tuple<int, int, int>> kept_by_wider;
        for (const PatchInstance& patch :
             wider.select({.viewer_m = viewer, .views = matrices, .bounds = sea_.bounds()}).instances)
            kept_by_wider.insert({patch.level, patch.corner_x, patch.corner_z});
        for (const PatchInstance& patch : kept.instances)
            EXPECT_TRUE(kept_by_wider.contains({patch.level, patch.corner_x, patch.corner_z}));
        const PatchMesh mesh(options.vertices);
        const std::vector<bool> visible = truly_visible(all, mesh, sea_, seen_by);
        int lost = 0, seen = 0;
        std::map<std::tuple<int, int, int>, const PatchInstance*> drawn;
        for (const PatchInstance& patch : kept.instances)
            drawn[{patch.level, patch.corner_x, patch.corner_z}] = &patch;
        for (std::size_t i = 0; i < visible.size(); ++i) {
            const PatchInstance& patch = all.instances[i];
            const auto found = drawn.find({patch.level, patch.corner_x, patch.corner_z});
            if (visible[i]) ++seen;
            if (visible[i] && found == drawn.end()) ++lost;
            if (found != drawn.end()) {
                ASSERT_EQ(*found->second, patch);  // culling changes nothing else
            }
        }
        EXPECT_EQ(lost, 0);
        truly_ += seen;
        kept_ += static_cast<int>(kept.instances.size());
        // Views that graze the crests contain a few patches; the boxes, as high as the highest
        // crest, keep a few more.
        if (seen >= 12) worst_ = std::max(worst_, static_cast<double>(kept.instances.size()) / seen);
    }

    Ocean ocean_;
    FrameSea sea_;
    double level_m_ = 0;  ///< mean height of the drawn points, above which eyes are
    int truly_ = 0, kept_ = 0;
    double worst_ = 0;
};

TEST_F(Culling, LosesNoVisibleTriangleAndKeepsFewInvisiblePatches) {
    Random random(11);
    const QuadtreeOptions choices[] = {quadtree_preset_named("low")->options(2048),
                                       {.size_m = 1024, .vertices = 16, .lod_scale = 2.4},
                                       {.size_m = 8192, .vertices = 8, .lod_scale = 2.2}};
    for (int i = 0; i < view_count; ++i) {
        const QuadtreeOptions& options = choices[i % 3];
        const double height = i % 5 == 0 ? random.between(20, options.size_m / 4) : random.between(-3, 12);
        const glm::dvec3 eye(random.between(-3000, 3000), height + level_m_, random.between(-3000, 3000));
        const Projection projection = random_projection(random, i);
        SCOPED_TRACE("view " + std::to_string(i));
        ASSERT_NO_FATAL_FAILURE(
            compare(options, eye, {{projection.matrix * random_camera(random, eye), projection.zero_to_one}}));
    }
    ASSERT_GT(truly_, 10 * view_count);
    EXPECT_LE(kept_, 1.6 * truly_);
    EXPECT_LE(worst_, 1.6);
    RecordProperty("kept_over_visible", std::to_string(static_cast<double>(kept_) / truly_));
    RecordProperty("worst_view", std::to_string(worst_));
    std::printf("kept %.3f times the visible patches, %.3f in the worst view\n", static_cast<double>(kept_) / truly_,
                worst_);
}

TEST_F(Culling, LosesNoVisibleTriangleOfEitherEye) {
    Random random(12);
    const QuadtreeOptions options = quadtree_preset_named("low")->options(2048);
    for (int i = 0; i < view_count / 10; ++i) {
        const glm::dvec3 head(random.between(-900, 900), random.between(0.5, 5), random.between(-900, 900));
        const glm::dmat4 camera = random_camera(random, head);
        std::vector<std::pair<glm::dmat4, bool>> eyes;
        for (const double side : {-0.032, 0.032}) {
            const glm::dmat4 eye = glm::translate(glm::dmat4(1), glm::dvec3(-side, 0, 0)) * camera;
            const double inner = 0.9, outer = 1.3, near = 0.1;
            const double left = side < 0 ? outer : inner, right = side < 0 ? inner : outer;
            eyes.push_back({glm::frustumRH_ZO(-left * near, right * near, -near, near, near, 5000.0) * eye, true});
        }
        ASSERT_NO_FATAL_FAILURE(compare(options, head, eyes));
    }
    EXPECT_LE(kept_, 1.6 * truly_);
}

/// Returns a node's box by equation 61.
Box box_of(const QuadtreeGrid& grid, const BoxesOfNodes& boxes, int level, int x, int z) {
    const double side = grid.patch_size_m(level);
    const glm::dvec2 centre = glm::dvec2(grid.corner) * grid.step_m + side * glm::dvec2(x + 0.5, z + 0.5);
    const glm::dvec2 half = side * boxes.cull_scale / 2 + boxes.horizontal_m;
    return {{centre.x, (boxes.low_m + boxes.high_m) / 2, centre.y},
            {half.x, (boxes.high_m - boxes.low_m) / 2, half.y}};
}

TEST(NodeCullingTest, AgreesWithTheFrustumAndDetectsFullyInsideNodes) {
    Random random(5);
    const QuadtreeGrid grid{.step_m = 4, .corner = {-300, 100}, .side = 512, .vertices = 32, .deepest_level = 4};
    std::map<NodeCulling::Sight, int> seen;
    for (int number = 0; number < 200; ++number) {
        const Projection projection = random_projection(random, number);
        const glm::dmat4 camera = random_camera(random, {random.between(-900, 900), 20, random.between(400, 2400)});
        const Frustum view(projection.matrix * camera,
                           projection.zero_to_one ? ClipDepth::zero_to_one : ClipDepth::minus_one_to_one);
        const BoxesOfNodes boxes{-2, 3, {1.5, 0.5}, random.between(1, 2)};
        const NodeCulling culling(view, grid, boxes);
        for (int node = 0; node < 200; ++node) {
            const int level = random.below(5), x = random.below(1 << level), z = random.below(1 << level);
            const Box box = box_of(grid, boxes, level, x, z);
            bool is_inside = true;
            for (const glm::dvec4& plane : view.planes)
                for (int corner = 0; corner < 8; ++corner) {
                    const glm::dvec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
                    is_inside = is_inside && glm::dot(plane, glm::dvec4(box.centre + sign * box.half, 1)) >= 0;
                }
            const NodeCulling::Sight sight = culling.sight_of(level, x, z);
            ASSERT_EQ(sight != NodeCulling::Sight::none, view.may_see(box));
            ASSERT_EQ(sight == NodeCulling::Sight::whole, is_inside);
            ++seen[sight];
        }
    }
    for (const auto sight : {NodeCulling::Sight::none, NodeCulling::Sight::partial, NodeCulling::Sight::whole})
        EXPECT_GT(seen[sight], 1000);
}

class CullingOfSeveralCascades : public Culling {
   protected:
    CullingOfSeveralCascades() : Culling({.cascades = 4, .resolution = 32, .wind_speed_mps = 18}) {}
};

// A frame's bounds are sums of its cascades' bounds, whose extremes need not coincide: a few more
// patches are kept.
TEST_F(CullingOfSeveralCascades, LosesNoVisibleTriangleAndKeepsFewInvisiblePatches) {
    Random random(13);
    const QuadtreeOptions options = quadtree_preset_named("low")->options(2048);
    for (int i = 0; i < view_count / 10; ++i) {
        const double height = i % 5 == 0 ? random.between(20, options.size_m / 4) : random.between(-3, 12);
        const glm::dvec3 eye(random.between(-3000, 3000), height + level_m_, random.between(-3000, 3000));
        const Projection projection = random_projection(random, i);
        SCOPED_TRACE("view " + std::to_string(i));
        ASSERT_NO_FATAL_FAILURE(
            compare(options, eye, {{projection.matrix * random_camera(random, eye), projection.zero_to_one}}));
    }
    EXPECT_GT(truly_, view_count);
    EXPECT_LE(kept_, 1.6 * truly_);
    std::printf("kept %.3f times the visible patches\n", static_cast<double>(kept_) / truly_);
}

}  // namespace
}  // namespace pelagic
