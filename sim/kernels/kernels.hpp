// The table of kernels: one row a job, one table an instruction set, chosen once when an ocean is built.
//
// A kernel does one job of its stage: it knows lanes and memory, but no threads, no graph and no options. Every
// instruction set yields the same bits. This header is included by the per-instruction-set objects, so it must stay
// free of containers, streams and anything else whose inline functions a linker might keep for everyone.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/dynamic_wave_jobs.hpp"
#include "pelagic/sim/kernels/input_jobs.hpp"
#include "pelagic/sim/kernels/shore_jobs.hpp"

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
    std::size_t line_count;          ///< lanes that hold lines: W, or W/2 where N = 16 has no more
    const FftTables* fft;
    float* lines;  ///< all column blocks; aliases no input
    /// Only for evolve_velocity_rows, which makes the same lines of the derivative in time: the angular frequency of
    /// harmonic 1, 2 pi / T in rad/s.
    float first_frequency = 0;
};

/// Beginning of stage `evolve` while one sea turns into another: one block of lines of both spectra, wave by wave. With S' =
/// (a + c, b + d, b - d, c - a) as equation 22 packs it, each of a, b, c, d becomes
///   sign sqrt((1 - s) before^2 + s after^2),
/// so that energies go over and draws stay; where the signs differ, as of waves that no draw is behind, (1 - s) before + s after.
/// Both have the waves of the same grid.
struct BlendWavesJob {
    /// A square of the least amplitude that a sea has, 1e-20 m, leaves the range of floats. A power of two changes no bit.
    static constexpr float scale = 0x1p32f;

    const float *before, *after;  ///< the block of each PackedSpectrum::waves
    std::size_t pairs;            ///< of waves in the block
    float part;                   ///< s, [0, 1]
    float* out;                   ///< as `before`; aliases no input
};

/// The same while a swell from afar comes: each wave has the s of its band of frequency (sim/spectrum/harmonic_bands.hpp).
struct BlendArrivingWavesJob {
    /// Of a harmonic as a float, exponent and four binary digits are its band.
    static constexpr int band_shift = 19;
    static constexpr int first_band = 127 << 4;  ///< of harmonic 1

    const float *before, *after;
    const std::uint32_t* harmonics;  ///< the block of PackedSpectrum::harmonics
    std::size_t pairs;
    const float* parts;      ///< s of each band, [0, 1]
    std::int32_t last_band;  ///< of those; later ones have its s
    float* out;              ///< as `before`; aliases no input
};

/// Extremes of a part of a frame, in metres; merged in any order they give the same bits.
struct PartBounds {
    float height_min, height_max, horizontal_x_max, horizontal_z_max;
};

/// Stages `columns` and `finalize`: the transforms along z of two column blocks, horizontal parts times lambda (VR
/// Ocean, equation 44; no sign correction, because the transforms work in FFT order), and the extremes of both.
/// Stack: 8 N W bytes.
struct ColumnsFinalizeJob {
    float* blocks[2];  ///< lines before, surface afterwards, metres; [1] holds the partners of [0]; null for N = 16
    const FftTables* fft;
    float choppiness;
    float cosine,
        sine;  ///< of the angle by which the cascade's axes are rotated; horizontal parts leave in the world's axes
    PartBounds* bounds;
};

/// The foam that water makes where it breaks, in whole bytes: nearest(clamp(offset - scale J, 0, 255)).
struct FoamSource {
    float offset = 0, scale = 0;
};

/// What a frame shows of a cascade's foam: at each texel the more of what breaks now and what is remembered, less `fade`.
struct ShownFoam {
    FoamSource source;
    const std::uint8_t* remembered = nullptr;  ///< N^2 bytes of the last tick; null: nothing, and nobody wants bytes
    int fade = 0;
    std::uint8_t* bytes = nullptr;  ///< N^2
};

/// Planes of averages that a mip level is made from: scaled normal x, y, z, and J clamped to [-1, 1].
inline constexpr std::size_t mip_planes = 4;

/// Stage `gradients` and the first levels of `mipmaps` on one cascade of texels. Central differences with wrap (equations
/// 45, 46), the full normal N = (hz Dz,x - hx (1 + Dz,z), J, hx Dx,z - hz (1 + Dx,x)) and the Jacobian J (48), packed
/// (50, 51); the half floats with foam as a part of 255; then cascade_levels levels of averages (52, 53).
struct GradientsJob {
    static constexpr std::size_t cascade_rows = 16, cascade_columns = 256;
    static constexpr int cascade_levels = 3;

