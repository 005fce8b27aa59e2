// Converts the Python class pelagic.Sea from and to SeaState. Fields are matched by name.
#pragma once

#include <pybind11/pybind11.h>

#include "pelagic/sim/sea_state.hpp"

namespace pelagic::python {

/// Reads the sea from the attributes of any object. Throws std::invalid_argument with Pelagic's
/// message for an invalid value, and TypeError for a value that is neither a number nor a name.
/// check() tests combinations.
SeaState sea_state_of(pybind11::handle sea);

/// Returns a pelagic.Sea.
pybind11::object python_sea_of(const SeaState& sea);

/// Adds sea_fields, presets and functions of a sea that need no ocean.
void add_sea_functions(pybind11::module_& module);

}  // namespace pelagic::python
