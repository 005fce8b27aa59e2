// The table of kernels: one row a job, one table an instruction set, chosen once when an ocean is built.
//
// A kernel does one job of its stage: it knows lanes and memory, but no threads, no graph and no options. Every
// instruction set yields the same bits. This header is included by the per-instruction-set objects, so it must stay
// free of containers, streams and anything else whose inline functions a linker might keep for everyone.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

enum class Isa;
struct FftTables;

/// Stages `evolve` and `rows`: one block of lines at a moment of the loop, transformed along x, turned so that x
/// becomes the lane.
///   h = S'_xy cos + S'_zw sin                                          VR Ocean, equation 24
///   P = -i (kx + i kz)/|k| h, R = (kx - i kz)/|k| h                    equation 30, both axes in one
/// Stack: 24 N W bytes, W the lanes of the instruction set.
struct EvolveRowsJob {
    const float* waves;              ///< the block of PackedSpectrum::waves
    const std::uint32_t* harmonics;  ///< the same of its harmonics
    std::uint32_t fraction;          ///< LoopFraction::turns
    std::size_t first_line;          ///< kz of lane 0
    std::size_t line_count;          ///< lanes that hold lines, at most W
    const FftTables* fft;
    float* lines;  ///< all column blocks; aliases no input
};

/// Extremes of a part of a frame, in metres; merged in any order they give the same bits.
struct PartBounds {
    float height_min, height_max, sideways_x_max, sideways_z_max;
};

/// Stages `columns` and `finalize`: the transforms along z of two column blocks, sideways parts times lambda (VR
/// Ocean, equation 44; no sign correction, because the transforms work in FFT order), and the extremes of both.
/// Stack: 8 N W bytes.
struct ColumnsFinalizeJob {
    float* blocks[2];  ///< lines before, surface afterwards, metres; [1] holds the partners of [0]; null for N = 16
    const FftTables* fft;
    float choppiness;
    PartBounds* bounds;
};

/// Planes of averages that a mip level is made from: scaled normal x, y, z, and J clamped to [-1, 1].
inline constexpr std::size_t mip_planes = 4;

/// Stage `gradients` and the first levels of `mipmaps` on one tile of texels. Central differences with wrap (equations
/// 45, 46), the full normal N = (hz Dz,x - hx (1 + Dz,z), J, hx Dx,z - hz (1 + Dx,x)) and the Jacobian J (48), packed
/// (50, 51); the half floats with foam = saturate((1/2 - J) / (1/2)); then tile_levels levels of averages (52, 53).
struct GradientsJob {
    static constexpr std::size_t tile_rows = 16, tile_columns = 256;
    static constexpr int tile_levels = 3;

    const float* surface;  ///< all column blocks
    std::size_t resolution;
    std::size_t first_row, first_column;     ///< of the tile, which is smaller than the above if N is
    std::size_t block_stride;                ///< floats between column blocks
    float two_texels_m;                      ///< 2 L / N
    float jacobian_factor;                   ///< 1 / two_texels_m^2
    float normal_length;                     ///< equation 49 at the sea's roughness
    std::int32_t smoothness_bits;            ///< 1 - sqrt(roughness) as the highest byte of a texel
    std::uint16_t* rgba16f;                  ///< tight rows of four halves a texel
    std::uint32_t* levels[tile_levels + 1];  ///< tight rows of RGBA8, the texels of level 0 to 3
    float* averages;                         ///< of level 3, for MipLevelJob
    std::size_t average_stride;
};

/// Stage `mipmaps`, one level: the averages of 2 x 2 texels (52), smoothness from the normal's length (53),
/// renormalised and packed. Averages are rows of mip_planes planes and one more for the kernel's own use, `stride`
/// floats each, at least 32 and the level's side.
struct MipLevelJob {
    float* finer;  ///< averages of the finer level
    std::size_t finer_stride;
    std::size_t side;
    float* averages;  ///< of this level; aliases no input
    std::size_t stride;
    std::uint32_t* texels;  ///< side^2
};

struct Kernels {
    std::size_t lanes;  ///< floats in a register, and lanes of a block in every buffer
    void (*evolve_rows)(const EvolveRowsJob&);
    void (*columns_finalize)(const ColumnsFinalizeJob&);
    void (*gradients)(const GradientsJob&);
    void (*mip_level)(const MipLevelJob&);
};

/// \pre runs_here(isa)
const Kernels& kernels_for(Isa isa);

}  // namespace pelagic
