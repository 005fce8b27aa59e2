#include "pelagic/tools/aov/aov.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr float depth_without_surface_m = 1e10f;
constexpr float floor_mark = -1;  // of gl::DrawMode::surface_data, in place of foam

std::vector<std::string> names_of_layer(Aov aov) {
    const auto vector = [](const std::string& layer) {
        return std::vector<std::string>{layer + ".X", layer + ".Y", layer + ".Z"};
    };
    switch (aov) {
        case Aov::depth: return {"depth.Z"};
        case Aov::normal: return vector("N");
        case Aov::foam: return {"foam.Y"};
        case Aov::velocity: return vector("velocity");
        case Aov::position: return vector("P");
    }
    return {};
}

/// Directions of the rays through the middles of an image's pixels.
class Rays {
   public:
    explicit Rays(const gl::Eye& eye)
        : eye_(eye), world_from_clip_(glm::inverse(eye.clip_from_world)), axis_(through(0, 0)) {}

    /// Returns the unit vector through a pixel; row 0 is at the top.
    glm::dvec3 of_pixel(int column, int row) const {
        return through(2 * (column + 0.5) / eye_.viewport.width - 1, 1 - 2 * (row + 0.5) / eye_.viewport.height);
    }
    const glm::dvec3& axis() const { return axis_; }  ///< of the camera

   private:
    glm::dvec3 through(double x, double y) const {
        const glm::dvec4 near = world_from_clip_ * glm::dvec4(x, y, -1, 1);
        return glm::normalize(glm::dvec3(near) / near.w - eye_.position_m);
    }

    const gl::Eye& eye_;
    glm::dmat4 world_from_clip_;
    glm::dvec3 axis_;
};

/// A pixel's surface.
struct Surface {
    glm::dvec3 position_m{}, normal{}, velocity_mps{};
    double depth_m = 0;  ///< 0: none
    double foam = 0;
    bool is_water = false;
};

std::vector<Surface> surfaces_in(std::span<const float> data, const gl::Eye& eye) {
    const Rays rays(eye);
    std::vector<Surface> surfaces(data.size() / 4);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const float* const texel = data.data() + 4 * i;
        if (!(texel[0] > 0)) continue;
        const auto width = static_cast<std::size_t>(eye.viewport.width);
        const glm::dvec3 ray = rays.of_pixel(static_cast<int>(i % width), static_cast<int>(i / width));
        Surface& surface = surfaces[i];
        surface.position_m = eye.position_m + double{texel[0]} * ray;
        surface.depth_m = texel[0] * glm::dot(ray, rays.axis());
        surface.normal = glm::normalize(glm::dvec3(texel[1], 1, texel[2]));
        surface.is_water = texel[3] != floor_mark;
        surface.foam = surface.is_water ? std::clamp(texel[3], 0.f, 1.f) : 0;
    }
    return surfaces;
}

void add_velocities(std::vector<Surface>& surfaces, const Frame& frame, SurfaceQueryJobs& jobs) {
    std::vector<double> x, z;
    for (const Surface& surface : surfaces)
        if (surface.is_water) x.push_back(surface.position_m.x), z.push_back(surface.position_m.z);
    std::vector<float> vx(x.size()), vy(x.size()), vz(x.size());
    jobs.sample(SurfaceQuery(frame), {x, z}, {.velocity_x_mps = vx, .velocity_y_mps = vy, .velocity_z_mps = vz});
    std::size_t at = 0;
    for (Surface& surface : surfaces) {
        if (!surface.is_water) continue;
        surface.velocity_mps = {vx[at], vy[at], vz[at]};
        ++at;
    }
}

}  // namespace

std::vector<Aov> parse_aovs(const std::string& option, const std::string& text) {
    std::vector<Aov> aovs;
    for (const std::string& name : split_at_commas(text)) {
        const Aov aov = one_of<Aov>(option, name);
        if (std::ranges::find(aovs, aov) != aovs.end()) throw bad_value(option, text, "each layer once");
        aovs.push_back(aov);
    }
    return aovs;
}

std::vector<std::string> channel_names(std::span<const Aov> aovs) {
    std::vector<std::string> all;
    for (const Aov aov : aovs)
        for (std::string& name : names_of_layer(aov)) all.push_back(std::move(name));
    return all;
}

std::vector<float> aov_pixels(std::span<const Aov> aovs, std::span<const float> data, const gl::Eye& eye,
                              const Frame& frame, SurfaceQueryJobs& jobs) {
    std::vector<Surface> surfaces = surfaces_in(data, eye);
    if (std::ranges::find(aovs, Aov::velocity) != aovs.end()) add_velocities(surfaces, frame, jobs);
    std::vector<float> values;
    values.reserve(surfaces.size() * channel_names(aovs).size());
    const auto add = [&](const glm::dvec3& v) {
        for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(v[axis]));
    };
    for (const Surface& surface : surfaces)
        for (const Aov aov : aovs) switch (aov) {
                case Aov::depth:
                    values.push_back(surface.depth_m > 0 ? static_cast<float>(surface.depth_m)
                                                         : depth_without_surface_m);
                    break;
                case Aov::normal: add(surface.normal); break;
                case Aov::foam: values.push_back(static_cast<float>(surface.foam)); break;
                case Aov::velocity: add(surface.velocity_mps); break;
                case Aov::position: add(surface.position_m); break;
            }
    return values;
}

}  // namespace pelagic::tools
