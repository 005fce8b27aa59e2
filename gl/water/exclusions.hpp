// Space inside hulls that holds no water: the cockpit of an open boat, or an engine room.
//
//   const HullMesh interior(vertices, triangles);        // closed by a lid at the gunwale
//   const ExclusionMap map(plan_of(interior, 128, 48));  // cells of 5 cm for 6.4 m x 2.4 m
//   renderer.set_exclusion_maps({&map, 1});
//   each frame:  const Exclusion dry{.position_m = hull.mesh_origin_m(state),
//                                    .orientation = state.orientation};
//                renderer.draw({.eyes = eyes, ..., .exclusions = {&dry, 1}});
//
// Link pelagic::floating for HullMesh and plan_of(). The front end itself needs no other symbol of
// it.
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace pelagic {
struct HullPlan;
}

namespace pelagic::gl {

inline constexpr std::size_t max_exclusions = 8;       ///< of a draw
inline constexpr std::size_t max_exclusion_maps = 16;  ///< of a renderer

/// The interior of a hull, as a height range above each cell of its plan. All space between the
/// lowest and the highest point of a cell is interior, so a mesh that folds back over itself is
/// filled. The outline is accurate to one cell. Immutable, so any thread may read it.
class ExclusionMap {
   public:
    /// \param plan  of a closed mesh around the dry space, in the axes of the hull
    /// \throws std::invalid_argument  check(plan), unless it is empty
    explicit ExclusionMap(const HullPlan& plan);

    /// Returns an empty string for a usable plan, else what is wrong: "HullPlan::columns 0 is out
    /// of range [1, 1024]". Its arrays have columns x rows finite elements, and the heights of
    /// covered cells a range.
    static std::string check(const HullPlan& plan);

    /// Returns whether a point in the axes of the hull, metres, is in the interior.
    bool contains(const glm::dvec3& point_m) const;

    /// Returns the number of cells along x.
    int columns() const { return columns_; }
    /// Returns the number of cells along z.
    int rows() const { return rows_; }
    glm::dvec3 lower_m() const { return lower_m_; }  ///< least coordinates of the interior
    /// Returns the extent of the interior.
    glm::dvec3 size_m() const { return size_m_; }

    /// Lowest and highest point, as fractions of the interior's height, and covered fraction.
    struct Texel {
        float low = 0, high = 0, coverage = 0;
    };
    /// Returns (columns + 2) x (rows + 2) texels in rows: the cells, and a border of coverage 0.
    const std::vector<Texel>& texels() const { return texels_; }

   private:
    int columns_ = 0, rows_ = 0;
    glm::dvec3 lower_m_{}, size_m_{};
    std::vector<Texel> texels_;
};

/// A hull of which the interior is left out of a draw.
struct Exclusion {
    std::size_t map = 0;                 ///< index into the maps of set_exclusion_maps()
    glm::dvec3 position_m{};             ///< world position of the origin of the map's axes
    glm::dquat orientation{1, 0, 0, 0};  ///< world from hull, unit

    /// Converts a world position to the axes of the hull.
    glm::dvec3 in_hull(const glm::dvec3& world_m) const {
        return glm::conjugate(orientation) * (world_m - position_m);
    }
};

/// Returns an empty string if a renderer with this number of maps can draw the exclusions, else
/// what is wrong: "DrawInput::exclusions has 9 elements, expected at most 8".
std::string check(std::span<const Exclusion> exclusions, std::size_t maps);

}  // namespace pelagic::gl
