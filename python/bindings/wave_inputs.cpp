// Wave inputs: lists of Gerstner waves, and ripples.
#include <pybind11/stl.h>

#include <string>

#include "pelagic/message/require.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/ocean_parts.hpp"
#include "pelagic/python/bindings/option_fields.hpp"
#include "pelagic/sim/gerstner_input.hpp"
#include "pelagic/sim/ripple_input.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

template <class Input>
struct HandleOf final : InputHandle {
    std::shared_ptr<Input> own;

    template <class Options>
    explicit HandleOf(const Options& options) : own(std::make_shared<Input>(options)) {}
    std::shared_ptr<WaveInput> input() const override { return own; }

    template <class Options>
    void set(const Options& options) {
        const std::shared_ptr<SharedOcean> has = ocean.lock();
        if (!has) return own->set(options);
        const py::gil_scoped_release others_run;
        has->alter_input([&] { own->set(options); });
    }
};
using GerstnerHandle = HandleOf<GerstnerInput>;
using RippleHandle = HandleOf<RippleInput>;

AnalyticWave read_wave(py::handle object) {
    AnalyticWave wave;
    read_fields(object, analytic_wave_fields(), wave);
    return wave;
}

Ripple read_ripple(py::handle object) {
    Ripple ripple;
    read_fields(object, ripple_fields(), ripple);
    require(check(ripple));
    return ripple;
}

py::iterable iterable_of(py::handle object, const char* argument, const char* accepted) {
    if (!py::isinstance<py::iterable>(object))
        throw py::type_error(invalid_value_message(argument, std::string(py::repr(object)), accepted));
    return py::reinterpret_borrow<py::iterable>(object);
}

AnalyticSea read_analytic_sea(py::handle waves, py::handle choppiness) {
    AnalyticSea sea;
    for (const py::handle wave : iterable_of(waves, "waves", "a list of pelagic.AnalyticWave")) {
        require_class(wave, ("waves[" + number_text(sea.waves.size()) + "]").c_str(), "AnalyticWave");
        sea.waves.push_back(read_wave(wave));
    }
    sea.choppiness = number_of(choppiness, "choppiness", false, "[0, 1]");
    return sea;
}

Ripple ripple_of(py::handle ripple) {
    require_class(ripple, "ripple", "Ripple");
    return read_ripple(ripple);
}

}  // namespace

TakenInputs::TakenInputs(py::handle inputs) {
    constexpr const char* accepted = "a list of pelagic.GerstnerInput and pelagic.RippleInput";
    std::vector<std::shared_ptr<InputHandle>> all;
    for (const py::handle input : iterable_of(inputs, "inputs", accepted)) {
        if (!py::isinstance<InputHandle>(input))
            throw py::type_error(invalid_value_message("inputs[" + number_text(all.size()) + "]",
                                                       std::string(py::repr(input)), accepted));
        all.push_back(input.cast<std::shared_ptr<InputHandle>>());
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i]->is_taken || std::find(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i), all[i]) !=
                                    all.begin() + static_cast<std::ptrdiff_t>(i))
            throw std::invalid_argument("inputs[" + number_text(i) + "] is in use, expected an input of its own");
    for (const auto& one : all) one->is_taken = true;
    handles_ = std::move(all);
}

TakenInputs::~TakenInputs() {
    if (are_given_) return;
    for (const auto& one : handles_) one->is_taken = false;
}

std::vector<std::shared_ptr<WaveInput>> TakenInputs::inputs() const {
    std::vector<std::shared_ptr<WaveInput>> inputs;
    for (const auto& one : handles_) inputs.push_back(one->input());
    return inputs;
}

void TakenInputs::give_to(const std::shared_ptr<SharedOcean>& ocean) {
    for (const auto& one : handles_) one->ocean = ocean;
    are_given_ = true;
}

void add_inputs(py::module_& module) {
    module.def("check_analytic_wave", [](py::handle object) { read_wave(object); });
    module.def("check_ripple", [](py::handle object) { read_ripple(object); });
    module.def("analytic_wave_fields", [] { return described(analytic_wave_fields()); });
    module.def("ripple_fields", [] { return described(ripple_fields()); });

    py::class_<InputHandle, std::shared_ptr<InputHandle>> input(module, "WaveInput", doc_of("WaveInput"));
    py::class_<GerstnerHandle, InputHandle, std::shared_ptr<GerstnerHandle>> waves(module, "GerstnerInput",
                                                                                   doc_of("GerstnerInput"));
    waves.def(py::init([](py::handle list, py::handle choppiness) {
                  return std::make_shared<GerstnerHandle>(read_analytic_sea(list, choppiness));
              }),
              py::arg("waves") = py::tuple(), py::arg("choppiness") = 1.0, doc_of("GerstnerInput.__init__"));
    waves.def(
        "set",
        [](GerstnerHandle& of, py::handle list, py::handle choppiness) { of.set(read_analytic_sea(list, choppiness)); },
        py::arg("waves"), py::arg("choppiness") = 1.0, doc_of("GerstnerInput.set"));

    py::class_<RippleHandle, InputHandle, std::shared_ptr<RippleHandle>> rings(module, "RippleInput",
                                                                               doc_of("RippleInput"));
    rings.def(py::init([](py::handle ripple) { return std::make_shared<RippleHandle>(ripple_of(ripple)); }),
              py::arg("ripple"), doc_of("RippleInput.__init__"));
    rings.def(
        "set", [](RippleHandle& of, py::handle ripple) { of.set(ripple_of(ripple)); }, py::arg("ripple"),
        doc_of("RippleInput.set"));
}

}  // namespace pelagic::python
