#include "pelagic/gl/meshes/boat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <initializer_list>
#include <numbers>
#include <numeric>
#include <vector>

namespace pelagic::gl {
namespace {

constexpr float hull_length = Boat::length_m, beam = Boat::beam_m, keel_m = -Boat::draught_m;

constexpr glm::vec3 antifouling(0.19f, 0.025f, 0.02f), white(0.72f, 0.71f, 0.67f), strake(0.02f, 0.09f, 0.16f),
    planks(0.33f, 0.20f, 0.10f), glass(0.02f, 0.035f, 0.045f), roof(0.46f, 0.10f, 0.03f), wood(0.24f, 0.13f, 0.06f);

/// A cross-section of the hull, m.
struct Section {
    float half;         ///< half the beam
    float keel, sheer;  ///< heights above the waterline
};

/// \param s  position along the hull, 0 at the transom, 1 at the stem
Section section_at(float s) {
    const float fullness =
        (1 - std::pow(std::max(0.f, (s - 0.3f) / 0.7f), 2.4f)) * (0.84f + 0.16f * std::min(1.f, s / 0.3f));
    return {beam / 2 * std::max(fullness, 0.012f), keel_m + 0.9f * std::pow(std::max(0.f, (s - 0.7f) / 0.3f), 2.5f),
            0.62f + 0.16f * (1 - s) * (1 - s) + 0.62f * std::pow(s, 2.6f)};
}

/// Returns a point of the hull.
/// \param s  position along the hull, 0 at the transom, 1 at the stem
/// \param v  position across the hull: -1 at the port gunwale, 0 at the keel, 1 at the starboard
/// gunwale
glm::vec3 hull_at(float s, float v) {
    const auto [half, keel, sheer] = section_at(s);
    const float t = std::abs(v);
    const float rake = 0.5f * std::pow(s, 8.f) * t;  // the stem leans forward
    const float out = std::pow(std::sin(t * std::numbers::pi_v<float> / 2), 0.75f);
    return {(s - 0.5f) * hull_length + rake, keel + (sheer - keel) * std::pow(t, 1.7f), std::copysign(half * out, v)};
}

glm::vec3 deck_at(float s, float v) {
    const auto [half, keel, sheer] = section_at(s);
    return {(s - 0.5f) * hull_length + 0.4f * std::pow(s, 8.f), sheer - 0.13f + 0.05f * (1 - v * v),
            v * half * 0.96f};
}

glm::vec3 hull_paint(float height, float v) {
    if (std::abs(v) > 0.925f) return wood;
    if (std::abs(v) > 0.85f) return strake;
    return height < 0.07f ? antifouling : white;
}

class Triangles {
   public:
    using Corners = std::array<glm::vec3, 4>;

    void quad(const Corners& at, const Corners& normals, glm::vec3 paint) {
        for (const std::size_t corner : {0, 1, 2, 0, 2, 3}) vertices.push_back({at[corner], normals[corner], paint});
    }

    void flat_quad(const Corners& at, glm::vec3 paint) {
        const glm::vec3 normal = glm::normalize(glm::cross(at[1] - at[0], at[3] - at[0]));
        quad(at, {normal, normal, normal, normal}, paint);
    }

    /// Adds a parametric surface with smooth normals.
    /// \param us, vs  parameters of the grid lines
    /// \param side  1 or -1: sign of the normals
    template <class Place, class Paint>
    void sheet(const Place& place, const std::vector<float>& us, const std::vector<float>& vs, float side,
               const Paint& paint) {
        const auto normal = [&](float u, float v) {
            const float e = 1e-3f;
            return side *
                   glm::normalize(glm::cross(place(u + e, v) - place(u - e, v), place(u, v + e) - place(u, v - e)));
        };
        for (std::size_t i = 0; i + 1 < us.size(); ++i)
            for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
                const glm::vec2 corners[] = {
                    {us[i], vs[j]}, {us[i + 1], vs[j]}, {us[i + 1], vs[j + 1]}, {us[i], vs[j + 1]}};
                Corners at, normals;
                float height = 0;
                for (std::size_t corner = 0; corner < 4; ++corner) {
                    at[corner] = place(corners[corner].x, corners[corner].y);
                    normals[corner] = normal(corners[corner].x, corners[corner].y);
                    height += at[corner].y / 4;
                }
                quad(at, normals, paint(height, (vs[j] + vs[j + 1]) / 2));
            }
    }

    /// Adds a box of four walls and a lid. The walls lean inwards by `lean` at the top.
    void box(glm::vec3 low, glm::vec3 high, float lean, glm::vec3 paint, glm::vec3 lid) {
        const auto ring = [&](float y, float in) {
            return Corners{glm::vec3(low.x + in, y, low.z + in), glm::vec3(high.x - in, y, low.z + in),
                           glm::vec3(high.x - in, y, high.z - in), glm::vec3(low.x + in, y, high.z - in)};
        };
        const Corners foot = ring(low.y, 0), top = ring(high.y, lean);
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t next = (i + 1) % 4;
            flat_quad({foot[next], foot[i], top[i], top[next]}, paint);
        }
        flat_quad({top[3], top[2], top[1], top[0]}, lid);
    }

