#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/frame_handle.hpp"
#include "pelagic/python/bindings/sea_fields.hpp"
#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/statistics.hpp"

namespace py = pybind11;

namespace pelagic::python {

void need_foam(const Frame& frame) {
    if (!frame.has_foam) throw std::invalid_argument("the frame has no foam: create the ocean with foam=True");
}

void need_planes(const Frame& frame) {
    if (!frame.cascades.front().height.data)
        throw std::invalid_argument("the frame has no planes: create the ocean with planes=True");
}

py::array view_of(const FrameHandle& handle, const py::dtype& type, Shape shape, const void* data) {
    auto view = std::make_unique<SharedOcean::View>(handle.ocean, handle.number);
    const py::capsule owner(view.get(), [](void* held) { delete static_cast<SharedOcean::View*>(held); });
    view.release();
    py::array array(type, std::move(shape), data, owner);
    array.attr("flags").attr("writeable") = false;
    return array;
}

namespace {

py::array halves_of(const CascadeHandle& handle) {
    const auto reader = handle.of->read();
    const Cascade& cascade = handle.cascade();
    const py::ssize_t side = cascade.resolution();
    return view_of(*handle.of, py::dtype("e"), {side, side, 4}, cascade.displacement_rgba16f.data());
}

/// Returns a plane's blocks as an array that the caller owns.
py::array plane_of(const CascadeHandle& handle, PlaneView Cascade::*plane, const char* option) {
    const auto reader = handle.of->read();
    const PlaneView& from = handle.cascade().*plane;
    if (!from.data)
        throw std::invalid_argument(std::string("the frame does not have it: create the ocean with ") + option);
    const py::ssize_t side = from.resolution;
    py::array_t<float> array({side, side});
    float* const out = array.mutable_data();
    {
        const py::gil_scoped_release others_run;
        copy_plane(from, {out, static_cast<std::size_t>(array.size())});
    }
    return array;
}

/// A chain of mip levels with one texel in a word.
using Chain = std::span<const std::uint32_t> Cascade::*;

/// Returns one level of a chain, (N, N, 4) bytes.
py::array level_of(const CascadeHandle& handle, Chain chain, int level, const char* option) {
    const auto reader = handle.of->read();
    const Cascade& cascade = handle.cascade();
    if ((cascade.*chain).empty())
        throw std::invalid_argument(std::string("the frame does not have it: create the ocean with ") + option);
    if (level < 0 || level >= mip_levels(cascade.resolution()))
        throw std::invalid_argument(
            invalid_value_message("level", level, "0 to " + number_text(mip_levels(cascade.resolution()) - 1)));
    const py::ssize_t side = cascade.resolution() >> level;
    return view_of(*handle.of, py::dtype("u1"), {side, side, 4}, cascade.level_of(cascade.*chain, level).data());
}

/// Returns the bytes of compression; None for a cascade whose compression makes no foam.
py::object compression_of(const CascadeHandle& handle) {
    const auto reader = handle.of->read();
    need_foam(handle.of->frame);
    const Cascade& cascade = handle.cascade();
    const py::ssize_t side = cascade.resolution();
    if (cascade.compression_r8.empty()) return py::none();
    return view_of(*handle.of, py::dtype("u1"), {side, side}, cascade.compression_r8.data());
}

/// Returns the images of snapshots; None for a cascade whose compression makes no foam.
py::object snapshots_of(const CascadeHandle& handle) {
    const auto reader = handle.of->read();
    need_foam(handle.of->frame);
    const Cascade& cascade = handle.cascade();
    const py::ssize_t side = cascade.resolution();
    if (cascade.snapshots_rgba8[0].empty()) return py::none();
    py::list images;
    for (const std::span<const std::uint32_t> image : cascade.snapshots_rgba8)
        images.append(view_of(*handle.of, py::dtype("u1"), {side, side, 4}, image.data()));
    return py::tuple(images);
}

std::vector<CascadeHandle> cascade_handles_of(const std::shared_ptr<FrameHandle>& frame) {
    const auto reader = frame->read();
    std::vector<CascadeHandle> cascades;
    for (std::size_t i = 0; i < frame->frame.cascades.size(); ++i) cascades.push_back({frame, i});
    return cascades;
}

/// Wraps a slow function so that other threads run meanwhile.
template <class Result>
auto on_frame(Result (*of)(const Frame&)) {
    return [of](const FrameHandle& handle) {
        const auto reader = handle.read();
        const py::gil_scoped_release others_run;
        return of(handle.frame);
    };
}

std::uint64_t checked_foam_hash(const FrameHandle& handle) {
    const auto reader = handle.read();
    need_foam(handle.frame);
    const py::gil_scoped_release others_run;
    return foam_hash_of(handle.frame);
}

std::string bounds_text(const FrameBounds& bounds) {
    return "Bounds(height_min_m=" + number_text(bounds.height_min_m) +
           ", height_max_m=" + number_text(bounds.height_max_m) +
           ", horizontal_x_max_m=" + number_text(bounds.horizontal_x_max_m) +
           ", horizontal_z_max_m=" + number_text(bounds.horizontal_z_max_m) + ")";
}

/// Wraps a value of a frame's cascades, read while their memory is valid.
template <class Value>
auto of_cascade(Value (*get)(const Cascade&)) {
    return [get](const CascadeHandle& handle) {
        const auto reader = handle.of->read();
        return get(handle.cascade());
    };
}

CascadeHandle first_cascade(const std::shared_ptr<FrameHandle>& frame) { return {frame, 0}; }

auto plane_getter(PlaneView Cascade::*plane, const char* option) {
    return [=](const CascadeHandle& handle) { return plane_of(handle, plane, option); };
}

void add_chain(py::class_<CascadeHandle>& cascade, const std::string& name, Chain chain, const char* option) {
    const std::string of_level = name + "_level";
    cascade.def_property_readonly(
        name.c_str(), [=](const CascadeHandle& handle) { return level_of(handle, chain, 0, option); },
        doc_of(("Cascade." + name).c_str()));
    cascade.def(
        of_level.c_str(),
        [=](const CascadeHandle& handle, int level) { return level_of(handle, chain, level, option); },
        py::arg("level"), doc_of(("Cascade." + of_level).c_str()));
}

void add_bounds(py::module_& module) {
    py::class_<FrameBounds> bounds(module, "Bounds", doc_of("Bounds"));
    add(bounds, "height_min_m", [](const FrameBounds& of) { return of.height_min_m; });
    add(bounds, "height_max_m", [](const FrameBounds& of) { return of.height_max_m; });
    add(bounds, "horizontal_x_max_m", [](const FrameBounds& of) { return of.horizontal_x_max_m; });
    add(bounds, "horizontal_z_max_m", [](const FrameBounds& of) { return of.horizontal_z_max_m; });
    bounds.def("__repr__", &bounds_text);
}

void add_cascade(py::module_& module) {
    py::class_<CascadeHandle> cascade(module, "Cascade", doc_of("Cascade"));
    add(cascade, "displacement", &halves_of);
    add(cascade, "height", plane_getter(&Cascade::height, "planes=True"));
    add(cascade, "dx", plane_getter(&Cascade::dx, "planes=True"));
    add(cascade, "dz", plane_getter(&Cascade::dz, "planes=True"));
    add(cascade, "velocity_x", plane_getter(&Cascade::velocity_x, "velocities=True"));
    add(cascade, "velocity_y", plane_getter(&Cascade::velocity_y, "velocities=True"));
    add(cascade, "velocity_z", plane_getter(&Cascade::velocity_z, "velocities=True"));
    add_chain(cascade, "gradient", &Cascade::gradient_rgba8, "gradients=True");
    add_chain(cascade, "slopes", &Cascade::slopes_rgba8, "slopes=True");
    add_chain(cascade, "moments", &Cascade::moments_rgba8, "slopes=True");
    add(cascade, "compression", &compression_of);
    add(cascade, "snapshots", &snapshots_of);
    add(cascade, "drift", of_cascade(+[](const Cascade& of) { return std::pair(of.drift_columns, of.drift_rows); }));
    add(cascade, "resolution", of_cascade(+[](const Cascade& of) { return of.resolution(); }));
    add(cascade, "levels", of_cascade(+[](const Cascade& of) { return mip_levels(of.resolution()); }));
    add(cascade, "patch_size_m", of_cascade(+[](const Cascade& of) { return of.grid.side_m; }));
    add(cascade, "rotation", of_cascade(+[](const Cascade& of) { return std::pair(of.grid.cosine, of.grid.sine); }));
    add(cascade, "slope_range", of_cascade(+[](const Cascade& of) { return of.slope_ranges.slope; }));
    add(cascade, "variance_range", of_cascade(+[](const Cascade& of) { return of.slope_ranges.variance; }));
    add(cascade, "bounds", of_cascade(+[](const Cascade& of) { return of.bounds; }));
}

FrameClass add_frame(py::module_& module) {
    FrameClass frame(module, "Frame", doc_of("Frame"));
    add(frame, "displacement", [](const FramePointer& of) { return halves_of(first_cascade(of)); });
    add(frame, "height", [](const FramePointer& of) { return plane_of(first_cascade(of), &Cascade::height, ""); });
    add(frame, "cascades", &cascade_handles_of);
    add(frame, "time_s", [](const FrameHandle& of) { return of.frame.time_s; });
    add(frame, "bounds", [](const FrameHandle& of) { return of.frame.bounds; });
    add(frame, "sea", [](const FrameHandle& of) { return python_sea_of(of.frame.sea); });
    add(frame, "significant_wave_height_m",
        [](const FrameHandle& of) { return of.frame.statistics.significant_wave_height_m; });
    add(frame, "is_alive", [](const FrameHandle& of) { return of.ocean->is_alive(of.number); });
    add(frame, "hash", on_frame(&hash_of));
    add(frame, "foam_hash", &checked_foam_hash);
    add(frame, "foam_threshold", [](const FrameHandle& of) { return of.frame.foam.level; });
    add(frame, "snapshot_ages", [](const FrameHandle& of) { return of.frame.foam.age; });
    frame.def("measured_significant_wave_height_m", on_frame(&measured_significant_wave_height_m),
              doc_of("Frame.measured_significant_wave_height_m"));
    add_queries(frame);
    add_reference_points(frame);
    return frame;
}

}  // namespace

FrameClass add_frame_classes(py::module_& module) {
    add_bounds(module);
    add_cascade(module);
    return add_frame(module);
}

}  // namespace pelagic::python
