#include "pelagic/gl/sky/cube.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace pelagic::gl {
namespace {

/// Returns the direction through a point of a face, not normalised (OpenGL ES 3.0, table 3.21).
/// \param s  [-1, 1]
/// \param t  [-1, 1]
glm::vec3 face_direction(int face, float s, float t) {
    switch (face) {
        case 0: return {1, -t, -s};
        case 1: return {-1, -t, s};
        case 2: return {s, 1, t};
        case 3: return {s, -1, -t};
        case 4: return {s, -t, 1};
        default: return {-s, -t, -1};
    }
}

struct FacePoint {
    int face;
    float s, t;
};

FacePoint face_of(glm::vec3 d) {
    const glm::vec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z)
        return d.x > 0 ? FacePoint{0, -d.z / a.x, -d.y / a.x} : FacePoint{1, d.z / a.x, -d.y / a.x};
    if (a.y >= a.z) return d.y > 0 ? FacePoint{2, d.x / a.y, d.z / a.y} : FacePoint{3, d.x / a.y, -d.z / a.y};
    return d.z > 0 ? FacePoint{4, d.x / a.z, -d.y / a.z} : FacePoint{5, -d.x / a.z, -d.y / a.z};
}

}  // namespace

glm::vec3 Cube::direction(int face, int x, int y) const {
    const float scale = 2.f / static_cast<float>(side);
    return glm::normalize(
        face_direction(face, (static_cast<float>(x) + 0.5f) * scale - 1, (static_cast<float>(y) + 0.5f) * scale - 1));
}

glm::vec3 Cube::sample(glm::vec3 d) const {
    const FacePoint p = face_of(d);
    const float half = 0.5f * static_cast<float>(side), last = static_cast<float>(side - 1);
    const float x = std::clamp((p.s + 1) * half - 0.5f, 0.f, last);
    const float y = std::clamp((p.t + 1) * half - 0.5f, 0.f, last);
    const int x0 = std::min(static_cast<int>(x), std::max(0, side - 2)), x1 = std::min(x0 + 1, side - 1);
    const int y0 = std::min(static_cast<int>(y), std::max(0, side - 2)), y1 = std::min(y0 + 1, side - 1);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    return glm::mix(glm::mix(at(p.face, x0, y0), at(p.face, x1, y0), fx),
                    glm::mix(at(p.face, x0, y1), at(p.face, x1, y1), fx), fy);
}

}  // namespace pelagic::gl