    std::vector<MeshVertex> vertices;
};

std::vector<float> steps(float from, float to, int count) {
    std::vector<float> all;
    for (int i = 0; i <= count; ++i)
        all.push_back(from + (to - from) * static_cast<float>(i) / static_cast<float>(count));
    return all;
}

std::vector<MeshVertex> boat_vertices() {
    Triangles mesh;
    const std::vector<float> stations = steps(0.001f, 0.999f, 40);
    std::vector<float> strakes = steps(0.02f, 0.55f, 8);
    for (const float v : {0.6f, 0.65f, 0.7f, 0.75f, 0.8f, 0.85f, 0.88f, 0.925f, 0.965f, 1.f}) strakes.push_back(v);
    std::vector<float> port = strakes;
    for (float& v : port) v = -v;
    mesh.sheet(hull_at, stations, strakes, 1, hull_paint);
    mesh.sheet(hull_at, stations, port, 1, hull_paint);
    mesh.sheet(deck_at, stations, steps(-1, 1, 6), -1, [](float, float) { return planks; });
    for (std::size_t i = 1; i < strakes.size(); ++i) {  // the transom
        const float a = strakes[i - 1], b = strakes[i];
        mesh.flat_quad({hull_at(0, -a), hull_at(0, a), hull_at(0, b), hull_at(0, -b)},
                       hull_paint(hull_at(0, a).y, (a + b) / 2));
    }
    mesh.box({-1.7f, 0.55f, -0.78f}, {0.35f, 1.35f, 0.78f}, 0.03f, white, white);
    mesh.box({-1.67f, 1.35f, -0.75f}, {0.32f, 1.85f, 0.75f}, 0.07f, glass, glass);
    for (const float x : {-1.62f, -0.68f, 0.27f})  // posts between the windows
        for (const float z : {-0.7f, 0.7f})
            mesh.box({x - 0.05f, 1.3f, z - 0.05f}, {x + 0.05f, 1.87f, z + 0.05f}, 0, white, white);
    mesh.box({-1.8f, 1.85f, -0.86f}, {0.45f, 1.95f, 0.86f}, 0.05f, roof, roof);
    mesh.box({-0.995f, 1.95f, -0.045f}, {-0.905f, 3.4f, 0.045f}, 0, wood, wood);
    mesh.box({1.3f, 0.6f, -0.42f}, {2.f, 0.86f, 0.42f}, 0.05f, white, planks);
    return mesh.vertices;
}

std::vector<std::uint16_t> one_after_the_other(std::size_t count) {
    std::vector<std::uint16_t> indices(count);
    std::iota(indices.begin(), indices.end(), std::uint16_t{0});
    return indices;
}

LitMesh boat_mesh(const Functions& gl) {
    const std::vector<MeshVertex> vertices = boat_vertices();
    return {gl, vertices, one_after_the_other(vertices.size()), "boat.frag.glsl"};
}

/// Returns a closed surface with a point for each station and strake.
template <class Place>
Boat::Surface closed_surface(const std::vector<float>& stations, const std::vector<float>& strakes,
                             const Place& place) {
    Boat::Surface surface;
    for (const float s : stations)
        for (const float v : strakes) surface.vertices.emplace_back(place(s, v));
    const auto ring = static_cast<std::uint32_t>(strakes.size());
    const auto last = static_cast<std::uint32_t>(surface.vertices.size()) - ring;
    for (std::uint32_t first = 0; first < last; first += ring)
        for (std::uint32_t j = 0; j < ring; ++j) {  // the last one is the lid
            const std::uint32_t a = first + j, b = first + (j + 1) % ring;
            surface.triangles.insert(surface.triangles.end(), {{a, a + ring, b}, {b, a + ring, b + ring}});
        }
    for (std::uint32_t j = 1; j + 1 < ring; ++j)
        surface.triangles.insert(surface.triangles.end(), {{0, j, j + 1}, {last, last + j + 1, last + j}});
    return surface;
}

}  // namespace

Boat::Surface Boat::hull() { return closed_surface(steps(0, 1, 16), steps(-1, 1, 12), hull_at); }

Boat::Surface Boat::interior() {
    constexpr float planking_m = 0.05f;
    return closed_surface(steps(0.01f, 0.98f, 32), steps(-1, 1, 24), [](float s, float v) {
        glm::vec3 at = hull_at(s, v);
        at.y += planking_m * (1 - std::abs(v));
        at.z *= 1 - 2 * planking_m / beam;
        return at;
    });
}

Boat::Boat(const Functions& gl) : LitMesh(boat_mesh(gl)) {}

}  // namespace pelagic::gl
