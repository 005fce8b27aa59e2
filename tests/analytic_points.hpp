// Random positions for analytic waves, and sums in long double to compare them with.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "pelagic/analytic/analytic_surface.hpp"

namespace pelagic {

using Long = long double;
inline constexpr Long long_pi = std::numbers::pi_v<Long>;

inline double rounded(Long value) { return static_cast<double>(value); }

struct AnalyticPositions {
    std::vector<double> x, z;
    AnalyticPoints view() const { return {x, z}; }
};

inline AnalyticPositions random_positions(std::size_t count, double reach_m, unsigned seed = 1) {
    std::mt19937 random(seed);
    const auto one = [&] { return (static_cast<double>(random()) * 0x1p-31 - 1) * reach_m; };
    AnalyticPositions positions;
    for (std::size_t i = 0; i < count; ++i) {
        positions.x.push_back(one());
        positions.z.push_back(one());
    }
    return positions;
}

/// FNV-1a hash of all values.
inline std::uint64_t hash_of(const std::vector<std::vector<float>>& arrays) {
    std::uint64_t bits = 0xcbf29ce484222325;
    for (const auto& array : arrays)
        for (const float value : array) bits = (bits ^ std::bit_cast<std::uint32_t>(value)) * 0x100000001b3;
    return bits;
}

}  // namespace pelagic
