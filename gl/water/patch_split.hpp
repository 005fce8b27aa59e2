// Splits a draw list into the patches that may reach the interior of a hull and the others, so that
// only the first need a program that discards pixels.
#pragma once

#include <span>
#include <vector>

#include "pelagic/gl/water/exclusions.hpp"
#include "pelagic/quadtree/draw_list.hpp"
#include "pelagic/sim/cascade.hpp"

namespace pelagic::gl {

class PatchSplit {
   public:
    /// Splits the batches of a list by the horizontal rectangles of the exclusions. Reuses memory.
    /// \param bounds  of the frame; displacement extends a patch's rectangle
    /// \pre check(exclusions, maps.size()) is empty
    void assign(const DrawList& list, std::span<const Exclusion> exclusions, std::span<const ExclusionMap> maps,
                const FrameBounds& bounds);

    std::span<const PatchInstance> instances() const { return instances_; }  ///< of all batches
    std::span<const DrawBatch> apart() const { return apart_; }              ///< reach no exclusion
    std::span<const DrawBatch> touching() const { return touching_; }

   private:
    std::vector<PatchInstance> instances_;
    std::vector<DrawBatch> apart_, touching_;
};

}  // namespace pelagic::gl
