// Computes the slopes and gradients of arbitrary planes with the kernels of an instruction set.
#pragma once

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/surface/slope_maps.hpp"
#include "pelagic/sim/surface/surface_appearance.hpp"
#include "pelagic/tests/unfused/unfused_slopes.hpp"

namespace pelagic {

/// Planes in the layout of columns_finalize().
inline AlignedBuffer<float> surface_of(const unfused::CascadePlanes& planes, std::size_t lanes) {
    const int n = planes.resolution;
    const auto side = static_cast<std::size_t>(n);
    AlignedBuffer<float> surface(column_blocks(n, lanes) * column_block_floats(n, lanes));
    for (std::size_t z = 0; z < side; ++z) {
        for (std::size_t x = 0; x < side; ++x) {
            float* texel = surface.data() + x / lanes * column_block_floats(n, lanes) +
                           z * surface_components * lanes + x % lanes;
            texel[surface_dx * lanes] = planes.dx[z * side + x];
            texel[surface_height * lanes] = planes.height[z * side + x];
            texel[surface_dz * lanes] = planes.dz[z * side + x];
        }
    }
    return surface;
}

inline unfused::CascadeSlopes slopes_by(const Kernels& kernels, const unfused::CascadePlanes& planes,
                                        const SlopeRanges& ranges) {
    const int n = planes.resolution;
    const AlignedBuffer<float> surface = surface_of(planes, kernels.lanes);
    AlignedBuffer<std::uint16_t> halves(4 * planes.height.size());
    AlignedBuffer<std::uint32_t> slopes(mip_offset(n, mip_levels(n))), moments(slopes.size());
    MipAverages averages(n, {}, slope_planes);
    const SlopeMaps maps{.surface = surface.data(),
                         .resolution = n,
                         .block_stride = column_block_floats(n, kernels.lanes),
                         .side_m = planes.side_m,
                         .cosine = planes.cosine,
                         .sine = planes.sine,
                         .ranges = ranges,
                         .rgba16f = halves.data(),
                         .slopes = chain_in(slopes.data(), n),
                         .moments = chain_in(moments.data(), n),
                         .averages = &averages};
    for (std::size_t job = 0; job < maps.jobs(); ++job) maps.make(kernels, job);
    maps.make_tail(kernels);
    return {{slopes.data(), slopes.data() + slopes.size()},
            {moments.data(), moments.data() + moments.size()},
            {halves.data(), halves.data() + halves.size()}};
}

/// The first levels of the gradient chain of a cascade of at most 256 texels, and its half floats.
struct Gradients {
    std::vector<std::uint32_t> texels;
    std::vector<std::uint16_t> halves;
};
inline Gradients gradients_by(const Kernels& kernels, const unfused::CascadePlanes& planes, bool with_halves) {
    const int n = planes.resolution;
    const AlignedBuffer<float> surface = surface_of(planes, kernels.lanes);
    AlignedBuffer<std::uint32_t> texels(mip_offset(n, mip_levels(n)));
    AlignedBuffer<std::uint16_t> halves(4 * planes.height.size());
    MipAverages averages(n);
    const double two_texels = 2 * planes.side_m / n;
    GradientsJob job{.surface = surface.data(),
                     .resolution = static_cast<std::size_t>(n),
                     .first_row = 0,
                     .first_column = 0,
                     .block_stride = column_block_floats(n, kernels.lanes),
                     .two_texels_m = static_cast<float>(two_texels),
                     .jacobian_factor = static_cast<float>(1 / (two_texels * two_texels)),
                     .normal_length = mean_normal_length(0.1f),
                     .smoothness_bits = smoothness_bits(0.1f),
                     .rgba16f = with_halves ? halves.data() : nullptr,
                     .levels = {},
                     .averages = averages.level(GradientsJob::block_levels),
                     .average_stride = averages.stride(GradientsJob::block_levels),
                     .cosine = planes.cosine,
                     .sine = planes.sine};
    for (int level = 0; level <= GradientsJob::block_levels; ++level)
        job.levels[level] = texels.data() + mip_offset(n, level);
    for (; job.first_row < static_cast<std::size_t>(n); job.first_row += GradientsJob::block_rows)
        kernels.gradients(job);
    return {{texels.data(), texels.data() + mip_offset(n, GradientsJob::block_levels + 1)},
            {halves.data(), halves.data() + halves.size()}};
}

}  // namespace pelagic
