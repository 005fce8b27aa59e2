// The jobs of waves that applications add to cascades (sim/wave_input.hpp). Rows are tight, aligned, and as long as the cascade is wide.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

struct PartBounds;

/// Three fields of a row: dx, height and dz, or their derivatives in time.
inline constexpr std::size_t input_fields = 3;

/// A wave of a cascade's grid along a row of texels: field f of column i gets
///   of_cosine[f] cos(2 pi m i / N) + of_sine[f] sin(2 pi m i / N).
struct GridWaveRow {
    const float *cosine, *sine;  ///< of the columns, N each
    float of_cosine[input_fields], of_sine[input_fields];
};

/// Waves are added in their order.
struct AddWavesJob {
    const GridWaveRow* waves;
    std::size_t count;
    std::size_t columns;        ///< N
    float* rows[input_fields];  ///< N each; alias no input
};

/// A row through rings (sim/ripple_input.hpp has the formula).
struct AddRippleJob {
    const float* along_squared;  ///< of each column, m^2: how far it is from the middle along the row
    float across_squared;        ///< of the row
    std::size_t columns;
    float reach_squared;                 ///< m^2, above 0
    float half_wave;                     ///< m
    float waves_per_m;                   ///< 1 / wavelength
    std::uint32_t start;                 ///< turns in the middle, 2^32 are one
    float amplitude, vertical_velocity;  ///< m, and m/s: amplitude times angular frequency
    float* heights;
    float* vertical_velocities;  ///< null: nobody wants them
};

/// Adds rows to those of a surface (wave_blocks.hpp), if all values are within `most`; else nothing is written.
struct AddRowsJob {
    const float* rows[input_fields];  ///< one row after the other
    std::size_t resolution;
    std::size_t first_row, row_count;
    float* surface;            ///< all column blocks
    std::size_t block_stride;  ///< floats between them
    float max;
    PartBounds* bounds;  ///< of the sum in these rows
};

}  // namespace pelagic
