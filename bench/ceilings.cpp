#include "pelagic/bench/ceilings.hpp"

#include <cstdlib>

namespace pelagic::bench {

#define PELAGIC_CEILINGS_OF(isa)          \
    double arithmetic_##isa(std::size_t); \
    double copy_##isa(const float*, float*, std::size_t, std::size_t);
#if defined(__x86_64__)
PELAGIC_CEILINGS_OF(sse4_2)
PELAGIC_CEILINGS_OF(avx2)
PELAGIC_CEILINGS_OF(avx512)
#else
PELAGIC_CEILINGS_OF(neon)
#endif

double run_arithmetic(Isa isa, std::size_t rounds) {
    switch (isa) {
#if defined(__x86_64__)
        case Isa::sse4_2: return arithmetic_sse4_2(rounds);
        case Isa::avx2: return arithmetic_avx2(rounds);
        case Isa::avx512: return arithmetic_avx512(rounds);
        default: break;
#else
        case Isa::neon: return arithmetic_neon(rounds);
        default: break;
#endif
    }
    std::abort();
}

double run_copy(Isa isa, const float* from, float* to, std::size_t floats, std::size_t rounds) {
    switch (isa) {
#if defined(__x86_64__)
        case Isa::sse4_2: return copy_sse4_2(from, to, floats, rounds);
        case Isa::avx2: return copy_avx2(from, to, floats, rounds);
        case Isa::avx512: return copy_avx512(from, to, floats, rounds);
        default: break;
#else
        case Isa::neon: return copy_neon(from, to, floats, rounds);
        default: break;
#endif
    }
    std::abort();
}

}  // namespace pelagic::bench
