#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

/// W vectors along the cascade's own axes.
template <class Arch>
struct GridVectors {
    xsimd::batch<float, Arch> along, across;

    PELAGIC_INLINE GridVectors operator-(const GridVectors& other) const {
        return {along - other.along, across - other.across};
    }
};

/// The contraction bound of W columns of cells, times twice the length of a texel.
///
/// The slope matrix G at a corner is the sum of an isotropic component t, a rotation w and a
/// traceless symmetric component of size r. The smallest eigenvalue of G's symmetric part is t - r,
/// and the norm of G is at most |t| + |w| + r. The extremes of t, w and r over several corners
/// bound these values at each corner. All corners together then need one square root.
template <class Arch>
struct ContractionOfCells {
    using V = xsimd::batch<float, Arch>;
    V min_even = V(1e30f), max_apart_squared = V(0.f);

    PELAGIC_INLINE void add_corner(const GridVectors<Arch>& edge, const GridVectors<Arch>& side, V& max_even,
                                   V& max_turn) {
        const V even = edge.along + side.across, difference = edge.along - side.across;
        const V shear = edge.across + side.along, turn = edge.across - side.along;
        min_even = xsimd::min(min_even, even);
        max_apart_squared = xsimd::max(max_apart_squared, difference * difference + shear * shear);
        max_even = xsimd::max(max_even, xsimd::abs(even));
        max_turn = xsimd::max(max_turn, xsimd::abs(turn));
    }
    PELAGIC_INLINE V contraction() const { return square_root<Arch>(max_apart_squared) - min_even; }
};

template <class Arch>
PELAGIC_INLINE float largest_of(xsimd::batch<float, Arch> values) {
    float lanes[xsimd::batch<float, Arch>::size];
    values.store_unaligned(lanes);
    float largest = lanes[0];
    for (const float lane : lanes) largest = lane > largest ? lane : largest;
    return largest;
}

/// W texels of three consecutive rows.
template <class Arch>
struct TexelRows {
    using V = xsimd::batch<float, Arch>;
    GridVectors<Arch> horizontal[3];
    V height[3];

    PELAGIC_INLINE TexelRows(const SurfaceTexels& surface, std::size_t column, const int* row_offsets, V cosine,
                             V sine) {
        const int i = static_cast<int>(column) & (surface.resolution - 1);
        const int column_offset = (i >> surface.block_shift) * surface.block_stride + (i & (surface.block_columns - 1));
        for (int r = 0; r < 3; ++r) {
            const V dx = V::load_unaligned(surface.dx + column_offset + row_offsets[r]);
            const V dz = V::load_unaligned(surface.dz + column_offset + row_offsets[r]);
            horizontal[r] = {cosine * dx + sine * dz, cosine * dz - sine * dx};
            height[r] = V::load_unaligned(surface.height + column_offset + row_offsets[r]);
        }
    }
};

