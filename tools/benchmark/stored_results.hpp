// Benchmark results of other machines and stored counts of instructions and bytes, which are
// embedded in the program.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/simd/isa.hpp"

namespace pelagic::tools {

/// Times of frames of one cascade on one thread with one instruction set of one machine, in
/// milliseconds by N.
struct MachineFrames {
    std::string machine, isa;
    std::map<int, double> ms = {};
    std::map<int, double> fftw_ms = {};  ///< times with FFTW in the same run; empty if not measured
};

/// Returns the results in bench/results.
std::vector<MachineFrames> stored_frames();

/// Returns instructions per texel from bench/budgets.json, or no value if they have not been
/// counted.
/// \param sea  name of the sea, such as "1x256" or "3x128"
/// \param job  name of the job, or "frame"
std::optional<double> stored_instructions(std::string_view sea, std::string_view job, Isa isa);

/// Returns the bytes per texel that a frame moves beyond a cache, from bench/bytes.json: those of
/// the largest counted cache that is not larger. Returns no value if the sea has not been counted,
/// or if every counted cache is larger.
std::optional<double> stored_bytes(std::string_view sea, std::size_t cache_bytes);

/// Returns the compiler of the stored instruction counts, such as "GNU 12.2.0".
std::string stored_instructions_compiler();

}  // namespace pelagic::tools
