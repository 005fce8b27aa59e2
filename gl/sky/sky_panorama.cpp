#include "pelagic/gl/sky/sky_panorama.hpp"

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "pelagic/gl/sky/cube.hpp"

namespace pelagic::gl {
namespace {

using std::numbers::pi;

/// Returns level 0 as floats.
Cube finest_level(const Sky& sky) {
    Cube cube(sky.face_size);
    auto* to = cube.texels.data();
    for (int face = 0; face < 6; ++face) {
        const std::span<const std::uint16_t> halves = sky.face(0, face);
        for (std::size_t i = 0; i < halves.size(); i += 4)
            *to++ = {glm::unpackHalf1x16(halves[i]), glm::unpackHalf1x16(halves[i + 1]),
                     glm::unpackHalf1x16(halves[i + 2])};
    }
    return cube;
}

}  // namespace

std::vector<float> panorama_of(const Sky& sky, int width, int height) {
    const Cube cube = finest_level(sky);
    std::vector<float> pixels;
    pixels.reserve(std::size_t{3} * width * height);
    for (int j = 0; j < height; ++j) {
        const double elevation = (0.5 - (j + 0.5) / height) * pi;
        for (int i = 0; i < width; ++i) {
            const double azimuth = ((i + 0.5) / width - 0.5) * 2 * pi;
            const glm::vec3 radiance =
                sky.unit * cube.sample({std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                                        std::cos(elevation) * std::sin(azimuth)});
            pixels.insert(pixels.end(), {radiance.x, radiance.y, radiance.z});
        }
    }
    return pixels;
}

}  // namespace pelagic::gl
