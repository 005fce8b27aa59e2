// What a figure was measured on.
#pragma once

#include <string>

namespace pelagic::tools {

/// As the operating system calls it: the processor, or the board where processors have no names, as on Arm.
std::string cpu_name();

std::string compiler_name();  ///< that built this program

}  // namespace pelagic::tools
