// Compiled once for each instruction set, as sim/kernels/kernels_isa.cpp. Include only kernels
// here: the linker keeps one copy of each inline function for the whole program, and it might be
// the copy compiled here.
#include "pelagic/analytic/kernels/gerstner.kernel.hpp"
#include "pelagic/analytic/kernels/pond.kernel.hpp"

#define PELAGIC_JOINED(a, b) a##b
#define PELAGIC_TABLE(name) PELAGIC_JOINED(analytic_kernels_, name)

namespace pelagic {

extern const AnalyticKernels PELAGIC_TABLE(PELAGIC_ISA_NAME);

const AnalyticKernels PELAGIC_TABLE(PELAGIC_ISA_NAME) = {
    xsimd::batch<float, xsimd::PELAGIC_ISA_ARCH>::size,
    kernels::gerstner_undisplaced<xsimd::PELAGIC_ISA_ARCH>,
    kernels::gerstner_in_world<xsimd::PELAGIC_ISA_ARCH>,
    kernels::pond<xsimd::PELAGIC_ISA_ARCH>,
};

}  // namespace pelagic
