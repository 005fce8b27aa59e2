// Reads options from the attributes of a Python object, by the C++ tables of their fields.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/message/enum_names.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/numeric_field.hpp"

namespace pelagic::python {

/// Converts any Python or NumPy number except bool. Throws TypeError for any other type, and
/// std::invalid_argument for an integer beyond the range of double.
double number_of(pybind11::handle value, const std::string& name, bool is_whole, std::string_view accepted);

using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Converts what NumPy makes an array of numbers, of any shape. Throws std::invalid_argument for
/// anything else.
Doubles doubles_of(pybind11::handle given, const std::string& name);

/// Returns the index in `names` of the attribute `field`. Throws TypeError unless it is a str, and
/// std::invalid_argument if it is none of them.
std::size_t name_in(pybind11::handle object, const char* field, std::span<const std::string_view> names);
/// Returns the value that the attribute `field` names; throws as name_in().
template <NamedEnum Enum>
Enum named_in(pybind11::handle object, const char* field) {
    return static_cast<Enum>(name_in(object, field, names_of<Enum>()));
}

/// Throws TypeError unless the object is of the class `name` of the package.
void require_class(pybind11::handle object, const char* argument, const char* name);

template <class Options>
double number_in(pybind11::handle object, const NumericField<Options>& field) {
    const std::string name(field.name);
    const bool is_whole = !std::holds_alternative<double Options::*>(field.member) &&
                          !std::holds_alternative<float Options::*>(field.member);
    const double number = number_of(object.attr(name.c_str()), name, is_whole, field.accepted);
    if (!field.accepts(number)) throw std::invalid_argument(invalid_value_message(name, number, field.accepted));
    return number;
}

template <class Options>
void read_fields(pybind11::handle object, std::span<const NumericField<Options>> fields, Options& options) {
    for (const NumericField<Options>& field : fields) field.set(options, number_in(object, field));
}

/// Returns the name, default and range of each field.
template <class Options>
pybind11::list described(std::span<const NumericField<Options>> fields) {
    static const Options defaults{};
    pybind11::list list;
    for (const NumericField<Options>& field : fields)
        list.append(pybind11::make_tuple(field.name, field.value_in(defaults), field.accepted));
    return list;
}

}  // namespace pelagic::python
