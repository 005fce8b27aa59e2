// What a frame does to points of water by where they rest: how far they are moved, how fast they move, how much foam floats on them. A
// mesh whose vertices rest asks for all at once and often, so a cascade's cells are found once for all of its planes.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <string>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/frame_handle.hpp"
#include "pelagic/sim/query/foam_at.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Planes = PlaneView Cascade::*[3];

/// One cascade, as many points read it.
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
        std::int64_t x, z;
        double u, v;  ///< where in it, [0, 1]
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
        return {upper + left, upper + right, lower + left, lower + right, i, j, x - column, z - row};
    }

    /// As surface/cascade_sum.hpp adds it: bilinear between texels, in double.
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

    double foam(const Cell& cell) const { return foam_at(cascade_, cell.x, cell.z, cell.u, cell.v); }

   private:
    const Cascade& cascade_;
    double texels_per_m_;
    std::vector<std::ptrdiff_t> columns_;  ///< where each begins, in floats
};

constexpr Planes displacements = {&Cascade::dx, &Cascade::height, &Cascade::dz};
constexpr Planes velocities = {&Cascade::velocity_x, &Cascade::velocity_y, &Cascade::velocity_z};
constexpr double farthest_m = 1e9;  // at which doubles tell micrometres apart

py::dict sample_undisplaced(const FrameHandle& handle, const Doubles& points) {
    const auto reader = handle.read();
    if (points.ndim() != 2 || points.shape(1) != 2)
        throw std::invalid_argument("points has another shape, expected (n, 2): x and z of each point");
    const py::ssize_t count = points.shape(0);
    const Cascade& first = handle.frame.cascades.front();
    const bool has_velocities = first.velocity_x.data != nullptr, has_foam = !first.foam_r8.empty();
    py::array_t<float> displacement({count, py::ssize_t{3}}), velocity({has_velocities ? count : 0, py::ssize_t{3}});
    py::array_t<float> foam(has_foam ? count : 0);
    float *moved = displacement.mutable_data(), *moves = velocity.mutable_data(), *white = foam.mutable_data();
    const double* at = points.data();
    {
        const py::gil_scoped_release others_run;
        const std::vector<ReferenceCascade> cascades(handle.frame.cascades.begin(), handle.frame.cascades.end());
        for (py::ssize_t point = 0; point < count; ++point, at += 2) {
            if (!(std::fabs(at[0]) <= farthest_m && std::fabs(at[1]) <= farthest_m))
                throw std::invalid_argument(invalid_value_message("points[" + number_text(point) + "]",
                                                                  number_text(at[0]) + ", " + number_text(at[1]),
                                                                  "metres in [-1e9, 1e9]"));
            double sum[3] = {}, speed[3] = {}, max_foam = 0;
            for (const ReferenceCascade& cascade : cascades) {
                const ReferenceCascade::Cell cell = cascade.cell_at(at[0], at[1]);
                cascade.add(displacements, cell, sum);
                if (has_velocities) cascade.add(velocities, cell, speed);
                if (has_foam) max_foam = std::max(max_foam, cascade.foam(cell));
            }
            for (const double part : sum) *moved++ = static_cast<float>(part);
            if (has_velocities)
                for (const double part : speed) *moves++ = static_cast<float>(part);
            if (has_foam) *white++ = static_cast<float>(max_foam);
        }
    }
    py::dict answers;
    answers["displacement"] = displacement;
    if (has_velocities) answers["velocity"] = velocity;
    if (has_foam) answers["foam"] = foam;
    return answers;
}

}  // namespace

void add_reference_points(FrameClass& frame) {
    frame.def("sample_undisplaced", &sample_undisplaced, py::arg("points"), doc_of("Frame.sample_undisplaced"));
}

}  // namespace pelagic::python
