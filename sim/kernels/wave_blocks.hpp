// The buffers between the stages, as float arrays in blocks of as many lanes as a register of the instruction set
// holds: everything that one job touches lies together, every load is a whole register, and no stride is a power of
// two times a row (those fall on the same cache sets from N = 512 on).
//
//   waves    [line block][pair of waves][quantity][lane = kz]   spectrum writes, evolve+rows reads
//   lines    [column block][kz][component][lane = x]            evolve+rows writes, columns+finalize reads
//   surface  [column block][z][component][lane = x]             columns+finalize writes; lies where the lines lay
//
// Lines hold three complex fields: the height h and the horizontal pair P = -(Dx + i Dz), R = -i (Dx - i Dz). The signs
// spare negations on the way: a column of P for kz >= 0 and of conj(R / i), R with its parts exchanged, for kz < 0 is
// the whole spectrum of -(Dx + i Dz), so one complex transform yields both, and choppiness takes the minus. The
// heights of two columns share another transform; which two shows in the last bits, so it is always x and x + 16,
// however many lanes a block has.
//
// A column block of lines and one of surface are equally long, and heights stand at the same places in both, so the
// second transform works in place, one field after the other.
#pragma once

#include <cstddef>

namespace pelagic {

/// A pair of waves (kx, kz) and (-kx, kz) goes round at one speed. Quantities of a pair, each a row of lanes; lane l
/// holds kz = first line of the block + l, and is zero beyond the last line. The harmonics stand apart, being integers.
enum WaveQuantity {
    plus_cos_re,  ///< S'_xy of (kx, kz), metres
    plus_cos_im,
    plus_sin_re,  ///< S'_zw
    plus_sin_im,
    minus_cos_re,  ///< the same of (-kx, kz)
    minus_cos_im,
    minus_sin_re,
    minus_sin_im,
    direction_x,  ///< k / |k| of (kx, kz) times orbit_ratio()
    direction_z,
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

/// Columns whose heights share a transform stand this far apart. One column block of the widest registers.
inline constexpr std::size_t partner_distance = 16;

/// The jobs of the second transform: a column block and the one with its partners, which N = 16 lacks.
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

/// Floats of one column block, of lines and of surface alike. The few behind the last row keep blocks from starting a
/// power of two apart.
constexpr std::size_t column_block_floats(int resolution, std::size_t lanes) {
    constexpr std::size_t margin = 112;
    return line_count(resolution) * line_components * lanes + margin;
}

}  // namespace pelagic
