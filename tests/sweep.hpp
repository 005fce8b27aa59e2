// Two sizes of a parameter sweep: a sample for the quick run, and all values at night. The
// assertions are the same.
#pragma once

#include <cstdlib>

namespace pelagic {

/// `./test.sh soak` sets PELAGIC_FULL_SWEEPS for the suites that tests/CMakeLists.txt names under
/// SWEEPS.
inline bool sweeps_are_full() {
    const char* full = std::getenv("PELAGIC_FULL_SWEEPS");
    return full && *full;
}

template <class T>
T of_sweep(T sample, T everything) {
    return sweeps_are_full() ? everything : sample;
}

}  // namespace pelagic
