// Dynamic waves of an ocean: commands, saved states, and the view that each frame has.
#include "pelagic/sim/dynamic_waves.hpp"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <string>
#include <string_view>

#include "pelagic/message/require.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/ocean_parts.hpp"
#include "pelagic/python/bindings/option_fields.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

constexpr const char* no_waves =
    "has no dynamic waves: create the ocean with dynamic_waves=pelagic.DynamicWavesOptions()";

DynamicWavesOptions read_dynamic_waves_options(py::handle object) {
    DynamicWavesOptions options;
    options.step = named_in<DynamicWavesStep>(object, "step");
    read_fields(object, dynamic_waves_fields(), options);
    require(check(options));
    return options;
}

Disturbance read_disturbance(py::handle object) {
    Disturbance disturbance;
    disturbance.shape = named_in<Disturbance::Shape>(object, "shape");
    disturbance.mode = named_in<Disturbance::Mode>(object, "mode");
    read_fields(object, disturbance_fields(), disturbance);
    return disturbance;
}

Rain read_rain(py::handle object) {
    Rain rain;
    read_fields(object, rain_fields(), rain);
    return rain;
}

Disturbance disturbance_of(py::handle object, const char* argument) {
    require_class(object, argument, "Disturbance");
    return read_disturbance(object);
}

std::uint32_t source_number_of(py::handle value) {
    constexpr const char* accepted = "a number that add_source() returned";
    const double number = number_of(value, "number", true, accepted);
    if (!(number >= 0 && number <= UINT32_MAX))
        throw std::invalid_argument(invalid_value_message("number", number, accepted));
    return static_cast<std::uint32_t>(number);
}

/// The dynamic waves of an ocean.
struct WavesHandle {
    std::shared_ptr<SharedOcean> ocean;

    void use(const std::function<void(DynamicWaves&)>& with) const {
        const py::gil_scoped_release others_run;
        ocean->use([&](Ocean& of) { with(of.dynamic_waves()); });
    }
    void use_between_frames(const std::function<void(DynamicWaves&)>& with) const {
        const py::gil_scoped_release others_run;
        ocean->use_between_frames([&](Ocean& of) { with(of.dynamic_waves()); });
    }
};

WavesHandle dynamic_waves_of(const std::shared_ptr<SharedOcean>& ocean) {
    ocean->need_open();
    if (!ocean->has_dynamic_waves()) throw std::invalid_argument(std::string("the ocean ") + no_waves);
    return {ocean};
}

std::uint32_t add_source(const WavesHandle& handle, py::handle source) {
    const Disturbance ours = disturbance_of(source, "source");
    std::uint32_t number = 0;
    handle.use([&](DynamicWaves& waves) { number = waves.add_source(ours); });
    return number;
}

py::bytes save_dynamic_waves(const WavesHandle& handle) {
    std::vector<std::uint8_t> saved;
    handle.use_between_frames([&](DynamicWaves& waves) { saved = waves.save_state(); });
    return {reinterpret_cast<const char*>(saved.data()), saved.size()};
}

