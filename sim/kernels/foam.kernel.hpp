#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/block_surface.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/mipmaps.kernel.hpp"

namespace pelagic::kernels {

/// FoamSource in registers; results are not yet rounded to whole bytes.
template <class Arch>
struct BreakingFoam {
    using V = xsimd::batch<float, Arch>;
    V offset, scale;

    explicit BreakingFoam(const FoamSource& source) : offset(source.offset), scale(source.scale) {}

    PELAGIC_INLINE V operator()(V jacobian) const { return clamped<Arch>(offset - scale * jacobian, 0.f, 255.f); }
};

/// One row of a block of texels: the accumulated foam and the new foam.
template <class Arch, std::size_t max_columns>
class FoamRow {
    using V = xsimd::batch<float, Arch>;

   public:
    /// Loads the accumulated foam and subtracts `fade`. \param from  bytes of the row
    PELAGIC_INLINE void remember(const std::uint8_t* from, std::size_t columns, int fade) {
        for (std::size_t x = 0; x < columns; ++x) {
            const int remaining = from[x] - fade;
            remembered_[x] = static_cast<float>(remaining > 0 ? remaining : 0);
        }
    }

    /// Returns the foam of W texels, in whole bytes: the maximum of generated and accumulated foam.
    PELAGIC_INLINE V show(V breaking, std::size_t column) {
        const auto bytes = xsimd::nearbyint_as_int(xsimd::max(breaking, V::load_aligned(remembered_ + column)));
        bytes.store_aligned(shown_ + column);
        return xsimd::to_float(bytes);
    }

    PELAGIC_INLINE void write(std::uint8_t* to, std::size_t columns) const {
        for (std::size_t x = 0; x < columns; ++x) to[x] = static_cast<std::uint8_t>(shown_[x]);
    }

   private:
    alignas(64) float remembered_[max_columns];
    alignas(64) std::int32_t shown_[max_columns];
};

/// Foam of two rows of a block of texels, as a frame shows it.
template <class Arch, std::size_t max_columns>
class ShownFoamRows {
    using V = xsimd::batch<float, Arch>;

   public:
    /// \param first  index of the first row's first texel; the second row starts `stride` texels
    /// later
    PELAGIC_INLINE ShownFoamRows(const ShownFoam& foam, std::size_t first, std::size_t stride, std::size_t columns)
        : breaking_(foam.source), bytes_(foam.bytes), first_(first), stride_(stride), columns_(columns) {
        for (std::size_t row = 0; row < 2; ++row)
            rows_[row].remember(foam.remembered + first + row * stride, columns, foam.fade);
    }

    /// Returns the foam at W texels with the given Jacobians, [0, 1].
    PELAGIC_INLINE V show(V jacobian, std::size_t row, std::size_t column) {
        return rows_[row].show(breaking_(jacobian), column) * V(1.f / 255);
    }

    PELAGIC_INLINE void write() const {
        for (std::size_t row = 0; row < 2; ++row) rows_[row].write(bytes_ + first_ + row * stride_, columns_);
    }

   private:
    BreakingFoam<Arch> breaking_;
    FoamRow<Arch, max_columns> rows_[2];
    std::uint8_t* bytes_;
    std::size_t first_, stride_, columns_;
};

/// ShownFoamRows without accumulated foam and without output bytes.
template <class Arch>
class FreshFoam {
    using V = xsimd::batch<float, Arch>;

   public:
    PELAGIC_INLINE FreshFoam(const ShownFoam& foam, std::size_t, std::size_t, std::size_t) : breaking_(foam.source) {}
    PELAGIC_INLINE V show(V jacobian, std::size_t, std::size_t) const {
        // A float of 2^23 or more is an integer, so the sum rounds the foam to the nearest whole
        // byte, ties to even.
        const V whole(0x1p23f);
        return ((breaking_(jacobian) + whole) - whole) * V(1.f / 255);
    }
    PELAGIC_INLINE void write() const {}

   private:
    BreakingFoam<Arch> breaking_;
};

/// Placeholder for ShownFoamRows if no half floats are written.
struct NoFoamRows {
    template <class... Any>
    PELAGIC_INLINE explicit NoFoamRows(const Any&...) {}
    PELAGIC_INLINE void write() const {}
};

/// Copies one row of the previous tick, shifted by the drift of the foam.
inline void shifted_row(const FoamTickJob& job, std::size_t z, std::uint8_t* to) {
    const std::size_t n = job.resolution;
    const std::uint8_t* const from = job.before + ((z + n - job.shift_z) & (n - 1)) * n;
    for (std::size_t x = 0; x < job.shift_x; ++x) to[x] = from[n - job.shift_x + x];
    for (std::size_t x = job.shift_x; x < n; ++x) to[x] = from[x - job.shift_x];
}

template <class Arch, class Turn>
inline void foam_rows(const FoamTickJob& job, const Turn& turn) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t n = job.resolution;
    const BlockSurface<Arch> surface(job.surface, n, job.block_stride);
    const V factor(job.difference_factor), no_far_weight(0.f), one(1.f);
    const BreakingFoam<Arch> breaking(job.source);
    std::uint8_t before[FoamTickJob::max_resolution];
    FoamRow<Arch, FoamTickJob::max_resolution> foam[2];
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; z += 2) {
        for (std::size_t row = 0; row < 2; ++row) {
            shifted_row(job, z + row, before);
            foam[row].remember(before, n, FoamTickJob::fade);
        }
        typename BlockSurface<Arch>::PairWalk walk(surface, 0, z);
        for (std::size_t x = 0; x < n; x += V::size) {
            for (int row = 0; row < 2; ++row) {
                Differences<Arch> dx, dz;
                walk.wide_difference(surface_dx, row, no_far_weight, dx);
                walk.wide_difference(surface_dz, row, no_far_weight, dz);
                turn(dx);
                turn(dz);
                const V jacobian = (one + dx.x * factor) * (one + dz.z * factor) - (dx.z * factor) * (dz.x * factor);
                foam[row].show(breaking(jacobian), x);
            }
            walk.next();
        }
        for (std::size_t row = 0; row < 2; ++row) foam[row].write(job.after + (z + row) * n, n);
    }
}

template <class Arch>
void foam_tick(const FoamTickJob& job) {
    using V = xsimd::batch<float, Arch>;
    if (job.sine != 0 || job.cosine != 1)
        foam_rows<Arch>(job, Turned<Arch>{V(job.cosine), V(job.sine)});
    else
        foam_rows<Arch>(job, NotTurned{});
}

/// Each output byte is the mean of 2 x 2 input bytes.
template <class Arch>
void halve_foam(const HalveFoamJob& job) {
    for (std::size_t z = 0; z < job.side; ++z) {
        const std::uint8_t *const upper = job.from + 4 * z * job.side, *const lower = upper + 2 * job.side;
        for (std::size_t x = 0; x < job.side; ++x) {
            const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
            job.to[z * job.side + x] = static_cast<std::uint8_t>((sum + 2) >> 2);
        }
    }
}

}  // namespace pelagic::kernels
