// Surface queries of a frame with several cascades. The interface is that of OneCascadeQuery.
#pragma once

#include <array>
#include <span>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/query/point_chunk.hpp"
#include "pelagic/sim/query/stack_search.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

class StackQuery {
   public:
    StackQuery(const Frame& frame, const Kernels& kernels, const SurfaceQueryOptions& options);

    void locate_points(PointChunk& chunk) const;
    void find_reference_points(PointChunk& chunk) const;
    void read(const SampleSurfaceJob::Outputs& outputs, PointChunk& chunk) const;
    ReferenceCell reference_cell(std::size_t cascade, const PointChunk& chunk, std::size_t point) const;
    void read_foam(const PointChunk& chunk, std::span<float> foam) const;

   private:
    bool is_only_one(const PointChunk& chunk, std::size_t point) const;
    void search(PointChunk& chunk, std::size_t point) const;
    StackCascade stack_cascade(std::size_t cascade, PointChunk& chunk) const;

    const Kernels& kernels_;
    Interpolation interpolation_;
    std::span<const Cascade> cascades_;
    const ShoreSurface& shore_;
    FoamSampler foam_;
    std::array<SearchCascade, max_cascades> search_cascades_;
    double finest_texel_m_;
    double reach_m_ = 0;  ///< upper bound of the horizontal displacement
    double target_m_;     ///< error at which the search stops
};

}  // namespace pelagic
