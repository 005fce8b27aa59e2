// The grids of a cascade's water levels in a frame.
#pragma once

#include <cstddef>

#include "pelagic/sim/water_levels.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// Depths, resolutions and weights of the grids of a sea.
struct WaterLayout {
    WaterLevels levels;  ///< without texels and pointers
    DepthLadder velocity, head;

    static std::size_t row_texels(const WaterGrid& grid) {
        return static_cast<std::size_t>(grid.resolution + WaterLevels::repeated);
    }
    static std::size_t floats(const WaterGrid& grid) {
        return 4 * row_texels(grid) * static_cast<std::size_t>(grid.resolution);
    }
};

class WaterPlanes {
   public:
    explicit WaterPlanes(const Allocator& memory) : memory_(memory) {}

    /// Sets a cascade's levels, and allocates texels unless they have the size already.
    void view(const WaterLayout& layout, WaterLevels& levels);
    /// Returns the texels of a grid. \pre view()
    float* of(std::size_t grid) { return texels_.data() + first_float_[grid]; }

    std::size_t bytes() const { return texels_.bytes() + sizeof(WaterPlanes); }

   private:
    Allocator memory_;
    AlignedBuffer<float> texels_;
    std::array<std::size_t, WaterLevels::max_grids> first_float_{};
    DepthLadder velocity_, head_;  ///< of the frame's sea
};

}  // namespace pelagic
