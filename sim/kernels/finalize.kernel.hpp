#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "sim/kernels/kernels.hpp"
#include "sim/wave_blocks.hpp"

namespace pelagic::kernels {

/// Extremes of a batch's lanes. A zero may come with either sign, by the order of lanes; + 0 makes it positive.
template <class Arch>
inline float least_lane(xsimd::batch<float, Arch> v) {
    float lanes[xsimd::batch<float, Arch>::size];
    v.store_unaligned(lanes);
    float least = lanes[0];
    for (const float lane : lanes) least = lane < least ? lane : least;
    return least + 0.f;
}

template <class Arch>
inline float most_lane(xsimd::batch<float, Arch> v) {
    float lanes[xsimd::batch<float, Arch>::size];
    v.store_unaligned(lanes);
    float most = lanes[0];
    for (const float lane : lanes) most = lane > most ? lane : most;
    return most + 0.f;
}

template <class Arch>
void finalize(const FinalizeJob& job) {
    using V = xsimd::batch<float, Arch>;
    const V factors[3] = {V(job.choppiness), V(1.f), V(job.choppiness)};
    const std::size_t surface_block = surface_block_floats(static_cast<int>(job.resolution));

    // Least and most of each plane.
    V least[3], most[3];
    for (int c = 0; c < 3; ++c) {
        least[c] = V(3.4e38f);
        most[c] = V(-3.4e38f);
    }
    for (std::size_t z = job.first_row; z < job.end_row; ++z) {
        for (std::size_t c = 0; c < surface_components; ++c) {
            float* row = job.planes[c] + static_cast<std::ptrdiff_t>(z) * job.stride;
            for (std::size_t x = 0; x < job.resolution; x += V::size) {
                const float* from = job.surface + x / lane_block * surface_block + z * surface_row_floats +
                                    c * lane_block + x % lane_block;
                const V value = V::load_aligned(from) * factors[c];
                value.store_aligned(row + x);
                least[c] = xsimd::min(least[c], value);
                most[c] = xsimd::max(most[c], value);
            }
            row[-1] = row[job.resolution - 1];
            row[job.resolution] = row[0];
        }
    }

    const auto largest_size = [&](int c) {
        const float down = 0.f - least_lane<Arch>(least[c]);
        const float up = most_lane<Arch>(most[c]);
        return down > up ? down : up;
    };
    *job.bounds = {least_lane<Arch>(least[surface_height]), most_lane<Arch>(most[surface_height]),
                   largest_size(surface_dx), largest_size(surface_dz)};
}

}  // namespace pelagic::kernels
