// The kernel table: one function pointer per job type. Each instruction set has one table; the
// ocean selects it once, at construction.
//
// A kernel executes one job of its stage. It depends on lanes and memory only, never on threads,
// the job graph or options. Results are bit-identical on every instruction set.
//
// The objects compiled per instruction set include this header. It must not include containers,
// streams or other code with inline functions: the linker could keep a copy of such a function that
// uses unsupported instructions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/sim/frame_bounds.hpp"
#include "pelagic/sim/kernels/dynamic_wave_jobs.hpp"
#include "pelagic/sim/kernels/input_jobs.hpp"
#include "pelagic/sim/kernels/shore_jobs.hpp"
#include "pelagic/sim/kernels/wave_sum_jobs.hpp"

namespace pelagic {

enum class Isa;
struct FftTables;

/// Stages `evolve` and `rows`: evaluates one block of lines at a moment of the loop, transforms it
/// along x and transposes it, so that x becomes the lane.
///   h = S'_xy cos(phase) + S'_zw sin(phase)                          VR Ocean, equation 24
///   P = -i (kx + i kz)/|k| d, R = (kx - i kz)/|k| d                  equation 30, both axes in one
/// In the paper d is h. Here it is h at the phase plus b, the angle of the lean: cos b times h, plus
/// sin b times the quadrature of h in time. That displaces crests along their own direction, so
/// that fronts are steeper than backs, and keeps the length of the displacement.
/// Stack: 24 N W bytes, where W is the number of lanes of the instruction set.
struct EvolveRowsJob {
    const float* waves;              ///< the block of PackedSpectrum::waves
    const std::uint32_t* harmonics;  ///< the block of PackedSpectrum::harmonics
    std::uint32_t fraction;          ///< LoopFraction::turns
    std::size_t first_line;          ///< kz of lane 0
    std::size_t line_count;          ///< lanes that hold lines: W, or W/2 if N = 16 and W = 16
    const FftTables* fft;
    float* lines;  ///< all column blocks; aliases no input
    /// Angular frequency of harmonic 1, 2 pi / T, in rad/s. Only evolve_velocity_rows reads it;
    /// that kernel computes the lines of the time derivative.
    float first_frequency = 0;
};

/// First step of stage `evolve` during a sea-state transition: blends one block of lines of both
/// spectra, wave by wave. Equation 22 packs S' = (a + c, b + d, b - d, c - a). Each of a, b, c, d
/// becomes
///   sign sqrt((1 - s) before^2 + s after^2),
/// which blends the energies linearly and keeps the random draws. Where the signs differ (waves
/// without a random draw), it becomes (1 - s) before + s after. So does the
/// tangent of the lean, whose cosine scales the directions. Both spectra have the waves of the same
/// grid.
struct BlendWavesJob {
    /// Scale applied before squaring: the square of the smallest amplitude, 1e-20 m, underflows a
    /// float. A power of two leaves the mantissa unchanged.
    static constexpr float scale = 0x1p32f;

    const float *before, *after;  ///< the block of each PackedSpectrum::waves
    std::size_t pairs;            ///< number of wave pairs in the block
    float weight;                 ///< s, [0, 1]
    float* out;                   ///< layout of `before`; aliases no input
};

/// BlendWavesJob while a distant swell arrives: s depends on the frequency band of the wave
/// (sim/kernels/harmonic_bands.hpp).
struct BlendArrivingWavesJob {
    /// The band of a harmonic is the exponent and four mantissa bits of its float representation.
    static constexpr int band_shift = 19;
    static constexpr int first_band = 127 << 4;  ///< band of harmonic 1

