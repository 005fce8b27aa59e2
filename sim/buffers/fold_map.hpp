// Where the surface may lie over itself.
//
// The displacement takes the patch once around itself, so intersections that are overturned and intersections that are not come in
// pairs but for one: where several reference points are drawn at one world point, one of them lies in a cell whose Jacobian
// is negative. Whatever the cells that turn over are drawn on covers every such world point, and nothing far from it.
// Everywhere else the reference point of a world point is the only one, and a search that finds one has found it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

class FoldMap {
   public:
    /// Rows of cells that one job looks at.
    static constexpr std::size_t rows_per_job = 16;
    /// Cells that nearly turn over count too: there a small error horizontal is a large one in height.
    static constexpr double max_jacobian = 0.05;
    /// Texels around what such cells are drawn on: more than a query's search for a reference point may be off.
    static constexpr double margin = 0.125;

    explicit FoldMap(int resolution, const Allocator& memory = {});

    /// Stage `folds`: looks for cells that turn over. Rows of different jobs may be looked at side by side.
    void find(const Cascade& cascade, const Kernels& kernels, std::size_t job);
    std::size_t jobs() const { return static_cast<std::size_t>(resolution_) / rows_per_job; }
    /// Stage `folds tail`: marks the squares that the cells found are drawn on.
    void mark(const Cascade& cascade);

    /// All of it, for cascades that no ocean made; sets cascade.folds, a view into the map.
    /// \param kernels  of an instruction set with at most as many lanes as the planes' blocks have columns
    void update(Cascade& cascade, const Kernels& kernels);

    /// N^2 bits: the square of the world from texel (i, j) to (i + 1, j + 1) is bit i % 8 of byte (j N + i) / 8.
    std::span<const std::uint8_t> squares() const { return {squares_.data(), squares_.size()}; }
    std::size_t bytes() const { return squares_.bytes() + cells_.bytes(); }

   private:
    void mark_squares(int first_x, int last_x, int first_z, int last_z);

    int resolution_;
    AlignedBuffer<std::uint8_t> cells_;    ///< that turn over, of the surface at rest
    AlignedBuffer<std::uint8_t> squares_;  ///< of the world
};

}  // namespace pelagic
