#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "pelagic/message/refusal.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/frame_handle.hpp"
#include "pelagic/python/bindings/sea_fields.hpp"
#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/statistics.hpp"

namespace py = pybind11;

namespace pelagic::python {

void need_foam(const Frame& frame) {
    if (frame.tiles.front().foam_r8.empty())
        throw std::invalid_argument("the frame has no foam, needs an ocean with foam=True");
}

namespace {

using Shape = std::vector<py::ssize_t>;

/// A read-only array of `data`, which keeps the ocean's memory as it is until the last array that shares it is gone.
py::array view_of(const FrameHandle& handle, const py::dtype& type, Shape shape, const void* data) {
    auto view = std::make_unique<SharedOcean::View>(handle.ocean, handle.number);
    const py::capsule owner(view.get(), [](void* held) { delete static_cast<SharedOcean::View*>(held); });
    view.release();
    py::array array(type, std::move(shape), data, owner);
    array.attr("flags").attr("writeable") = false;
    return array;
}

py::array halves_of(const TileHandle& handle) {
    const auto reader = handle.of->read();
    const Tile& tile = handle.tile();
    const py::ssize_t side = tile.resolution();
    return view_of(*handle.of, py::dtype("e"), {side, side, 4}, tile.displacement_rgba16f.data());
}

/// A plane's blocks as an array of the caller's own.
py::array plane_of(const TileHandle& handle, PlaneView Tile::*plane, const char* option) {
    const auto reader = handle.of->read();
    const PlaneView& from = handle.tile().*plane;
    if (!from.data) throw std::invalid_argument(std::string("the frame has none of that, needs an ocean with ") + option);
    const py::ssize_t side = from.resolution;
    py::array_t<float> array({side, side});
    float* const out = array.mutable_data();
    {
        const py::gil_scoped_release others_run;
        copy_plane(from, {out, static_cast<std::size_t>(array.size())});
    }
    return array;
}

/// One level of a chain, (N, N, 4) bytes of words or (N, N) bytes.
template <class Texel>
py::array level_of(const TileHandle& handle, std::span<const Texel> Tile::*chain, int level, const char* option) {
    const auto reader = handle.of->read();
    const Tile& tile = handle.tile();
    if ((tile.*chain).empty())
        throw std::invalid_argument(std::string("the frame has none of that, needs an ocean with ") + option);
    if (level < 0 || level >= mip_levels(tile.resolution()))
        throw std::invalid_argument(refusal("level", level, "0 to " + number_text(mip_levels(tile.resolution()) - 1)));
    const py::ssize_t side = tile.resolution() >> level;
    Shape shape{side, side};
    if (sizeof(Texel) == 4) shape.push_back(4);
    return view_of(*handle.of, py::dtype("u1"), std::move(shape), tile.level_of(tile.*chain, level).data());
}

std::vector<TileHandle> tiles_of(const std::shared_ptr<FrameHandle>& frame) {
    const auto reader = frame->read();
    std::vector<TileHandle> tiles;
    for (std::size_t i = 0; i < frame->frame.tiles.size(); ++i) tiles.push_back({frame, i});
    return tiles;
}

/// What takes long enough for other threads to run meanwhile.
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

std::string text_of(const FrameBounds& bounds) {
    return "Bounds(height_min_m=" + number_text(bounds.height_min_m) + ", height_max_m=" + number_text(bounds.height_max_m) +
           ", sideways_x_max_m=" + number_text(bounds.sideways_x_max_m) +
           ", sideways_z_max_m=" + number_text(bounds.sideways_z_max_m) + ")";
}

/// Of the frame's tiles, read as long as their memory is there.
template <class Value>
auto of_tile(Value (*get)(const Tile&)) {
    return [get](const TileHandle& handle) {
        const auto reader = handle.of->read();
        return get(handle.tile());
    };
}

TileHandle first_tile(const std::shared_ptr<FrameHandle>& frame) { return {frame, 0}; }

auto plane_getter(PlaneView Tile::*plane, const char* option) {
    return [=](const TileHandle& handle) { return plane_of(handle, plane, option); };
}

template <class Texel>
void add_chain(py::class_<TileHandle>& tile, const std::string& name, std::span<const Texel> Tile::*chain, const char* option) {
    const std::string of_level = name + "_level";
    tile.def_property_readonly(
        name.c_str(), [=](const TileHandle& handle) { return level_of(handle, chain, 0, option); },
        doc_of(("Tile." + name).c_str()));
    tile.def(
        of_level.c_str(), [=](const TileHandle& handle, int level) { return level_of(handle, chain, level, option); },
        py::arg("level"), doc_of(("Tile." + of_level).c_str()));
}

/// The property `name` of a class, with its docstring.
template <class Class, class Getter>
void add(Class& to, const std::string& name, Getter getter) {
    const std::string class_name = py::str(to.attr("__name__"));
    to.def_property_readonly(name.c_str(), getter, doc_of((class_name + "." + name).c_str()));
}

void add_bounds(py::module_& module) {
    py::class_<FrameBounds> bounds(module, "Bounds", doc_of("Bounds"));
    add(bounds, "height_min_m", [](const FrameBounds& of) { return of.height_min_m; });
    add(bounds, "height_max_m", [](const FrameBounds& of) { return of.height_max_m; });
    add(bounds, "sideways_x_max_m", [](const FrameBounds& of) { return of.sideways_x_max_m; });
    add(bounds, "sideways_z_max_m", [](const FrameBounds& of) { return of.sideways_z_max_m; });
    bounds.def("__repr__", &text_of);
}

void add_tile(py::module_& module) {
    py::class_<TileHandle> tile(module, "Tile", doc_of("Tile"));
    add(tile, "displacement", &halves_of);
    add(tile, "height", plane_getter(&Tile::height, ""));
    add(tile, "dx", plane_getter(&Tile::dx, ""));
    add(tile, "dz", plane_getter(&Tile::dz, ""));
    add(tile, "velocity_x", plane_getter(&Tile::velocity_x, "velocities=True"));
    add(tile, "velocity_y", plane_getter(&Tile::velocity_y, "velocities=True"));
    add(tile, "velocity_z", plane_getter(&Tile::velocity_z, "velocities=True"));
    add_chain(tile, "gradient", &Tile::gradient_rgba8, "gradients=True");
    add_chain(tile, "slopes", &Tile::slopes_rgba8, "slopes=True");
    add_chain(tile, "moments", &Tile::moments_rgba8, "slopes=True");
    add_chain(tile, "foam", &Tile::foam_r8, "foam=True");
    add(tile, "resolution", of_tile(+[](const Tile& of) { return of.resolution(); }));
    add(tile, "levels", of_tile(+[](const Tile& of) { return mip_levels(of.resolution()); }));
    add(tile, "patch_size_m", of_tile(+[](const Tile& of) { return of.lattice.side_m; }));
    add(tile, "turn", of_tile(+[](const Tile& of) { return std::pair(of.lattice.cosine, of.lattice.sine); }));
    add(tile, "slope_range", of_tile(+[](const Tile& of) { return of.slope_ranges.slope; }));
    add(tile, "variance_range", of_tile(+[](const Tile& of) { return of.slope_ranges.variance; }));
    add(tile, "bounds", of_tile(+[](const Tile& of) { return of.bounds; }));
}

using FramePointer = std::shared_ptr<FrameHandle>;

void add_frame(py::module_& module) {
    FrameClass frame(module, "Frame", doc_of("Frame"));
    add(frame, "displacement", [](const FramePointer& of) { return halves_of(first_tile(of)); });
    add(frame, "height", [](const FramePointer& of) { return plane_of(first_tile(of), &Tile::height, ""); });
    add(frame, "tiles", &tiles_of);
    add(frame, "time_s", [](const FrameHandle& of) { return of.frame.time_s; });
    add(frame, "bounds", [](const FrameHandle& of) { return of.frame.bounds; });
    add(frame, "sea", [](const FrameHandle& of) { return python_sea_of(of.frame.sea); });
    add(frame, "significant_wave_height_m",
        [](const FrameHandle& of) { return of.frame.figures.significant_wave_height_m; });
    add(frame, "is_alive", [](const FrameHandle& of) { return of.ocean->is_alive(of.number); });
    add(frame, "hash", on_frame(&hash_of));
    add(frame, "foam_hash", &checked_foam_hash);
    frame.def("measured_significant_wave_height_m", on_frame(&measured_significant_wave_height_m),
              doc_of("Frame.measured_significant_wave_height_m"));
    add_questions(frame);
    add_resting_points(frame);
}

}  // namespace

void add_frame_classes(py::module_& module) {
    add_bounds(module);
    add_tile(module);
    add_frame(module);
}

}  // namespace pelagic::python
