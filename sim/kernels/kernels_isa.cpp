// Compiled once per instruction set, always with optimisation (cmake/isa.cmake sets the flags).
// Include only kernels here: the linker keeps one copy of an inline function for all objects, and
// could keep the copy compiled for this instruction set.
//
// PELAGIC_ISA_NAME  sse4_2, avx2, avx512, neon or wasm128
// PELAGIC_ISA_ARCH  the instruction set's name in xsimd
#include "pelagic/sim/kernels/blend.kernel.hpp"
#include "pelagic/sim/kernels/columns_finalize.kernel.hpp"
#include "pelagic/sim/kernels/contraction.kernel.hpp"
#include "pelagic/sim/kernels/dynamic_waves_step.kernel.hpp"
#include "pelagic/sim/kernels/evolve_rows.kernel.hpp"
#include "pelagic/sim/kernels/folds.kernel.hpp"
#include "pelagic/sim/kernels/gradients.kernel.hpp"
#include "pelagic/sim/kernels/inputs.kernel.hpp"
#include "pelagic/sim/kernels/mipmaps.kernel.hpp"
#include "pelagic/sim/kernels/positions.kernel.hpp"
#include "pelagic/sim/kernels/shore.kernel.hpp"
#include "pelagic/sim/kernels/slopes.kernel.hpp"
#include "pelagic/sim/kernels/snapshots.kernel.hpp"
#include "pelagic/sim/kernels/stack_query.kernel.hpp"
#include "pelagic/sim/kernels/surface_query.kernel.hpp"
#include "pelagic/sim/kernels/water_levels.kernel.hpp"
#include "pelagic/sim/kernels/wave_sums.kernel.hpp"

#define PELAGIC_JOINED(a, b) a##b
#define PELAGIC_TABLE(name) PELAGIC_JOINED(kernels_, name)

namespace pelagic {

extern const Kernels PELAGIC_TABLE(PELAGIC_ISA_NAME);

const Kernels PELAGIC_TABLE(PELAGIC_ISA_NAME) = {
    xsimd::batch<float, xsimd::PELAGIC_ISA_ARCH>::size,
    kernels::blend_waves<xsimd::PELAGIC_ISA_ARCH>,
    kernels::blend_arriving_waves<xsimd::PELAGIC_ISA_ARCH>,
    kernels::evolve_rows<xsimd::PELAGIC_ISA_ARCH>,
    kernels::evolve_velocity_rows<xsimd::PELAGIC_ISA_ARCH>,
    kernels::columns_finalize<xsimd::PELAGIC_ISA_ARCH>,
    kernels::water_rows<xsimd::PELAGIC_ISA_ARCH>,
    kernels::water_columns<xsimd::PELAGIC_ISA_ARCH>,
    kernels::gradients<xsimd::PELAGIC_ISA_ARCH>,
    kernels::mip_level<xsimd::PELAGIC_ISA_ARCH>,
    kernels::slopes<xsimd::PELAGIC_ISA_ARCH>,
    kernels::slope_level<xsimd::PELAGIC_ISA_ARCH>,
    kernels::compression<xsimd::PELAGIC_ISA_ARCH>,
    kernels::snapshot<xsimd::PELAGIC_ISA_ARCH>,
    kernels::halve_snapshots<xsimd::PELAGIC_ISA_ARCH>,
    kernels::find_folds<xsimd::PELAGIC_ISA_ARCH>,
    kernels::split_positions<xsimd::PELAGIC_ISA_ARCH>,
    {kernels::invert_surface<xsimd::PELAGIC_ISA_ARCH, kernels::Linear>,
     kernels::invert_surface<xsimd::PELAGIC_ISA_ARCH, kernels::Cubic>},
    {kernels::sample_surface<xsimd::PELAGIC_ISA_ARCH, kernels::Linear>,
     kernels::sample_surface<xsimd::PELAGIC_ISA_ARCH, kernels::Cubic>},
    kernels::find_contraction<xsimd::PELAGIC_ISA_ARCH>,
    kernels::spread_contraction<xsimd::PELAGIC_ISA_ARCH>,
    kernels::halve_contraction<xsimd::PELAGIC_ISA_ARCH>,
    kernels::steepness<xsimd::PELAGIC_ISA_ARCH>,
    {kernels::invert_stack<xsimd::PELAGIC_ISA_ARCH, kernels::Linear>,
     kernels::invert_stack<xsimd::PELAGIC_ISA_ARCH, kernels::Cubic>},
    {kernels::sample_stack<xsimd::PELAGIC_ISA_ARCH, kernels::Linear>,
     kernels::sample_stack<xsimd::PELAGIC_ISA_ARCH, kernels::Cubic>},
    kernels::dynamic_columns<xsimd::PELAGIC_ISA_ARCH>,
    kernels::dynamic_lines<xsimd::PELAGIC_ISA_ARCH>,
    kernels::dynamic_columns_back<xsimd::PELAGIC_ISA_ARCH>,
    kernels::damp_rows<xsimd::PELAGIC_ISA_ARCH>,
    kernels::verlet_rows<xsimd::PELAGIC_ISA_ARCH>,
    kernels::dynamic_foam<xsimd::PELAGIC_ISA_ARCH>,
    kernels::interpolate_ticks<xsimd::PELAGIC_ISA_ARCH>,
    kernels::shore_rows<xsimd::PELAGIC_ISA_ARCH>,
    kernels::add_waves<xsimd::PELAGIC_ISA_ARCH>,
    kernels::add_ripple<xsimd::PELAGIC_ISA_ARCH>,
    kernels::add_rows<xsimd::PELAGIC_ISA_ARCH>,
    kernels::move_waves<xsimd::PELAGIC_ISA_ARCH>,
    kernels::sum_heights<xsimd::PELAGIC_ISA_ARCH>,
    kernels::sum_water<xsimd::PELAGIC_ISA_ARCH>,
};

}  // namespace pelagic
