// The instruction sets that kernels are compiled for, and detection of those that this CPU
// supports.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace pelagic {

enum class Isa { sse4_2, avx2, avx512, neon, wasm128 };

/// Returns the name on the command line: "sse4.2", "avx2", "avx512", "neon" or "wasm128".
std::string_view name_of(Isa);

/// Returns the instruction set with this name, if there is one.
std::optional<Isa> isa_named(std::string_view name);

/// Returns true if this build has kernels for `isa`, and this CPU and its operating system support
/// it.
bool runs_here(Isa isa);

/// Returns every instruction set for which runs_here() is true, weakest first. Results are
/// bit-identical on all of them.
std::vector<Isa> isas_here();

/// Chooses the instruction set: `wanted` if set, else the environment variable PELAGIC_ISA, else
/// the strongest one for which runs_here() is true.
/// \throws std::invalid_argument  if this CPU does not support the chosen one; the message is one
///                                line
Isa choose_isa(std::optional<Isa> wanted = {});

}  // namespace pelagic