    const float *before, *after;
    const std::uint32_t* harmonics;  ///< the block of PackedSpectrum::harmonics
    std::size_t pairs;
    const float* weights;    ///< s of each band, [0, 1]
    std::int32_t last_band;  ///< last band of `weights`; higher bands use its s
    float* out;              ///< layout of `before`; aliases no input
};

/// Stages `columns` and `finalize`: transforms two column blocks along z, multiplies the horizontal
/// displacement by lambda (VR Ocean, equation 44) and computes the extremes of both blocks. No sign
/// correction is needed, because the transforms work in FFT order. Stack: 8 N W bytes.
struct ColumnsFinalizeJob {
    /// Input: lines; output: surface, metres. [1] holds the partner columns of [0]; null if N = 16.
    float* blocks[2];
    const FftTables* fft;
    float choppiness;
    /// Cosine and sine of the rotation angle of the cascade's axes. The horizontal displacement is
    /// stored along the world's axes.
    float cosine, sine;
    FrameBounds* bounds;
    float level_m = 0;  ///< Cascade::level_m, added to each height
};

/// Compression of a cascade in a frame, in bytes:
/// nearest(clamp(offset + factor (Dx,x + Dz,z + front . grad h), 0, 255)) for slopes in units of a
/// byte step, along the world's axes.
struct PresentCompression {
    float factor = 0, offset = 0, front_x = 0, front_z = 0;
    std::uint8_t* bytes = nullptr;  ///< N^2; null: not written
};

/// Stage `water levels`, rows: evaluates the velocity and the head (sim/water_levels.hpp) of one block of
/// lines, transforms them along x and stores lines in the grid's texels. Stack: 32 N W bytes.
struct WaterRowsJob {
    const float* waves;              ///< as in EvolveRowsJob, without lean; the height is the vertical velocity's
    const std::uint32_t* harmonics;  ///< as in EvolveRowsJob
    /// Factors of heights that give heads, by pair of waves and lane; null: only the velocity.
    const float* head_factors;
    std::uint32_t fraction;  ///< LoopFraction::turns
    float first_frequency;   ///< as in EvolveRowsJob
    std::size_t first_line, line_count;
    const FftTables* fft;
    float* texels;           ///< of the grid, aligned as registers; aliases no input
    std::size_t row_floats;  ///< a multiple of a register
};

/// Stage `water levels`, columns: transforms W columns of lines along z in place, into texels of velocity
/// and head. Stack: 8 N W bytes.
struct WaterColumnsJob {
    float* texels;
    std::size_t row_floats;
    std::size_t first_column;
    bool has_head;
    const FftTables* fft;
    float cosine, sine;  ///< as in ColumnsFinalizeJob
};

/// Number of planes of averages that a mip level is computed from: scaled normal x, y, z, and J
/// clamped to [-1, 1].
inline constexpr std::size_t mip_planes = 4;

/// Stage `gradients` and the first levels of `mipmaps`, on one rectangular block of texels.
/// Computes
///   central differences with wrap (equations 45, 46),
///   the full normal N = (hz Dz,x - hx (1 + Dz,z), J, hx Dx,z - hz (1 + Dx,x)),
///   the Jacobian J (48),
/// packs them (50, 51), writes the half floats, then block_levels
/// levels of averages (52, 53). block_rows and block_columns are the size of the block.
struct GradientsJob {
    static constexpr std::size_t block_rows = 16, block_columns = 256;
    static constexpr int block_levels = 3;

