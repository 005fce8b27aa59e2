#include "pelagic/sim/surface/slope_maps.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/cascade.hpp"

namespace pelagic {
namespace {

std::size_t jobs_across(int resolution) {
    return std::max(static_cast<std::size_t>(resolution) / SlopesJob::block_columns, std::size_t{1});
}

}  // namespace

std::size_t SlopeMaps::jobs() const {
    return jobs_across(resolution) * static_cast<std::size_t>(resolution) / SlopesJob::block_rows;
}

SlopesJob SlopeMaps::slopes_job() const {
    const double texel_m = side_m / resolution;
    SlopesJob job{.surface = surface,
                  .resolution = static_cast<std::size_t>(resolution),
                  .first_row = 0,
                  .first_column = 0,
                  .block_stride = block_stride,
                  .cosine = static_cast<float>(cosine),
                  .sine = static_cast<float>(sine),
                  .difference_factor = static_cast<float>(SlopesJob::near_weight / (double{slope_step()} * texel_m)),
                  .variance_factor = variance_factor(),
                  .rgba16f = rgba16f,
                  .compression = compression,
                  .slopes = {},
                  .moments = {},
                  .averages = averages->level(SlopesJob::block_levels),
                  .average_stride = averages->stride(SlopesJob::block_levels)};
    for (std::size_t level = 0; level <= SlopesJob::block_levels; ++level) {
        job.slopes[level] = slopes[level];
        job.moments[level] = moments[level];
    }
    return job;
}

void SlopeMaps::make(const Kernels& kernels, std::size_t job) const {
    const std::size_t across = jobs_across(resolution);
    SlopesJob block = slopes_job();
    block.first_row = job / across * SlopesJob::block_rows;
    block.first_column = job % across * SlopesJob::block_columns;
    kernels.slopes(block);
}

void SlopeMaps::make_strip(const Kernels& kernels, const TextureStrip& strip) const {
    SlopesJob block = slopes_job();
    block.first_column = strip.first_column;
    block.narrow_columns = strip.columns;
    for (; block.first_row < block.resolution; block.first_row += SlopesJob::block_rows) kernels.slopes(block);
}

void SlopeMaps::make_tail(const Kernels& kernels) const {
    for (int level = SlopesJob::block_levels + 1; level < mip_levels(resolution); ++level)
        kernels.slope_level({.finer = averages->level(level - 1),
                             .finer_stride = averages->stride(level - 1),
                             .side = static_cast<std::size_t>(resolution) >> level,
                             .averages = averages->level(level),
                             .stride = averages->stride(level),
                             .variance_factor = variance_factor(),
                             .slopes = slopes[static_cast<std::size_t>(level)],
                             .moments = moments[static_cast<std::size_t>(level)]});
}

}  // namespace pelagic
