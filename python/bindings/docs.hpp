// Docstrings, which are written in the stub pelagic/_pelagic.pyi.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace pelagic::python {

/// Returns the docstring of a name such as "Ocean" or "Ocean.schedule". Throws std::logic_error if
/// the stub has none.
const char* doc_of(const char* name);

/// Adds the property `name` to a class, with its docstring.
template <class Class, class Getter>
void add(Class& to, const std::string& name, Getter getter) {
    const std::string class_name = pybind11::str(to.attr("__name__"));
    to.def_property_readonly(name.c_str(), getter, doc_of((class_name + "." + name).c_str()));
}

}  // namespace pelagic::python
