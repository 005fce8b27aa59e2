#include "pelagic/sim/kernels/kernels.hpp"

#include <cassert>
#include <cstdlib>

#include "pelagic/simd/isa.hpp"

namespace pelagic {

#if defined(__x86_64__)
extern const Kernels kernels_sse4_2, kernels_avx2, kernels_avx512;
#elif defined(__wasm__)
extern const Kernels kernels_wasm128;
#else
extern const Kernels kernels_neon;
#endif

const Kernels& kernels_for(Isa isa) {
    assert(runs_here(isa));
    switch (isa) {
#if defined(__x86_64__)
        case Isa::sse4_2: return kernels_sse4_2;
        case Isa::avx2: return kernels_avx2;
        case Isa::avx512: return kernels_avx512;
        default: break;
#elif defined(__wasm__)
        case Isa::wasm128: return kernels_wasm128;
        default: break;
#else
        case Isa::neon: return kernels_neon;
        default: break;
#endif
    }
    std::abort();  // the precondition is violated
}

}  // namespace pelagic
