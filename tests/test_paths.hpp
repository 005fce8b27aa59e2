// Paths of a test program, in a source that CMake writes for each (cmake/pelagic_test.cmake).
#pragma once

#include <string>

namespace pelagic {

extern const char* const source_folder;  ///< of Pelagic
extern const char* const tested_binary;  ///< the program that the tests run; "" without one

/// Returns the path of a file in Pelagic's sources.
inline std::string in_sources(const std::string& file) { return source_folder + ("/" + file); }

}  // namespace pelagic
