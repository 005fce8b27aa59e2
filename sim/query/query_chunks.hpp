// Points of a query in chunks.
#pragma once

#include <algorithm>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/query/one_cascade_query.hpp"
#include "pelagic/sim/query/stack_query.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

/// \param use  use(query, chunk, whether all positions have samples)
template <class Use>
void SurfaceQuery::for_each_chunk(const SurfacePoints& points, Use use) const {
    const std::size_t count = points.x.size();
    PointChunk chunk;
    const auto each_with = [&](const auto& query) {
        for (std::size_t first = 0; first < count; first += PointChunk::capacity) {
            chunk.first = first;
            chunk.count = std::min(PointChunk::capacity, count - first);
            chunk.padded = (chunk.count + kernels_->lanes - 1) / kernels_->lanes * kernels_->lanes;
            const bool all_have_samples = load_positions(points, chunk);
            query.locate_points(chunk);
            query.find_reference_points(chunk);
            use(query, chunk, all_have_samples);
        }
    };
    if (frame_.cascades.front().contraction.empty())
        each_with(OneCascadeQuery(frame_, *kernels_, options_));
    else
        each_with(StackQuery(frame_, *kernels_, options_));
}

}  // namespace pelagic
