// Instructions of one frame, ours and the peers', counted by instructions/instructions.py in a process of its own.
#pragma once

#include <map>
#include <string>

#include "pelagic/simd/isa.hpp"

namespace pelagic::bench {

/// Instructions a texel of the frames that pelagic_count_frames names: "ours", "packed", "separate", "paper". Empty if
/// they can't be counted here: no valgrind, no Python, AVX-512, which valgrind does not know. Uses the plans that FFTW has
/// made in this process. Takes seconds.
std::map<std::string, double> counted_frames(int resolution, Isa isa);

}  // namespace pelagic::bench
