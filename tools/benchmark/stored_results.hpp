// Figures that the project keeps of other machines, and instructions that it has counted: in the program itself.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/simd/isa.hpp"

namespace pelagic::tools {

/// Frames of one cascade on one thread, with one instruction set of one machine: milliseconds by N.
struct MachineFrames {
    std::string machine, isa;
    std::map<int, double> ms = {};
    std::map<int, double> fftw_ms = {};  ///< the same frames on FFTW, in the same run, where that was run
};

/// From bench/results.
std::vector<MachineFrames> stored_frames();

/// Instructions a texel, from bench/budgets.json. None if they have not been counted.
/// \param sea  "1x256", "3x128"
/// \param job  or "frame"
std::optional<double> stored_instructions(std::string_view sea, std::string_view job, Isa isa);

/// The compiler whose instructions those are, "GNU 12.2.0".
std::string stored_instructions_compiler();

}  // namespace pelagic::tools