void restore_dynamic_waves(const WavesHandle& handle, py::handle saved) {
    if (!py::isinstance<py::bytes>(saved))
        throw py::type_error(invalid_value_message("saved", std::string(py::str(saved.get_type().attr("__name__"))),
                                                   "bytes that save_state() returned"));
    const auto bytes = py::reinterpret_borrow<py::bytes>(saved).cast<std::string_view>();
    handle.use_between_frames([&](DynamicWaves& waves) {
        waves.restore_state({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    });
}

void add_waves(py::module_& module) {
    py::class_<WavesHandle> type(module, "DynamicWaves", doc_of("DynamicWaves"));
    type.def(
        "add_impulse",
        [](const WavesHandle& of, py::handle disturbance) {
            const Disturbance ours = disturbance_of(disturbance, "disturbance");
            of.use([&](DynamicWaves& waves) { waves.add_impulse(ours); });
        },
        py::arg("disturbance"), doc_of("DynamicWaves.add_impulse"));
    type.def("add_source", &add_source, py::arg("source"), doc_of("DynamicWaves.add_source"));
    type.def(
        "set_source",
        [](const WavesHandle& of, py::handle number, py::handle source) {
            const std::uint32_t which = source_number_of(number);
            const Disturbance ours = disturbance_of(source, "source");
            of.use([&](DynamicWaves& waves) { waves.set_source(which, ours); });
        },
        py::arg("number"), py::arg("source"), doc_of("DynamicWaves.set_source"));
    type.def(
        "remove_source",
        [](const WavesHandle& of, py::handle number) {
            const std::uint32_t which = source_number_of(number);
            of.use([&](DynamicWaves& waves) { waves.remove_source(which); });
        },
        py::arg("number"), doc_of("DynamicWaves.remove_source"));
    type.def(
        "set_center",
        [](const WavesHandle& of, py::handle x_m, py::handle z_m) {
            const double x = number_of(x_m, "x_m", false, "[-1e8, 1e8]");
            const double z = number_of(z_m, "z_m", false, "[-1e8, 1e8]");
            of.use([&](DynamicWaves& waves) { waves.set_center(x, z); });
        },
        py::arg("x_m"), py::arg("z_m"), doc_of("DynamicWaves.set_center"));
    type.def(
        "set_rain",
        [](const WavesHandle& of, py::handle rain) {
            require_class(rain, "rain", "Rain");
            const Rain ours = read_rain(rain);
            of.use([&](DynamicWaves& waves) { waves.set_rain(ours); });
        },
        py::arg("rain"), doc_of("DynamicWaves.set_rain"));
    type.def("save_state", &save_dynamic_waves, doc_of("DynamicWaves.save_state"));
    type.def("restore_state", &restore_dynamic_waves, py::arg("saved"), doc_of("DynamicWaves.restore_state"));
}

/// The dynamic waves of a frame.
struct WavesViewHandle {
    std::shared_ptr<FrameHandle> of;

    const DynamicWavesView& view() const { return of->frame.dynamic_waves; }
    template <class Number>
    py::array array(std::span<const Number> numbers, const char* type) const {
        const auto reader = of->read();
        const py::ssize_t side = view().resolution;
        return view_of(*of, py::dtype(type), {side, side}, numbers.data());
    }
};

WavesViewHandle waves_of_frame(const std::shared_ptr<FrameHandle>& frame) {
    if (!frame->frame.dynamic_waves) throw std::invalid_argument(std::string("the frame ") + no_waves);
    return {frame};
}

void add_view(py::module_& module) {
    using Handle = WavesViewHandle;
    py::class_<Handle> view(module, "DynamicWavesView", doc_of("DynamicWavesView"));
    add(view, "height_m", [](const Handle& of) { return of.array(of.view().height_m, "f4"); });
    add(view, "vertical_velocity_mps",
        [](const Handle& of) { return of.array(of.view().vertical_velocity_mps, "f4"); });
    add(view, "foam", [](const Handle& of) { return of.array(of.view().foam, "u1"); });
    add(view, "resolution", [](const Handle& of) { return of.view().resolution; });
    add(view, "texel_m", [](const Handle& of) { return of.view().texel_m; });
    add(view, "first_x", [](const Handle& of) { return of.view().first_x; });
    add(view, "first_z", [](const Handle& of) { return of.view().first_z; });
    add(view, "height_min_m", [](const Handle& of) { return of.view().bounds.height_min_m; });
    add(view, "height_max_m", [](const Handle& of) { return of.view().bounds.height_max_m; });
    add(view, "hash", [](const Handle& of) {
        const auto reader = of.of->read();
        const py::gil_scoped_release others_run;
        return hash_of(of.view());
    });
}

}  // namespace

std::optional<DynamicWavesOptions> dynamic_waves_options_of(py::handle options) {
    if (options.is_none()) return {};
    require_class(options, "dynamic_waves", "DynamicWavesOptions");
    return read_dynamic_waves_options(options);
}

void add_dynamic_waves(py::module_& module, FrameClass& frame, OceanClass& ocean) {
    module.def("check_dynamic_waves_options", [](py::handle object) { read_dynamic_waves_options(object); });
    module.def("check_disturbance", [](py::handle object) { read_disturbance(object); });
    module.def("check_rain", [](py::handle object) { read_rain(object); });
    module.def("dynamic_waves_fields", [] { return described(dynamic_waves_fields()); });
    module.def("disturbance_fields", [] { return described(disturbance_fields()); });
    module.def("rain_fields", [] { return described(rain_fields()); });
    add_waves(module);
    add_view(module);
    add(frame, "dynamic_waves", &waves_of_frame);
    add(ocean, "dynamic_waves", &dynamic_waves_of);
}

}  // namespace pelagic::python