/// Processes two rows of cells at a time and writes one byte for each block of 2 x 2 cells.
template <class Arch>
void find_contraction(const FindContractionJob& job) {
    using V = xsimd::batch<float, Arch>;
    using Vectors = GridVectors<Arch>;
    constexpr std::size_t lanes = V::size;
    const SurfaceTexels& surface = job.surface;
    const std::size_t n = static_cast<std::size_t>(surface.resolution);
    const V cosine(job.cosine), sine(job.sine);
    const V scale(0.5f * job.one * job.texels_per_m), up(0.999f), max_byte(255.f);
    V displacement(0.f), even(0.f), turn(0.f), apart_squared(0.f), steepness(0.f);
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; z += 2) {
        alignas(64) std::int32_t columns[FindContractionJob::max_resolution];
        int row_offsets[3];
        for (std::size_t r = 0; r < 3; ++r) row_offsets[r] = static_cast<int>((z + r) & (n - 1)) * surface.row_stride;
        TexelRows<Arch> here(surface, 0, row_offsets, cosine, sine);
        for (std::size_t x = 0; x < n; x += lanes) {
            const TexelRows<Arch> behind(surface, x + lanes, row_offsets, cosine, sine);
            Vectors edges[3];
            V rises[3];
            for (int r = 0; r < 3; ++r) {
                const Vectors& row = here.horizontal[r];
                edges[r] = Vectors{lanes_behind<1, Arch>(row.along, behind.horizontal[r].along),
                                   lanes_behind<1, Arch>(row.across, behind.horizontal[r].across)} -
                           row;
                displacement = xsimd::max(displacement, row.along * row.along + row.across * row.across);
                const V rise = lanes_behind<1, Arch>(here.height[r], behind.height[r]) - here.height[r];
                rises[r] = rise * rise;
            }
            ContractionOfCells<Arch> cells;
            for (int r = 0; r < 2; ++r) {
                const Vectors side = here.horizontal[r + 1] - here.horizontal[r];
                const Vectors behind_side = behind.horizontal[r + 1] - behind.horizontal[r];
                const Vectors next_side{lanes_behind<1, Arch>(side.along, behind_side.along),
                                        lanes_behind<1, Arch>(side.across, behind_side.across)};
                for (int e = r; e < r + 2; ++e) {
                    cells.add_corner(edges[e], side, even, turn);
                    cells.add_corner(edges[e], next_side, even, turn);
                }
                const V fall = here.height[r + 1] - here.height[r];
                const V next_fall = lanes_behind<1, Arch>(fall, behind.height[r + 1] - behind.height[r]);
                steepness = xsimd::max(
                    steepness, xsimd::max(rises[r], rises[r + 1]) + xsimd::max(fall * fall, next_fall * next_fall));
            }
            here = behind;
            apart_squared = xsimd::max(apart_squared, cells.max_apart_squared);
            // Rounded up and clamped to a byte.
            xsimd::to_int(xsimd::min(xsimd::max(cells.contraction(), V(0.f)) * scale + up, max_byte))
                .store_aligned(columns + x);
        }
        std::uint8_t* const blocks = job.blocks + z / 2 * (n / 2);
        for (std::size_t i = 0; i < n / 2; ++i) {
            const std::int32_t left = columns[2 * i], right = columns[2 * i + 1];
            blocks[i] = static_cast<std::uint8_t>(left > right ? left : right);
        }
    }
    // Each value is the maximum over all lanes, so it does not depend on the number of lanes.
    const float max_apart = largest_of<Arch>(square_root<Arch>(apart_squared));
    const float stretch = largest_of<Arch>(even) + largest_of<Arch>(turn) + max_apart;
    job.extremes->displacement_squared = largest_of<Arch>(displacement);
    job.extremes->stretch = stretch * (0.5f * job.texels_per_m);
    job.extremes->steepness_squared = largest_of<Arch>(steepness) * job.texels_per_m * job.texels_per_m;
}

/// Replaces entry i of `count` entries by the maximum of entries i to i + width - 1, byte by byte.
/// Each entry has `stride` bytes. The last width - 1 entries are undefined afterwards. The covered
/// width doubles in each pass.
template <class Arch>
PELAGIC_INLINE void largest_ahead(std::uint8_t* bytes, std::size_t count, std::size_t width, std::size_t stride) {
    std::size_t covered = 1;
    const auto cover = [&](std::size_t further, std::size_t kept) {
        for (std::size_t i = 0; i < kept * stride; ++i) {
            const std::uint8_t ahead = bytes[i + further * stride];
            bytes[i] = bytes[i] > ahead ? bytes[i] : ahead;
        }
    };
    for (; 2 * covered <= width; covered *= 2) cover(covered, count - covered);
    if (covered < width) cover(width - covered, count - width + 1);
}

template <class Arch>
void spread_contraction(const SpreadContractionJob& job) {
    const std::size_t n = job.side, width = 2 * job.reach + 1, padded = n + 2 * job.reach;
    for (std::size_t z = 0; z < padded; ++z) {
        const std::uint8_t* const from = job.from + ((z + n - job.reach) & (n - 1)) * n;
        std::uint8_t row[2 * SpreadContractionJob::max_side];
        for (std::size_t x = 0; x < job.reach; ++x) {
            row[x] = from[n - job.reach + x];
            row[job.reach + n + x] = from[x];
        }
        for (std::size_t x = 0; x < n; ++x) row[job.reach + x] = from[x];
        largest_ahead<Arch>(row, padded, width, 1);
        for (std::size_t x = 0; x < n; ++x) job.scratch[z * n + x] = row[x];
    }
    largest_ahead<Arch>(job.scratch, padded, width, n);
    for (std::size_t i = 0; i < n * n; ++i) job.to[i] = job.scratch[i];
}

/// Each output byte is the maximum of 2 x 2 input bytes.
template <class Arch>
void halve_contraction(const HalveContractionJob& job) {
    for (std::size_t z = 0; z < job.side; ++z) {
        const std::uint8_t *const upper = job.from + 4 * z * job.side, *const lower = upper + 2 * job.side;
        for (std::size_t x = 0; x < job.side; ++x) {
            std::uint8_t max = upper[2 * x];
            const std::uint8_t others[] = {upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]};
            for (const std::uint8_t byte : others) max = byte > max ? byte : max;
            job.to[z * job.side + x] = max;
        }
    }
}

}  // namespace pelagic::kernels
