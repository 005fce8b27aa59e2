#include "pelagic/sim/surface/mipmaps.hpp"

#include <algorithm>

#include "pelagic/sim/frame.hpp"

namespace pelagic {
namespace {

// Kernels read and write whole registers, two at a time.
constexpr std::size_t min_stride = 32;

std::size_t stride_of(int resolution, int level) {
    return std::max(static_cast<std::size_t>(resolution) >> level, min_stride);
}

}  // namespace

MipAverages::MipAverages(int resolution, const Allocator& memory, std::size_t planes)
    : resolution_(resolution), planes_(planes), values_(floats_before(mip_levels(resolution)), memory) {}

std::size_t MipAverages::floats_before(int level) const {
    std::size_t floats = 0;
    for (int l = GradientsJob::block_levels; l < level; ++l)
        floats += (static_cast<std::size_t>(resolution_) >> l) * planes_ * stride_of(resolution_, l);
    return floats;
}

float* MipAverages::level(int level) { return values_.data() + floats_before(level); }

std::size_t MipAverages::stride(int level) const { return stride_of(resolution_, level); }

}  // namespace pelagic
