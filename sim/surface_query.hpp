// Surface queries: height, normal, velocity and foam of a frame at any position in the world.
//
//   Ocean ocean(sea, {.queries = true});
//   const SurfaceQuery water(ocean.complete());
//   water.sample({.x = xs, .z = zs}, {.height_m = heights});
//
// The surface is the one that a GPU draws. Between texels each displacement is bilinear, and the
// reference point q is drawn at q + D(q), where D is the sum of the cascades' displacements. A
// query finds the reference point that is drawn at the given (x, z) and samples the frame there.
// Where the surface intersects itself (breaking crests at high choppiness) the query returns the
// highest point.
//
// Linear interpolation attenuates short waves. A wave with k radians a texel along one axis keeps
// (2 + cos k) / 3 of its variance, and its slopes (sin(k) / k)^2 of that. With four cascades of
// 128^2 texels heights lose 7 % of Hm0 and normals 33 % of the slope variance (default sea).
// Interpolation::cubic is for measurements: 1.5 % and 3 %.
//
// Dynamic waves (dynamic_waves.hpp) and a shore (shore.hpp) add their height, slopes and vertical
// velocity at the given position. A shore also multiplies each cascade by its weight at the given
// position p: q + sum of weight D(q) = p.
//
// Positions, heights and velocities are in the world: Frame::water_frame has a sea level and a
// current, which moves the surface.
//
// Results depend only on the frame, the point, the tolerance and the interpolation. They do not
// depend on other points of the batch, their order, the thread or the instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

struct Kernels;
struct LevelSums;
struct PointChunk;

/// Interpolation of a frame between texels.
enum class Interpolation {
    linear,  ///< the surface that a GPU draws, for floating objects
    /// Displacements, heights and velocities by products of Catmull-Rom cubics through 4 x 4
    /// texels, normals and Jacobians by their derivatives. Heights may leave Frame::bounds
    /// slightly. Foam stays linear, because a cubic would leave 0 to 1. Dynamic waves and shores
    /// keep their own interpolation.
    cubic
};
template <>
struct EnumNames<Interpolation> {
    static constexpr std::array<std::string_view, 2> all = {"linear", "cubic"};
};

struct SurfaceQueryOptions {
    /// Largest error of a converged point, positive, metres. The search aims at 1/64 of it, because
    /// on a steep face a small horizontal step changes the height by more. It never aims below the
    /// resolution of float.
    double tolerance_m = 1e-3;
    Interpolation interpolation = Interpolation::linear;
};

/// Positions in the world, in metres, at any distance from the origin: the sea repeats in double
/// precision. A position has no sample if it is not finite, or so far away that doubles cannot
/// distinguish the finest texels (beyond 2^50 of them). Its error is then infinite, it is not
/// converged, and its other results are the quiet NaN 0x7fc00000.
struct SurfacePoints {
    std::span<const double> x, z;  ///< equally long
    /// Leaves out waves shorter than about this length, as WaterPoints::footprint_m; at least 0. Above 0 it needs
    /// OceanOptions::depth, except for a pond. Velocities are then the water's own, and the Jacobian is 1: slopes are
    /// those of the remaining heights, at the reference point of the drawn surface.
    double footprint_m = 0;
};

/// \throws std::invalid_argument  if a footprint is below 0 or not finite
void require_footprint(double footprint_m);

/// Arrays that receive the results. Each span is as long as the points, or empty to leave that
/// result out. No span may overlap another or the points.
struct SurfaceSamples {
    std::span<float> height_m = {};
    /// Unit normal of the displaced surface,
    /// (hz Dz,x - hx (1 + Dz,z), J, hx Dx,z - hz (1 + Dx,x)), with each derivative summed over the
    /// cascades. Linear interpolation: slopes are central differences at texels, bilinear between
    /// them, and so as smooth as in the textures.
    std::span<float> normal_x = {}, normal_y = {}, normal_z = {};
    /// The Jacobian J = (1 + Dx,x)(1 + Dz,z) - Dx,z Dz,x of these slopes: 1 at rest, small at sharp
    /// crests, negative (and the normal points down) where the surface is overturned. Not clamped.
    std::span<float> jacobian = {};
    /// Velocity of the water at the position, as of OceanOptions::velocities: `drawn` is the
    /// displacement's derivative in time at the fixed reference point.
    std::span<float> velocity_x_mps = {}, velocity_y_mps = {}, velocity_z_mps = {};
    /// Horizontal distance from the given point to the sample's drawn position, metres.
    std::span<float> error_m = {};
    std::span<std::uint8_t> converged = {};  ///< 1 if the error is within the tolerance
    /// Fraction covered by foam, 0 to 1: that of the sum of the cascades at the reference point,
    /// bilinear between texels.
    std::span<float> foam = {};
};

