// Where a sum of cascades can't lie over itself.
//
// A reference point q is drawn at F(q) = q + sum of D_i(q). Let -s_i be the least eigenvalue of the symmetric part of cascade i's
// slopes, or 0 if that is positive. Where 1 - sum s_i >= m > 0 on a convex set, (F(q') - F(q)) . (q' - q) >= m |q' - q|^2 on it:
// at most one of its points is drawn at any place. How far from a reference point q can another one q' of the same place be? Let
// e_i be the largest |D_i|, and the cascades be sorted, the coarsest first.
//
//   F(q') = F(q), so q' - q = sum of D_i(q) - D_i(q'):                          |q' - q| <= r_0 = 2 (e_0 + e_1 + ...)
//   if 1 - s_0 - ... - s_(i-1) >= m_i within r_(i-1) of q, then with
//   C(q) = q + D_0(q) + ... + D_(i-1)(q):
//   m_i |q' - q| <= |C(q') - C(q)| = |sum over j >= i of D_j(q) - D_j(q')|:     |q' - q| <= r_i = 2 (e_i + e_(i+1) + ...) / m_i
//
// So a cascade need only be looked at within r_i, some of its own texels, and if the slack m_i is left after each cascade, the last
// step leaves q alone. The map holds the largest s_i within r_i of each block of 2 x 2 cells, for fixed m_i, in a byte: at a
// point a query adds up one byte of each cascade. Where that says nothing, query/stack_search.hpp looks closer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// The map of one cascade.
class ContractionMap {
   public:
    /// Rows of cells that one job looks at.
    static constexpr std::size_t rows_per_job = 16;
    /// What cascades but the last must leave of 1, and what all must leave: there a small error of the search is a larger one
    /// of the reference point.
    static constexpr double min_slack = 0.3, min_slack_of_all = 0.05;
    /// Of the finest cascade's texel: more than a query's search for a reference point may be off.
    static constexpr double margin = 0.125;

    explicit ContractionMap(int resolution, const Allocator& memory = {});

    /// Stage `folds`: looks at cells. Rows of different jobs may be looked at side by side.
    void find(const Cascade& cascade, const Kernels& kernels, std::size_t job);
    std::size_t jobs() const { return extremes_.size(); }
    /// Stage `folds tail`, when that is done for all cascades: the rest of it. Sets cascade.contraction, a view into the map.
    /// \param maps   of all cascades, the coarsest first
    /// \param number  of this map among them
    void spread(Cascade& cascade, std::span<const ContractionMap* const> maps, std::size_t number,
                double finest_texel_m, const Kernels& kernels);

    /// All of it, for cascades that no ocean made.
    static void update(std::span<Cascade> cascades, std::span<ContractionMap* const> maps, const Kernels& kernels);

    std::size_t bytes() const { return blocks_.bytes() + around_.bytes() + scratch_.bytes(); }

   private:
    double largest_m() const;

    int resolution_;
    AlignedBuffer<std::uint8_t> blocks_, around_, scratch_;
    std::vector<ContractionExtremes> extremes_;  ///< of each job
};

}  // namespace pelagic
