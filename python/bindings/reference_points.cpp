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
#include "pelagic/sim/query/foam_at.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Planes = PlaneView Cascade::*[3];

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
        std::int64_t x, z;
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
        return {upper + left, upper + right, lower + left, lower + right, i, j, x - column, z - row};
    }

    /// Returns planes, bilinear between texels, in double, as surface/cascade_sum.hpp does.
    Displacement at(const Planes& planes, const Cell& cell) const {
        const auto between = [&](PlaneView Cascade::*which) {
            const float* plane = (cascade_.*which).data;
            const double upper_left = static_cast<double>(plane[cell.upper_left]);
            const double lower_left = static_cast<double>(plane[cell.lower_left]);
            const double upper = upper_left + cell.u * (static_cast<double>(plane[cell.upper_right]) - upper_left);
            const double lower = lower_left + cell.u * (static_cast<double>(plane[cell.lower_right]) - lower_left);
            return upper + cell.v * (lower - upper);
        };
        return {between(planes[0]), between(planes[1]), between(planes[2])};
    }

    double foam(const Cell& cell) const { return foam_at(cascade_, cell.x, cell.z, cell.u, cell.v); }

   private:
    const Cascade& cascade_;
    double texels_per_m_;
    std::vector<std::ptrdiff_t> columns_;  ///< offset of each column, in floats
};

constexpr Planes displacements = {&Cascade::dx, &Cascade::height, &Cascade::dz};
constexpr Planes velocities = {&Cascade::velocity_x, &Cascade::velocity_y, &Cascade::velocity_z};
constexpr double farthest_m = 1e9;  // at this distance doubles still resolve micrometres

/// Samples a frame at one reference position after the other.
class ReferenceSampler {
   public:
    explicit ReferenceSampler(const Frame& frame)
        : frame_(frame),
          has_cascade_foam_(!frame.cascades.front().foam_r8.empty()),
          cascades_(frame.cascades.begin(), frame.cascades.end()) {}

    void move_to(double x_m, double z_m) {
        x_m_ = x_m, z_m_ = z_m;
        for (std::size_t t = 0; t < cascades_.size(); ++t) {
            cells_[t] = cascades_[t].cell_at(x_m, z_m);
            of_cascades_[t] = cascades_[t].at(displacements, cells_[t]);
        }
        drawn_ = drawn_water(frame_, x_m, z_m, {of_cascades_.data(), cascades_.size()});
    }

    const Displacement& displacement() const { return drawn_.displacement; }

    /// Returns the velocity along x, y and z, m/s, as queries do. \pre the frame has velocities
    std::array<double, 3> velocity() const {
        std::array<double, 3> sum{};
        for (std::size_t t = 0; t < cascades_.size(); ++t) {
            const Displacement one = cascades_[t].at(velocities, cells_[t]);
            sum[0] += drawn_.weights[t] * one.dx;
            sum[1] += drawn_.weights[t] * one.height;
            sum[2] += drawn_.weights[t] * one.dz;
        }
        sum[1] += sample(frame_.dynamic_waves, drawn_x(), drawn_z()).vertical_velocity_mps;
        if (!frame_.shore) return sum;
        const ShoreAt shore(frame_.shore, drawn_x(), drawn_z());
        const auto [x_mps, z_mps] = shore.velocity();
        sum[0] += x_mps;
        sum[1] += shore.cubic(frame_.shore.vertical_velocity_mps).value;
        sum[2] += z_mps;
        return sum;
    }

    /// Returns the foam in [0, 1]. \pre has_foam(frame)
    double foam() const {
        double max = foam_of_place(frame_, drawn_x(), drawn_z());
        if (has_cascade_foam_)
            for (std::size_t t = 0; t < cascades_.size(); ++t)
                max = std::max(max, drawn_.weights[t] * cascades_[t].foam(cells_[t]));
        return max;
    }

   private:
    double drawn_x() const { return x_m_ + drawn_.displacement.dx; }
    double drawn_z() const { return z_m_ + drawn_.displacement.dz; }

    const Frame& frame_;
    bool has_cascade_foam_;
    std::vector<ReferenceCascade> cascades_;
    std::array<ReferenceCascade::Cell, max_cascades> cells_{};
    std::array<Displacement, max_cascades> of_cascades_{};
    double x_m_ = 0, z_m_ = 0;
    DrawnWater drawn_{};
};

py::dict sample_undisplaced(const FrameHandle& handle, const Doubles& points) {
    const auto reader = handle.read();
    if (points.ndim() != 2 || points.shape(1) != 2)
        throw std::invalid_argument("points has another shape, expected (n, 2): x and z of each point");
    const py::ssize_t count = points.shape(0);
    const Frame& frame = handle.frame;
    const bool has_velocities = frame.cascades.front().velocity_x.data != nullptr, foam_is_there = has_foam(frame);
    py::array_t<float> displacement({count, py::ssize_t{3}}), velocity({has_velocities ? count : 0, py::ssize_t{3}});
    py::array_t<float> foam(foam_is_there ? count : 0);
    float *moved = displacement.mutable_data(), *moves = velocity.mutable_data(), *white = foam.mutable_data();
    const double* at = points.data();
    {
        const py::gil_scoped_release others_run;
        ReferenceSampler sampler(frame);
        for (py::ssize_t point = 0; point < count; ++point, at += 2) {
            if (!(std::fabs(at[0]) <= farthest_m && std::fabs(at[1]) <= farthest_m))
                throw std::invalid_argument(invalid_value_message("points[" + number_text(point) + "]",
                                                                  number_text(at[0]) + ", " + number_text(at[1]),
                                                                  "metres in [-1e9, 1e9]"));
            sampler.move_to(at[0], at[1]);
            const Displacement& d = sampler.displacement();
            for (const double part : {d.dx, d.height, d.dz}) *moved++ = static_cast<float>(part);
            if (has_velocities)
                for (const double part : sampler.velocity()) *moves++ = static_cast<float>(part);
            if (foam_is_there) *white++ = static_cast<float>(sampler.foam());
        }
    }
    py::dict answers;
    answers["displacement"] = displacement;
    if (has_velocities) answers["velocity"] = velocity;
    if (foam_is_there) answers["foam"] = foam;
    return answers;
}

}  // namespace

void add_reference_points(FrameClass& frame) {
    frame.def("sample_undisplaced", &sample_undisplaced, py::arg("points"), doc_of("Frame.sample_undisplaced"));
}

}  // namespace pelagic::python
