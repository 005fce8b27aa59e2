#include "pelagic/tools/benchmark/machine.hpp"

namespace pelagic::tools {

std::string compiler_name() {
#if defined(__clang__)
    return "clang++ " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

}  // namespace pelagic::tools
