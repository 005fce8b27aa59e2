#pragma once

#include <cstddef>

#include "sim/kernels/fft.kernel.hpp"
#include "sim/kernels/kernels.hpp"
#include "sim/wave_blocks.hpp"
#include "simd/transpose.kernel.hpp"

namespace pelagic::kernels {

/// Puts the real or imaginary parts of W transformed lines (element x of `parts` is 2 W floats on) where the columns
/// stage wants them: x is the lane now. `lines` points at the first line's row of column block 0.
template <class Arch>
inline void turn_lines(const float* parts, std::size_t size, std::size_t lines_here, float* lines) {
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    const std::size_t column_block_floats = lines_block_floats(static_cast<int>(size));
    for (std::size_t x = 0; x < size; x += 4) {
        float* out = lines + x / lane_block * column_block_floats + x % lane_block;
        for (std::size_t line = 0; line < lines_here; line += 4)
            transpose_4x4<Arch>(parts + x * element + line, element, out + line * wave_row_floats, wave_row_floats);
    }
}

template <class Arch>
void rows(const RowsJob& job) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t element = 2 * V::size;
    const std::size_t size = static_cast<std::size_t>(job.fft->size);
    FftWorkspace<Arch> workspace;

    for (std::size_t lane = 0; lane < job.line_count; lane += V::size) {
        const std::size_t lines_here = job.line_count - lane < V::size ? job.line_count - lane : V::size;
        float* out = job.lines + (job.first_line + lane) * wave_row_floats;
        for (std::size_t part = 0; part < wave_components; part += 2) {
            for (std::size_t p = 0; p < size; ++p) {
                const float* wave = job.waves + p * wave_row_floats + part * lane_block + lane;
                float* to = workspace.data + job.fft->positions[p] * element;
                V::load_aligned(wave).store_aligned(to);
                V::load_aligned(wave + lane_block).store_aligned(to + V::size);
            }
            inverse_fft<Arch>(workspace.data, *job.fft);
            turn_lines<Arch>(workspace.data, size, lines_here, out + part * lane_block);
            turn_lines<Arch>(workspace.data + V::size, size, lines_here, out + (part + 1) * lane_block);
        }
    }
}

}  // namespace pelagic::kernels
