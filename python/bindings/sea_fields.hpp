// pelagic.Sea, which is Python's, from and to SeaState: fields go by their names.
#pragma once

#include <pybind11/pybind11.h>

#include "pelagic/sim/sea_state.hpp"

namespace pelagic::python {

/// Of any object that has the fields as attributes. Throws std::invalid_argument with Pelagic's line for a value that can't be
/// taken, and TypeError for what is no number or name; check() is for what doesn't go together.
SeaState sea_state_of(pybind11::handle sea);

/// A pelagic.Sea.
pybind11::object python_sea_of(const SeaState& sea);

/// sea_fields, presets and what can be said of a sea without an ocean.
void add_sea_functions(pybind11::module_& module);

}  // namespace pelagic::python