    const float* surface;  ///< all column blocks
    std::size_t resolution;
    std::size_t first_row, first_column;  ///< of the block, which is smaller if N < block_columns
    std::size_t block_stride;             ///< floats between column blocks
    float two_texels_m;                   ///< 2 L / N
    float jacobian_factor;                ///< 1 / two_texels_m^2
    float normal_length;                  ///< equation 49 at the sea's roughness
    std::int32_t smoothness_bits;         ///< 1 - sqrt(roughness) as the highest byte of a texel
    /// Tight rows of four halves per texel, the fourth 0; null: not written.
    std::uint16_t* rgba16f;
    std::uint32_t* levels[block_levels + 1];  ///< tight rows of RGBA8, the texels of level 0 to 3
    float* averages;                          ///< averages of level 3, for MipLevelJob
    std::size_t average_stride;
    /// Cosine and sine of the rotation angle of the cascade's axes in the world, from +x towards
    /// +z. Displacement, normals and J are along the world's axes.
    float cosine = 1, sine = 0;
    /// Width of a narrow block, a multiple of 32; 0: block_columns, or N if it is smaller.
    std::size_t narrow_columns = 0;
};

/// Stage `mipmaps`, one level: averages 2 x 2 texels (52), computes smoothness from the normal's
/// length (53), renormalises and packs. Averages are rows of mip_planes planes and one scratch
/// plane. The stride of a plane is at least 32 floats and at least the level's side.
struct MipLevelJob {
    float* finer;  ///< averages of the finer level
    std::size_t finer_stride;
    std::size_t side;
    float* averages;  ///< averages of this level; aliases no input
    std::size_t stride;
    std::uint32_t* texels;  ///< side^2
};

/// Number of planes that slope levels are averaged from: h_x, h_z, D_xx, D_zz, D_xz and the mean
/// squares h_x^2, h_z^2, h_x h_z, in units of one byte step.
inline constexpr std::size_t slope_planes = 8;

/// Stage `slopes` and its first levels, on one rectangular block of texels. Slopes of cascades are
/// additive, so a sum of cascades has the normals and Jacobians of the sum (sim/slope_sum.hpp).
/// Two words per texel, from the lowest byte up:
///   slopes   h_x, h_z, D_xx, D_zz, signed, as fractions of slope_range
///   moments  D_xz = (Dx,z + Dz,x)/2, signed, as a fraction of slope_range;
///            var h_x, var h_z unsigned and cov(h_x, h_z) signed, as fractions of variance_range
/// A signed byte b is (b - 128)/127, an unsigned byte is b/255; values are clamped to the ranges.
/// Derivatives are along the world's axes. Variances are those within a texel (LEAN mapping: Olano
/// and Baker 2010); they are 0 at level 0.
///
/// Derivatives are near_weight (f(1) - f(-1)) + far_weight (f(2) - f(-2)) over the texel's size.
/// The condition that a constant slope keeps its value leaves one free weight. That weight
/// minimises the mean error of the bilinearly filtered slopes over the square between texels. The
/// mean includes all waves with 6/128 to 1/3 cycles per texel, in all directions, with equal
/// steepness per octave (docs/theory.md has the integral). The derivative at a texel therefore
/// amplifies short waves as much as the bilinear filter attenuates them.
struct SlopesJob {
    static constexpr std::size_t block_rows = 16, block_columns = 256;
    static constexpr int block_levels = 3;
    static constexpr double far_weight = -0.2194, near_weight = 0.5 - 2 * far_weight;

    const float* surface;  ///< all column blocks
    std::size_t resolution;
    std::size_t first_row, first_column;  ///< of the block, which is smaller if N < block_columns
    std::size_t block_stride;             ///< floats between column blocks
    float cosine, sine;                   ///< as in GradientsJob
    /// near_weight / (slope_step L / N), where slope_step is slope_range / 127.
    float difference_factor;
    float variance_factor;  ///< slope_step^2 / variance_range
    /// Tight rows of four halves per texel, the fourth 0; null: not written.
    std::uint16_t* rgba16f;
    PresentCompression compression;
    std::uint32_t* slopes[block_levels + 1];   ///< tight rows, the texels of level 0 to 3
    std::uint32_t* moments[block_levels + 1];  ///< tight rows, the texels of level 0 to 3
    float* averages;                           ///< averages of level 3, for SlopeLevelJob
    std::size_t average_stride;
    std::size_t narrow_columns = 0;  ///< as in GradientsJob
};

/// Stage `slopes tail`, one level: averages 2 x 2 texels and packs them. Averages are rows of
/// slope_planes planes. The stride of a plane is at least 32 floats and at least the level's side.
struct SlopeLevelJob {
    float* finer;  ///< averages of the finer level
    std::size_t finer_stride;
    std::size_t side;
    float* averages;  ///< averages of this level; aliases no input
    std::size_t stride;
    float variance_factor;
    std::uint32_t *slopes, *moments;  ///< side^2 each
};

/// Compression at all texels of a cascade's rows: offset + factor (Dx,x + Dz,z + front . grad h), in
/// bytes that are not rounded. Derivatives are those of SlopesJob.
struct CompressionJob {
    const float* surface;  ///< all column blocks
    std::size_t resolution;
    std::size_t block_stride;
    float cosine, sine;   ///< as in GradientsJob
    float far_over_near;  ///< SlopesJob::far_weight over near_weight
    float factor;         ///< includes the near weight over L / N
    float offset;
    float front_along, front_across;  ///< along the cascade's axes
    std::size_t first_row, rows;      ///< even
    float* out;                       ///< N^2, tight rows; only the job's rows are written
};

/// One byte of the texels of an image of snapshots: the compression at texel (x + shift_x + s_x,
/// z + shift_z + s_z), where s_x and s_z in [0, 1) are the fractions of the weights. The other
/// bytes are copied.
struct SnapshotJob {
    static constexpr std::size_t max_resolution = 2048;
    static constexpr int taps = 8;