    const float* surface;  ///< all column blocks
    std::size_t resolution;
    std::size_t first_row, first_column;        ///< of the cascade, which is smaller than the above if N is
    std::size_t block_stride;                   ///< floats between column blocks
    float two_texels_m;                         ///< 2 L / N
    float jacobian_factor;                      ///< 1 / two_texels_m^2
    float normal_length;                        ///< equation 49 at the sea's roughness
    std::int32_t smoothness_bits;               ///< 1 - sqrt(roughness) as the highest byte of a texel
    std::uint16_t* rgba16f;                     ///< tight rows of four halves a texel; null: nobody wants them
    ShownFoam foam;                             ///< with the half floats
    std::uint32_t* levels[cascade_levels + 1];  ///< tight rows of RGBA8, the texels of level 0 to 3
    float* averages;                            ///< of level 3, for MipLevelJob
    std::size_t average_stride;
    float cosine = 1,
          sine = 0;  ///< of the angle by which the cascade's axes are rotated in the world, from +x towards +z;
                     ///< displacement, normals and J are along the world's axes
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

/// What the slopes' levels are averaged from: h_x, h_z, D_xx, D_zz, D_xz and the mean squares h_x^2, h_z^2, h_x h_z,
/// in steps of a byte.
inline constexpr std::size_t slope_planes = 8;

/// Stage `slopes` and its first levels on one cascade of texels: what of a surface can be added to other surfaces', so that
/// a sum of cascades has the normals and Jacobians of the sum (sim/slope_sum.hpp). Two words a texel, from the lowest byte up:
///   slopes   h_x, h_z, D_xx, D_zz, signed, in parts of slope_range
///   moments  D_xz = (Dx,z + Dz,x)/2, signed, in parts of slope_range; var h_x, var h_z from 0, cov(h_x, h_z) signed, in
///            parts of variance_range
/// A signed byte b is (b - 128)/127, one from 0 is b/255; values beyond the ranges stop there. Derivatives are along the
/// world's axes. Variances are those within a texel (LEAN mapping: Olano and Baker 2010); none at level 0.
///
/// Derivatives are near_weight (f(1) - f(-1)) + far_weight (f(2) - f(-2)) over the texel's size. One number is free when
/// a constant slope keeps its value. It is chosen so that what a GPU shows, bilinear between texels, is nearest the
/// surface itself: of all waves with 6/128 to 1/3 steps a texel, each octave as steep, from everywhere, in the mean over
/// the square between texels (docs/equations.md has the integral). The derivative at a texel therefore overstates short
/// waves as much as the filter takes of them.
struct SlopesJob {
    static constexpr std::size_t cascade_rows = 16, cascade_columns = 256;
    static constexpr int cascade_levels = 3;
    static constexpr double far_weight = -0.2194, near_weight = 0.5 - 2 * far_weight;

    const float* surface;  ///< all column blocks
    std::size_t resolution;
    std::size_t first_row, first_column;         ///< of the cascade, which is smaller than the above if N is
    std::size_t block_stride;                    ///< floats between column blocks
    float cosine, sine;                          ///< as in GradientsJob
    float difference_factor;                     ///< near_weight / (slope_step L / N)
    float slope_step;                            ///< slope_range / 127
    float variance_factor;                       ///< slope_step^2 / variance_range
    std::uint16_t* rgba16f;                      ///< as in GradientsJob, J from these slopes; null: nobody wants them
    ShownFoam foam;                              ///< the same
    std::uint32_t* slopes[cascade_levels + 1];   ///< tight rows, the texels of level 0 to 3
    std::uint32_t* moments[cascade_levels + 1];  ///< the same
    float* averages;                             ///< of level 3, for SlopeLevelJob
    std::size_t average_stride;
};

/// Stage `slopes tail`, one level: averages of 2 x 2 texels, packed. Averages are rows of slope_planes planes, `stride`
/// floats each, at least 32 and the level's side.
struct SlopeLevelJob {
    float* finer;  ///< averages of the finer level
    std::size_t finer_stride;
    std::size_t side;
    float* averages;  ///< of this level; aliases no input
    std::size_t stride;
    float variance_factor;
    std::uint32_t *slopes, *moments;  ///< side^2 each
};

/// One tick of a cascade's foam: after = max(source(J), before - fade), `before` moved by whole texels, which wrap. Derivatives are
/// as in SlopesJob.
struct FoamTickJob {
    static constexpr std::size_t max_resolution = 2048;
    static constexpr int fade = 9;

