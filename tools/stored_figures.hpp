// Figures that the project keeps of other machines, and instructions that it has counted: in the program itself.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/simd/isa.hpp"

namespace pelagic::tools {

/// A frame of one tile on one thread, from bench/results.
struct StoredFrame {
    std::string machine, isa;
    int resolution;
    double ms;
    std::optional<double> fftw_ms;  ///< the same frame on FFTW, in the same run
};

std::vector<StoredFrame> stored_frames();

/// Instructions a texel, from bench/budgets.json. None if they have not been counted.
/// \param sea  "1x256", "3x128"
/// \param job  or "frame"
std::optional<double> stored_instructions(std::string_view sea, std::string_view job, Isa isa);

/// The compiler whose instructions those are, "GNU 12.2.0".
std::string stored_instructions_compiler();

}  // namespace pelagic::tools