    const float* compression;  ///< of CompressionJob
    std::size_t resolution;
    std::size_t shift_x, shift_z;            ///< less than N
    float weights_x[taps], weights_z[taps];  ///< of texels -3 to 4
    std::size_t first_row, rows;
    std::uint32_t byte;           ///< 0 to 3, from the lowest
    const std::uint32_t* before;  ///< N^2
    std::uint32_t* after;         ///< N^2, only the job's rows are written; may be `before`
};

/// Averages each byte over 2 x 2 words; halves round up at odd x + z, and down elsewhere.
struct HalveSnapshotsJob {
    const std::uint32_t* from;  ///< 4 side^2
    std::size_t side;
    std::uint32_t* to;  ///< side^2
};

/// Surface of a frame, as queries read it. Texel (i, j) of a plane is
/// plane[(i >> block_shift) * block_stride + (i & (block_columns - 1)) + j * row_stride].
struct SurfaceTexels {
    const float *dx, *height, *dz;  ///< metres
    /// m/s; null if the frame has no velocities.
    const float *velocity_x, *velocity_y, *velocity_z;
    std::int32_t resolution;  ///< N, a power of two
    /// A power of two, and its binary logarithm.
    std::int32_t block_columns, block_shift;
    std::int32_t row_stride, block_stride;  ///< in floats
};

/// Positions on a square of texels, by component: a cell index and the position within the cell,
/// [0, 1]. Cells may lie outside the cascade. Arrays are aligned; their length is a multiple of W.
struct CellPositions {
    std::int32_t *cell_x, *cell_z;
    float *u, *v;
};

/// Splits positions into the cell of a cascade and the position within the cell.
struct SplitPositionsJob {
    const double *x, *z;   ///< world positions \pre at most 2^50 texels from the origin
    double texel_m;        ///< of a grid along the world's axes; 0: `along` and `across` are used
    double along, across;  ///< cosine and sine of the grid's rotation, times N / L
    std::int32_t resolution;
    std::size_t count;  ///< a multiple of W
    CellPositions out;  ///< u and v are in [0, 1]; aliases no input
};

/// Computes the reference position of each given world position: the q of q + D(q) = p, where D is
/// bilinear or cubic between texels. Uses Newton steps with the slopes of the cell. Far from the
/// solution or near a fold it uses the fixed-point step q - (q + D(q) - p). A lane within `target`
/// of its solution does not change any more, so no lane depends on its neighbours.
struct InvertSurfaceJob {
    static constexpr int max_steps = 12;
    /// Largest distance for a Newton step, texels along each axis. Beyond it the slopes of one cell
    /// are no approximation of the surface.
    static constexpr float newton_reach = 2;
    /// A step is at most 1 / this times the distance.
    static constexpr float min_determinant = 0.1f;

