#include "pelagic/analytic/kernels/analytic_kernels.hpp"

#include <cassert>
#include <cstdlib>

namespace pelagic {

#define PELAGIC_COMPILED_ISA(isa) extern const AnalyticKernels analytic_kernels_##isa;
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA

const AnalyticKernels& analytic_kernels_for(Isa isa) {
    assert(runs_here(isa));
    switch (isa) {
#define PELAGIC_COMPILED_ISA(isa) \
    case Isa::isa: return analytic_kernels_##isa;
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA
        default: break;
    }
    std::abort();  // precondition violated
}

}  // namespace pelagic
