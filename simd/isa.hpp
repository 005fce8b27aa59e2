// The instruction sets that kernels exist for, and which of them this CPU runs.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace pelagic {

enum class Isa { sse4_2, avx2, avx512, neon, wasm128 };

/// "sse4.2", "avx2", "avx512", "neon" or "wasm128", as the command line spells it.
std::string_view name_of(Isa);
std::optional<Isa> isa_named(std::string_view name);

/// True if this build has kernels for `isa` and this CPU (and its operating system) can run them.
bool runs_here(Isa isa);

/// Every instruction set that runs here, weakest first. All give the same bits.
std::vector<Isa> isas_here();

/// The instruction set to use: `wanted` if given, else the environment variable PELAGIC_ISA, else the strongest
/// that runs here. Throws std::invalid_argument with one clear line if the wish can't be met.
Isa choose_isa(std::optional<Isa> wanted = {});

}  // namespace pelagic
