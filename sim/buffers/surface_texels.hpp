// Converts a cascade's planes to the input of the query kernels.
#pragma once

#include <bit>
#include <cassert>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// Returns the planes of a cascade. \pre All planes have equal layouts, with a power of two of
/// columns per block (asserted).
inline SurfaceTexels texels_of(const Cascade& cascade) {
    const PlaneView& plane = cascade.height;
    [[maybe_unused]] const auto is_alike = [&](const PlaneView& other) {
        return other.resolution == plane.resolution && other.block_columns == plane.block_columns &&
               other.row_stride == plane.row_stride && other.block_stride == plane.block_stride;
    };
    assert(is_alike(cascade.dx) && is_alike(cascade.dz));
    assert(std::has_single_bit(static_cast<unsigned>(plane.block_columns)));
    assert(!cascade.velocity_y.data ||
           (is_alike(cascade.velocity_x) && is_alike(cascade.velocity_y) && is_alike(cascade.velocity_z)));
    return {.dx = cascade.dx.data,
            .height = plane.data,
            .dz = cascade.dz.data,
            .velocity_x = cascade.velocity_x.data,
            .velocity_y = cascade.velocity_y.data,
            .velocity_z = cascade.velocity_z.data,
            .resolution = plane.resolution,
            .block_columns = plane.block_columns,
            .block_shift = std::countr_zero(static_cast<unsigned>(plane.block_columns)),
            .row_stride = static_cast<std::int32_t>(plane.row_stride),
            .block_stride = static_cast<std::int32_t>(plane.block_stride)};
}

/// Returns the offset of texel (i, j) in each plane. i and j may be outside the cascade.
inline std::ptrdiff_t texel_offset(const SurfaceTexels& surface, int i, int j) {
    const int column = i & (surface.resolution - 1), row = j & (surface.resolution - 1);
    return static_cast<std::ptrdiff_t>(column >> surface.block_shift) * surface.block_stride +
           (column & (surface.block_columns - 1)) + static_cast<std::ptrdiff_t>(row) * surface.row_stride;
}

}  // namespace pelagic
