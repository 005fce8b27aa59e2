// The module pelagic._pelagic: the C++ interface for Python. pelagic/_pelagic.pyi and
// pelagic/__init__.py document its names.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/frame_handle.hpp"
#include "pelagic/python/bindings/ocean_parts.hpp"
#include "pelagic/python/bindings/sea_fields.hpp"
#include "pelagic/sim/statistics.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

using OceanPointer = std::shared_ptr<SharedOcean>;

FramePointer python_frame_of(const OceanPointer& ocean, NumberedFrame made) {
    return std::make_shared<FrameHandle>(FrameHandle{ocean, made.number, made.frame});
}

/// Returns an option whose value 0 means that it is not set.
std::optional<double> unless_0(double value) { return value == 0 ? std::nullopt : std::optional(value); }

OceanPointer make_ocean(py::handle sea, bool queries, bool velocities, bool foam, std::optional<bool> gradients,
                        std::optional<bool> slopes, int threads, const std::optional<std::string>& isa,
                        double largest_peak_m, py::handle dynamic_waves, py::handle shore, py::handle inputs,
                        bool planes, py::handle spray) {
    const Forecast forecast{.first = sea_state_of(sea), .largest_peak_m = unless_0(largest_peak_m)};
    require(check(forecast.first));
    OceanOptions options{.queries = queries,
                         .velocities = velocities,
                         .gradients = gradients,
                         .slopes = slopes,
                         .foam = foam,
                         .planes = planes};
    if (isa) {
        options.isa = isa_named(*isa);
        if (!options.isa)
            throw std::invalid_argument(invalid_value_message("isa", *isa, "sse4.2, avx2, avx512 or neon"));
    }
    options.dynamic_waves = dynamic_waves_options_of(dynamic_waves);
    options.shore = shore_options_of(shore);
    options.spray = spray_options_of(spray);
    TakenInputs taken(inputs);
    options.inputs = taken.inputs();
    OceanPointer ocean;
    {
        const py::gil_scoped_release others_run;
        options.executor = make_default_executor(threads);
        ocean = std::make_shared<SharedOcean>(forecast, options);
    }
    // A filter may turn the warning into an exception, which destroys the ocean.
    if (const std::string warning = largest_peak_m > 0 ? warning_about(forecast) : ""; !warning.empty())
        if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 2) != 0) throw py::error_already_set();
    taken.give_to(ocean);
    return ocean;
}

std::vector<std::string> names_of_isas() {
    std::vector<std::string> names;
    for (const Isa isa : isas_here()) names.emplace_back(name_of(isa));
    return names;
}

/// Calls the ocean's method while other threads run.
template <class Result, class... Arguments>
auto freely(Result (SharedOcean::*method)(Arguments...)) {
    return [method](SharedOcean& ocean, Arguments... arguments) {
        const py::gil_scoped_release others_run;
        return (ocean.*method)(arguments...);
    };
}

template <class... Arguments>
auto freely_made(NumberedFrame (SharedOcean::*method)(Arguments...)) {
    return [method](const OceanPointer& ocean, Arguments... arguments) {
        const py::gil_scoped_release others_run;
        return python_frame_of(ocean, (*ocean.*method)(arguments...));
    };
}

template <class Value>
auto fact(Value (*get)(const SharedOcean::Facts&)) {
    return [get](SharedOcean& ocean) {
        const auto facts = [&] {
            const py::gil_scoped_release others_run;
            return ocean.facts();
        }();
        return get(facts);
    };
}

OceanPointer entered(const OceanPointer& ocean) {
    ocean->need_open();
    return ocean;
}

void schedule_sea(SharedOcean& ocean, py::handle sea, double from_s, double over_s, double swell_from_m) {
    const SeaChange change{
        .sea = sea_state_of(sea), .from_s = from_s, .over_s = over_s, .swell_from_m = unless_0(swell_from_m)};
    const py::gil_scoped_release others_run;
    ocean.schedule_sea(change);
}

