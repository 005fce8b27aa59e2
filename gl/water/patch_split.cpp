#include "pelagic/gl/water/patch_split.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace pelagic::gl {
namespace {

/// For rounding of displacements to half floats and of positions to floats.
constexpr double margin_m = 0.05;

struct Rectangle {
    glm::dvec2 lower, upper;  ///< x and z
};

Rectangle rectangle_of(const Exclusion& exclusion, const ExclusionMap& map) {
    const glm::dmat3 world_from_hull = glm::mat3_cast(exclusion.orientation);
    const glm::dvec3 half = 0.5 * map.size_m();
    const glm::dvec3 centre = exclusion.position_m + world_from_hull * (map.lower_m() + half);
    glm::dvec3 reach(margin_m);
    for (int axis = 0; axis < 3; ++axis) reach += glm::abs(world_from_hull[axis]) * half[axis];
    return {{centre.x - reach.x, centre.z - reach.z}, {centre.x + reach.x, centre.z + reach.z}};
}

}  // namespace

void PatchSplit::assign(const DrawList& list, std::span<const Exclusion> exclusions,
                        std::span<const ExclusionMap> maps, const FrameBounds& bounds) {
    std::array<Rectangle, max_exclusions> rectangles;
    const glm::dvec2 displaced(bounds.horizontal_x_max_m, bounds.horizontal_z_max_m);
    for (std::size_t i = 0; i < exclusions.size(); ++i) {
        rectangles[i] = rectangle_of(exclusions[i], maps[exclusions[i].map]);
        rectangles[i].lower -= displaced;
        rectangles[i].upper += displaced;
    }
    const auto touches = [&](const PatchInstance& patch) {
        const glm::dvec2 lower(static_cast<double>(list.grid.corner.x + patch.corner_x) * list.grid.step_m,
                               static_cast<double>(list.grid.corner.y + patch.corner_z) * list.grid.step_m);
        const glm::dvec2 upper = lower + list.grid.patch_size_m(patch.level);
        return std::any_of(rectangles.begin(), rectangles.begin() + static_cast<std::ptrdiff_t>(exclusions.size()),
                           [&](const Rectangle& r) {
                               return lower.x <= r.upper.x && upper.x >= r.lower.x && lower.y <= r.upper.y &&
                                      upper.y >= r.lower.y;
                           });
    };
    instances_.clear();
    apart_.clear();
    touching_.clear();
    for (const DrawBatch& batch : list.batches) {
        // The order within a batch stays, because the nearest patches come first.
        for (const bool touching : {true, false}) {
            const auto first = static_cast<std::uint32_t>(instances_.size());
            for (const PatchInstance& patch : std::span(list.instances).subspan(batch.first, batch.count))
                if (touches(patch) == touching) instances_.push_back(patch);
            const auto count = static_cast<std::uint32_t>(instances_.size()) - first;
            if (count > 0) (touching ? touching_ : apart_).push_back({batch.stitches, first, count});
        }
    }
}

}  // namespace pelagic::gl