    SurfaceTexels surface;
    float texels_per_m;   ///< N / L
    float target;         ///< remaining distance at which a lane stops, in texels
    std::size_t count;    ///< a multiple of W
    CellPositions world;  ///< world positions
    CellPositions rest;   ///< reference positions (output); aliases no input
    float* error;         ///< remaining distance in texels
};

/// Samples the surface at reference positions. Linear: all values are bilinear between texels,
/// slopes are central differences at texels. Cubic: values are products of Catmull-Rom cubics,
/// slopes are their derivatives. Blocks of the surface have a multiple of W columns.
struct SampleSurfaceJob {
    struct Outputs {
        float* height;                                     ///< metres; null: not written
        float *normal_x, *normal_y, *normal_z, *jacobian;  ///< all, with height, or none
        float *velocity_x, *velocity_y, *velocity_z;       ///< all or none
    };
    SurfaceTexels surface;
    float two_texels_m;     ///< 2 L / N
    float jacobian_factor;  ///< 1 / two_texels_m^2
    std::size_t count;      ///< a multiple of W
    CellPositions rest;
    Outputs out;  ///< aliases no input
};

/// Finds cells in which the surface overturns, or nearly does: the minimum Jacobian times the
/// undisplaced texel area is at most `max_area`. Blocks of the surface have a multiple of W
/// columns.
struct FindFoldsJob {
    SurfaceTexels surface;
    float texel_m;  ///< L / N
    float max_area;
    std::size_t first_row, rows;  ///< multiples of 4
    /// N^2 bits: cell (i, j) is bit i % 8 of byte (j N + i) / 8. Only the job's rows are written.
    std::uint8_t* cells;
};

/// Extremes of a piece of a cascade.
struct ContractionExtremes {
    float displacement_squared;  ///< largest Dx^2 + Dz^2
    float stretch_squared;       ///< upper bound of the squared norm of all slope matrices
    std::uint8_t byte;           ///< the largest byte of FindContractionJob
};

/// Computes an upper bound of a cascade's contraction for blocks of one column of cells by
/// block_rows: minus the smallest eigenvalue of the symmetric part of the slope matrix, at least 0,
/// times `one`, rounded up. A byte of 255 means 255 or more. Blocks of the surface have a multiple
/// of W columns.
struct FindContractionJob {
    static constexpr std::size_t max_resolution = 2048, block_rows = 4;

    SurfaceTexels surface;
    float texels_per_m;             ///< N / L
    float cosine, sine;             ///< rotation of the cascade's grid
    float one;                      ///< the byte value that represents 1
    std::size_t first_row, rows;    ///< multiples of block_rows
    std::uint8_t* blocks;           ///< N^2 / block_rows, rows of N; only the job's rows are written
    ContractionExtremes* extremes;  ///< extremes of the job's rows
};

/// Computes the largest gradient of a cascade's heights over reference positions, where each cell has
/// the larger change of its two edges along x, and along z. Blocks of the surface have a multiple of
/// W columns.
struct SteepnessJob {
    SurfaceTexels surface;
    float texels_per_m;  ///< N / L
};

/// Computes for each byte the maximum of all bytes within a reach along both axes. The rectangle of
/// bytes is periodic.
struct SpreadContractionJob {
    static constexpr std::size_t max_columns = FindContractionJob::max_resolution;
    static constexpr std::size_t margin = 64;  ///< a register's bytes

    const std::uint8_t* from;      ///< in tight rows
    std::size_t columns, rows;     ///< powers of two
    std::size_t reach_x, reach_z;  ///< less than half of columns and of rows
    std::uint8_t* scratch;         ///< 2 columns rows + margin
    std::uint8_t* to;              ///< in tight rows
};

/// Computes the maximum of two columns, of one row or two.
struct HalveContractionJob {
    const std::uint8_t* from;   ///< 2 columns by rows_each rows for each byte of the output, in tight rows
    std::size_t columns, rows;  ///< of the output
    std::size_t rows_each;      ///< 1 or 2
    std::uint8_t* to;           ///< in tight rows
};

/// Maximum number of cascades that a kernel adds.
inline constexpr std::size_t max_cascades = 4;

/// One cascade of a stack, as queries read it. The reference position of a world position p that is
/// displaced by d metres is p - d.
struct StackCascade {
    SurfaceTexels surface;
    float along, across;  ///< cosine and sine of the grid's rotation, times N / L
    CellPositions world;  ///< world positions, along the cascade's own axes
    /// Weight of the cascade's displacement at each point. Null for all cascades or for none; null
    /// means a weight of 1.
    const float* weight = nullptr;
};

/// InvertSurfaceJob for a sum of cascades: computes the offset o with o + sum of D(p + o) = 0. The
/// first step evaluates the coarsest cascades only. Finer cascades are evaluated at positions that
/// are accurate to within the length of their waves. From the second step on, a lane within
/// `target` does not change any more.
struct InvertStackJob {
    static constexpr std::size_t first_cascades = 2;
    static constexpr int max_steps = 16;
    static constexpr float min_determinant = 0.1f;

