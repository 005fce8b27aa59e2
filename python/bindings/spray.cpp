// Spray of an ocean: its options, emitters, saved droplets, and the droplets of a frame.
#include "pelagic/sim/spray.hpp"

#include <pybind11/numpy.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pelagic/message/require.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/ocean_parts.hpp"
#include "pelagic/python/bindings/option_fields.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

SprayOptions read_spray_options(py::handle object) {
    SprayOptions options;
    read_fields(object, spray_fields(), options);
    return options;
}

SprayEmitter read_emitter(py::handle object) {
    SprayEmitter emitter;
    read_fields(object, spray_emitter_fields(), emitter);
    return emitter;
}

constexpr const char* no_spray = "has no spray: create the ocean with spray=pelagic.SprayOptions()";

void need_spray(const SharedOcean& ocean, const char* of) {
    if (!ocean.has_spray()) throw std::invalid_argument(std::string(of) + " " + no_spray);
}

void set_spray_center(SharedOcean& ocean, py::handle x_m, py::handle z_m) {
    need_spray(ocean, "the ocean");
    const double x = number_of(x_m, "x_m", false, "[-1e8, 1e8]"), z = number_of(z_m, "z_m", false, "[-1e8, 1e8]");
    const py::gil_scoped_release others_run;
    ocean.use([&](Ocean& of) { of.set_spray_center(x, z); });
}

void emit(SharedOcean& ocean, py::handle emitters) {
    need_spray(ocean, "the ocean");
    if (!py::isinstance<py::iterable>(emitters))
        throw py::type_error(
            invalid_value_message("emitters", std::string(py::repr(emitters)), "a list of pelagic.SprayEmitter"));
    std::vector<SprayEmitter> ours;
    for (const py::handle emitter : py::reinterpret_borrow<py::iterable>(emitters)) {
        require_class(emitter, ("emitters[" + number_text(ours.size()) + "]").c_str(), "SprayEmitter");
        ours.push_back(read_emitter(emitter));
    }
    const py::gil_scoped_release others_run;
    ocean.use([&](Ocean& of) { of.emit(ours); });
}

py::bytes save_spray(SharedOcean& ocean) {
    need_spray(ocean, "the ocean");
    std::vector<std::uint8_t> saved;
    {
        const py::gil_scoped_release others_run;
        ocean.use_between_frames([&](Ocean& of) { saved = of.save_spray(); });
    }
    return {reinterpret_cast<const char*>(saved.data()), saved.size()};
}

void restore_spray(SharedOcean& ocean, py::handle saved) {
    need_spray(ocean, "the ocean");
    if (!py::isinstance<py::bytes>(saved))
        throw py::type_error(invalid_value_message("saved", std::string(py::str(saved.get_type().attr("__name__"))),
                                                   "bytes that save_spray() returned"));
    const auto bytes = py::reinterpret_borrow<py::bytes>(saved).cast<std::string_view>();
    const py::gil_scoped_release others_run;
    ocean.use_between_frames(
        [&](Ocean& of) { of.restore_spray({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}); });
}

py::dtype droplet_type() {
    py::list fields;
    for (const auto& [name, type] :
         {std::pair("position", "3f8"), std::pair("velocity", "3f4"), std::pair("radius", "f4"),
          std::pair("opacity", "f4"), std::pair("age", "f4")})
        fields.append(py::make_tuple(name, type));
    return py::dtype::from_args(fields);
}

py::array droplets_of(const FrameHandle& handle) {
    const auto reader = handle.read();
    need_spray(*handle.ocean, "the frame");
    const auto droplets = handle.frame.droplets;
    return view_of(handle, droplet_type(), {static_cast<py::ssize_t>(droplets.size())}, droplets.data());
}

std::uint64_t hash_of_spray(const FrameHandle& handle) {
    const auto reader = handle.read();
    need_spray(*handle.ocean, "the frame");
    return spray_hash_of(handle.frame);
}

}  // namespace

std::optional<SprayOptions> spray_options_of(py::handle options) {
    if (options.is_none()) return {};
    require_class(options, "spray", "SprayOptions");
    return read_spray_options(options);
}

void add_spray(py::module_& module, FrameClass& frame, OceanClass& ocean) {
    module.def("check_spray_options", [](py::handle object) { read_spray_options(object); });
    module.def("check_spray_emitter", [](py::handle object) { read_emitter(object); });
    module.def("spray_fields", [] { return described(spray_fields()); });
    module.def("spray_emitter_fields", [] { return described(spray_emitter_fields()); });
    ocean.def("set_spray_center", &set_spray_center, py::arg("x_m"), py::arg("z_m"),
              doc_of("Ocean.set_spray_center"));
    ocean.def("emit", &emit, py::arg("emitters"), doc_of("Ocean.emit"));
    ocean.def("save_spray", &save_spray, doc_of("Ocean.save_spray"));
    ocean.def("restore_spray", &restore_spray, py::arg("saved"), doc_of("Ocean.restore_spray"));
    add(frame, "droplets", &droplets_of);
    add(frame, "spray_hash", &hash_of_spray);
}

}  // namespace pelagic::python
