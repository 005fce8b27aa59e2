// Names of the processor and the compiler, for benchmark results.
#pragma once

#include <string>

namespace pelagic::tools {

/// Returns the operating system's name of the processor, or of the board if processors have no
/// names, as on Arm.
std::string cpu_name();

/// Returns the name of the compiler of this program.
std::string compiler_name();

}  // namespace pelagic::tools
