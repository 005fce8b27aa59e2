#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "pelagic/message/refusal.hpp"
#include "pelagic/python/bindings/frame_handle.hpp"
#include "pelagic/python/bindings/sea_fields.hpp"
#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/statistics.hpp"

namespace py = pybind11;

namespace pelagic::python {
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
    if (handle.frame.tiles.front().foam_r8.empty())
        throw std::invalid_argument("the frame has no foam, needs an ocean with foam=True");
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
void add_chain(py::class_<TileHandle>& tile, const char* name, std::span<const Texel> Tile::*chain, const char* option) {
    tile.def_property_readonly(name,
                               [=](const TileHandle& handle) { return level_of(handle, chain, 0, option); });
    tile.def((std::string(name) + "_level").c_str(),
             [=](const TileHandle& handle, int level) { return level_of(handle, chain, level, option); },
             py::arg("level"));
}

}  // namespace

void add_frame_classes(py::module_& module) {
    py::class_<FrameBounds>(module, "Bounds")
        .def_readonly("height_min_m", &FrameBounds::height_min_m)
        .def_readonly("height_max_m", &FrameBounds::height_max_m)
        .def_readonly("sideways_x_max_m", &FrameBounds::sideways_x_max_m)
        .def_readonly("sideways_z_max_m", &FrameBounds::sideways_z_max_m)
        .def("__repr__", &text_of);

    py::class_<TileHandle> tile(module, "Tile");
    tile.def_property_readonly("displacement", &halves_of)
        .def_property_readonly("height", plane_getter(&Tile::height, ""))
        .def_property_readonly("dx", plane_getter(&Tile::dx, ""))
        .def_property_readonly("dz", plane_getter(&Tile::dz, ""))
        .def_property_readonly("velocity_x", plane_getter(&Tile::velocity_x, "velocities=True"))
        .def_property_readonly("velocity_y", plane_getter(&Tile::velocity_y, "velocities=True"))
        .def_property_readonly("velocity_z", plane_getter(&Tile::velocity_z, "velocities=True"))
        .def_property_readonly("resolution", of_tile(+[](const Tile& of) { return of.resolution(); }))
        .def_property_readonly("levels", of_tile(+[](const Tile& of) { return mip_levels(of.resolution()); }))
        .def_property_readonly("patch_size_m", of_tile(+[](const Tile& of) { return of.lattice.side_m; }))
        .def_property_readonly("turn", of_tile(+[](const Tile& of) {
                                   return std::pair(of.lattice.cosine, of.lattice.sine);
                               }))
        .def_property_readonly("slope_range", of_tile(+[](const Tile& of) { return of.slope_ranges.slope; }))
        .def_property_readonly("variance_range", of_tile(+[](const Tile& of) { return of.slope_ranges.variance; }))
        .def_property_readonly("bounds", of_tile(+[](const Tile& of) { return of.bounds; }));
    add_chain(tile, "gradient", &Tile::gradient_rgba8, "gradients=True");
    add_chain(tile, "slopes", &Tile::slopes_rgba8, "slopes=True");
    add_chain(tile, "moments", &Tile::moments_rgba8, "slopes=True");
    add_chain(tile, "foam", &Tile::foam_r8, "foam=True");

    FrameClass frame(module, "Frame");
    frame.def_property_readonly("displacement", [](const std::shared_ptr<FrameHandle>& of) { return halves_of(first_tile(of)); })
        .def_property_readonly("height", [](const std::shared_ptr<FrameHandle>& of) {
            return plane_of(first_tile(of), &Tile::height, "");
        })
        .def_property_readonly("tiles", &tiles_of)
        .def_property_readonly("time_s", [](const FrameHandle& of) { return of.frame.time_s; })
        .def_property_readonly("bounds", [](const FrameHandle& of) { return of.frame.bounds; })
        .def_property_readonly("sea", [](const FrameHandle& of) { return python_sea_of(of.frame.sea); })
        .def_property_readonly("significant_wave_height_m",
                               [](const FrameHandle& of) { return of.frame.figures.significant_wave_height_m; })
        .def_property_readonly("is_alive", [](const FrameHandle& of) { return of.ocean->is_alive(of.number); })
        .def_property_readonly("hash", on_frame(&hash_of))
        .def_property_readonly("foam_hash", &checked_foam_hash)
        .def("measured_significant_wave_height_m", on_frame(&measured_significant_wave_height_m));
    add_questions(frame);
}

}  // namespace pelagic::python
