#include "pelagic/bench/ceilings.hpp"

#include <cstdlib>

namespace pelagic::bench {

#define PELAGIC_COMPILED_ISA(isa)         \
    double arithmetic_##isa(std::size_t); \
    double copy_##isa(const float*, float*, std::size_t, std::size_t);
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA

double run_arithmetic(Isa isa, std::size_t rounds) {
    switch (isa) {
#define PELAGIC_COMPILED_ISA(isa) \
    case Isa::isa: return arithmetic_##isa(rounds);
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA
        default: break;
    }
    std::abort();
}

double run_copy(Isa isa, const float* from, float* to, std::size_t floats, std::size_t rounds) {
    switch (isa) {
#define PELAGIC_COMPILED_ISA(isa) \
    case Isa::isa: return copy_##isa(from, to, floats, rounds);
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA
        default: break;
    }
    std::abort();
}

}  // namespace pelagic::bench
