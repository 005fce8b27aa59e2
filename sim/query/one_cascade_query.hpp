// Surface queries of a frame with one cascade.
//
// StackQuery could serve one cascade, too, but at fewer points per second. Ratios at N = 256, a side
// of 250 m, choppiness 1, wind 12 m/s, one thread of an AMD EPYC:
//
//   StackQuery's kernels compiled for one unrotated cascade, with this class's fold map and search:
//   0.86 (heights) and 0.90 (with normals) with AVX2, 0.82 and 0.85 with SSE4.2. With AVX2 they
//   take only 6 % more instructions. Likely reason: they convert the offset from the position to a
//   cell in each step and for the samples, which lengthens the chain of dependent instructions.
//   The general kernels with contraction maps and StackSearch: 0.75 (heights, AVX2). On folded seas
//   of the paper's scale, a point takes over 1,000 times as long (AVX2, N = 64 and 256). Frames
//   with queries take 3 % more instructions.
#pragma once

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/query/point_chunk.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

class OneCascadeQuery {
   public:
    OneCascadeQuery(const Frame& frame, const Kernels& kernels, const SurfaceQueryOptions& options);

    /// Converts each position of a chunk to a cell and a position in the cell.
    void locate_points(PointChunk& chunk) const;
    /// Finds the reference point of each position. \pre locate_points(chunk)
    void find_reference_points(PointChunk& chunk) const;
    /// Samples the frame at the reference points. \pre find_reference_points(chunk)
    void read(const SampleSurfaceJob::Outputs& outputs, PointChunk& chunk) const;
    /// Returns a reference point. \pre find_reference_points(chunk)
    ReferenceCell reference_cell(std::size_t cascade, const PointChunk& chunk, std::size_t point) const;
    /// Samples the foam at the reference points, to one value for each position of the chunk.
    /// \pre the cascade has foam
    void read_foam(const PointChunk& chunk, std::span<float> foam) const;

   private:
    struct Intersection;

    Intersection highest_intersection(int cell_x, double u, int cell_z, double v) const;
    Intersection highest_cubic_intersection(int cell_x, double u, int cell_z, double v) const;

    const Kernels& kernels_;
    const Cascade& cascade_;
    FoamSampler foam_;
    Interpolation interpolation_;
    double texel_m_;
    float target_;  ///< error at which the search stops, texels
};

}  // namespace pelagic
