// Shores: the options of an ocean's shore, and the shore of a frame.
#include "pelagic/sim/shore.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <climits>
#include <string>

#include "pelagic/message/require.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/ocean_parts.hpp"
#include "pelagic/python/bindings/option_fields.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

/// Returns true for fields that follow from the shape of heights_m.
bool is_shape(const NumericField<ShoreOptions>& field) { return field.name == "columns" || field.name == "rows"; }

ShoreOptions read_shore_options(py::handle object) {
    ShoreOptions options;
    for (const NumericField<ShoreOptions>& field : shore_fields())
        if (!is_shape(field)) field.set(options, number_in(object, field));
    const Floats heights = Floats::ensure(object.attr("heights_m"));
    if (!heights) {
        PyErr_Clear();
        throw std::invalid_argument("heights_m can't be made an array of numbers");
    }
    if (heights.ndim() != 2)
        throw std::invalid_argument(
            invalid_value_message("heights_m.ndim", heights.ndim(), "2: an array of (rows, columns)"));
    options.rows = static_cast<int>(std::min<py::ssize_t>(heights.shape(0), INT_MAX));
    options.columns = static_cast<int>(std::min<py::ssize_t>(heights.shape(1), INT_MAX));
    options.heights_m.assign(heights.data(), heights.data() + heights.size());
    require(check(options));
    return options;
}

py::list described_fields() {
    static const ShoreOptions defaults{};
    py::list fields;
    for (const NumericField<ShoreOptions>& field : shore_fields())
        if (!is_shape(field)) fields.append(py::make_tuple(field.name, field.value_in(defaults), field.accepted));
    return fields;
}

/// The shore of a frame.
struct ShoreHandle {
    std::shared_ptr<FrameHandle> of;

    const ShoreSurface& shore() const { return of->frame.shore; }
    template <class Number>
    py::array array(std::span<const Number> numbers, const char* type) const {
        const auto reader = of->read();
        Shape shape{shore().rows, shore().columns};
        if (std::is_same_v<Number, std::uint32_t>) shape.push_back(4);
        return view_of(*of, py::dtype(type), std::move(shape), numbers.data());
    }
};

ShoreHandle shore_of(const std::shared_ptr<FrameHandle>& frame) {
    if (!frame->frame.shore)
        throw std::invalid_argument(
            "the frame has no shore: create the ocean with shore=pelagic.ShoreOptions(heights_m)");
    return {frame};
}

}  // namespace

std::optional<ShoreOptions> shore_options_of(py::handle options) {
    if (options.is_none()) return {};
    require_class(options, "shore", "ShoreOptions");
    return read_shore_options(options);
}

void add_shore(py::module_& module, FrameClass& frame) {
    using Handle = ShoreHandle;
    module.def("check_shore_options", [](py::handle object) { read_shore_options(object); });
    module.def("shore_fields", &described_fields);
    py::class_<Handle> shore(module, "ShoreSurface", doc_of("ShoreSurface"));
    add(shore, "columns", [](const Handle& of) { return of.shore().columns; });
    add(shore, "rows", [](const Handle& of) { return of.shore().rows; });
    add(shore, "texel_m", [](const Handle& of) { return of.shore().texel_m; });
    add(shore, "x_m", [](const Handle& of) { return of.shore().x_m; });
    add(shore, "z_m", [](const Handle& of) { return of.shore().z_m; });
    add(shore, "depth_m", [](const Handle& of) { return of.array(of.shore().depth_m, "f4"); });
    add(shore, "weights_rgba8", [](const Handle& of) { return of.array(of.shore().weights_rgba8, "u1"); });
    add(shore, "height_m", [](const Handle& of) { return of.array(of.shore().height_m, "f4"); });
    add(shore, "vertical_velocity_mps",
        [](const Handle& of) { return of.array(of.shore().vertical_velocity_mps, "f4"); });
    add(shore, "potential_m2ps", [](const Handle& of) { return of.array(of.shore().potential_m2ps, "f4"); });
    add(shore, "reach_m", [](const Handle& of) { return of.array(of.shore().reach_m, "f4"); });
    add(shore, "foam", [](const Handle& of) { return of.array(of.shore().foam, "u1"); });
    add(shore, "height_min_m", [](const Handle& of) { return of.shore().bounds.height_min_m; });
    add(shore, "height_max_m", [](const Handle& of) { return of.shore().bounds.height_max_m; });
    add(shore, "weights_change_per_m", [](const Handle& of) { return of.shore().weights_change_per_m; });
    add(shore, "hash", [](const Handle& of) {
        const auto reader = of.of->read();
        const py::gil_scoped_release others_run;
        return shore_hash_of(of.of->frame);
    });
    add(frame, "shore", &shore_of);
}

}  // namespace pelagic::python
