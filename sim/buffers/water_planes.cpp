#include "pelagic/sim/buffers/water_planes.hpp"

namespace pelagic {

void WaterPlanes::view(const WaterLayout& layout, WaterLevels& levels) {
    levels = layout.levels;
    std::size_t floats = 0;
    for (std::size_t grid = 0; grid < levels.count; ++grid) {
        first_float_[grid] = floats;
        floats += WaterLayout::floats(levels.grids[grid]);
    }
    if (texels_.size() != floats) texels_ = AlignedBuffer<float>(floats, memory_);
    for (std::size_t grid = 0; grid < levels.count; ++grid) levels.grids[grid].texels = of(grid);
    velocity_ = layout.velocity;
    head_ = layout.head;
    levels.velocity = &velocity_;
    levels.head = &head_;
}

}  // namespace pelagic
