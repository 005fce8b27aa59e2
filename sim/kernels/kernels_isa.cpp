// Compiled once for each instruction set, always optimised: cmake/isa.cmake says how. Only kernels may be included
// here, because the linker keeps one copy of an inline function for everyone, and it might be this one.
//
// PELAGIC_ISA_NAME  sse4_2, avx2, avx512 or neon
// PELAGIC_ISA_ARCH  xsimd's name of it
#include "sim/kernels/columns.kernel.hpp"
#include "sim/kernels/evolve.kernel.hpp"
#include "sim/kernels/finalize.kernel.hpp"
#include "sim/kernels/gradients.kernel.hpp"
#include "sim/kernels/mipmaps.kernel.hpp"
#include "sim/kernels/rows.kernel.hpp"

#define PELAGIC_JOINED(a, b) a##b
#define PELAGIC_TABLE(name) PELAGIC_JOINED(kernels_, name)

namespace pelagic {

extern const Kernels PELAGIC_TABLE(PELAGIC_ISA_NAME);

const Kernels PELAGIC_TABLE(PELAGIC_ISA_NAME) = {
    kernels::evolve<xsimd::PELAGIC_ISA_ARCH>,    kernels::rows<xsimd::PELAGIC_ISA_ARCH>,
    kernels::columns<xsimd::PELAGIC_ISA_ARCH>,   kernels::finalize<xsimd::PELAGIC_ISA_ARCH>,
    kernels::gradients<xsimd::PELAGIC_ISA_ARCH>, kernels::halve<xsimd::PELAGIC_ISA_ARCH>,
    kernels::pack_mip<xsimd::PELAGIC_ISA_ARCH>,
};

}  // namespace pelagic
