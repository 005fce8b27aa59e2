// The table of kernels: one row a stage, one table an instruction set, chosen once when an ocean is built.
//
// A kernel does one job of its stage: it knows lanes and memory, but no threads, no graph and no options. Every
// instruction set yields the same bits. This header is included by the per-instruction-set objects, so it must stay
// free of containers, streams and anything else whose inline functions a linker might keep for everyone.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

enum class Isa;
struct ModeRow;
struct FftTables;

/// Stage `evolve`: `count` rows of the packed spectrum at a moment of the loop.
///   h = S'_xy cos + S'_zw sin                                          VR Ocean, equation 24
///   P = i (kx + i kz)/|k| h, Q = i (kx - i kz)/|k| h                   equation 30, both axes in one
/// Each kx position is independent of the others.
struct EvolveJob {
    const ModeRow* modes;
    std::size_t count;
    std::uint32_t fraction;  ///< LoopFraction::turns
    float* waves;            ///< count rows of wave_row_floats, metres; aliases no input
};

/// Stage `rows`: the transforms along x of one block of lines, all three fields, turned so that x becomes the lane.
/// Stack: at most 8 N W bytes, W the instruction set's lanes: 256 KiB for AVX-512 at N = 2048.
struct RowsJob {
    const float* waves;      ///< one line block
    std::size_t first_line;  ///< kz of its lane 0
    std::size_t line_count;  ///< lanes that hold lines: a multiple of 4, at most lane_block
    const FftTables* fft;
    float* lines;  ///< the whole buffer; aliases no input
};

/// Stage `columns`: the transforms along z of two column blocks (the second may be missing for N = 16). Same stack.
struct ColumnsJob {
    const float* lines[2];  ///< one column block each; [1] may be null
    const FftTables* fft;
    float* surface[2];  ///< one column block each, metres before choppiness; aliases no input
};

/// Extremes of some rows of a frame, in metres; merged in any order they give the same bits.
struct RowBounds {
    float height_min, height_max, sideways_x_max, sideways_z_max;
};

/// Stage `finalize`: rows [first_row, end_row) of the surface as three planes, sideways parts times lambda
/// (VR Ocean, equation 44; no sign correction, because the transforms work in FFT order).
struct FinalizeJob {
    const float* surface;
    std::size_t resolution;
    std::size_t first_row, end_row;
    float choppiness;
    float* planes[3];       ///< dx, height, dz: texel (0, 0) of each; x = -1 and x = N are written too (wrap-around)
    std::ptrdiff_t stride;  ///< floats between rows, at least N + 2
    RowBounds* bounds;      ///< of these rows
};

/// Stage `gradients`: rows 2 row_pair and 2 row_pair + 1. Central differences with wrap (equations 45, 46), the full
/// normal N = (hz Dz,x - hx (1 + Dz,z), J, hx Dx,z - hz (1 + Dx,x)) and the Jacobian J (48), packed (50, 51), the
/// half floats with foam = saturate((1/2 - J) / (1/2)), and the first mip's averages (52).
struct GradientsJob {
    const float* planes[3];
    std::ptrdiff_t stride;
    std::size_t resolution;
    std::size_t row_pair;
    float half_texels_per_metre;  ///< N / (2 L)
    float normal_length;          ///< equation 49 at the sea's roughness
    float smoothness;             ///< 1 - sqrt(roughness)
    std::uint32_t* rgba8;         ///< level 0, tight rows
    std::uint16_t* rgba16f;       ///< tight rows of four halves a texel
    float* mip_row[4];  ///< level 1, row row_pair: nx, ny, nz of the scaled normal, and J clamped to [-1, 1]
};

/// Stage `mipmaps`, half a step: averages two rows of a level to one of the next (equation 52).
struct HalveJob {
    const float* above[4] = {};
    const float* below[4] = {};
    std::size_t count;  ///< texels of the result
    float* out[4] = {};
};

/// Stage `mipmaps`, the other half: smoothness from the normal's length (equation 53), renormalised and packed.
struct PackMipJob {
    const float* row[4] = {};  ///< padded to a whole lane_block
    std::size_t count;
    std::uint32_t* out;  ///< count texels
};

struct Kernels {
    void (*evolve)(const EvolveJob&);
    void (*rows)(const RowsJob&);
    void (*columns)(const ColumnsJob&);
    void (*finalize)(const FinalizeJob&);
    void (*gradients)(const GradientsJob&);
    void (*halve)(const HalveJob&);
    void (*pack_mip)(const PackMipJob&);
};

/// \pre runs_here(isa)
const Kernels& kernels_for(Isa isa);

}  // namespace pelagic
