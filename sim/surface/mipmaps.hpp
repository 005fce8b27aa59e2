// Stage `mipmaps`: the mip chain of averaged normals and Jacobians, or of slopes (kernels.hpp).
// Averages are stored as float, because bytes lose the smoothness: near a normal length of 1, one
// byte step already means a smoothness of 0.88 (errata). Jobs on blocks of texels compute the first
// levels (kernels.hpp); one job computes the remaining levels, the tail.
#pragma once

#include <cstddef>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// Float averages of the levels from GradientsJob::block_levels up, which jobs on blocks of
/// texels pass to the tail.
class MipAverages {
   public:
    /// \param planes  planes per row of averages: mip_planes + 1 for MipLevelJob, slope_planes for
    /// SlopeLevelJob
    explicit MipAverages(int resolution, const Allocator& memory = {}, std::size_t planes = mip_planes + 1);

    /// Averages of a level and the stride of a plane, in the layout of MipLevelJob and
    /// SlopeLevelJob.
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
