// Displacement, velocity and foam of water at reference positions, for meshes of many vertices that
// move every frame.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/drawn_water.hpp"
#include "pelagic/python/bindings/frame_handle.hpp"
#include "pelagic/python/bindings/option_fields.hpp"
#include "pelagic/sim/cascade_sum.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

constexpr double farthest_m = 1e9;  // at this distance doubles still resolve micrometres

/// Outputs of points in order; null: not wanted. Each call appends.
struct Outputs {
    float *displacement, *velocity, *foam;
};

/// Appends the values of one point. Velocities and foam of dynamic waves and a shore are those of a
/// query at the drawn position.
void sample_point(const Frame& frame, const FoamSampler& foam, double x_m, double z_m, Outputs& out) {
    const DrawnWater drawn = drawn_water(frame, x_m, z_m);
    const Displacement& d = drawn.displacement;
    for (const double part : {d.dx, d.height, d.dz}) *out.displacement++ = static_cast<float>(part);
    const double x = x_m + d.dx, z = z_m + d.dz;
    if (out.velocity) {
        std::array<double, 3> sum = velocity_of_place(frame, x, z);
        for (std::size_t t = 0; t < frame.cascades.size(); ++t) {
            const Displacement speed = velocity_of(frame.cascades[t], x_m, z_m);
            const double weight{drawn.weights[t]};
            sum = {sum[0] + weight * speed.dx, sum[1] + weight * speed.height, sum[2] + weight * speed.dz};
        }
        for (const double part : sum) *out.velocity++ = static_cast<float>(part);
    }
    if (out.foam) {
        const auto of_place = static_cast<float>(foam_of_place(frame, x, z));
        *out.foam++ = foam.has_foam() ? std::max(of_place, foam.at(x_m, z_m, drawn.weights)) : of_place;
    }
}

py::dict sample_undisplaced(const FrameHandle& handle, const Doubles& points) {
    const auto reader = handle.read();
    if (points.ndim() != 2 || points.shape(1) != 2)
        throw std::invalid_argument("points has another shape, expected (n, 2): x and z of each point");
    const py::ssize_t count = points.shape(0);
    const Frame& frame = handle.frame;
    need_planes(frame);
    const bool has_velocities = frame.cascades.front().velocity_x.data != nullptr, foam_is_there = has_foam(frame);
    py::array_t<float> displacement({count, py::ssize_t{3}}), velocity({has_velocities ? count : 0, py::ssize_t{3}});
    py::array_t<float> foam(foam_is_there ? count : 0);
    Outputs out = {.displacement = displacement.mutable_data(),
                   .velocity = has_velocities ? velocity.mutable_data() : nullptr,
                   .foam = foam_is_there ? foam.mutable_data() : nullptr};
    const double* at = points.data();
    {
        const py::gil_scoped_release others_run;
        const FoamSampler foam_sampler(frame);
        for (py::ssize_t point = 0; point < count; ++point, at += 2) {
            if (!(std::fabs(at[0]) <= farthest_m && std::fabs(at[1]) <= farthest_m))
                throw std::invalid_argument(invalid_value_message("points[" + number_text(point) + "]",
                                                                  number_text(at[0]) + ", " + number_text(at[1]),
                                                                  "metres in [-1e9, 1e9]"));
            sample_point(frame, foam_sampler, at[0], at[1], out);
        }
    }
    py::dict results;
    results["displacement"] = displacement;
    if (has_velocities) results["velocity"] = velocity;
    if (foam_is_there) results["foam"] = foam;
    return results;
}

}  // namespace

void add_reference_points(FrameClass& frame) {
    frame.def("sample_undisplaced", &sample_undisplaced, py::arg("points"), doc_of("Frame.sample_undisplaced"));
}

}  // namespace pelagic::python
