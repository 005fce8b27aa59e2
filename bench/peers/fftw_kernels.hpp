// Kernels of the FFTW frame outside of FFTW, in the widest registers: one table for each
// instruction set, as in sim/kernels/kernels.hpp, with shared code where the data's layout allows.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic::peers {

/// Waves (kx, kz) and (kx, -kz) for kx in [0, N/2), planes of N/2 floats each for one kz: S' of
/// both, then k / |k| of the first, as in sim/kernels/wave_blocks.hpp but with kz negated instead
/// of kx.
struct FftwWaves {
    const float* planes;             ///< 10 rows of N/2
    const std::uint32_t* harmonics;  ///< N/2
};

/// The spectra of rows kz and -kz at a time, in FFTW's layout; those of Nyquist stay zero. For kz =
/// 0 both are one row.
struct FftwEvolveJob {
    FftwWaves waves;
    std::size_t half_size;  ///< N/2
    std::uint32_t fraction;
    bool is_one_row;
    float* height[2];      ///< rows kz and -kz of N/2 + 1 complex numbers
    float* horizontal[2];  ///< packed: rows of N complex numbers of Dx + i Dz
    float* dx[2];          ///< separate: rows of N/2 + 1 complex numbers, like height
    float* dz[2];
};

struct FftwFinalizeJob {
    const float* horizontal;  ///< Dx + i Dz, or null: then dx and dz hold the transforms' results
    std::size_t texels;
    float choppiness;
    float *dx, *height, *dz;
    FrameBounds* bounds;
};

struct FftwKernels {
    void (*evolve_packed)(const FftwEvolveJob&);
    void (*evolve_separate)(const FftwEvolveJob&);
    void (*finalize)(const FftwFinalizeJob&);
    /// GradientsJob::surface is the plane of dx. The planes of the height and dz follow at
    /// distances of `block_stride` floats.
    void (*gradients)(const GradientsJob&);
};

/// \pre runs_here(isa)
const FftwKernels& fftw_kernels_for(Isa isa);

}  // namespace pelagic::peers
