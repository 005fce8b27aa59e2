#include "pelagic/sim/kernels/kernels.hpp"

#include <cassert>
#include <cstdlib>

#include "pelagic/simd/isa.hpp"

namespace pelagic {

#define PELAGIC_COMPILED_ISA(isa) extern const Kernels kernels_##isa;
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA

const Kernels& kernels_for(Isa isa) {
    assert(runs_here(isa));
    switch (isa) {
#define PELAGIC_COMPILED_ISA(isa) \
    case Isa::isa: return kernels_##isa;
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA
        default: break;
    }
    std::abort();  // the precondition is violated
}

}  // namespace pelagic
