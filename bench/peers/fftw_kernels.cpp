#include "pelagic/bench/peers/fftw_kernels.hpp"

#include <cassert>
#include <cstdlib>

#include "pelagic/simd/isa.hpp"

namespace pelagic::peers {

#define PELAGIC_COMPILED_ISA(isa) extern const FftwKernels fftw_kernels_##isa;
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA

const FftwKernels& fftw_kernels_for(Isa isa) {
    assert(runs_here(isa));
    switch (isa) {
#define PELAGIC_COMPILED_ISA(isa) \
    case Isa::isa: return fftw_kernels_##isa;
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA
        default: break;
    }
    std::abort();  // the precondition is broken
}

}  // namespace pelagic::peers
