// Closed triangle meshes of hulls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace pelagic {

/// The outer surface of a hull: closed, wound counter-clockwise as seen from outside. An open boat
/// is closed by its deck, or by a lid at the gunwale. Axes: x forward, y up, z to starboard, in
/// metres.
///
/// Vertices at equal positions are merged, because files repeat a vertex for each of its normals,
/// and triangles that then have equal vertices are left out. Triangles of three collinear vertices
/// stay: they close edges, and have neither volume nor forces. Immutable, so any thread may read it.
class HullMesh {
   public:
    using Triangle = std::array<std::uint32_t, 3>;  ///< indices of vertices
    static constexpr std::size_t max_triangles = 4096;
    static constexpr std::size_t max_vertices = 3 * max_triangles;

    /// \throws std::invalid_argument  check(vertices, triangles), unless it is empty
    HullMesh(std::span<const glm::dvec3> vertices, std::span<const Triangle> triangles);

    /// Returns an empty string for a usable mesh, else what is wrong: "the hull is open at the edge
    /// between vertices 3 and 7". A mesh has 4 to 4096 triangles, coordinates in [-1000, 1000] m,
    /// for each edge exactly one triangle on both sides, and a positive volume.
    /// \param first_number  of the first vertex, in messages
    static std::string check(std::span<const glm::dvec3> vertices, std::span<const Triangle> triangles,
                             std::size_t first_number = 0);
    /// Returns what check() returns for these numbers, without reading a mesh.
    static std::string check_counts(std::size_t vertices, std::size_t triangles);

    /// Returns the merged vertices.
    const std::vector<glm::dvec3>& vertices() const { return vertices_; }
    /// Returns the triangles of three different vertices.
    const std::vector<Triangle>& triangles() const { return triangles_; }
    /// Returns the enclosed volume.
    double volume_m3() const { return volume_m3_; }
    glm::dvec3 centre_m() const { return centre_m_; }  ///< of the volume
    /// Returns the integral of (r - centre) (r - centre)^T over the volume, m^5.
    const glm::dmat3& second_moments_m5() const { return second_moments_m5_; }
    glm::dvec3 lower_m() const { return lower_m_; }  ///< least coordinates
    glm::dvec3 upper_m() const { return upper_m_; }  ///< greatest coordinates

   private:
    std::vector<glm::dvec3> vertices_;
    std::vector<Triangle> triangles_;
    double volume_m3_ = 0;
    glm::dvec3 centre_m_{}, lower_m_{}, upper_m_{};
    glm::dmat3 second_moments_m5_{0};
};

}  // namespace pelagic
