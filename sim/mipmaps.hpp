// Stage `mipmaps`: the chain of averaged normals and Jacobians, kept in float because bytes lose the smoothness:
// at a length of one a single step of a byte already means 0.88 (errata).
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/kernels/kernels.hpp"
#include "simd/aligned_buffer.hpp"

namespace pelagic {

/// Float averages of every level from 1 on: four planes (scaled normal x, y, z, Jacobian) a level, rows padded.
class MipAverages {
   public:
    explicit MipAverages(int resolution);

    /// Row `row` of plane `plane`, 0 to 3, of level `level`, at least 1.
    float* row(int level, std::size_t plane, std::size_t row);
    std::size_t bytes() const { return values_.bytes(); }

   private:
    int resolution_;
    AlignedBuffer<float> values_;
};

/// A band is 32 rows of level 0, so its levels 1 to 5 need nothing from outside: bands run side by side.
std::size_t mip_bands(int resolution);

/// Packs levels 1 to 5 of a band into the chain `gradient_rgba8`, making the averages of 2 to 5 from those of 1.
void mipmap_band(MipAverages& averages, int resolution, std::size_t band, std::uint32_t* gradient_rgba8,
                 const Kernels& kernels);

/// What is above: level 6 and on, a few texels, after all bands.
void mipmap_tail(MipAverages& averages, int resolution, std::uint32_t* gradient_rgba8, const Kernels& kernels);

}  // namespace pelagic
