// Bounds of a displacement's slopes in strips of cells, from the lengths of the cells' edges.
//
// Inside a cell the displacement is bilinear, and its slope matrix G is a convex combination of those
// at the four corners. The columns of G at a corner are the changes e and f of the displacement along
// the two adjacent edges. With the squared Frobenius norm F^2 = |e|^2 + |f|^2 and the trace
// E = e_along + f_across, along the cascade's axes,
//
//   -(smallest eigenvalue of G's symmetric part) <= (sqrt(2 F^2 - E^2) - E) / 2
//   det(1 + G)                                   >= ((1 + E)^2 + 1 - F^2) / 2
//
// because 2 F^2 = E^2 + T^2 + A^2, where T is the antisymmetric component, A the length of the
// traceless symmetric one, the eigenvalue (E - A) / 2 and det G = (E^2 + T^2 - A^2) / 4. A wave of one
// direction has equality. Both bounds get worse with a larger F and a smaller E, the first one down to
// E = -F, where it is F, and the second one down to E = -1. So the extremes of e and f over a strip
// bound all corners of its cells. An edge needs no partner then, and |e| and |f| do not depend on the
// cascade's rotation.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

/// Rows of cells of a strip, and strips that are processed together.
inline constexpr std::size_t strip_rows = FindContractionJob::block_rows, max_strips = 4;

/// Returns the offset of a column in a row. \param column  may be N
PELAGIC_INLINE std::ptrdiff_t column_offset(const SurfaceTexels& surface, std::size_t column) {
    const int i = static_cast<int>(column) & (surface.resolution - 1);
    return (i >> surface.block_shift) * surface.block_stride + (i & (surface.block_columns - 1));
}

/// Extremes over the edges at W texels and below them, along the cascade's z axis.
template <class Arch>
struct SideEdges {
    xsimd::batch<float, Arch> squared, across;  ///< largest |f|^2, smallest f_across
};

/// Extremes over the edges of W columns of cells of a strip. Those along the z axis are on the
/// cells' left.
/// \tparam is_rotated         whether the cascade's axes differ from the world's
/// \tparam with_displacement  whether displacement_squared is computed
template <class Arch, bool is_rotated, bool with_displacement>
struct CellStrip {
    using V = xsimd::batch<float, Arch>;

    V x_squared, x_along;  ///< largest |e|^2, smallest e_along
    SideEdges<Arch> sides;
    V displacement_squared;  ///< largest of the texels, but for those below the strip

    /// W texels, and the edges from them to the texels on their right.
    struct Row {
        V dx, dz, edge_squared, edge_along;
    };
    struct Axes {
        V cosine, sine;

        PELAGIC_INLINE V along(V x, V z) const { return is_rotated ? cosine * x + sine * z : x; }
        PELAGIC_INLINE V across(V x, V z) const { return is_rotated ? cosine * z - sine * x : z; }
    };

    CellStrip() = default;
    /// The first row of cells.
    PELAGIC_INLINE CellStrip(const Row& above, const Row& below, const Axes& axes)
        : x_squared(xsimd::max(above.edge_squared, below.edge_squared)),
          x_along(xsimd::min(above.edge_along, below.edge_along)) {
        const V side_x = below.dx - above.dx, side_z = below.dz - above.dz;
        sides.squared = squared(side_x, side_z);
        sides.across = axes.across(side_x, side_z);
        if constexpr (with_displacement) displacement_squared = squared(above.dx, above.dz);
    }
    PELAGIC_INLINE void add(const Row& above, const Row& below, const Axes& axes) {
        const CellStrip other(above, below, axes);
        x_squared = xsimd::max(x_squared, below.edge_squared);
        x_along = xsimd::min(x_along, below.edge_along);
        sides.squared = xsimd::max(sides.squared, other.sides.squared);
        sides.across = xsimd::min(sides.across, other.sides.across);
        if constexpr (with_displacement)
            displacement_squared = xsimd::max(displacement_squared, other.displacement_squared);
    }

