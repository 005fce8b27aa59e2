#include "pelagic/tools/machine.hpp"

#include <fstream>

namespace pelagic::tools {

std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    std::string board;
    std::getline(std::ifstream("/sys/firmware/devicetree/base/model"), board, '\0');
    return board.empty() ? "unknown" : board;
}

std::string compiler_name() {
#if defined(__clang__)
    return "clang++ " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

}  // namespace pelagic::tools