    StackCascade cascades[max_cascades];
    std::size_t cascade_count;
    float target;                        ///< metres
    float reach;                         ///< metres; limit of an offset: the largest displacement
    std::size_t count;                   ///< a multiple of W
    float *offset_x, *offset_z;          ///< metres, world to reference positions; alias no input
    float* error;                        ///< remaining distance in metres
    std::int32_t* blocks[max_cascades];  ///< index of the block (FindContractionJob) of each cascade
};

/// SampleSurfaceJob for a sum of cascades: adds the slopes and computes the normals of the sum.
struct SampleStackJob {
    StackCascade cascades[max_cascades];
    std::size_t cascade_count;
    std::size_t count;  ///< a multiple of W
    const float *offset_x, *offset_z;
    SampleSurfaceJob::Outputs out;  ///< aliases no input
};

/// A query kernel for each Interpolation. The cubic inversion starts at the reference positions
/// that the linear inversion computed, so these are an input, too.
template <class Job>
struct ByInterpolation {
    void (*linear)(const Job&);
    void (*cubic)(const Job&);
};

struct Kernels {
    std::size_t lanes;  ///< W: floats per register, and lanes per block in every buffer
    void (*blend_waves)(const BlendWavesJob&);
    void (*blend_arriving_waves)(const BlendArrivingWavesJob&);
    void (*evolve_rows)(const EvolveRowsJob&);
    void (*evolve_velocity_rows)(const EvolveRowsJob&);
    void (*columns_finalize)(const ColumnsFinalizeJob&);
    void (*water_rows)(const WaterRowsJob&);
    void (*water_columns)(const WaterColumnsJob&);
    void (*gradients)(const GradientsJob&);
    void (*mip_level)(const MipLevelJob&);
    void (*slopes)(const SlopesJob&);
    void (*slope_level)(const SlopeLevelJob&);
    void (*compression)(const CompressionJob&);
    void (*snapshot)(const SnapshotJob&);
    void (*halve_snapshots)(const HalveSnapshotsJob&);
    void (*find_folds)(const FindFoldsJob&);
    void (*split_positions)(const SplitPositionsJob&);
    ByInterpolation<InvertSurfaceJob> invert_surface;
    ByInterpolation<SampleSurfaceJob> sample_surface;
    void (*find_contraction)(const FindContractionJob&);
    void (*spread_contraction)(const SpreadContractionJob&);
    void (*halve_contraction)(const HalveContractionJob&);
    float (*steepness)(const SteepnessJob&);
    ByInterpolation<InvertStackJob> invert_stack;
    ByInterpolation<SampleStackJob> sample_stack;
    void (*dynamic_columns)(const DynamicColumnsJob&);
    void (*dynamic_lines)(const DynamicLinesJob&);
    void (*dynamic_columns_back)(const DynamicColumnsJob&);  ///< third pass: into h and w
    void (*damp_rows)(const DampJob&);
    void (*verlet_rows)(const VerletRowsJob&);
    void (*dynamic_foam)(const DynamicFoamJob&);
    void (*interpolate_ticks)(const TickInterpolationJob&);
    void (*shore_rows)(const ShoreRowsJob&);
    void (*add_waves)(const AddWavesJob&);
    void (*add_ripple)(const AddRippleJob&);
    bool (*add_rows)(const AddRowsJob&);  ///< returns false if a value is too large or NaN
    void (*move_waves)(const MoveWavesJob&);
    void (*sum_heights)(const SumHeightsJob&);
    void (*sum_water)(const SumWaterJob&);
};

/// Returns the kernel table of an instruction set. \pre runs_here(isa)
const Kernels& kernels_for(Isa isa);

}  // namespace pelagic
