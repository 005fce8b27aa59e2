// Stage `mipmaps`: the chain of averaged normals and Jacobians, kept in float because bytes lose the smoothness:
// at a length of one a single step of a byte already means 0.88 (errata). Tiles of texels make the first levels
// (kernels.hpp), one job the rest, the tail.
#pragma once

#include <cstddef>

#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// Float averages of the levels that a tile leaves to others: GradientsJob::tile_levels and up.
class MipAverages {
   public:
    explicit MipAverages(int resolution, const HostMemory& memory = {});

    /// As MipLevelJob wants them.
    float* level(int level);
    std::size_t stride(int level) const;
    std::size_t bytes() const { return values_.bytes(); }

   private:
    int resolution_;
    AlignedBuffer<float> values_;
};

}  // namespace pelagic