    /// Upper bound of F^2 and lower bound of E in the cells. \param behind  of the next W columns
    PELAGIC_INLINE V norm_squared(const SideEdges<Arch>& behind) const {
        return x_squared + xsimd::max(sides.squared, lanes_behind<1, Arch>(sides.squared, behind.squared));
    }
    PELAGIC_INLINE V trace(const SideEdges<Arch>& behind) const {
        return x_along + xsimd::min(sides.across, lanes_behind<1, Arch>(sides.across, behind.across));
    }

    /// Reads W texels of a row. \param behind  offset of the next W texels
    PELAGIC_INLINE static Row row_at(const SurfaceTexels& surface, std::ptrdiff_t here, std::ptrdiff_t behind,
                                     const Axes& axes) {
        Row row;
        row.dx = V::load_unaligned(surface.dx + here);
        row.dz = V::load_unaligned(surface.dz + here);
        const V edge_x = edge(row.dx, surface.dx + behind), edge_z = edge(row.dz, surface.dz + behind);
        row.edge_squared = squared(edge_x, edge_z);
        row.edge_along = axes.along(edge_x, edge_z);
        return row;
    }

   private:
    PELAGIC_INLINE static V edge(V texels, const float* behind) {
        return lanes_behind<1, Arch>(texels, V::load_unaligned(behind)) - texels;
    }
    PELAGIC_INLINE static V squared(V x, V z) { return x * x + z * z; }
};

/// Calls take(strip, x, cells, behind) for each W columns of up to max_strips strips of cells, where
/// `behind` are the side edges of the next W columns. Columns are processed from right to left, and
/// each from above, so that every texel is read once.
template <class Strip, class V, class Take>
PELAGIC_INLINE void for_each_strip(const SurfaceTexels& surface, std::size_t first_row, std::size_t strips, V cosine,
                                   V sine, Take take) {
    using Row = typename Strip::Row;
    const std::size_t n = static_cast<std::size_t>(surface.resolution);
    const typename Strip::Axes axes{cosine, sine};
    std::ptrdiff_t rows[max_strips * strip_rows + 1];
    for (std::size_t row = 0; row <= strips * strip_rows; ++row)
        rows[row] = static_cast<std::ptrdiff_t>((first_row + row) & (n - 1)) * surface.row_stride;
    const auto column = [&](std::ptrdiff_t here, std::ptrdiff_t behind, auto take_strip) PELAGIC_INLINE_LAMBDA {
        const auto row_at = [&](std::ptrdiff_t row) PELAGIC_INLINE_LAMBDA {
            return Strip::row_at(surface, here + row, behind + row, axes);
        };
        Row above = row_at(rows[0]);
        for (std::size_t s = 0; s < strips; ++s) {
            // One row after the other, so that the values stay in registers.
            const std::ptrdiff_t* const row = rows + s * strip_rows;
            static_assert(strip_rows == 4);
            const Row second = row_at(row[1]);
            Strip cells(above, second, axes);
            const Row third = row_at(row[2]);
            cells.add(second, third, axes);
            const Row fourth = row_at(row[3]);
            cells.add(third, fourth, axes);
            above = row_at(row[4]);
            cells.add(fourth, above, axes);
            take_strip(s, cells);
        }
    };
    Strip first[max_strips];
    decltype(Strip::sides) behind[max_strips];
    std::ptrdiff_t behind_offset = column_offset(surface, 0);
    const auto keep_first = [&](std::size_t s, const Strip& cells) PELAGIC_INLINE_LAMBDA {
        first[s] = cells;
        behind[s] = cells.sides;
    };
    column(behind_offset, column_offset(surface, V::size), keep_first);
    for (std::size_t x = n - V::size; x > 0; x -= V::size) {
        const std::ptrdiff_t here = column_offset(surface, x);
        column(here, behind_offset, [&](std::size_t s, const Strip& cells) PELAGIC_INLINE_LAMBDA {
            take(s, x, cells, behind[s]);
            behind[s] = cells.sides;
        });
        behind_offset = here;
    }
    for (std::size_t s = 0; s < strips; ++s) take(s, 0, first[s], behind[s]);
}

}  // namespace pelagic::kernels
