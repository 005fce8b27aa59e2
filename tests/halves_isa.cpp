// Compiled once for each instruction set: converts ranges of float bit patterns to half floats.
#include "pelagic/simd/half.kernel.hpp"

#define PELAGIC_JOINED(a, b) a##b
#define PELAGIC_HALVES(name) PELAGIC_JOINED(wrong_halves_, name)

namespace pelagic {

std::uint16_t PELAGIC_HALVES(PELAGIC_ISA_NAME)(std::uint32_t first, std::uint32_t last, std::uint16_t expected);

/// Returns the number of wrong half floats among the floats with the bit patterns from `first` to
/// `last`.
std::uint16_t PELAGIC_HALVES(PELAGIC_ISA_NAME)(std::uint32_t first, std::uint32_t last, std::uint16_t expected) {
    using V = xsimd::batch<float, xsimd::PELAGIC_ISA_ARCH>;
    constexpr std::uint32_t channel = V::size, count = 4 * V::size;
    alignas(64) std::uint16_t wrong[count] = {};
    const std::uint32_t range = last - first;
    for (std::uint32_t offset = 0; offset <= range; offset += count) {
        alignas(64) std::uint32_t floats[count];
        for (std::uint32_t i = 0; i < count; ++i) floats[i] = first + (offset + i < range ? offset + i : range);
        const auto* values = reinterpret_cast<const float*>(floats);
        alignas(64) std::uint16_t halves[count];
        kernels::store_halves<xsimd::PELAGIC_ISA_ARCH>(V::load_aligned(values), V::load_aligned(values + channel),
                                                       V::load_aligned(values + 2 * channel),
                                                       V::load_aligned(values + 3 * channel), halves);
        for (std::uint32_t i = 0; i < count; ++i) wrong[i] |= halves[i] ^ expected;
    }
    std::uint16_t all = 0;
    for (const std::uint16_t bits : wrong) all |= bits;
    return all;
}

}  // namespace pelagic
