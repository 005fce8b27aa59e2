// Two sizes of one sweep: a sample for the gate, everything for the night. The assertion is the same in both.
#pragma once

#include <cstdlib>

namespace pelagic {

/// `./test.sh night` sets PELAGIC_FULL_SWEEPS for the suites that tests/CMakeLists.txt names under SWEEPS.
inline bool sweeps_are_full() {
    const char* full = std::getenv("PELAGIC_FULL_SWEEPS");
    return full && *full;
}

template <class T>
T of_sweep(T sample, T everything) {
    return sweeps_are_full() ? everything : sample;
}

}  // namespace pelagic
