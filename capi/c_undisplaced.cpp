// C interface of water at undisplaced positions.
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/drawn_water.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic::capi {
namespace {

/// Arrays of the application, of which each may be null.
struct UndisplacedSamples {
    double* displacement_m;
    float* velocity_mps;
    float* foam;
};

/// Writes point i. Velocity and foam of dynamic waves and a shore are those of the drawn position.
void sample_point(const Frame& frame, const FoamSampler& foam, double x_m, double z_m, std::size_t i,
                  const UndisplacedSamples& out) {
    const DrawnWater drawn = drawn_water(frame, x_m, z_m);
    const Displacement& d = drawn.displacement;
    const double x = x_m + d.dx, z = z_m + d.dz;
    if (out.displacement_m) {
        out.displacement_m[3 * i] = d.dx;
        out.displacement_m[3 * i + 1] = d.height;
        out.displacement_m[3 * i + 2] = d.dz;
    }
    if (out.velocity_mps) {
        std::array<double, 3> sum = velocity_of_place(frame, x, z);
        for (std::size_t t = 0; t < frame.cascades.size(); ++t) {
            const Displacement speed = velocity_of(frame.cascades[t], x_m, z_m);
            const double weight{drawn.weights[t]};
            sum = {sum[0] + weight * speed.dx, sum[1] + weight * speed.height, sum[2] + weight * speed.dz};
        }
        for (std::size_t axis = 0; axis < 3; ++axis) out.velocity_mps[3 * i + axis] = static_cast<float>(sum[axis]);
    }
    if (out.foam) {
        const auto of_place = static_cast<float>(foam_of_place(frame, x, z));
        out.foam[i] = foam.has_foam() ? std::max(of_place, foam.at(x_m, z_m, drawn.weights)) : of_place;
    }
}

void check_positions(std::span<const double> positions, const char* axis) {
    constexpr double max_m = 1e9;  // at this distance doubles still resolve micrometres
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (!(std::fabs(positions[i]) <= max_m))
            reject(invalid_value_message("points." + std::string(axis) + "[" + number_text(i) + "]", positions[i],
                                         "[-1e9, 1e9]"));
}

void check_contents(const Frame& frame, const UndisplacedSamples& wanted) {
    if (!frame.cascades.front().height.data)
        reject("the frame has no planes: the ocean was created with pelagic_ocean_options.textures_only");
    if (wanted.velocity_mps && !frame.cascades.front().velocity_x.data)
        reject("the frame has no velocities: the ocean was created without PELAGIC_VELOCITIES_DRAWN");
    if (wanted.foam && !has_foam(frame))
        reject("the frame has no foam: the ocean was created without pelagic_ocean_options.foam");
}

}  // namespace
}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_ocean_sample_undisplaced(const pelagic_ocean* ocean, const pelagic_points* points,
                                                double* displacement_m, float* velocity_mps, float* foam) {
    return guarded([&] {
        const pelagic_points where = read_struct(points, "points");
        const QueryFrames::Reader reader(needed(ocean, "ocean").query_frames, where.frame);
        const Frame& frame = needed_frame(reader, where.frame);
        const UndisplacedSamples out{displacement_m, velocity_mps, foam};
        check_contents(frame, out);
        if (where.count == 0) return;
        const std::span<const double> x(&needed(where.x, "points.x"), where.count),
            z(&needed(where.z, "points.z"), where.count);
        check_positions(x, "x");
        check_positions(z, "z");
        const DefaultFloatEnvironment environment;
        const FoamSampler sampler(frame);
        for (std::size_t i = 0; i < where.count; ++i) sample_point(frame, sampler, x[i], z[i], i, out);
    });
}
