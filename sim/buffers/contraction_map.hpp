// A map of positions at which a sum of cascades cannot self-intersect.
//
// A reference position q is displaced to F(q) = q + sum of D_i(q). Let -s_i be the smallest
// eigenvalue of the symmetric part of cascade i's slopes, and s_i = 0 if that eigenvalue is
// positive. If 1 - sum s_i >= m > 0 on a convex set, then (F(q') - F(q)) . (q' - q) >= m |q' - q|^2
// on this set. At most one of its points is then displaced to any given position.
//
// The following bounds limit the distance of two reference positions q and q' with F(q) = F(q').
// Let e_i be the largest |D_i|, and let the cascades be sorted from coarse to fine.
//
//   F(q') = F(q), so q' - q = sum of D_i(q) - D_i(q'):
//     |q' - q| <= r_0 = 2 (e_0 + e_1 + ...)
//   if 1 - s_0 - ... - s_(i-1) >= m_i within r_(i-1) of q, then with
//   C(q) = q + D_0(q) + ... + D_(i-1)(q):
//     m_i |q' - q| <= |C(q') - C(q)| = |sum over j >= i of D_j(q) - D_j(q')|
//     |q' - q| <= r_i = 2 (e_i + e_(i+1) + ...) / m_i
//
// Cascade i therefore only has to be searched within r_i, which is a few of its own texels. If the
// slack m_i remains after each cascade, the last step proves that q is unique. The map stores an
// upper bound of s_i for each block of one column by 4 rows of cells (kernels/cell_strip.kernel.hpp),
// and the largest one within r_i of each block. m_i is what the largest bounds of the cascades before
// leave, or min_slack. At a point, a query adds one byte of each cascade. If the sum proves nothing,
// query/stack_search.hpp tries the r_i of the point's own m_i, then searches.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// The map of a cascade.
class ContractionMap {
   public:
    /// Rows of cells per job.
    static constexpr std::size_t rows_per_job = 16;
    /// Smallest slack m_i after any cascade except the last, and after all cascades. At a small
    /// slack, a small error of the search becomes a large error of the reference position.
    static constexpr double min_slack = 0.3, min_slack_of_all = 0.05;
    /// Upper bound of the position error of a query's search, as a fraction of the finest cascade's
    /// texel.
    static constexpr double margin = 0.125;

    explicit ContractionMap(int resolution, const Allocator& memory = {});

    /// Stage `folds`: computes the contraction of one job's cells. Different jobs may run
    /// concurrently.
    void find(const Cascade& cascade, const Kernels& kernels, std::size_t job);
    std::size_t jobs() const { return extremes_.size(); }
    /// Stage `folds tail`: completes the map and sets cascade.contraction, a view into the map.
    /// \pre find() has run for all jobs of all cascades
    /// \param maps  maps of all cascades, the coarsest first
    /// \param number  index of this map in `maps`
    /// \param finest_texel_m  texel of the finest cascade, metres
    void spread(Cascade& cascade, std::span<const ContractionMap* const> maps, std::size_t number,
                double finest_texel_m, const Kernels& kernels);

    /// Runs all jobs of both stages on the calling thread, for cascades that do not belong to an
    /// ocean.
    static void update(std::span<Cascade> cascades, std::span<ContractionMap* const> maps, const Kernels& kernels);

    std::size_t bytes() const { return blocks_.bytes() + around_.bytes() + scratch_.bytes(); }

   private:
    double largest_m() const;
    int largest_byte() const;

    int resolution_;
    AlignedBuffer<std::uint8_t> blocks_, around_, scratch_;
    std::vector<ContractionExtremes> extremes_;  ///< one per job
    std::unique_ptr<std::atomic<float>> steepness_;
};

}  // namespace pelagic