    const float* surface;  ///< all column blocks
    std::size_t resolution;
    std::size_t block_stride;
    float cosine, sine;       ///< as in GradientsJob
    float difference_factor;  ///< the near weight over L / N
    float far_over_near;      ///< 0: central differences
    FoamSource source;
    const std::uint8_t* before;    ///< N^2
    std::size_t shift_x, shift_z;  ///< along the cascade's axes, less than N
    std::size_t first_row, rows;   ///< even
    std::uint8_t* after;           ///< N^2, these rows are written; aliases no input
};

/// The mean of each 2 x 2 bytes, halves up.
struct HalveFoamJob {
    const std::uint8_t* from;  ///< 4 side^2
    std::size_t side;
    std::uint8_t* to;  ///< side^2
};

/// The surface of a frame as queries read it. Texel (i, j) of a plane is
/// plane[(i >> block_shift) * block_stride + (i & (block_columns - 1)) + j * row_stride].
struct SurfaceTexels {
    const float *dx, *height, *dz;                      ///< metres
    const float *velocity_x, *velocity_y, *velocity_z;  ///< metres a second; null if the frame has none
    std::int32_t resolution;                            ///< N, a power of two
    std::int32_t block_columns, block_shift;            ///< a power of two, and its logarithm
    std::int32_t row_stride, block_stride;              ///< in floats
};

/// Places on a square of texels, by component: a cell and where in it, from 0 to 1. Cells may lie outside of the patch.
/// Arrays are aligned, and as long as whole registers.
struct CellPlaces {
    std::int32_t *cell_x, *cell_z;
    float *u, *v;
};

/// Which reference point is drawn at a given world point: the q of q + D(q) = p, D being bilinear or cubic between texels. Newton's
/// steps with the slopes of the cell; where they don't hold (far away, or near a fold) q - (q + D(q) - p) instead.
/// A lane that has come within `target` stays as it is, so no lane depends on its neighbours.
struct InvertSurfaceJob {
    static constexpr int max_steps = 12;
    static constexpr float newton_reach = 2;  ///< texels, along each axis: the slopes of one cell say nothing beyond
    static constexpr float min_determinant = 0.1f;  ///< a step is at most 1 / this times what is missing

    SurfaceTexels surface;
    float texels_per_m;  ///< N / L
    float target;        ///< remaining distance at which a lane stops, in texels
    std::size_t count;   ///< a multiple of W
    CellPlaces world;    ///< where to look
    CellPlaces rest;     ///< what rests there; aliases no input
    float* error;        ///< remaining distance in texels
};

/// The surface at reference points. Linear: everything bilinear between texels, slopes from central differences at texels. Cubic:
/// products of Catmull and Rom's cubics, and their derivatives. Blocks of the surface have a multiple of W columns.
struct SampleSurfaceJob {
    struct Outputs {
        float* height;                                     ///< metres; null if nobody wants it
        float *normal_x, *normal_y, *normal_z, *jacobian;  ///< all, with height, or none
        float *velocity_x, *velocity_y, *velocity_z;       ///< all or none
    };
    SurfaceTexels surface;
    float two_texels_m;     ///< 2 L / N
    float jacobian_factor;  ///< 1 / two_texels_m^2
    std::size_t count;      ///< a multiple of W
    CellPlaces rest;
    Outputs out;  ///< aliases no input
};

/// Cells in which the surface turns over, or nearly so: the least Jacobian, times the area of a texel at rest, is at
/// most `max_area`. Blocks of the surface have a multiple of W columns.
struct FindFoldsJob {
    SurfaceTexels surface;
    float texel_m;  ///< L / N
    float max_area;
    std::size_t first_row, rows;
    std::uint8_t* cells;  ///< N^2 bits, cell (i, j) being bit i % 8 of byte (j N + i) / 8; these rows are written
};

/// Extremes of a part of a cascade.
struct ContractionExtremes {
    float displacement_squared;  ///< largest Dx^2 + Dz^2
    float stretch;               ///< what no slope matrix makes a vector grow by more than
    float steepness_squared;     ///< largest square of the height's gradient
};

/// How much a cascade contracts the water together at most, by blocks of 2 x 2 cells: minus the least eigenvalue of the
/// symmetric part of its slopes, or 0, times `one`, rounded up; the largest byte means that or anything more. Inside
/// a cell the slopes lie between those at its corners, and the least eigenvalue is a concave function of them, so it is
/// least at a corner. Blocks of the surface have a multiple of W columns.
struct FindContractionJob {
    static constexpr std::size_t max_resolution = 2048;

    SurfaceTexels surface;
    float texels_per_m;             ///< N / L
    float cosine, sine;             ///< of the cascade's grid
    float one;                      ///< the byte that means 1
    std::size_t first_row, rows;    ///< even
    std::uint8_t* blocks;           ///< (N/2)^2, tight rows; those of these rows are written
    ContractionExtremes* extremes;  ///< of these rows
};

/// The largest byte within `reach` of each along both axes; the square of bytes repeats.
struct SpreadContractionJob {
    static constexpr std::size_t max_side = 1024;  ///< half of the largest resolution

