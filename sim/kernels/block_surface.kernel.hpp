#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

/// Differences of a surface component along both axes, between the neighbours on both sides.
template <class Arch>
struct Differences {
    xsimd::batch<float, Arch> x, z;
};

/// Rotates differences along the cascade's axes into differences along the world's axes. The
/// cascade's x axis has the components `cosine` along the world's x and `sine` along the world's z.
template <class Arch>
struct Turned {
    xsimd::batch<float, Arch> cosine, sine;

    PELAGIC_INLINE void operator()(Differences<Arch>& along) const {
        const xsimd::batch<float, Arch> x = along.x;
        along.x = x * cosine - along.z * sine;
        along.z = x * sine + along.z * cosine;
    }
};

/// Leaves differences unchanged: the axes of cascade and world are equal.
struct NotTurned {
    template <class Arch>
    PELAGIC_INLINE void operator()(Differences<Arch>&) const {}
};

/// The surface in the layout that columns_finalize() writes.
template <class Arch>
class BlockSurface {
    using V = xsimd::batch<float, Arch>;
    static constexpr std::size_t row_floats = surface_components * V::size;

   public:
    BlockSurface(const float* surface, std::size_t resolution, std::size_t block_stride)
        : data_(surface), block_stride_(block_stride), last_(resolution - 1) {}

    /// Two adjacent rows, register by register.
    struct RowPair {
        const float* block;
        std::size_t block_stride;

        PELAGIC_INLINE V at(SurfaceComponent component, std::size_t row) const {
            return V::load_aligned(block + row * row_floats + component * V::size);
        }
        void next() { block += block_stride; }
    };
    RowPair rows(std::size_t x, std::size_t z) const { return {block(x) + z * row_floats, block_stride_}; }

    /// Calls take(along) for each W texels of a row, with the Differences over two texels of each
    /// component, metres. Registers are processed in pairs, so that no register moves are needed. A
    /// row of one register is processed twice.
    template <class Take>
    PELAGIC_INLINE void differences_of_row(std::size_t z, std::size_t first_column, std::size_t columns,
                                           Take take) const {
        const std::size_t stride = block_stride_;  // read once, before the stores of `take`
        const float* row = data_ + z * row_floats;
        const float* end = row + column_blocks() * stride;
        const std::ptrdiff_t above = floats_to(z, z - 1), below = floats_to(z, z + 1);
        const auto load = [](const float* texels, std::size_t component) {
            return V::load_aligned(texels + component * V::size);
        };
        const auto next = [=](const float* texels) { return texels + stride == end ? row : texels + stride; };
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

    /// Iterates over an even row and the row after it, register by register.
    class PairWalk {
       public:
        PELAGIC_INLINE PairWalk(const BlockSurface& surface, std::size_t first_column, std::size_t z)
            : row_(surface.data_ + z * row_floats),
              end_(row_ + surface.column_blocks() * surface.block_stride_),
              before_(surface.block(first_column - V::size) + z * row_floats),
              here_(surface.block(first_column) + z * row_floats),
              stride_(surface.block_stride_),
              above_(surface.floats_to(z, z - 2)),
              below_(surface.floats_to(z, z + 2)) {}

        PELAGIC_INLINE V at(std::size_t component, int row) const { return load(here_, row, component); }

        /// Computes weighted differences of two neighbours per side: f(1) - f(-1) + far_weight
        /// (f(2) - f(-2)).
        PELAGIC_INLINE void wide_difference(std::size_t component, int row, V far_weight,
                                            Differences<Arch>& along) const {
            const auto column = [&](int of) { return load(here_, of, component); };
            const V here = column(row);
            const Seam<Arch> left{load(before_, row, component), here}, right{here, load(behind(), row, component)};
            along.x = (lanes_behind<1, Arch>(here, right) - lanes_before<1, Arch>(left, here)) +
                      far_weight * (lanes_behind<2, Arch>(here, right) - lanes_before<2, Arch>(left, here));
            along.z = (column(row + 1) - column(row - 1)) + far_weight * (column(row + 2) - column(row - 2));
        }

        PELAGIC_INLINE void next() {
            before_ = here_;
            here_ = behind();
        }

       private:
        PELAGIC_INLINE const float* behind() const { return here_ + stride_ == end_ ? row_ : here_ + stride_; }
        /// \param row  -2 to 3, relative to the first of the two rows
        PELAGIC_INLINE V load(const float* block, int row, std::size_t component) const {
            const std::ptrdiff_t from = row < 0 ? above_ + 2 * step : row < 2 ? 0 : below_ - 2 * step;
            return V::load_aligned(block + from + row * step + component * V::size);
        }

        static constexpr auto step = static_cast<std::ptrdiff_t>(row_floats);

        const float *row_, *end_;  ///< in the first block, and past the last block
        const float *before_, *here_;
        std::size_t stride_;
        std::ptrdiff_t above_, below_;  ///< offsets in floats to the two rows on either side
    };

   private:
    std::size_t column_blocks() const { return (last_ + 1) / V::size; }
    /// Returns the offset within a block from row z to row `other`, which wraps.
    std::ptrdiff_t floats_to(std::size_t z, std::size_t other) const {
        return (static_cast<std::ptrdiff_t>(other & last_) - static_cast<std::ptrdiff_t>(z)) *
               static_cast<std::ptrdiff_t>(row_floats);
    }
    const float* block(std::size_t x) const { return data_ + (x & last_) / V::size * block_stride_; }

    const float* data_;
    std::size_t block_stride_;
    std::size_t last_;  ///< N - 1, the wrap mask
};

}  // namespace pelagic::kernels
