#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/cell_strip.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"

namespace pelagic::kernels {

template <class Arch>
PELAGIC_INLINE float largest_of(xsimd::batch<float, Arch> values) {
    float lanes[xsimd::batch<float, Arch>::size];
    values.store_unaligned(lanes);
    float largest = lanes[0];
    for (const float lane : lanes) largest = lane > largest ? lane : largest;
    return largest;
}

template <class Arch, bool is_rotated>
void find_contraction_of(const FindContractionJob& job) {
    using V = xsimd::batch<float, Arch>;
    using Strip = CellStrip<Arch, is_rotated, true>;
    const SurfaceTexels surface = job.surface;
    const std::size_t n = static_cast<std::size_t>(surface.resolution);
    // A byte is above the bound by more than the bound's rounding error.
    const V cosine(job.cosine), sine(job.sine), scale(0.5f * job.one * job.texels_per_m), up(1.001f), max_byte(255.f);
    V displacement(0.f), norm(0.f), largest(0.f);
    alignas(64) std::int32_t bytes[max_strips][FindContractionJob::max_resolution];
    const auto take = [&](std::size_t strip, std::size_t x, const Strip& cells,
                          const SideEdges<Arch>& behind) PELAGIC_INLINE_LAMBDA {
        const V norm_squared = cells.norm_squared(behind), trace = cells.trace(behind);
        // Twice the bound. At traces below -F it is 2 F.
        const V apart = square_root<Arch>(xsimd::max((norm_squared + norm_squared) - trace * trace, norm_squared));
        const V bound = xsimd::max(xsimd::min(apart - trace, apart + apart), V(0.f)) * scale;
        const V byte = xsimd::min(bound + up, max_byte);
        displacement = xsimd::max(displacement, cells.displacement_squared);
        norm = xsimd::max(norm, norm_squared);
        largest = xsimd::max(largest, byte);
        xsimd::to_int(byte).store_aligned(bytes[strip] + x);
    };
    for (std::size_t z = 0; z < job.rows; z += max_strips * strip_rows) {
        const std::size_t remaining = (job.rows - z) / strip_rows;
        const std::size_t strips = remaining < max_strips ? remaining : max_strips;
        for_each_strip<Strip>(surface, job.first_row + z, strips, cosine, sine, take);
        std::uint8_t* blocks = job.blocks + (job.first_row + z) / strip_rows * n;
        for (std::size_t strip = 0; strip < strips; ++strip, blocks += n)
            for (std::size_t i = 0; i < n; ++i) blocks[i] = static_cast<std::uint8_t>(bytes[strip][i]);
    }
    // Each value is the maximum over all lanes, so it does not depend on the number of lanes.
    *job.extremes = {
        .displacement_squared = largest_of<Arch>(displacement),
        .stretch_squared = largest_of<Arch>(norm) * job.texels_per_m * job.texels_per_m,
        .byte = static_cast<std::uint8_t>(largest_of<Arch>(largest))};
}

template <class Arch>
void find_contraction(const FindContractionJob& job) {
    if (job.sine != 0 || job.cosine != 1)
        find_contraction_of<Arch, true>(job);
    else
        find_contraction_of<Arch, false>(job);
}

/// Replaces entry i of `count` entries by the maximum of entries i to i + width - 1, byte by byte.
/// Each entry has `stride` bytes. The last width - 1 entries are undefined afterwards. Whole registers
/// are read and written, up to one beyond the entries. The covered width doubles in each pass.
template <class Arch>
PELAGIC_INLINE void largest_ahead(std::uint8_t* bytes, std::size_t count, std::size_t width, std::size_t stride) {
    using B = xsimd::batch<std::uint8_t, Arch>;
    std::size_t covered = 1;
    const auto cover = [&](std::size_t further, std::size_t kept) {
        for (std::size_t i = 0; i < kept * stride; i += B::size)
            xsimd::max(B::load_unaligned(bytes + i), B::load_unaligned(bytes + i + further * stride))
                .store_unaligned(bytes + i);
    };
    for (; 2 * covered <= width; covered *= 2) cover(covered, count - covered);
    if (covered < width) cover(width - covered, count - width + 1);
}

template <class Arch>
void spread_contraction(const SpreadContractionJob& job) {
    static_assert(xsimd::batch<std::uint8_t, Arch>::size <= SpreadContractionJob::margin);
    const std::size_t columns = job.columns, rows = job.rows, reach_x = job.reach_x, reach_z = job.reach_z;
    const std::size_t padded = rows + 2 * reach_z;
    std::uint8_t *const scratch = job.scratch, *const to = job.to;
    for (std::size_t z = 0; z < rows; ++z) {
        const std::uint8_t* const from = job.from + z * columns;
        std::uint8_t row[2 * SpreadContractionJob::max_columns + SpreadContractionJob::margin];
        for (std::size_t x = 0; x < reach_x; ++x) {
            row[x] = from[columns - reach_x + x];
            row[reach_x + columns + x] = from[x];
        }
        for (std::size_t x = 0; x < columns; ++x) row[reach_x + x] = from[x];
        largest_ahead<Arch>(row, columns + 2 * reach_x, 2 * reach_x + 1, 1);
        std::uint8_t* const line = scratch + (reach_z + z) * columns;
        for (std::size_t x = 0; x < columns; ++x) line[x] = row[x];
    }
    for (std::size_t i = 0; i < reach_z * columns; ++i) {
        scratch[i] = scratch[rows * columns + i];
        scratch[(rows + reach_z) * columns + i] = scratch[reach_z * columns + i];
    }
    largest_ahead<Arch>(scratch, padded, 2 * reach_z + 1, columns);
    for (std::size_t i = 0; i < rows * columns; ++i) to[i] = scratch[i];
}

template <class Arch>
void halve_contraction(const HalveContractionJob& job) {
    const std::size_t columns = job.columns, rows = job.rows;
    const std::uint8_t* from = job.from;
    std::uint8_t* to = job.to;
    const auto largest = [](std::uint8_t a, std::uint8_t b) { return a > b ? a : b; };
    if (job.rows_each == 1) {
        for (std::size_t i = 0; i < rows * columns; ++i) to[i] = largest(from[2 * i], from[2 * i + 1]);
        return;
    }
    for (std::size_t z = 0; z < rows; ++z, to += columns, from += 4 * columns) {
        const std::uint8_t* const lower = from + 2 * columns;
        for (std::size_t x = 0; x < columns; ++x)
            to[x] = largest(largest(from[2 * x], lower[2 * x]), largest(from[2 * x + 1], lower[2 * x + 1]));
    }
}

template <class Arch>
float steepness(const SteepnessJob& job) {
    using V = xsimd::batch<float, Arch>;
    const SurfaceTexels surface = job.surface;
    const std::size_t n = static_cast<std::size_t>(surface.resolution);
    const auto squared = [](V change) { return change * change; };
    V steepness_squared(0.f);
    for (std::size_t x = 0; x < n; x += V::size) {
        const float* here = surface.height + column_offset(surface, x);
        const float* behind = surface.height + column_offset(surface, x + V::size);
        V above = V::load_unaligned(here), above_behind = V::load_unaligned(behind);
        const V first = above, first_behind = above_behind;
        V rise = squared(lanes_behind<1, Arch>(above, above_behind) - above);
        for (std::size_t z = 0; z < n; ++z) {
            here += surface.row_stride;
            behind += surface.row_stride;
            const V below = z + 1 < n ? V::load_unaligned(here) : first;
            const V below_behind = z + 1 < n ? V::load_unaligned(behind) : first_behind;
            const V next_rise = squared(lanes_behind<1, Arch>(below, below_behind) - below);
            const V fall = squared(below - above), fall_behind = squared(below_behind - above_behind);
            const V largest_fall = xsimd::max(fall, lanes_behind<1, Arch>(fall, fall_behind));
            steepness_squared = xsimd::max(steepness_squared, xsimd::max(rise, next_rise) + largest_fall);
            above = below;
            above_behind = below_behind;
            rise = next_rise;
        }
    }
    // The maximum over all lanes does not depend on the number of lanes.
    return largest_of<Arch>(square_root<Arch>(steepness_squared)) * job.texels_per_m;
}

}  // namespace pelagic::kernels
