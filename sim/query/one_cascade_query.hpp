// Queries of a frame of one cascade.
#pragma once

#include "pelagic/sim/query/point_chunk.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

class OneCascadeQuery {
   public:
    OneCascadeQuery(const Cascade& cascade, const Kernels& kernels, const SurfaceQueryOptions& options);

    /// Each point of a chunk becomes a cell of the patch and a place in it.
    void place(PointChunk& chunk) const;
    void find_reference_points(PointChunk& chunk) const;
    /// Reads the frame at the reference points.
    void read(const SampleSurfaceJob::Outputs& outputs, PointChunk& chunk) const;
    /// \param foam  of the chunk's points \pre the cascade has foam
    void read_foam(const PointChunk& chunk, std::span<float> foam) const;

   private:
    struct Intersection;

    Intersection highest_intersection(int cell_x, double u, int cell_z, double v) const;
    Intersection highest_cubic_intersection(int cell_x, double u, int cell_z, double v) const;

    const Kernels& kernels_;
    const Cascade& cascade_;
    Interpolation interpolation_;
    double texel_m_;
    float target_;  ///< where the search stops, in texels
};

}  // namespace pelagic
