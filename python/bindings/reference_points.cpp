// Displacement, velocity and foam of water at reference positions, for meshes of many vertices that
// move every frame. The cell of a cascade is computed once for all of its planes.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/drawn_water.hpp"
#include "pelagic/python/bindings/frame_handle.hpp"
#include "pelagic/python/bindings/option_fields.hpp"
#include "pelagic/sim/query/foam_sampler.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

using Planes = PlaneView Cascade::*[3];

constexpr Planes displacement_planes = {&Cascade::dx, &Cascade::height, &Cascade::dz};
constexpr Planes velocity_planes = {&Cascade::velocity_x, &Cascade::velocity_y, &Cascade::velocity_z};

/// A cascade that is sampled at many points.
class ReferenceCascade {
   public:
    explicit ReferenceCascade(const Cascade& cascade)
        : cascade_(cascade), texels_per_m_(cascade.resolution() / cascade.grid.side_m) {
        const PlaneView& plane = cascade.height;
        for (int i = 0; i < plane.resolution; ++i)
            columns_.push_back(i / plane.block_columns * plane.block_stride + i % plane.block_columns);
    }

    struct Cell {
        std::ptrdiff_t upper_left, upper_right, lower_left, lower_right;  ///< in floats of a plane
        double u, v;  ///< position in the cell, [0, 1]
    };

    Cell cell_at(double x_m, double z_m) const {
        const CascadeGrid::Place place = cascade_.grid.in_cascade(x_m, z_m);
        const double x = place.along * texels_per_m_, z = place.across * texels_per_m_;
        const double column = std::floor(x), row = std::floor(z);
        const auto i = static_cast<std::int64_t>(column), j = static_cast<std::int64_t>(row);
        // The resolution is a power of two, so a mask wraps negative texels too.
        const std::int64_t mask = cascade_.resolution() - 1;
        const std::ptrdiff_t left = columns_[static_cast<std::size_t>(i & mask)];
        const std::ptrdiff_t right = columns_[static_cast<std::size_t>((i + 1) & mask)];
        const std::ptrdiff_t upper = (j & mask) * cascade_.height.row_stride;
        const std::ptrdiff_t lower = ((j + 1) & mask) * cascade_.height.row_stride;
        return {upper + left, upper + right, lower + left, lower + right, x - column, z - row};
    }

    /// Adds planes, bilinear between texels, in double, as surface/cascade_sum.hpp does.
    void add(const Planes& planes, const Cell& cell, double* sum) const {
        for (int part = 0; part < 3; ++part) {
            const float* plane = (cascade_.*planes[part]).data;
            const double upper_left = static_cast<double>(plane[cell.upper_left]);
            const double lower_left = static_cast<double>(plane[cell.lower_left]);
            const double upper = upper_left + cell.u * (static_cast<double>(plane[cell.upper_right]) - upper_left);
            const double lower = lower_left + cell.u * (static_cast<double>(plane[cell.lower_right]) - lower_left);
            sum[part] += upper + cell.v * (lower - upper);
        }
    }

   private:
    const Cascade& cascade_;
    double texels_per_m_;
    std::vector<std::ptrdiff_t> columns_;  ///< offset of each column, in floats
};

constexpr double farthest_m = 1e9;  // at this distance doubles still resolve micrometres

/// Outputs of points in order; null: not wanted. Each call appends.
struct Outputs {
    float *displacement, *velocity, *foam;
};

/// Samples a sea without dynamic waves and without a shore.
void sample_cascades(const std::vector<ReferenceCascade>& cascades, const FoamSampler& foam, double x_m, double z_m,
                     Outputs& out) {
    double sum[3] = {}, speed[3] = {};
    for (const ReferenceCascade& cascade : cascades) {
        const ReferenceCascade::Cell cell = cascade.cell_at(x_m, z_m);
        cascade.add(displacement_planes, cell, sum);
        if (out.velocity) cascade.add(velocity_planes, cell, speed);
    }
    for (const double part : sum) *out.displacement++ = static_cast<float>(part);
    if (out.velocity)
        for (const double part : speed) *out.velocity++ = static_cast<float>(part);
    if (out.foam) *out.foam++ = foam.at(x_m, z_m);
}

/// Samples a sea with dynamic waves or a shore. Velocities and foam are those of a query at the
/// drawn position.
void sample_all(const Frame& frame, const std::vector<ReferenceCascade>& cascades, const FoamSampler& foam,
                double x_m, double z_m, Outputs& out) {
    std::array<Displacement, max_cascades> of_cascades;
    std::array<std::array<double, 3>, max_cascades> speeds{};
    for (std::size_t t = 0; t < cascades.size(); ++t) {
        const ReferenceCascade::Cell cell = cascades[t].cell_at(x_m, z_m);
        double one[3] = {};
        cascades[t].add(displacement_planes, cell, one);
        of_cascades[t] = {one[0], one[1], one[2]};
        if (out.velocity) cascades[t].add(velocity_planes, cell, speeds[t].data());
    }
    const DrawnWater drawn = drawn_water(frame, x_m, z_m, {of_cascades.data(), cascades.size()});
    const Displacement& d = drawn.displacement;
    for (const double part : {d.dx, d.height, d.dz}) *out.displacement++ = static_cast<float>(part);
    const double x = x_m + d.dx, z = z_m + d.dz;
    if (out.velocity) {
        std::array<double, 3> sum = velocity_of_place(frame, x, z);
        for (std::size_t t = 0; t < cascades.size(); ++t)
            for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += double{drawn.weights[t]} * speeds[t][axis];
        for (const double part : sum) *out.velocity++ = static_cast<float>(part);
    }
    if (out.foam) {
        const auto of_place = static_cast<float>(foam_of_place(frame, x, z));
        *out.foam++ = foam.has_foam() ? std::max(of_place, foam.at(x_m, z_m, &drawn.weights)) : of_place;
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
        const std::vector<ReferenceCascade> cascades(frame.cascades.begin(), frame.cascades.end());
        const FoamSampler foam_sampler(frame);
        const bool has_cascades_only = !frame.dynamic_waves && !frame.shore;
        for (py::ssize_t point = 0; point < count; ++point, at += 2) {
            if (!(std::fabs(at[0]) <= farthest_m && std::fabs(at[1]) <= farthest_m))
                throw std::invalid_argument(invalid_value_message("points[" + number_text(point) + "]",
                                                                  number_text(at[0]) + ", " + number_text(at[1]),
                                                                  "metres in [-1e9, 1e9]"));
            if (has_cascades_only)
                sample_cascades(cascades, foam_sampler, at[0], at[1], out);
            else
                sample_all(frame, cascades, foam_sampler, at[0], at[1], out);
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
