#include "pelagic/sim/surface/mipmaps.hpp"

#include <algorithm>

#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {
namespace {

// Kernels read and write whole registers, two at a time.
constexpr std::size_t least_stride = 32;

std::size_t stride_of(int resolution, int level) {
    return std::max(static_cast<std::size_t>(resolution) >> level, least_stride);
}

std::size_t floats_before(int resolution, int level) {
    std::size_t floats = 0;
    for (int l = GradientsJob::tile_levels; l < level; ++l)
        floats += (static_cast<std::size_t>(resolution) >> l) * (mip_planes + 1) * stride_of(resolution, l);
    return floats;
}

}  // namespace

MipAverages::MipAverages(int resolution, const HostMemory& memory)
    : resolution_(resolution), values_(floats_before(resolution, mip_levels(resolution)), memory) {}

float* MipAverages::level(int level) { return values_.data() + floats_before(resolution_, level); }

std::size_t MipAverages::stride(int level) const { return stride_of(resolution_, level); }

}  // namespace pelagic
