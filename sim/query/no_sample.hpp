// The result of a query where a position has no sample.
#pragma once

#include <bit>
#include <cstdint>

namespace pelagic {

/// Quiet NaN with equal bits on every machine.
inline constexpr float no_sample = std::bit_cast<float>(std::uint32_t{0x7fc00000});

}  // namespace pelagic