/// A query of a frame, cheap to make and to copy. It is valid as long as the frame's views, so
/// while the next frame is computed. Thread-safe: any number of threads may call all methods at
/// once. The methods allocate nothing and never wait.
class SurfaceQuery {
   public:
    static constexpr double default_tolerance_m = SurfaceQueryOptions{}.tolerance_m;

    /// \throws std::invalid_argument  if the frame was made without OceanOptions::queries, or the
    ///                                tolerance is not above 0
    explicit SurfaceQuery(const Frame& frame, const SurfaceQueryOptions& options = {});
    /// As above, with linear interpolation.
    SurfaceQuery(const Frame& frame, double tolerance_m) : SurfaceQuery(frame, {.tolerance_m = tolerance_m}) {}

    /// Samples the surface at the points.
    /// \throws std::invalid_argument  before it writes, for spans of another length than the points,
    ///                                velocities of a frame made without OceanOptions::velocities,
    ///                                foam of one without foam, dynamic_waves and shore, or a
    ///                                footprint of one without depth
    void sample(const SurfacePoints& points, const SurfaceSamples& samples) const;

    /// Returns a query of this frame and tolerance with another interpolation.
    SurfaceQuery with(Interpolation interpolation) const;

    /// Returns the queried frame.
    const Frame& frame() const { return frame_; }
    /// Returns the bounds of the frame, with heights in the world.
    const FrameBounds& bounds() const { return bounds_; }
    double texel_m() const { return texel_m_; }  ///< of the finest cascade
    /// Returns the largest error of a converged point, metres.
    double tolerance_m() const { return tolerance_m_; }
    /// Returns how values between texels are interpolated.
    Interpolation interpolation() const { return options_.interpolation; }
    /// Returns whether velocities can be sampled.
    bool has_velocities() const {
        return frame_.cascades.front().velocity_y.data != nullptr || frame_.cascades.front().water.has_surface();
    }
    /// Returns whether foam can be sampled.
    bool has_foam() const { return cascades_have_foam() || frame_.dynamic_waves || frame_.shore; }
    /// Checks arrays, but not their lengths. \throws std::invalid_argument  what sample() throws
    void check(const SurfaceSamples& wanted) const;
    /// Checks points and arrays. \throws std::invalid_argument  what sample() throws
    void check(const SurfacePoints& points, const SurfaceSamples& wanted) const;

   private:
    friend class WaterQuery;
    /// Calls use(query, chunk) for the points in chunks, whose reference points were found.
    template <class Use>
    void for_each_chunk(const SurfacePoints& points, Use use) const;
    template <class Query>
    void read_water_velocities(const Query& query, PointChunk& chunk) const;
    /// Replaces what was read by the surface without waves shorter than the footprint.
    template <class Query>
    void read_without(std::span<const LevelSums> sums, const Query& query, PointChunk& chunk) const;
    bool cascades_have_foam() const { return frame_.has_foam; }
    /// Takes a position in the water.
    bool has_sample(double x, double z) const;
    /// Returns whether all positions have samples.
    bool load_positions(const SurfacePoints& points, PointChunk& chunk) const;
    void write_samples(const SurfaceSamples& samples, const PointChunk& chunk) const;
    void add_dynamic_waves_and_shore(const SurfaceSamples& samples, const PointChunk& chunk) const;
    void move_to_world(const SurfaceSamples& samples, const PointChunk& chunk) const;
    void remove_missing(const SurfacePoints& points, const SurfaceSamples& samples, const PointChunk& chunk) const;

    const Kernels* kernels_;
    Frame frame_;
    WaterFrame::Origin origin_;  ///< of the water, in the world
    FrameBounds bounds_;
    double texel_m_;
    SurfaceQueryOptions options_;
    float tolerance_m_;
};

}  // namespace pelagic
