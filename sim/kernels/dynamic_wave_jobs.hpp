// The jobs of dynamic waves (sim/dynamic_waves/grid.hpp). Texels are stored in rows and wrap along
// both axes. Each row has a margin before it. The float before a row repeats the row's last texel;
// the float after a row repeats its first texel.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

struct FftTables;

/// Floats before each row and after the last one. The margin is a whole register of every
/// instruction set, so rows are aligned, and strides are not powers of two.
inline constexpr std::size_t dynamic_row_margin = 16;
constexpr std::size_t dynamic_row_stride(std::size_t resolution) { return resolution + dynamic_row_margin; }
constexpr std::size_t dynamic_plane_floats(std::size_t resolution) {
    return resolution * dynamic_row_stride(resolution) + 2 * dynamic_row_margin;
}

/// Damping in the border of the grid: each tick multiplies a texel by damping_x damping_z, which is
/// less than 1 in the border. Values below `smallest` become 0; otherwise decaying waves would end
/// as denormal numbers, which are slow on most processors.
struct BorderDamping {
    static constexpr float smallest = 1e-18f;
    const float *damping_x, *damping_z;  ///< factors per tick of each column and row of the grid
};

/// First pass of the spectral step: damps W columns of z = h + i w in the border, transforms them
/// along z and transposes squares of W x W texels in place, so that the wave number along z becomes
/// the lane: wave number k of column x lies in row k - k % W + x % W, at column x - x % W + k % W.
/// Third pass: transforms back into the columns. Stack: 8 N W bytes in the first pass, 16 N W bytes in
/// the third.
struct DynamicColumnsJob {
    float *h, *w;  ///< texel (0, 0)
    BorderDamping border;
    std::size_t first_column;
    const FftTables* fft;
};

/// Second pass: transforms one block of W lines along x in place, advances each wave by its phase per
/// tick, and transforms back. Real and imaginary parts are exchanged, because the transform of the
/// opposite direction equals the transform of the exchanged number. Stack: 16 N W bytes.
struct DynamicLinesJob {
    float *h, *w;  ///< first texel of the block
    /// For kx = 0, ..., N/2: W cosines, then W sines of the phase per tick. Both include the
    /// damping per tick and the factor 1/N^2.
    const float* phases;
    const FftTables* fft;
};

/// Damps waves in the border of both planes of a Verlet step. If only one plane were damped, the
/// border would act as a spring and reflect the waves.
struct DampJob {
    float* planes[2];  ///< texel (0, 0) of both planes
    std::size_t resolution;
    std::size_t first_row, rows;
    BorderDamping border;
};

/// One Verlet step, which replaces the previous rows: h' = h + damping (h - h_before) + coupling
/// lap h, where lap h is the sum of four neighbours minus four times h. A constant level is
/// preserved exactly.
struct VerletRowsJob {
    const float* now;  ///< texel (0, 0); its margins repeat the other end of each row
    float* before;     ///< previous heights; overwritten by the next heights; aliases no input
    std::size_t resolution;
    std::size_t first_row, rows;
    float coupling;  ///< c e^(-decay tick), c = (speed tick / texel)^2
    float damping;   ///< e^(-2 decay tick)
};

/// Foam of rows: the maximum of the foam generated where the water is high and the decayed foam of
/// the previous tick. Rows without high water and without foam are skipped.
struct DynamicFoamJob {
    static constexpr std::size_t max_resolution = 1024;

    const float* heights;  ///< texel (0, 0)
    std::size_t resolution;
    std::size_t first_row, rows;
    float threshold, scale;  ///< generated foam in bytes: (h - threshold) scale
    int fade;                ///< decay per tick, in bytes
    std::uint8_t* foam;      ///< N^2
    std::uint8_t* has_foam;  ///< one byte per row; 0 if the row has no foam
};

/// Computes the rows of a frame between two ticks, faded towards the edges of the grid. Heights are
/// interpolated linearly from `before` to `now`. The vertical velocity at `fraction` is the
/// derivative of the parabola through the height differences of the last two ticks.
struct TickInterpolationJob {
    const float *before, *now;       ///< texel (0, 0)
    const float* difference_before;  ///< height difference of the previous tick, m
    std::size_t resolution;
    std::size_t first_row, rows;
    float fraction;  ///< fraction of the tick, [0, 1]
    float ticks_per_s;
    const float *shown_x, *shown_z;     ///< fade factors of each column and row of the grid
    float *height, *vertical_velocity;  ///< m and m/s, N^2, in rows of N
    float *lowest, *highest;            ///< extremes of each row's heights, including 0
};

}  // namespace pelagic