void set_water_frame(SharedOcean& ocean, double sea_level_m, const std::pair<double, double>& current_mps) {
    const WaterFrame water{sea_level_m, current_mps.first, current_mps.second};
    const py::gil_scoped_release others_run;
    ocean.set_water_frame(water);
}

OceanClass add_ocean_class(py::module_& module) {
    using Facts = SharedOcean::Facts;
    const auto facts_and_docs = [](auto& ocean, const char* name, auto get) {
        ocean.def_property_readonly(name, fact(get), doc_of((std::string("Ocean.") + name).c_str()));
    };
    OceanClass ocean(module, "Ocean", doc_of("Ocean"));
    ocean.def(py::init(&make_ocean), py::arg("sea"), py::arg("queries") = true, py::arg("velocities") = false,
              py::arg("foam") = false, py::arg("gradients") = py::none(), py::arg("slopes") = py::none(),
              py::arg("threads") = 0, py::arg("isa") = py::none(), py::arg("largest_peak_m") = 0.0,
              py::arg("dynamic_waves") = py::none(), py::arg("shore") = py::none(), py::arg("inputs") = py::tuple(),
              py::arg("planes") = true, py::arg("spray") = py::none(), doc_of("Ocean.__init__"));
    ocean.def("__enter__", &entered);
    ocean.def("__exit__", [](SharedOcean& of, const py::args&) { freely (&SharedOcean::close)(of); });
    ocean.def("close", freely(&SharedOcean::close), doc_of("Ocean.close"));
    ocean.def_property_readonly("is_closed", &SharedOcean::is_closed, doc_of("Ocean.is_closed"));
    ocean.def("schedule", freely(&SharedOcean::schedule), py::arg("time_s"), doc_of("Ocean.schedule"));
    ocean.def("is_ready", freely(&SharedOcean::is_ready), doc_of("Ocean.is_ready"));
    ocean.def("complete", freely_made(&SharedOcean::complete), doc_of("Ocean.complete"));
    ocean.def("frame_at", freely_made(&SharedOcean::frame_at), py::arg("time_s"), doc_of("Ocean.frame_at"));
    ocean.def("schedule_sea", &schedule_sea, py::arg("sea"), py::arg("from_s"), py::arg("over_s"),
              py::arg("swell_from_m") = 0.0, doc_of("Ocean.schedule_sea"));
    ocean.def("set_water_frame", &set_water_frame, py::arg("sea_level_m") = 0.0,
              py::arg("current_mps") = std::pair(0.0, 0.0), doc_of("Ocean.set_water_frame"));
    add_series(ocean);
    facts_and_docs(
        ocean, "sea", +[](const Facts& of) { return python_sea_of(of.sea); });
    facts_and_docs(
        ocean, "resolution", +[](const Facts& of) { return of.resolution; });
    facts_and_docs(
        ocean, "cascade_count", +[](const Facts& of) { return of.cascade_count; });
    facts_and_docs(
        ocean, "threads", +[](const Facts& of) { return of.threads; });
    facts_and_docs(
        ocean, "memory_bytes", +[](const Facts& of) { return of.memory_bytes; });
    facts_and_docs(
        ocean, "isa", +[](const Facts& of) { return std::string(name_of(of.isa)); });
    return ocean;
}

}  // namespace
}  // namespace pelagic::python

PYBIND11_MODULE(_pelagic, module) {
    using namespace pelagic::python;
    // The docs have signatures in Python's own form.
    py::options options;
    options.disable_function_signatures();
    module.attr("version") = PELAGIC_VERSION;
    py::register_exception<StaleFrame>(module, "StaleFrame", PyExc_RuntimeError);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const MemoryInUse& in_use) {
            PyErr_SetString(PyExc_BufferError, in_use.what());
        }
    });
    module.def("isas_here", &names_of_isas, doc_of("isas_here"));
    add_sea_functions(module);
    add_inputs(module);
    FrameClass frame = add_frame_classes(module);
    OceanClass ocean = add_ocean_class(module);
    add_dynamic_waves(module, frame, ocean);
    add_shore(module, frame);
    add_spray(module, frame, ocean);
    add_hulls(module);
}
