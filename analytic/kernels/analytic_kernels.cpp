#include "pelagic/analytic/kernels/analytic_kernels.hpp"

#include <cassert>
#include <cstdlib>

namespace pelagic {

#if defined(__x86_64__)
extern const AnalyticKernels analytic_kernels_sse4_2, analytic_kernels_avx2, analytic_kernels_avx512;
#elif defined(__wasm__)
extern const AnalyticKernels analytic_kernels_wasm128;
#else
extern const AnalyticKernels analytic_kernels_neon;
#endif

const AnalyticKernels& analytic_kernels_for(Isa isa) {
    assert(runs_here(isa));
    switch (isa) {
#if defined(__x86_64__)
        case Isa::sse4_2: return analytic_kernels_sse4_2;
        case Isa::avx2: return analytic_kernels_avx2;
        case Isa::avx512: return analytic_kernels_avx512;
        default: break;
#elif defined(__wasm__)
        case Isa::wasm128: return analytic_kernels_wasm128;
        default: break;
#else
        case Isa::neon: return analytic_kernels_neon;
        default: break;
#endif
    }
    std::abort();  // precondition violated
}

}  // namespace pelagic
