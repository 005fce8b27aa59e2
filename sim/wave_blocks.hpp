// The buffers between the stages, as float arrays in blocks: everything that one job touches lies together, and no
// stride is a power of two times a row (those fall on the same cache sets from N = 512 on).
//
//   modes    [line block][kx position] rows of ModeRow        spectrum writes, evolve reads
//   waves    [line block][kx position][component][lane = kz]    evolve writes, rows reads
//   lines    [column block][kz][component][lane = x]            rows writes, columns reads
//   surface  [column block][z][component][lane = x]             columns writes, finalize reads; lies where waves lay
//
// Components of waves and lines are three complex fields: the height h and the sideways pair P = Dx + i Dz,
// Q = Dx - i Dz. A column of P for kz >= 0 and conj(Q) for kz < 0 is the whole spectrum of Dx + i Dz, so one complex
// transform yields both; the heights of two column blocks share another one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/lanes.hpp"

namespace pelagic {

/// One kx of a block of lines: lane l holds the wave (kx, kz = first line of the block + l).
struct alignas(64) ModeRow {
    float cos_re[lane_block], cos_im[lane_block];  ///< S'_xy, metres
    float sin_re[lane_block], sin_im[lane_block];  ///< S'_zw, metres
    float dir_x[lane_block], dir_z[lane_block];    ///< k / |k|
    std::uint32_t harmonic[lane_block];            ///< periods in one loop
};

/// Lines are kz = 0, 1, ..., N/2 - 1, in blocks of lane_block; lanes beyond them (N = 16) are zero.
constexpr std::size_t line_count(int resolution) { return static_cast<std::size_t>(resolution) / 2; }
constexpr std::size_t line_blocks(int resolution) { return (line_count(resolution) + lane_block - 1) / lane_block; }

enum WaveComponent { height_re, height_im, p_re, p_im, q_re, q_im, wave_components };
enum SurfaceComponent { surface_dx, surface_height, surface_dz, surface_components };

inline constexpr std::size_t wave_row_floats = wave_components * lane_block;
inline constexpr std::size_t surface_row_floats = surface_components * lane_block;

constexpr std::size_t column_blocks(int resolution) { return static_cast<std::size_t>(resolution) / lane_block; }

constexpr std::size_t waves_block_floats(int resolution) { return resolution * wave_row_floats; }
constexpr std::size_t lines_block_floats(int resolution) { return line_count(resolution) * wave_row_floats; }
constexpr std::size_t surface_block_floats(int resolution) { return resolution * surface_row_floats; }

/// The buffer that holds waves first and the surface later (A of VR Ocean, figure 4).
constexpr std::size_t waves_floats(int resolution) {
    const std::size_t waves = line_blocks(resolution) * waves_block_floats(resolution);
    const std::size_t surface = column_blocks(resolution) * surface_block_floats(resolution);
    return waves > surface ? waves : surface;
}

/// The buffer between the two transforms (B of VR Ocean, figure 4).
constexpr std::size_t lines_floats(int resolution) {
    return column_blocks(resolution) * lines_block_floats(resolution);
}

}  // namespace pelagic
