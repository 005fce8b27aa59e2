#include "pelagic/floating/hull_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double max_coordinate_m = 1000;

/// A mesh of the vertices that triangles use, those at equal positions merged, with the number of
/// each in the caller's mesh.
struct Merged {
    std::vector<glm::dvec3> vertices;
    std::vector<std::uint32_t> original;
    std::vector<HullMesh::Triangle> triangles;
};

Merged merged(std::span<const glm::dvec3> vertices, std::span<const HullMesh::Triangle> triangles) {
    Merged mesh;
    std::map<std::tuple<double, double, double>, std::uint32_t> numbers;
    for (HullMesh::Triangle triangle : triangles) {
        for (std::uint32_t& vertex : triangle) {
            const glm::dvec3 at = vertices[vertex] + 0.0;  // -0 becomes 0
            const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
            const auto [place, is_new] = numbers.try_emplace({at.x, at.y, at.z}, next);
            if (is_new) {
                mesh.vertices.push_back(at);
                mesh.original.push_back(vertex);
            }
            vertex = place->second;
        }
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
            mesh.triangles.push_back(triangle);
    }
    return mesh;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Edge> directed_edges(const std::vector<HullMesh::Triangle>& triangles) {
    std::vector<Edge> edges;
    for (const auto& [a, b, c] : triangles) edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
    std::sort(edges.begin(), edges.end());
    return edges;
}

std::string check_edges(const Merged& mesh, std::size_t first_number) {
    const std::vector<Edge> edges = directed_edges(mesh.triangles);
    const auto ends = [&](Edge edge) {
        return std::to_string(first_number + mesh.original[edge.first]) + " and " +
               std::to_string(first_number + mesh.original[edge.second]);
    };
    const auto twice = std::adjacent_find(edges.begin(), edges.end());
    if (twice != edges.end())
        return "two triangles of the hull pass the edge between vertices " + ends(*twice) +
               " in the same direction, expected a consistent winding and two triangles an edge";
    for (const Edge& edge : edges)
        if (!std::binary_search(edges.begin(), edges.end(), Edge{edge.second, edge.first}))
            return "the hull is open at the edge between vertices " + ends(edge) +
                   ", expected a closed mesh (close an open boat with a lid)";
    return {};
}

/// Sums over the tetrahedra between the origin and the triangles.
struct Volume {
    explicit Volume(const Merged& mesh) {
        for (const auto& [a, b, c] : mesh.triangles) {
            const glm::dvec3 p = mesh.vertices[a], q = mesh.vertices[b], r = mesh.vertices[c], sum = p + q + r;
            const double six = glm::dot(p, glm::cross(q, r));
            m3 += six / 6;
            first_moment_m4 += six / 24 * sum;
            const glm::dmat3 products = glm::outerProduct(p, p) + glm::outerProduct(q, q) + glm::outerProduct(r, r);
            second_moments_m5 += six / 120 * (products + glm::outerProduct(sum, sum));
        }
    }
    double m3 = 0;
    glm::dvec3 first_moment_m4{};
    glm::dmat3 second_moments_m5{0};
};

}  // namespace

std::string HullMesh::check_counts(std::size_t vertices, std::size_t triangles) {
    if (triangles < 4 || triangles > max_triangles)
        return "the hull has " + std::to_string(triangles) + " triangles, expected 4 to " +
               std::to_string(max_triangles);
    if (vertices > max_vertices)
        return "the hull has " + std::to_string(vertices) + " vertices, expected at most " +
               std::to_string(max_vertices);
    return {};
}

std::string HullMesh::check(std::span<const glm::dvec3> vertices, std::span<const Triangle> triangles,
                            std::size_t first_number) {
    if (std::string reason = check_counts(vertices.size(), triangles.size()); !reason.empty()) return reason;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::fabs(vertices[i][axis]) <= max_coordinate_m))
                return invalid_value_message("vertex " + std::to_string(first_number + i) + ": " + "xyz"[axis],
                                             vertices[i][axis], "[-1000, 1000] m");
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const std::uint32_t vertex : triangles[i])
            if (vertex >= vertices.size())
                return "triangle " + std::to_string(i) + " of the hull has vertex " +
                       std::to_string(first_number + vertex) + ", expected less than " +
                       std::to_string(first_number + vertices.size());
    const Merged mesh = merged(vertices, triangles);
    if (std::string reason = check_edges(mesh, first_number); !reason.empty()) return reason;
    const double volume_m3 = Volume(mesh).m3;
    if (volume_m3 < 0)
        return "the hull's volume is " + number_text(volume_m3) + " m^3: its triangles are wound inwards";
    if (!(volume_m3 >= 1e-9))
        return "the hull's volume is " + number_text(volume_m3) + " m^3, expected at least 1e-9";
    return {};
}

HullMesh::HullMesh(std::span<const glm::dvec3> vertices, std::span<const Triangle> triangles) {
    const DefaultFloatEnvironment environment;
    require(check(vertices, triangles));
    Merged mesh = merged(vertices, triangles);
    const Volume volume(mesh);
    volume_m3_ = volume.m3;
    centre_m_ = volume.first_moment_m4 / volume.m3;
    second_moments_m5_ = volume.second_moments_m5 - volume.m3 * glm::outerProduct(centre_m_, centre_m_);
    vertices_ = std::move(mesh.vertices);
    triangles_ = std::move(mesh.triangles);
    lower_m_ = upper_m_ = vertices_[triangles_[0][0]];
    for (const Triangle& triangle : triangles_)
        for (const std::uint32_t vertex : triangle) {
            lower_m_ = glm::min(lower_m_, vertices_[vertex]);
            upper_m_ = glm::max(upper_m_, vertices_[vertex]);
        }
}

}  // namespace pelagic
