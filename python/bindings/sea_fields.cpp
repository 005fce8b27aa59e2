#include "pelagic/python/bindings/sea_fields.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/python/bindings/option_fields.hpp"
#include "pelagic/sim/statistics.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

void check_sea(py::handle sea) { require(check(sea_state_of(sea))); }

SeaState checked_sea(py::handle sea) {
    check_sea(sea);
    return sea_state_of(sea);
}

py::list preset_list() {
    py::list presets;
    for (const SeaPreset& preset : sea_presets())
        presets.append(py::make_tuple(preset.name, preset.summary, python_sea_of(preset.sea)));
    return presets;
}

py::dict report(py::handle sea) {
    const SeaReport found = report_on(checked_sea(sea));
    py::dict out;
    out["significant_wave_height_m"] = found.expected.significant_wave_height_m;
    out["model_significant_wave_height_m"] = found.expected.model_significant_wave_height_m;
    out["peak_period_s"] = found.expected.peak_period_s;
    out["peak_wavelength_m"] = found.expected.peak_wavelength_m;
    out["realised_significant_wave_height_m"] = found.realised_significant_wave_height_m;
    out["realised_peak_period_s"] = found.realised_peak_period_s;
    out["warnings"] = found.warnings;
    return out;
}

py::array_t<double> densities(py::handle sea, const Doubles& at, const char* name,
                              std::vector<double> (*model)(const SeaState&, std::span<const double>)) {
    const std::span<const double> places(at.data(), static_cast<std::size_t>(at.size()));
    for (const double place : places)
        if (!(place > 0 && place < 1e9)) throw std::invalid_argument(invalid_value_message(name, place, "(0, 1e9)"));
    const std::vector<double> found = model(checked_sea(sea), places);
    return py::array_t<double>(std::vector<py::ssize_t>(at.shape(), at.shape() + at.ndim()), found.data());
}

}  // namespace

SeaState sea_state_of(py::handle sea) {
    if (!py::hasattr(sea, "wind_speed_mps"))
        throw py::type_error(invalid_value_message("sea", std::string(py::repr(sea)),
                                                   "a pelagic.Sea, such as pelagic.preset(\"rough\")"));
    SeaState state;
    state.waves = named_in<WaveModel>(sea, "waves");
    state.spectrum = named_in<SpectrumModel>(sea, "spectrum");
    state.spreading = named_in<SpreadingModel>(sea, "spreading");
    read_fields(sea, sea_state_fields(), state);
    return state;
}

py::object python_sea_of(const SeaState& sea) {
    py::dict fields;
    fields["waves"] = name_of(sea.waves);
    fields["spectrum"] = name_of(sea.spectrum);
    fields["spreading"] = name_of(sea.spreading);
    for (const SeaStateField& field : sea_state_fields())
        std::visit([&](auto member) { fields[py::str(std::string(field.name))] = sea.*member; }, field.member);
    return py::module_::import("pelagic._sea").attr("Sea").attr("_of_library")(fields);
}

void add_sea_functions(py::module_& module) {
    module.def("check_sea", &check_sea, py::arg("sea"));
    module.def("sea_fields", [] { return described(sea_state_fields()); });
    module.def("preset_list", &preset_list);
    module.def("report", &report, py::arg("sea"));
    module.def(
        "model_by_frequency",
        [](py::handle sea, const Doubles& at) { return densities(sea, at, "frequencies_hz", &model_by_frequency); },
        py::arg("sea"), py::arg("frequencies_hz"));
    module.def(
        "model_by_wave_number",
        [](py::handle sea, const Doubles& at) { return densities(sea, at, "wave_numbers", &model_by_wave_number); },
        py::arg("sea"), py::arg("wave_numbers"));
}

}  // namespace pelagic::python
