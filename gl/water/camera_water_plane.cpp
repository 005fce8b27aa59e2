#include "pelagic/gl/water/camera_water_plane.hpp"

#include <array>

namespace pelagic::gl {

CameraWaterPlane camera_water_plane(const SurfaceQuery& query, glm::dvec3 viewer_m, double apart_m) {
    const double half = apart_m / 2;
    const std::array<double, 5> x{viewer_m.x, viewer_m.x - half, viewer_m.x + half, viewer_m.x, viewer_m.x};
    const std::array<double, 5> z{viewer_m.z, viewer_m.z, viewer_m.z, viewer_m.z - half, viewer_m.z + half};
    std::array<float, 5> height{};
    query.sample({x, z}, {.height_m = height});
    return {
        static_cast<double>(height[0]),
        {static_cast<double>(height[2] - height[1]) / apart_m, static_cast<double>(height[4] - height[3]) / apart_m}};
}

}  // namespace pelagic::gl
