// The jobs of dynamic waves (sim/dynamic_waves/grid.hpp). Texels lie in rows, a torus: the column behind the last one is
// the first. Rows have a margin before them whose nearest float repeats the row's last one, and the float behind a row its first.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

struct FftTables;

/// Floats before each row, and behind the last one: a register of every instruction set, so that rows stay aligned and strides are
/// no powers of two.
inline constexpr std::size_t dynamic_row_margin = 16;
constexpr std::size_t dynamic_row_stride(std::size_t resolution) { return resolution + dynamic_row_margin; }
constexpr std::size_t dynamic_plane_floats(std::size_t resolution) {
    return resolution * dynamic_row_stride(resolution) + 2 * dynamic_row_margin;
}

/// What a tick leaves of each texel, left_x left_z: less than 1 in the border, where waves end. What is smaller than `smallest`
/// becomes 0, or water at rest would fade into numbers that processors are slow with.
struct BorderDamping {
    static constexpr float smallest = 1e-18f;
    const float *left_x, *left_z;  ///< of each column and row of the torus
};

/// First part of the spectral step: W columns of z = h + i w, as far as the border leaves them, transformed along z and turned, so
/// that the wave number along z becomes the lane. Third part: back into them. Stack: 8 N W bytes, 16 N W back.
struct DynamicColumnsJob {
    float *h, *w;  ///< texel (0, 0)
    BorderDamping border;
    std::size_t first_column;
    const FftTables* fft;
    float*
        lines;  ///< all line blocks: element x of block b is W real parts, then W imaginary ones, at b block_stride + 2 x W
    std::size_t block_stride;
};

/// Second part: one block of lines to wave numbers along x, where each wave goes on by its phase of a tick, and back. Parts are
/// exchanged: a transform of the other direction is one of the exchanged number. Stack: 16 N W bytes.
struct DynamicLinesJob {
    float* lines;  ///< the block
    const float*
        phases;  ///< for kx = 0, ..., N/2 W times the cosine, then W times the sine, with what a tick leaves, over N^2
    const FftTables* fft;
};

/// Takes the waves out of the border of both planes, for Verlet's step: of one alone it would be a spring, which sends them back.
struct DampJob {
    float* planes[2];  ///< texel (0, 0) of both
    std::size_t resolution;
    std::size_t first_row, rows;
    BorderDamping border;
};

/// Verlet's step, in place of the rows before: h' = h + left (h - h_before) + coupling lap h, lap h the sum of four neighbours less
/// four times h. A constant level stays, bit for bit.
struct VerletRowsJob {
    const float* now;  ///< texel (0, 0); its margins repeat the other end of each row
    float* before;     ///< becomes what comes after; aliases nothing
    std::size_t resolution;
    std::size_t first_row, rows;
    float coupling;  ///< c e^(-decay tick), c = (speed tick / texel)^2
    float left;      ///< e^(-2 decay tick)
};

/// Foam of rows: the more of what stands high and what is left of the tick before. Rows without either are told from a look.
struct DynamicFoamJob {
    static constexpr std::size_t max_resolution = 1024;

    const float* heights;  ///< texel (0, 0)
    std::size_t resolution;
    std::size_t first_row, rows;
    float threshold, scale;  ///< bytes (h - threshold) scale
    int fade;
    std::uint8_t* foam;      ///< N^2
    std::uint8_t* has_foam;  ///< a byte a row
};

/// What a frame shows of rows, faded towards the edges: heights on the straight way from `before` to `now`, and vertical velocity at
/// `part` of it, the derivative of the parabola through the ways of the last two ticks.
struct TickInterpolationJob {
    const float *before, *now;  ///< texel (0, 0)
    const float* way_before;    ///< that of the tick before
    std::size_t resolution;
    std::size_t first_row, rows;
    float part;  ///< of the way
    float ticks_per_s;
    const float *shown_x, *shown_z;     ///< of each column and row of the torus
    float *height, *vertical_velocity;  ///< N^2, in rows of N
    float *lowest, *highest;            ///< of each row's heights
};

}  // namespace pelagic
