// Fold map: marks the positions at which the surface may self-intersect.
//
// The displacement maps the periodic domain onto itself with degree 1. At a world position with
// several reference positions, those with positive Jacobian therefore outnumber those with negative
// Jacobian by one. So at least one of them lies in a cell with negative Jacobian. The displaced
// images of the overturned cells cover every such world position, and nothing far from one.
// Everywhere else the reference position of a world position is unique, so the first solution that
// a search finds is the only one.
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
    /// Rows of cells per job.
    static constexpr std::size_t rows_per_job = 16;
    /// Cells with a Jacobian up to this bound are treated as overturned. In nearly overturned
    /// cells, a small horizontal error is a large error in height.
    static constexpr double max_jacobian = 0.05;
    /// Margin in texels around the displaced cells: an upper bound of the position error of a
    /// query's search.
    static constexpr double margin = 0.125;

    explicit FoldMap(int resolution, const Allocator& memory = {});

    /// Stage `folds`: finds the overturned cells of one job. Different jobs may run concurrently.
    void find(const Cascade& cascade, const Kernels& kernels, std::size_t job);
    std::size_t jobs() const { return static_cast<std::size_t>(resolution_) / rows_per_job; }
    /// Stage `folds tail`: marks the squares that the displaced overturned cells cover. \pre find()
    /// has run for all jobs
    void mark(const Cascade& cascade);

    /// Runs all jobs of both stages on the calling thread, for cascades that do not belong to an
    /// ocean. Sets cascade.folds, a view into the map.
    /// \param kernels  of an instruction set with at most as many lanes as the planes' blocks have
    /// columns
    void update(Cascade& cascade, const Kernels& kernels);

    /// N^2 bits: the square of the world from texel (i, j) to (i + 1, j + 1) is bit i % 8 of byte
    /// (j N + i) / 8.
    std::span<const std::uint8_t> squares() const { return {squares_.data(), squares_.size()}; }
    std::size_t bytes() const { return squares_.bytes() + cells_.bytes(); }

   private:
    void mark_squares(int first_x, int last_x, int first_z, int last_z);

    int resolution_;
    AlignedBuffer<std::uint8_t> cells_;    ///< overturned cells, at their reference positions
    AlignedBuffer<std::uint8_t> squares_;  ///< marked squares of the world
};

}  // namespace pelagic
