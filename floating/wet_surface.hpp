// Triangles of a hull, cut at the waterline, and integrals over the wet ones.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "pelagic/floating/hull.hpp"

namespace pelagic {

using HullVertex = HullWorkspace::Vertex;

struct HullTriangle {
    const HullVertex &a, &b, &c;

    /// Returns the area along the outward normal.
    glm::dvec3 area_m2() const { return 0.5 * glm::cross(b.arm_m - a.arm_m, c.arm_m - a.arm_m); }
    glm::dvec3 centre_m() const { return third * (a.arm_m + b.arm_m + c.arm_m); }
    glm::dvec3 relative_mps() const { return third * (a.relative_mps + b.relative_mps + c.relative_mps); }

    static constexpr double third = 1.0 / 3;
};

/// Returns the point of zero depth between a vertex below the surface and one above it.
inline HullVertex at_waterline(const HullVertex& below, const HullVertex& above) {
    const double along = below.depth_m / (below.depth_m - above.depth_m);
    const auto between = [along](const auto& from, const auto& to) { return from + along * (to - from); };
    return {.arm_m = between(below.arm_m, above.arm_m),
            .relative_mps = between(below.relative_mps, above.relative_mps),
            .depth_m = 0,
            .head_m = 0,
            .rise_mps2 = between(below.rise_mps2, above.rise_mps2),
            .wake_m = between(below.wake_m, above.wake_m)};
}

/// Calls wet(triangle) for the parts below the surface and dry(triangle) for those above it.
/// Winding is kept.
template <class Wet, class Dry>
void cut_at_waterline(const HullTriangle& triangle, Wet&& wet, Dry&& dry) {
    const bool is_wet[] = {triangle.a.depth_m > 0, triangle.b.depth_m > 0, triangle.c.depth_m > 0};
    const int below = is_wet[0] + is_wet[1] + is_wet[2];
    if (below == 3) return wet(triangle);
    if (below == 0) return dry(triangle);
    // a is the only vertex on its side
    const HullVertex* const corners[] = {&triangle.a, &triangle.b, &triangle.c, &triangle.a, &triangle.b};
    std::size_t alone = 0;
    while (is_wet[alone] != (below == 1)) ++alone;
    const HullVertex &a = *corners[alone], &b = *corners[alone + 1], &c = *corners[alone + 2];
    const HullVertex ab = below == 1 ? at_waterline(a, b) : at_waterline(b, a);
    const HullVertex ac = below == 1 ? at_waterline(a, c) : at_waterline(c, a);
    const HullTriangle tip{a, ab, ac}, left{ab, b, c}, right{ab, c, ac};
    if (below == 1) return wet(tip), dry(left), dry(right);
    dry(tip), wet(left), wet(right);
}

/// Integrals over the wet surface of quantities that are linear on each triangle; exact. Those of the
/// depth d give the displaced volume and its waterplane, because a column from the bottom to the surface
/// meets both. Those of the head p / (rho g) give the pressure, and by Gauss' theorem the mean
/// acceleration of the water that the hull displaces. HullWake computes the force of its waves along
/// x and z, and their torque about y.
struct Hydrostatics {
    glm::dvec3 force_m3{};   ///< -integral n head: in still water the displaced volume, along y
    glm::dvec3 torque_m4{};  ///< of it about the centre of mass
    double volume_m3 = 0;    ///< displaced
    double volume_x_m4 = 0, volume_z_m4 = 0;  ///< its moments from the centre of mass
    double waterplane_m2 = 0, x_m3 = 0, z_m3 = 0, xx_m4 = 0, xz_m4 = 0, zz_m4 = 0;
    double depth_moment_m4 = 0;  ///< displaced volume times the mean depth in it

    /// \param area  triangle.area_m2()
    void add(const HullTriangle& triangle, const glm::dvec3& area) {
        const HullVertex &a = triangle.a, &b = triangle.b, &c = triangle.c;
        const glm::dvec3 arms = a.arm_m + b.arm_m + c.arm_m;
        const double heads = a.head_m + b.head_m + c.head_m;
        const double depths = a.depth_m + b.depth_m + c.depth_m;
        const double third = HullTriangle::third * area.y, twelfth = area.y * (1.0 / 12);
        force_m3 -= HullTriangle::third * heads * area;
        torque_m4 += glm::cross((1.0 / 12) * area,
                                heads * arms + a.head_m * a.arm_m + b.head_m * b.arm_m + c.head_m * c.arm_m);
        volume_m3 -= depths * third;
        const auto moment = [&](int i) {
            return depths * arms[i] + a.depth_m * a.arm_m[i] + b.depth_m * b.arm_m[i] + c.depth_m * c.arm_m[i];
        };
        volume_x_m4 -= twelfth * moment(0);
        volume_z_m4 -= twelfth * moment(2);
        waterplane_m2 -= area.y;
        x_m3 -= third * arms.x;
        z_m3 -= third * arms.z;
        const auto second = [&](int i, int j) {
            return twelfth *
                   (arms[i] * arms[j] + a.arm_m[i] * a.arm_m[j] + b.arm_m[i] * b.arm_m[j] + c.arm_m[i] * c.arm_m[j]);
        };
        xx_m4 -= second(0, 0);
        xz_m4 -= second(0, 2);
        zz_m4 -= second(2, 2);
        depth_moment_m4 -= twelfth / 2 *
                           (depths * depths + a.depth_m * a.depth_m + b.depth_m * b.depth_m + c.depth_m * c.depth_m);
    }

    /// Leaves out the force of waves that HullWake acts on along x and z, and its torque about y.
    void leave_out_wake(const HullTriangle& triangle, const glm::dvec3& area) {
        const HullVertex &a = triangle.a, &b = triangle.b, &c = triangle.c;
        const double wakes = a.wake_m + b.wake_m + c.wake_m;
        const glm::dvec3 moment = wakes * (a.arm_m + b.arm_m + c.arm_m) + a.wake_m * a.arm_m + b.wake_m * b.arm_m +
                                  c.wake_m * c.arm_m;
        force_m3 += HullTriangle::third * wakes * glm::dvec3(area.x, 0, area.z);
        torque_m4.y -= glm::cross(area, moment).y * (1.0 / 12);
    }
};

}  // namespace pelagic
