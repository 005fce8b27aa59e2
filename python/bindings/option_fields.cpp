#include "pelagic/python/bindings/option_fields.hpp"

#include <algorithm>

#include "pelagic/message/near_names.hpp"

namespace py = pybind11;

namespace pelagic::python {

double number_of(py::handle value, const std::string& name, bool is_whole, std::string_view accepted) {
    // Python's conversions, which accept NumPy's numbers too; a bool is rejected here.
    PyObject* const converted = py::isinstance<py::bool_>(value) ? nullptr
                                : is_whole                       ? PyNumber_Index(value.ptr())
                                : py::isinstance<py::str>(value) ? nullptr
                                                                 : PyNumber_Float(value.ptr());
    if (!converted) {
        PyErr_Clear();
        throw py::type_error(
            invalid_value_message(name, std::string(py::repr(value)), is_whole ? "a whole number" : "a number"));
    }
    const double number = PyFloat_AsDouble(py::reinterpret_steal<py::object>(converted).ptr());
    if (PyErr_Occurred()) {  // an integer beyond the range of double
        PyErr_Clear();
        throw std::invalid_argument(invalid_value_message(name, std::string(py::str(value)), accepted));
    }
    return number;
}

Doubles doubles_of(py::handle given, const std::string& name) {
    Doubles array = Doubles::ensure(given);
    if (array) return array;
    PyErr_Clear();
    throw std::invalid_argument(name + " can't be made an array of numbers");
}

std::size_t name_in(py::handle object, const char* field, std::span<const std::string_view> names) {
    const py::object value = object.attr(field);
    if (!py::isinstance<py::str>(value))
        throw py::type_error(invalid_value_message(field, std::string(py::repr(value)), "a name: " + list_of(names)));
    const auto name = value.cast<std::string>();
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
        throw std::invalid_argument(invalid_value_message(field, name, list_of(names)) + nearest_hint(name, names));
    return static_cast<std::size_t>(found - names.begin());
}

void require_class(py::handle object, const char* argument, const char* name) {
    if (!py::isinstance(object, py::module_::import("pelagic._options").attr(name)))
        throw py::type_error(
            invalid_value_message(argument, std::string(py::repr(object)), "a pelagic." + std::string(name)));
}

}  // namespace pelagic::python
