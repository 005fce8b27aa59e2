#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

/// How something on a surface changes along an axis: differences of neighbours on both sides.
template <class Arch>
struct Differences {
    xsimd::batch<float, Arch> x, z;
};

/// Axes of a tile that is turned against the world: a texel's place along the tile's x axis counts `cosine` along the
/// world's x and `sine` along its z. Differences along the tile's axes become those along the world's.
template <class Arch>
struct Turned {
    xsimd::batch<float, Arch> cosine, sine;

    PELAGIC_INLINE Differences<Arch> operator()(const Differences<Arch>& along) const {
        return {along.x * cosine - along.z * sine, along.x * sine + along.z * cosine};
    }
};

/// The axes of tile and world are the same.
struct NotTurned {
    template <class Arch>
    PELAGIC_INLINE const Differences<Arch>& operator()(const Differences<Arch>& along) const {
        return along;
    }
};

/// The surface as columns_finalize() leaves it.
template <class Arch>
class BlockSurface {
    using V = xsimd::batch<float, Arch>;
    static constexpr std::size_t row_floats = surface_components * V::size;

   public:
    BlockSurface(const float* surface, std::size_t resolution, std::size_t block_stride)
        : data_(surface), block_stride_(block_stride), last_(resolution - 1) {}

    PELAGIC_INLINE V at(SurfaceComponent component, std::size_t x, std::size_t z) const {
        return load(block(x), z, component);
    }

    /// Calls take(dx, height, dz) with the Differences over two texels, metres, at each W texels of a row.
    template <class Take>
    PELAGIC_INLINE void differences_of_row(std::size_t z, std::size_t first_column, std::size_t columns,
                                           Take take) const {
        const std::size_t above = (z - 1) & last_, below = (z + 1) & last_;
        const float* before = block(first_column - V::size);
        for (std::size_t x = first_column; x < first_column + columns; x += V::size) {
            const float* here = block(x);
            const float* behind = block(x + V::size);
            const auto difference = [&](SurfaceComponent component) {
                const V value = load(here, z, component);
                return Differences<Arch>{lanes_behind<1, Arch>(value, load(behind, z, component)) -
                                             lanes_before<1, Arch>(load(before, z, component), value),
                                         load(here, below, component) - load(here, above, component)};
            };
            take(difference(surface_dx), difference(surface_height), difference(surface_dz));
            before = here;
        }
    }

    /// Three blocks side by side.
    struct Blocks {
        const float *before, *here, *behind;
    };
    Blocks blocks_at(std::size_t x) const { return {block(x - V::size), block(x), block(x + V::size)}; }
    Blocks next(const Blocks& blocks, std::size_t x) const {
        return {blocks.here, blocks.behind, block(x + V::size)};
    }

    /// Where a row and its two neighbours on each side lie in a block.
    struct Rows {
        std::size_t far_above, above, here, below, far_below;
    };
    Rows rows_at(std::size_t z) const {
        const auto row = [&](std::size_t of) { return (of & last_) * row_floats; };
        return {row(z - 2), row(z - 1), row(z), row(z + 1), row(z + 2)};
    }

    PELAGIC_INLINE static V at(SurfaceComponent component, const Blocks& blocks, const Rows& rows) {
        return load_row(blocks.here, rows.here, component);
    }

    /// The weighted Differences of the two neighbours on each side, f(1) - f(-1) + far_weight (f(2) - f(-2)), at W texels.
    PELAGIC_INLINE static Differences<Arch> wide_difference(SurfaceComponent component, const Blocks& blocks,
                                                            const Rows& rows, V far_weight) {
        const auto column = [&](std::size_t row) { return load_row(blocks.here, row, component); };
        const V before = load_row(blocks.before, rows.here, component), here = column(rows.here);
        const V behind = load_row(blocks.behind, rows.here, component);
        return {(lanes_behind<1, Arch>(here, behind) - lanes_before<1, Arch>(before, here)) +
                    far_weight * (lanes_behind<2, Arch>(here, behind) - lanes_before<2, Arch>(before, here)),
                (column(rows.below) - column(rows.above)) +
                    far_weight * (column(rows.far_below) - column(rows.far_above))};
    }

   private:
    const float* block(std::size_t x) const { return data_ + (x & last_) / V::size * block_stride_; }
    static V load(const float* column, std::size_t z, SurfaceComponent component) {
        return load_row(column, z * row_floats, component);
    }
    static V load_row(const float* column, std::size_t row, SurfaceComponent component) {
        return V::load_aligned(column + row + component * V::size);
    }

    const float* data_;
    std::size_t block_stride_;
    std::size_t last_;  ///< N - 1, the mask that wraps
};

}  // namespace pelagic::kernels
