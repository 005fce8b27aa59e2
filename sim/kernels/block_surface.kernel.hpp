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

    PELAGIC_INLINE void operator()(Differences<Arch>& along) const {
        const xsimd::batch<float, Arch> x = along.x;
        along.x = x * cosine - along.z * sine;
        along.z = x * sine + along.z * cosine;
    }
};

/// The axes of tile and world are the same.
struct NotTurned {
    template <class Arch>
    PELAGIC_INLINE void operator()(Differences<Arch>&) const {}
};

/// The surface as columns_finalize() leaves it.
template <class Arch>
class BlockSurface {
    using V = xsimd::batch<float, Arch>;
    static constexpr std::size_t row_floats = surface_components * V::size;

   public:
    BlockSurface(const float* surface, std::size_t resolution, std::size_t block_stride)
        : data_(surface), block_stride_(block_stride), last_(resolution - 1) {}

    /// Two rows beside one another, register after register.
    struct RowPair {
        const float* block;
        std::size_t block_stride;

        PELAGIC_INLINE V at(SurfaceComponent component, std::size_t row) const {
            return V::load_aligned(block + row * row_floats + component * V::size);
        }
        void next() { block += block_stride; }
    };
    RowPair rows(std::size_t x, std::size_t z) const { return {block(x) + z * row_floats, block_stride_}; }

    /// Calls take(along) with the Differences over two texels of each component, metres, at each W texels of a row. Registers
    /// come in twos, so that nothing need be moved from one to the next: a row of one register is gone through twice.
    template <class Take>
    PELAGIC_INLINE void differences_of_row(std::size_t z, std::size_t first_column, std::size_t columns,
                                           Take take) const {
        const float* row = data_ + z * row_floats;
        const float* end = row + column_blocks() * block_stride_;
        const std::size_t above = (((z - 1) & last_) - z) * row_floats, below = (((z + 1) & last_) - z) * row_floats;
        const auto load = [](const float* texels, std::size_t component) {
            return V::load_aligned(texels + component * V::size);
        };
        const auto next = [&](const float* texels) {
            const float* const after = texels + block_stride_;
            return after == end ? row : after;
        };
        const float* texels = block(first_column) + z * row_floats;
        const float* before = block(first_column - V::size) + z * row_floats;
        Seam<Arch> left[surface_components];
        for (std::size_t component = 0; component < surface_components; ++component)
            left[component] = Seam<Arch>{load(before, component), load(texels, component)};
        const auto step = [&](const float* here, const float* behind) {
            Differences<Arch> along[surface_components];
            for (std::size_t component = 0; component < surface_components; ++component) {
                const V value = load(here, component);
                const Seam<Arch> right{value, load(behind, component)};
                along[component].x =
                    lanes_behind<1, Arch>(value, right) - lanes_before<1, Arch>(left[component], value);
                along[component].z = load(here + below, component) - load(here + above, component);
                left[component] = right;
            }
            take(along);
        };
        for (std::size_t column = 0; column < columns; column += 2 * V::size) {
            const float* const second = next(texels);
            const float* const third = next(second);
            step(texels, second);
            step(second, third);
            texels = third;
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
        const V here = column(rows.here);
        const Seam<Arch> left{load_row(blocks.before, rows.here, component), here};
        const Seam<Arch> right{here, load_row(blocks.behind, rows.here, component)};
        return {(lanes_behind<1, Arch>(here, right) - lanes_before<1, Arch>(left, here)) +
                    far_weight * (lanes_behind<2, Arch>(here, right) - lanes_before<2, Arch>(left, here)),
                (column(rows.below) - column(rows.above)) +
                    far_weight * (column(rows.far_below) - column(rows.far_above))};
    }

   private:
    std::size_t column_blocks() const { return (last_ + 1) / V::size; }
    const float* block(std::size_t x) const { return data_ + (x & last_) / V::size * block_stride_; }
    static V load_row(const float* column, std::size_t row, SurfaceComponent component) {
        return V::load_aligned(column + row + component * V::size);
    }

    const float* data_;
    std::size_t block_stride_;
    std::size_t last_;  ///< N - 1, the mask that wraps
};

}  // namespace pelagic::kernels
