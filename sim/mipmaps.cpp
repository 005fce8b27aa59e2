#include "sim/mipmaps.hpp"

#include <algorithm>

#include "sim/frame.hpp"
#include "simd/lanes.hpp"

namespace pelagic {
namespace {

constexpr int band_levels = 5;
constexpr std::size_t band_rows = std::size_t{1} << band_levels;

std::size_t side_of(int resolution, int level) { return static_cast<std::size_t>(resolution) >> level; }

// Kernels read and write whole lane blocks.
std::size_t stride_of(int resolution, int level) {
    return (side_of(resolution, level) + lane_block - 1) / lane_block * lane_block;
}

std::size_t level_floats(int resolution, int level) {
    return 4 * side_of(resolution, level) * stride_of(resolution, level);
}

std::size_t floats_before(int resolution, int level) {
    std::size_t floats = 0;
    for (int l = 1; l < level; ++l) floats += level_floats(resolution, l);
    return floats;
}

void halve_row(MipAverages& averages, int resolution, int level, std::size_t row, const Kernels& kernels) {
    HalveJob job{.count = side_of(resolution, level)};
    for (std::size_t plane = 0; plane < 4; ++plane) {
        job.above[plane] = averages.row(level - 1, plane, 2 * row);
        job.below[plane] = averages.row(level - 1, plane, 2 * row + 1);
        job.out[plane] = averages.row(level, plane, row);
    }
    kernels.halve(job);
}

void pack_row(MipAverages& averages, int resolution, int level, std::size_t row, std::uint32_t* gradient_rgba8,
              const Kernels& kernels) {
    const std::size_t side = side_of(resolution, level);
    PackMipJob job{.count = side, .out = gradient_rgba8 + mip_offset(resolution, level) + row * side};
    for (std::size_t plane = 0; plane < 4; ++plane) job.row[plane] = averages.row(level, plane, row);
    kernels.pack_mip(job);
}

}  // namespace

MipAverages::MipAverages(int resolution)
    : resolution_(resolution), values_(floats_before(resolution, mip_levels(resolution))) {}

float* MipAverages::row(int level, std::size_t plane, std::size_t row) {
    const std::size_t line = plane * side_of(resolution_, level) + row;
    return values_.data() + floats_before(resolution_, level) + line * stride_of(resolution_, level);
}

std::size_t mip_bands(int resolution) { return (static_cast<std::size_t>(resolution) + band_rows - 1) / band_rows; }

void mipmap_band(MipAverages& averages, int resolution, std::size_t band, std::uint32_t* gradient_rgba8,
                 const Kernels& kernels) {
    const int last_level = std::min(band_levels, mip_levels(resolution) - 1);
    const std::size_t rows_of_level_0 = std::min(band_rows, static_cast<std::size_t>(resolution));
    for (int level = 1; level <= last_level; ++level) {
        const std::size_t rows = rows_of_level_0 >> level;
        for (std::size_t row = band * rows; row < (band + 1) * rows; ++row) {
            if (level > 1) halve_row(averages, resolution, level, row, kernels);
            pack_row(averages, resolution, level, row, gradient_rgba8, kernels);
        }
    }
}

void mipmap_tail(MipAverages& averages, int resolution, std::uint32_t* gradient_rgba8, const Kernels& kernels) {
    for (int level = band_levels + 1; level < mip_levels(resolution); ++level) {
        for (std::size_t row = 0; row < side_of(resolution, level); ++row) {
            halve_row(averages, resolution, level, row, kernels);
            pack_row(averages, resolution, level, row, gradient_rgba8, kernels);
        }
    }
}

}  // namespace pelagic
