#include "pelagic/gl/meshes/rock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <vector>

namespace pelagic::gl {
namespace {

using std::numbers::pi_v;

constexpr int cells_around = 192, cells_down = 96;

/// Returns a deterministic pseudo-random value in [-1, 1] for a corner of the grid.
float value_at(glm::ivec3 corner) {
    std::uint32_t h = static_cast<std::uint32_t>(corner.x) * 0x8da6b343u ^
                      static_cast<std::uint32_t>(corner.y) * 0xd8163841u ^
                      static_cast<std::uint32_t>(corner.z) * 0xcb1ab31fu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return static_cast<float>(h >> 8) / 8388608.f - 1;
}

/// Value noise.
float noise(glm::vec3 at) {
    const glm::vec3 corner = glm::floor(at);
    const glm::vec3 t = at - corner, w = t * t * (3.f - 2.f * t);
    float sum = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 step(i & 1, i >> 1 & 1, i >> 2);
        const glm::vec3 weight = glm::mix(1.f - w, w, glm::vec3(step));
        sum += weight.x * weight.y * weight.z * value_at(glm::ivec3(corner) + step);
    }
    return sum;
}

/// Returns a point of the rock: an ellipsoid displaced by ridged noise in five octaves.
/// \param u  azimuth, rad
/// \param v  angle from the top, rad
glm::vec3 on_rock(float u, float v) {
    const glm::vec3 direction(std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u));
    float radius = 1, height = 0.3f;
    glm::vec3 at = 1.3f * direction + glm::vec3(3.7f, 1.1f, 8.2f);
    for (int octave = 0; octave < 5; ++octave, height *= 0.5f, at = 2.03f * at) {
        radius += height * (0.6f - 1.6f * std::abs(noise(at)));
    }
    // The base is below the water.
    return radius * direction * glm::vec3(6, direction.y > 0 ? 6 : 4, 5);
}

std::vector<MeshVertex> rock_vertices() {
    std::vector<MeshVertex> all;
    for (int j = 0; j <= cells_down; ++j)
        for (int i = 0; i <= cells_around; ++i) {
            const float u = 2 * pi_v<float> * static_cast<float>(i) / cells_around;
            // The azimuth is undefined at the poles.
            const float v = std::clamp(pi_v<float> * static_cast<float>(j) / cells_down, 1e-3f, pi_v<float> - 1e-3f);
            const float step = 0.5f * pi_v<float> / cells_down;
            const glm::vec3 along = on_rock(u + step, v) - on_rock(u - step, v),
                            below = on_rock(u, v + step) - on_rock(u, v - step);
            all.push_back({on_rock(u, v), glm::normalize(glm::cross(along, below)), {}});
        }
    return all;
}

std::vector<std::uint16_t> rock_indices() {
    std::vector<std::uint16_t> all;
    for (int j = 0; j < cells_down; ++j)
        for (int i = 0; i < cells_around; ++i) {
            const int corner = j * (cells_around + 1) + i;
            for (const int index :
                 {corner, corner + 1, corner + cells_around + 1, corner + 1, corner + cells_around + 2,
                  corner + cells_around + 1})
                all.push_back(static_cast<std::uint16_t>(index));
        }
    return all;
}

}  // namespace

Rock::Rock(const Functions& gl, glm::dvec3 foot_m)
    : mesh_(gl, rock_vertices(), rock_indices(), "rock.frag.glsl"),
      world_from_rock_(glm::translate(glm::dmat4(1), foot_m)) {}

}  // namespace pelagic::gl
