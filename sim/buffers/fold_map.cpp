#include "pelagic/sim/buffers/fold_map.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

int int_floor_of(double x) {
    const int cut = static_cast<int>(x);
    return cut > x ? cut - 1 : cut;
}

}  // namespace

FoldMap::FoldMap(int resolution, const Allocator& memory)
    : resolution_(resolution),
      cells_(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution) / 8, memory),
      squares_(cells_.size(), memory) {}

void FoldMap::find(const Cascade& cascade, const Kernels& kernels, std::size_t job) {
    assert(cascade.resolution() == resolution_);
    assert(static_cast<std::size_t>(cascade.height.block_columns) >= kernels.lanes);
    const double texel_m = cascade.grid.side_m / resolution_;
    kernels.find_folds({.surface = texels_of(cascade),
                        .texel_m = static_cast<float>(texel_m),
                        .max_area = static_cast<float>(max_jacobian * texel_m * texel_m),
                        .first_row = job * rows_per_job,
                        .rows = rows_per_job,
                        .cells = cells_.data()});
}

void FoldMap::mark(const Cascade& cascade) {
    const SurfaceTexels surface = texels_of(cascade);
    const double texels_per_m = resolution_ / cascade.grid.side_m;
    std::fill_n(squares_.data(), squares_.size(), std::uint8_t{0});
    for (std::size_t byte = 0; byte < cells_.size(); ++byte) {
        // Cells are almost all unmarked. N^2 / 8 is a multiple of 8.
        std::uint64_t eight;
        while (byte % sizeof eight == 0 && byte < cells_.size()) {
            std::memcpy(&eight, &cells_[byte], sizeof eight);
            if (eight != 0) break;
            byte += sizeof eight;
        }
        if (byte == cells_.size()) break;
        for (unsigned remaining = cells_[byte]; remaining != 0; remaining &= remaining - 1) {
            const int cell = static_cast<int>(byte) * 8 + std::countr_zero(remaining);
            const int i = cell % resolution_, j = cell / resolution_;
            double min_x = 1e300, max_x = -1e300, min_z = 1e300, max_z = -1e300;
            for (const auto& [x, z] : {std::pair{i, j}, {i + 1, j}, {i, j + 1}, {i + 1, j + 1}}) {
                const std::ptrdiff_t offset = texel_offset(surface, x, z);
                const double drawn_x = x + surface.dx[offset] * texels_per_m;
                const double drawn_z = z + surface.dz[offset] * texels_per_m;
                min_x = std::min(min_x, drawn_x), max_x = std::max(max_x, drawn_x);
                min_z = std::min(min_z, drawn_z), max_z = std::max(max_z, drawn_z);
            }
            mark_squares(int_floor_of(min_x - margin), int_floor_of(max_x + margin), int_floor_of(min_z - margin),
                         int_floor_of(max_z + margin));
        }
    }
}

void FoldMap::mark_squares(int first_x, int last_x, int first_z, int last_z) {
    // A cell that is displaced over more than the whole cascade marks each square once.
    last_x = std::min(last_x, first_x + resolution_ - 1);
    last_z = std::min(last_z, first_z + resolution_ - 1);
    for (int z = first_z; z <= last_z; ++z) {
        for (int x = first_x; x <= last_x; ++x) {
            const int square = (z & (resolution_ - 1)) * resolution_ + (x & (resolution_ - 1));
            std::uint8_t& byte = squares_[static_cast<std::size_t>(square) / 8];
            byte = static_cast<std::uint8_t>(byte | 1u << square % 8);
        }
    }
}

void FoldMap::update(Cascade& cascade, const Kernels& kernels) {
    const DefaultFloatEnvironment environment;
    for (std::size_t job = 0; job < jobs(); ++job) find(cascade, kernels, job);
    mark(cascade);
    cascade.folds = squares();
}

}  // namespace pelagic
