// Instruction counts of one frame of Pelagic and its peers, by instructions/instructions.py in a
// separate process.
#pragma once

#include <map>
#include <string>

#include "pelagic/simd/isa.hpp"

namespace pelagic::bench {

/// Returns instructions per texel of the frames of pelagic_count_frames: "ours", "fftw_packed",
/// "fftw_separate", "kiss_packed", "kiss_separate", "paper". Empty without valgrind or Python, and
/// for AVX-512, which valgrind does not support. Uses FFTW's plans of this process. Takes some
/// seconds.
std::map<std::string, double> counted_frames(int resolution, Isa isa);

}  // namespace pelagic::bench
