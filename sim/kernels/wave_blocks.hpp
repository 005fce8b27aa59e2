// Layout of the buffers between the stages. Buffers are float arrays in blocks of W lanes, where W
// is the number of floats per register of the instruction set. The data of one job is contiguous,
// and every load is a whole register. No stride is a power of two times a row, because such strides
// map to the same cache sets from N = 512 on.
//
//   waves    [line block][pair of waves][quantity][lane = kz]
//            written by spectrum, read by evolve+rows
//   lines    [column block][kz][component][lane = x]
//            written by evolve+rows, read by columns+finalize
//   surface  [column block][z][component][lane = x]
//            written by columns+finalize in place of the lines
//
// Lines hold three complex fields: the height h and the horizontal pair P = -(Dx + i Dz), R = -i
// (Dx - i Dz). These signs save negations. The column of P for kz >= 0 and of conj(R / i) for kz <
// 0 is the whole spectrum of -(Dx + i Dz). Here conj(R / i) is R with real and imaginary part
// exchanged. One complex transform therefore yields both components, and the factor of choppiness
// includes the minus sign. The heights of two columns share another transform. The choice of the
// two columns affects the last bits, so they are always x and x + 16, for any number of lanes per
// block.
//
// A column block of lines and one of the surface have equal length, and heights have the same
// offsets in both. The second transform therefore works in place, one field after the other.
#pragma once

#include <cstddef>

namespace pelagic {

/// Quantities of a pair of waves (kx, kz) and (-kx, kz), which have the same frequency. Each
/// quantity is a row of lanes. Lane l holds kz = first line of the block + l, and is zero beyond
/// the last line. The harmonics are integers and are stored in a separate array.
enum WaveQuantity {
    plus_cos_re,  ///< S'_xy of (kx, kz), metres
    plus_cos_im,
    plus_sin_re,  ///< S'_zw
    plus_sin_im,
    minus_cos_re,  ///< S'_xy of (-kx, kz), metres
    minus_cos_im,
    minus_sin_re,
    minus_sin_im,
    direction_x,  ///< k / |k| of (kx, kz) times orbit_ratio() and the cosine of the lean
    direction_z,
    lean_tangent,  ///< tan b of EvolveRowsJob
    wave_quantities
};

enum LineComponent { p_re, height_re, p_im, r_re, height_im, r_im, line_components };
enum SurfaceComponent { surface_dx, surface_height, surface_dz, surface_components };

/// Lines are kz = 0, 1, ..., N/2 - 1; columns are x = 0, ..., N - 1.
constexpr std::size_t line_count(int resolution) { return static_cast<std::size_t>(resolution) / 2; }
constexpr std::size_t line_blocks(int resolution, std::size_t lanes) {
    return (line_count(resolution) + lanes - 1) / lanes;
}
constexpr std::size_t column_blocks(int resolution, std::size_t lanes) {
    return static_cast<std::size_t>(resolution) / lanes;
}

/// Distance in columns between two columns whose heights share a transform: one column block of the
/// widest registers.
inline constexpr std::size_t partner_distance = 16;

/// A job of the second transform: a column block and the block of its partner columns, which N = 16
/// lacks.
struct ColumnBlockPair {
    std::size_t first;
    bool has_second;
    std::size_t second;
};
constexpr std::size_t column_block_pairs(int resolution, std::size_t lanes) {
    return column_blocks(resolution, lanes) / (line_count(resolution) < partner_distance ? 1 : 2);
}
constexpr ColumnBlockPair column_block_pair(int resolution, std::size_t lanes, std::size_t number) {
    const std::size_t distance = partner_distance / lanes;
    const std::size_t first = number / distance * 2 * distance + number % distance;
    return {first, first + distance < column_blocks(resolution, lanes), first + distance};
}

/// Floats of one column block, for lines and for the surface. The margin after the last row
/// prevents block strides that are powers of two.
constexpr std::size_t column_block_floats(int resolution, std::size_t lanes) {
    constexpr std::size_t margin = 112;
    return line_count(resolution) * line_components * lanes + margin;
}

}  // namespace pelagic
