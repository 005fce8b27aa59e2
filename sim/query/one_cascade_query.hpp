// Surface queries of a frame with one cascade.
#pragma once

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/query/point_chunk.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

class OneCascadeQuery {
   public:
    OneCascadeQuery(const Frame& frame, const Kernels& kernels, const SurfaceQueryOptions& options);

    /// Converts each position of a chunk to a cell and a position in the cell.
    void place(PointChunk& chunk) const;
    /// Finds the reference point of each position. \pre place(chunk)
    void find_reference_points(PointChunk& chunk) const;
    /// Samples the frame at the reference points. \pre find_reference_points(chunk)
    void read(const SampleSurfaceJob::Outputs& outputs, PointChunk& chunk) const;
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
