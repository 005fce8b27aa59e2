#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

/// A vector along the tile's own axes, W at a time.
template <class Arch>
struct LatticeVectors {
    xsimd::batch<float, Arch> along, across;

    PELAGIC_INLINE LatticeVectors operator-(const LatticeVectors& other) const {
        return {along - other.along, across - other.across};
    }
};

/// What W cells do at most to the water in them.
template <class Arch>
struct SqueezeOfCells {
    using V = xsimd::batch<float, Arch>;
    V squeeze = V(0.f), stretch = V(0.f);

    /// At a corner, where the edges along the two axes meet: the slopes G are an even part t, a turn w and a part of
    /// size r that stretches one way as much as it squeezes the other. The least eigenvalue of G's symmetric part is
    /// t - r, and no vector grows by more than hypot(t, w) + r.
    PELAGIC_INLINE void look(const LatticeVectors<Arch>& edge, const LatticeVectors<Arch>& side) {
        const V half(0.5f);
        const V even = half * (edge.along + side.across), difference = half * (edge.along - side.across);
        const V shear = half * (edge.across + side.along), turn = half * (edge.across - side.along);
        const V apart = square_root<Arch>(difference * difference + shear * shear);
        squeeze = xsimd::max(squeeze, apart - even);
        stretch = xsimd::max(stretch, xsimd::abs(even) + xsimd::abs(turn) + apart);
    }
};

template <class Arch>
PELAGIC_INLINE float largest_of(xsimd::batch<float, Arch> values) {
    float lanes[xsimd::batch<float, Arch>::size];
    values.store_unaligned(lanes);
    float largest = lanes[0];
    for (const float lane : lanes) largest = lane > largest ? lane : largest;
    return largest;
}

/// Two rows of cells at a time, whose blocks of 2 x 2 become a byte each.
template <class Arch>
void find_squeeze(const FindSqueezeJob& job) {
    using V = xsimd::batch<float, Arch>;
    using Vectors = LatticeVectors<Arch>;
    constexpr std::size_t lanes = V::size;
    const SurfaceTexels& surface = job.surface;
    const std::size_t n = static_cast<std::size_t>(surface.resolution);
    const V cosine(job.cosine), sine(job.sine);
    const V most_byte(255.f), scale(job.one * job.texels_per_m), up(0.999f);
    V displacement(0.f), stretch(0.f), steepness(0.f);
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; z += 2) {
        std::uint8_t* const blocks = job.blocks + z / 2 * (n / 2);
        struct Rows {
            Vectors rows[3];
            V height[3];
        };
        const auto rows_at = [&](std::size_t x) {
            const int i = static_cast<int>(x & (n - 1));
            const int column = (i >> surface.block_shift) * surface.block_stride + (i & (surface.block_columns - 1));
            Rows loaded;
            for (std::size_t r = 0; r < 3; ++r) {
                const int place = column + static_cast<int>((z + r) & (n - 1)) * surface.row_stride;
                const V dx = V::load_unaligned(surface.dx + place), dz = V::load_unaligned(surface.dz + place);
                loaded.rows[r] = {cosine * dx + sine * dz, cosine * dz - sine * dx};
                loaded.height[r] = V::load_unaligned(surface.height + place);
            }
            return loaded;
        };
        Rows here = rows_at(0);
        for (std::size_t x = 0; x < n; x += lanes) {
            const Rows behind = rows_at(x + lanes);
            Vectors edges[3], sides[2], next_sides[2];
            for (int r = 0; r < 3; ++r) {
                const Vectors& row = here.rows[r];
                edges[r] = Vectors{lanes_behind<1, Arch>(row.along, behind.rows[r].along),
                                   lanes_behind<1, Arch>(row.across, behind.rows[r].across)} -
                           row;
                displacement = xsimd::max(displacement, row.along * row.along + row.across * row.across);
            }
            V rises[3];
            for (int r = 0; r < 3; ++r) {
                const V rise = lanes_behind<1, Arch>(here.height[r], behind.height[r]) - here.height[r];
                rises[r] = rise * rise;
            }
            SqueezeOfCells<Arch> cells;
            for (int r = 0; r < 2; ++r) {
                sides[r] = here.rows[r + 1] - here.rows[r];
                const Vectors side_behind = behind.rows[r + 1] - behind.rows[r];
                next_sides[r] = {lanes_behind<1, Arch>(sides[r].along, side_behind.along),
                                 lanes_behind<1, Arch>(sides[r].across, side_behind.across)};
                const V side = here.height[r + 1] - here.height[r];
                const V next_side = lanes_behind<1, Arch>(side, behind.height[r + 1] - behind.height[r]);
                steepness = xsimd::max(
                    steepness, xsimd::max(rises[r], rises[r + 1]) + xsimd::max(side * side, next_side * next_side));
                for (int e = r; e < r + 2; ++e) {
                    cells.look(edges[e], sides[r]);
                    cells.look(edges[e], next_sides[r]);
                }
            }
            here = behind;
            stretch = xsimd::max(stretch, cells.stretch);
            // Rounded up; what is more than a byte holds is the most that it holds.
            const V bytes = xsimd::min(cells.squeeze * scale + up, most_byte);
            std::int32_t whole[lanes];
            xsimd::to_int(bytes).store_unaligned(whole);
            for (std::size_t block = 0; block < lanes / 2; ++block) {
                const std::int32_t left = whole[2 * block], right = whole[2 * block + 1];
                blocks[x / 2 + block] = static_cast<std::uint8_t>(left > right ? left : right);
            }
        }
    }
    job.extremes->displacement_squared = largest_of<Arch>(displacement);
    job.extremes->stretch = largest_of<Arch>(stretch) * job.texels_per_m;
    job.extremes->steepness_squared = largest_of<Arch>(steepness) * job.texels_per_m * job.texels_per_m;
}

/// Of `count` entries, `stride` bytes each, entry i becomes the largest of i to i + width - 1, byte by byte; the last
/// width - 1 are left over. What is covered doubles each time.
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
void spread_squeeze(const SpreadSqueezeJob& job) {
    const std::size_t n = job.side, width = 2 * job.reach + 1, padded = n + 2 * job.reach;
    for (std::size_t z = 0; z < padded; ++z) {
        const std::uint8_t* const from = job.from + ((z + n - job.reach) & (n - 1)) * n;
        std::uint8_t row[2 * SpreadSqueezeJob::most_side];
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

/// Each byte the largest of 2 x 2.
template <class Arch>
void halve_squeeze(const HalveSqueezeJob& job) {
    for (std::size_t z = 0; z < job.side; ++z) {
        const std::uint8_t *const upper = job.from + 4 * z * job.side, *const lower = upper + 2 * job.side;
        for (std::size_t x = 0; x < job.side; ++x) {
            std::uint8_t most = upper[2 * x];
            const std::uint8_t others[] = {upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]};
            for (const std::uint8_t byte : others) most = byte > most ? byte : most;
            job.to[z * job.side + x] = most;
        }
    }
}

}  // namespace pelagic::kernels
