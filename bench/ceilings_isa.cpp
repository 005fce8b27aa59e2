// Compiled once for each instruction set, with the rules of sim/kernels/kernels_isa.cpp.
#include <cstddef>
#include <xsimd/xsimd.hpp>

#define PELAGIC_JOINED(a, b) a##b
#define PELAGIC_NAMED(function, isa) PELAGIC_JOINED(function, isa)

namespace pelagic::bench {

using V = xsimd::batch<float, xsimd::PELAGIC_ISA_ARCH>;

double PELAGIC_NAMED(arithmetic_, PELAGIC_ISA_NAME)(std::size_t rounds) {
    constexpr std::size_t chains = 6;
    V sums[chains], products[chains];
    for (std::size_t i = 0; i < chains; ++i) sums[i] = products[i] = V(static_cast<float>(i + 1));
    const V term(1e-9f), factor(0.999999f);
    // Without fast-math the compiler must not reorder a chain, so it executes every operation.
    for (std::size_t round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < chains; ++i) {
            sums[i] = sums[i] + term;
            products[i] = products[i] * factor;
        }
    }
    V all(0.f);
    for (std::size_t i = 0; i < chains; ++i) all = all + sums[i] + products[i];
    float lanes[V::size];
    all.store_unaligned(lanes);
    __asm__ volatile("" : : "r"(lanes) : "memory");
    return 2.0 * chains * V::size * static_cast<double>(rounds);
}

double PELAGIC_NAMED(copy_, PELAGIC_ISA_NAME)(const float* from, float* to, std::size_t floats, std::size_t rounds) {
    for (std::size_t round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < floats; i += 4 * V::size)
            for (std::size_t part = 0; part < 4 * V::size; part += V::size)
                V::load_aligned(from + i + part).store_aligned(to + i + part);
        __asm__ volatile("" : : "r"(to) : "memory");
    }
    return 2.0 * sizeof(float) * static_cast<double>(floats) * static_cast<double>(rounds);
}

}  // namespace pelagic::bench
