// Docstrings, which stand in the stub pelagic/_pelagic.pyi.
#pragma once

namespace pelagic::python {

/// Of "Ocean" or "Ocean.schedule". Throws std::logic_error if the stub has none.
const char* doc_of(const char* name);

}  // namespace pelagic::python