    const std::uint8_t* from;  ///< side^2
    std::size_t side;          ///< a power of two
    std::size_t reach;         ///< less than side / 2
    std::uint8_t* scratch;     ///< 2 side^2
    std::uint8_t* to;          ///< side^2
};

/// The largest byte of each 2 x 2.
struct HalveContractionJob {
    const std::uint8_t* from;  ///< 4 side^2
    std::size_t side;
    std::uint8_t* to;  ///< side^2
};

/// Cascades that a kernel adds up, at most.
inline constexpr std::size_t max_cascades = 4;

/// One cascade of a stack as queries read it. A point that is drawn d metres from where it rests rests at world - d.
struct StackCascade {
    SurfaceTexels surface;
    float along, across;  ///< the grid's cosine and sine, times N / L
    CellPlaces world;     ///< of each point, along the cascade's own axes
    const float* part =
        nullptr;  ///< of the cascade's displacement that counts at each point; of all cascades or none: null, all of it
};

/// InvertSurfaceJob for a sum of cascades: the offset o with o + sum of D(p + o) = 0. The first step knows the coarsest cascades only:
/// where finer ones are looked at, the place is right to within their waves. From then on a lane that has come within
/// `target` stays as it is.
struct InvertStackJob {
    static constexpr std::size_t first_cascades = 2;
    static constexpr int max_steps = 16;
    static constexpr float min_determinant = 0.1f;

    StackCascade cascades[max_cascades];
    std::size_t cascade_count;
    float target;                        ///< metres
    float reach;                         ///< metres: no offset is longer than the largest displacement
    std::size_t count;                   ///< a multiple of W
    float *offset_x, *offset_z;          ///< metres, from the given points to those that rest there; alias no input
    float* error;                        ///< remaining distance in metres
    std::int32_t* blocks[max_cascades];  ///< of 2 x 2 cells of each cascade, row by row: where that is
};

/// SampleSurfaceJob for a sum of cascades: slopes add, and normals are those of the sum.
struct SampleStackJob {
    StackCascade cascades[max_cascades];
    std::size_t cascade_count;
    std::size_t count;  ///< a multiple of W
    const float *offset_x, *offset_z;
    SampleSurfaceJob::Outputs out;  ///< aliases no input
};

/// A kernel of queries for each Interpolation. The cubic inversion begins where the linear one ended: the places of what rests
/// there are its input, too.
template <class Job>
struct ByInterpolation {
    void (*linear)(const Job&);
    void (*cubic)(const Job&);
};

struct Kernels {
    std::size_t lanes;  ///< floats in a register, and lanes of a block in every buffer
    void (*blend_waves)(const BlendWavesJob&);
    void (*blend_arriving_waves)(const BlendArrivingWavesJob&);
    void (*evolve_rows)(const EvolveRowsJob&);
    void (*evolve_velocity_rows)(const EvolveRowsJob&);
    void (*columns_finalize)(const ColumnsFinalizeJob&);
    void (*gradients)(const GradientsJob&);
    void (*mip_level)(const MipLevelJob&);
    void (*slopes)(const SlopesJob&);
    void (*slope_level)(const SlopeLevelJob&);
    void (*foam_tick)(const FoamTickJob&);
    void (*halve_foam)(const HalveFoamJob&);
    void (*find_folds)(const FindFoldsJob&);
    ByInterpolation<InvertSurfaceJob> invert_surface;
    ByInterpolation<SampleSurfaceJob> sample_surface;
    void (*find_contraction)(const FindContractionJob&);
    void (*spread_contraction)(const SpreadContractionJob&);
    void (*halve_contraction)(const HalveContractionJob&);
    ByInterpolation<InvertStackJob> invert_stack;
    ByInterpolation<SampleStackJob> sample_stack;
    void (*dynamic_columns)(const DynamicColumnsJob&);
    void (*dynamic_lines)(const DynamicLinesJob&);
    void (*dynamic_columns_back)(const DynamicColumnsJob&);  ///< the third part: into h and w
    void (*damp_rows)(const DampJob&);
    void (*verlet_rows)(const VerletRowsJob&);
    void (*dynamic_foam)(const DynamicFoamJob&);
    void (*interpolate_ticks)(const TickInterpolationJob&);
    void (*shore_rows)(const ShoreRowsJob&);
    void (*add_waves)(const AddWavesJob&);
    void (*add_ripple)(const AddRippleJob&);
    bool (*add_rows)(const AddRowsJob&);  ///< false: a value is too large, or none
};

/// \pre runs_here(isa)
const Kernels& kernels_for(Isa isa);

}  // namespace pelagic
