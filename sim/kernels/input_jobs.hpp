// The jobs of wave inputs, which applications add to cascades (sim/wave_input.hpp). Rows are tight
// and aligned, and have N texels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/sim/frame_bounds.hpp"

namespace pelagic {

/// Number of fields of a row: dx, height and dz, or their time derivatives.
inline constexpr std::size_t input_fields = 3;

/// A wave of a cascade's grid along a row of texels. It adds to field f of column i
///   of_cosine[f] cos(2 pi m i / N) + of_sine[f] sin(2 pi m i / N).
struct GridWaveRow {
    const float *cosine, *sine;  ///< cos and sin of 2 pi m i / N for each column i, N each
    float of_cosine[input_fields], of_sine[input_fields];
};

/// Adds waves to a row, in their order.
struct AddWavesJob {
    const GridWaveRow* waves;
    std::size_t count;
    std::size_t columns;        ///< N
    float* rows[input_fields];  ///< N each; alias no input
};

/// Adds ring waves to a row (sim/ripple_input.hpp has the formula).
struct AddRippleJob {
    /// Squared distance of each column from the centre along the row, m^2.
    const float* along_squared;
    float across_squared;  ///< squared distance of the row from the centre, m^2
    std::size_t columns;
    float reach_squared;                 ///< m^2, above 0
    float half_wave;                     ///< m
    float waves_per_m;                   ///< 1 / wavelength
    std::uint32_t start;                 ///< phase at the centre, in turns of 2^32
    float amplitude, vertical_velocity;  ///< m, and m/s: amplitude times angular frequency
    float* heights;
    float* vertical_velocities;  ///< null: not written
};

/// Adds rows to the rows of a surface (wave_blocks.hpp) if the absolute values of all inputs are at
/// most `max`. Otherwise nothing is written.
struct AddRowsJob {
    const float* rows[input_fields];  ///< one row after the other
    std::size_t resolution;
    std::size_t first_row, row_count;
    float* surface;            ///< all column blocks
    std::size_t block_stride;  ///< floats between them
    float max;
    FrameBounds* bounds;  ///< extremes of the sum in the job's rows
};

}  // namespace pelagic
