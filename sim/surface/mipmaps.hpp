// Stage `mipmaps`: the chain of averaged normals and Jacobians, or of slopes (kernels.hpp), kept in float because bytes lose the smoothness:
// at a length of one a single step of a byte already means 0.88 (errata). Cascades of texels make the first levels
// (kernels.hpp), one job the rest, the tail.
#pragma once

#include <cstddef>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// Float averages of the levels that a cascade leaves to others: GradientsJob::cascade_levels and up.
class MipAverages {
   public:
    /// \param planes  of a row of averages: those of MipLevelJob, or slope_planes for SlopeLevelJob
    explicit MipAverages(int resolution, const Allocator& memory = {}, std::size_t planes = mip_planes + 1);

    /// As those jobs want them.
    float* level(int level);
    std::size_t stride(int level) const;
    std::size_t bytes() const { return values_.bytes(); }

   private:
    std::size_t floats_before(int level) const;

    int resolution_;
    std::size_t planes_;
    AlignedBuffer<float> values_;
};

}  // namespace pelagic
