#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/block_surface.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/bytes.kernel.hpp"

namespace pelagic::kernels {

/// Bytes of W compressions in units of a byte step: clamped and rounded to the nearest, ties to
/// even.
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> bytes_of_compression(xsimd::batch<float, Arch> compression) {
    return xsimd::nearbyint_as_int(clamped<Arch>(compression, 0.f, 255.f));
}

/// Bytes of two rows of a block of texels.
template <class Arch, std::size_t max_columns>
class CompressionRows {
    using V = xsimd::batch<float, Arch>;

   public:
    /// \param first  index of the first row's first texel; the second row starts `stride` texels
    /// later
    PELAGIC_INLINE CompressionRows(const PresentCompression& compression, std::size_t first, std::size_t stride,
                                   std::size_t columns)
        : factor_(compression.factor),
          offset_(compression.offset),
          front_x_(compression.front_x),
          front_z_(compression.front_z),
          bytes_(compression.bytes),
          first_(first),
          stride_(stride),
          columns_(columns) {}

    PELAGIC_INLINE void put(V trace, V h_x, V h_z, std::size_t row, std::size_t column) {
        const V contraction = trace + (front_x_ * h_x + front_z_ * h_z);
        bytes_of_compression<Arch>(contraction * factor_ + offset_).store_aligned(rows_[row] + column);
    }

    PELAGIC_INLINE void write() const {
        if (!bytes_) return;
        for (std::size_t row = 0; row < 2; ++row)
            for (std::size_t x = 0; x < columns_; ++x)
                bytes_[first_ + row * stride_ + x] = static_cast<std::uint8_t>(rows_[row][x]);
    }

   private:
    V factor_, offset_, front_x_, front_z_;
    std::uint8_t* bytes_;
    std::size_t first_, stride_, columns_;
    alignas(64) std::int32_t rows_[2][max_columns];
};

template <class Arch, class Turn>
inline void compression_of_rows(const CompressionJob& job, const Turn& turn) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t n = job.resolution;
    const BlockSurface<Arch> surface(job.surface, n, job.block_stride);
    const V factor(job.factor), offset(job.offset), far_weight(job.far_over_near);
    const V front_along(job.front_along), front_across(job.front_across);
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; z += 2) {
        typename BlockSurface<Arch>::PairWalk walk(surface, 0, z);
        for (std::size_t x = 0; x < n; x += V::size) {
            for (int row = 0; row < 2; ++row) {
                Differences<Arch> dx, h, dz;
                walk.wide_difference(surface_dx, row, far_weight, dx);
                walk.wide_difference(surface_height, row, far_weight, h);
                walk.wide_difference(surface_dz, row, far_weight, dz);
                turn(dx);
                turn(dz);
                ((dx.x + dz.z + (front_along * h.x + front_across * h.z)) * factor + offset)
                    .store_aligned(job.out + (z + static_cast<std::size_t>(row)) * n + x);
            }
            walk.next();
        }
    }
}

template <class Arch>
void compression(const CompressionJob& job) {
    using V = xsimd::batch<float, Arch>;
    if (job.sine != 0 || job.cosine != 1)
        compression_of_rows<Arch>(job, Turned<Arch>{V(job.cosine), V(job.sine)});
    else
        compression_of_rows<Arch>(job, NotTurned{});
}

template <class Arch>
void snapshot(const SnapshotJob& job) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t n = job.resolution, last = n - 1;
    const std::uint32_t shift = 8 * job.byte, kept = ~(std::uint32_t{255} << shift);
    alignas(64) float column[SnapshotJob::max_resolution];
    alignas(64) std::int32_t bytes[SnapshotJob::max_resolution];
    constexpr std::size_t taps = SnapshotJob::taps, ahead = taps / 2 - 1;
    alignas(64) float padded[SnapshotJob::max_resolution + taps + V::size];
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; ++z) {
        const float* rows[taps];
        V weights_x[taps], weights_z[taps];
        for (std::size_t k = 0; k < taps; ++k) {
            rows[k] = job.compression + ((z + job.shift_z + n - ahead + k) & last) * n;
            weights_x[k] = V(job.weights_x[k]);
            weights_z[k] = V(job.weights_z[k]);
        }
        for (std::size_t x = 0; x < n; x += V::size) {
            V sum = weights_z[0] * V::load_aligned(rows[0] + x);
            for (std::size_t k = 1; k < taps; ++k) sum += weights_z[k] * V::load_aligned(rows[k] + x);
            sum.store_aligned(column + x);
        }
        for (std::size_t x = 0; x < n + taps - 1; ++x) padded[x] = column[(x + job.shift_x + n - ahead) & last];
        for (std::size_t x = 0; x < n; x += V::size) {
            V sum = weights_x[0] * V::load_aligned(padded + x);
            for (std::size_t k = 1; k < taps; ++k) sum += weights_x[k] * V::load_unaligned(padded + x + k);
            bytes_of_compression<Arch>(sum).store_aligned(bytes + x);
        }
        const std::uint32_t* const before = job.before + z * n;
        std::uint32_t* const after = job.after + z * n;
        for (std::size_t x = 0; x < n; ++x)
            after[x] = (before[x] & kept) | static_cast<std::uint32_t>(bytes[x]) << shift;
    }
}

/// Each byte of an output word is the mean of the corresponding bytes of 2 x 2 words. Halves are
/// rounded up and down in turn, and quarters with them: a bias would add up over the levels.
template <class Arch>
void halve_snapshots(const HalveSnapshotsJob& job) {
    constexpr std::uint32_t even = 0x00FF00FF, one = 0x00010001;
    for (std::size_t z = 0; z < job.side; ++z) {
        const std::uint32_t *const upper = job.from + 4 * z * job.side, *const lower = upper + 2 * job.side;
        std::uint32_t* const to = job.to + z * job.side;
        for (std::size_t x = 0; x < job.side; ++x) {
            const std::uint32_t a = upper[2 * x], b = upper[2 * x + 1], c = lower[2 * x], d = lower[2 * x + 1];
            const std::uint32_t half = one + one * static_cast<std::uint32_t>((x ^ z) & 1);
            const std::uint32_t low = (a & even) + (b & even) + (c & even) + (d & even) + half;
            const std::uint32_t high = (a >> 8 & even) + (b >> 8 & even) + (c >> 8 & even) + (d >> 8 & even) + half;
            to[x] = (low >> 2 & even) | (high >> 2 & even) << 8;
        }
    }
}

}  // namespace pelagic::kernels
