#include "pelagic/bench/peers/fftw_kernels.hpp"

#include <cassert>
#include <cstdlib>

#include "pelagic/simd/isa.hpp"

namespace pelagic::peers {

#if defined(__x86_64__)
extern const FftwKernels fftw_kernels_sse4_2, fftw_kernels_avx2, fftw_kernels_avx512;
#else
extern const FftwKernels fftw_kernels_neon;
#endif

const FftwKernels& fftw_kernels_for(Isa isa) {
    assert(runs_here(isa));
    switch (isa) {
#if defined(__x86_64__)
        case Isa::sse4_2: return fftw_kernels_sse4_2;
        case Isa::avx2: return fftw_kernels_avx2;
        case Isa::avx512: return fftw_kernels_avx512;
        default: break;
#else
        case Isa::neon: return fftw_kernels_neon;
        default: break;
#endif
    }
    std::abort();  // the precondition is broken
}

}  // namespace pelagic::peers
