// Hulls and floating bodies of the C interface that several tests use.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pelagic/floating/hull.hpp"
#include "pelagic/tests/capi_sea.hpp"
#include "pelagic/tests/hull_meshes.hpp"

namespace pelagic {

/// Arrays of a mesh, as an application has them.
struct HullArrays {
    std::vector<double> vertices_m;
    std::vector<std::uint32_t> triangles;

    HullArrays(const std::vector<glm::dvec3>& vertices, const std::vector<HullMesh::Triangle>& of) {
        for (const glm::dvec3& v : vertices) vertices_m.insert(vertices_m.end(), {v.x, v.y, v.z});
        for (const HullMesh::Triangle& t : of) triangles.insert(triangles.end(), t.begin(), t.end());
    }
    explicit HullArrays(const HullMesh& mesh) : HullArrays(mesh.vertices(), mesh.triangles()) {}
    explicit HullArrays(const HullSoup& soup) : HullArrays(soup.vertices, soup.triangles) {}

    pelagic_hull_mesh mesh() const {
        auto mesh = pelagic_hull_mesh_make();
        mesh.vertex_count = vertices_m.size() / 3;
        mesh.vertices_m = vertices_m.data();
        mesh.triangle_count = triangles.size() / 3;
        mesh.triangles = triangles.data();
        return mesh;
    }
};

inline pelagic_hull_options hull_options(double mass_kg) {
    auto options = pelagic_hull_options_make();
    options.mass_kg = mass_kg;
    return options;
}

struct DestroyHull {
    void operator()(pelagic_hull* hull) const { pelagic_hull_destroy(hull); }
};
using CHull = std::unique_ptr<pelagic_hull, DestroyHull>;

inline CHull hull_of(const HullArrays& arrays, const pelagic_hull_options& options) {
    const pelagic_hull_mesh mesh = arrays.mesh();
    pelagic_hull* hull = nullptr;
    EXPECT_EQ(pelagic_hull_create(&mesh, &options, &hull), PELAGIC_OK) << pelagic_last_error();
    return CHull(hull);
}

inline CHull boat_of(double length_m, double beam_m, double height_m, double mass_kg) {
    return hull_of(HullArrays(boat_mesh(length_m, beam_m, height_m)), hull_options(mass_kg));
}

inline pelagic_hull_state at_rest(const CHull& hull, double x_m, double z_m, double heading_rad = 0) {
    pelagic_hull_state state{};
    EXPECT_EQ(pelagic_hull_at_rest(hull.get(), x_m, z_m, heading_rad, &state), PELAGIC_OK) << pelagic_last_error();
    return state;
}

/// Returns the first value that differs, or an empty string.
inline std::string difference(const pelagic_hull_state& c, const HullState& cpp) {
    for (int axis = 0; axis < 3; ++axis) {
        if (c.position_m[axis] != cpp.position_m[axis]) return "position_m";
        if (c.velocity_mps[axis] != cpp.velocity_mps[axis]) return "velocity_mps";
        if (c.wake_rotation_radps[axis] != cpp.wake_rotation_radps[axis]) return "wake_rotation_radps";
        if (c.angular_velocity_radps[axis] != cpp.angular_velocity_radps[axis]) return "angular_velocity_radps";
    }
    const glm::dquat& q = cpp.orientation;
    if (c.orientation[0] != q.x || c.orientation[1] != q.y || c.orientation[2] != q.z || c.orientation[3] != q.w)
        return "orientation";
    if (c.wake_velocity_y_mps != cpp.wake_velocity_y_mps) return "wake_velocity_y_mps";
    if (c.submersion != cpp.submersion) return "submersion";
    return (c.has_previous_step != 0) == cpp.has_previous_step ? "" : "has_previous_step";
}

}  // namespace pelagic
