// Asks a frame about any points of the world: how high is the water there, which way does it face, how does it move?
//
//   Ocean ocean(sea, {.queries = true});
//   const SurfaceQuery water(ocean.complete());
//   water.sample({.x = xs, .z = zs}, {.height_m = heights});
//
// The surface is what a GPU draws: between texels each displacement is bilinear, and the reference point q is drawn at
// q + D(q), D being the sum of the cascades' displacements. A query looks for the reference point that is drawn at the given (x, z) and reads the frame there. Where intersections
// lie over one another (breaking crests at high choppiness) the highest one counts.
//
// Linear interpolation attenuates short waves. A wave with k radians a texel along one axis keeps (2 + cos k) / 3 of its variance,
// and its slopes (sin(k) / k)^2 of that: with four cascades of 128^2 texels heights lose 7 % of Hm0 and normals 33 % of the slope
// variance (default sea). Interpolation::cubic is for measurements: 1.5 % and 3 %.
//
// Dynamic waves (dynamic_waves.hpp) adds its height, its slopes and how it rises at the given place, and so does a shore (shore.hpp).
// There each cascade counts with its part at the given place: q + sum of part D(q) = p.
//
// The bits depend on the frame, the point and the tolerance alone: not on other points of the batch, nor their order,
// nor the thread, nor the instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

struct Kernels;
struct PointChunk;

/// How the frame is read between texels.
enum class Interpolation {
    linear,  ///< the surface that a GPU draws, for what floats on it
    /// Displacements, heights and velocities by products of Catmull and Rom's cubics through the texels (4 x 4 of them), normals
    /// and Jacobians by their derivatives. Heights may leave Frame::bounds by a little. Foam stays linear: a cubic would leave
    /// 0 to 1. Dynamic waves and shores keep their own interpolation.
    cubic
};

/// "linear" or "cubic".
std::string_view name_of(Interpolation);
std::optional<Interpolation> interpolation_named(std::string_view name);
std::span<const Interpolation> interpolations();

struct SurfaceQueryOptions {
    /// Largest error of a converged point, positive, metres. The search aims at a 64th of it, because on a steep face a step
    /// horizontal is a larger one in height, and at no less than float can tell.
    double tolerance_m = 1e-3;
    Interpolation interpolation = Interpolation::linear;
};

/// World positions in metres, as far from the origin as you like: the sea repeats in double precision. A position that
/// is no number, or so far away that doubles can't tell the finest texels apart (2^50 of them), has no sample: its error is
/// infinite, it is not converged and the rest is that of the origin.
struct SurfacePoints {
    std::span<const double> x, z;  ///< equally long
};

/// What to tell. Each span is as long as the points, or empty if nobody wants it. None aliases another or the points.
struct SurfaceSamples {
    std::span<float> height_m = {};
    /// Unit normal of the displaced surface, (hz Dz,x - hx (1 + Dz,z), J, hx Dx,z - hz (1 + Dx,x)), added up over the cascades.
    /// Linear: slopes by central differences at texels, bilinear between them, smooth, as textures show it.
    std::span<float> normal_x = {}, normal_y = {}, normal_z = {};
    /// The same slopes' (1 + Dx,x)(1 + Dz,z) - Dx,z Dz,x: 1 at rest, small at sharp crests, negative (and the normal
    /// points down) where the surface is overturned. Not clamped.
    std::span<float> jacobian = {};
    /// How the water that is there now moves: the displacement's derivative in time at the fixed reference point.
    std::span<float> velocity_x_mps = {}, velocity_y_mps = {}, velocity_z_mps = {};
    /// How far horizontal from the given point the sampled one is drawn.
    std::span<float> error_m = {};
    std::span<std::uint8_t> converged = {};  ///< 1 if the error is within the tolerance
    /// How much of the water there is white, 0 to 1: the largest of the cascades' foam at the reference point, bilinear between texels.
    std::span<float> foam = {};
};

/// A view of a frame, cheap to make and to copy; valid as long as the frame's own views, so while the next frame is
/// computed. All methods may be called from any number of threads at once. Nothing is allocated, nothing waits.
class SurfaceQuery {
   public:
    static constexpr double default_tolerance_m = SurfaceQueryOptions{}.tolerance_m;

    /// Throws std::invalid_argument if the frame was made without OceanOptions::queries.
    explicit SurfaceQuery(const Frame& frame, const SurfaceQueryOptions& options = {});
    SurfaceQuery(const Frame& frame, double tolerance_m) : SurfaceQuery(frame, {.tolerance_m = tolerance_m}) {}

    /// Throws std::invalid_argument, before it writes, if a velocity is wanted of a frame made without
    /// OceanOptions::velocities, or foam of one without OceanOptions::foam, dynamic_waves and shore. \pre spans are as long as the points or empty (asserted)
    void sample(const SurfacePoints& points, const SurfaceSamples& samples) const;

    /// The same query with another interpolation.
    SurfaceQuery with(Interpolation interpolation) const;

    const Frame& frame() const { return frame_; }
    const FrameBounds& bounds() const { return frame_.bounds; }
    double texel_m() const { return texel_m_; }  ///< of the finest cascade
    double tolerance_m() const { return tolerance_m_; }
    Interpolation interpolation() const { return options_.interpolation; }
    bool has_velocities() const { return frame_.cascades.front().velocity_y.data != nullptr; }
    bool has_foam() const { return cascades_have_foam() || frame_.dynamic_waves || frame_.shore; }
    /// Throws as sample() does.
    void check(const SurfaceSamples& wanted) const;

   private:
    bool cascades_have_foam() const { return !frame_.cascades.front().foam_r8.empty(); }
    bool has_sample(double x, double z) const;
    void take(const SurfacePoints& points, PointChunk& chunk) const;
    void hand_out(const SurfacePoints& points, const SurfaceSamples& samples, const PointChunk& chunk) const;
    void add_water_of_place(const SurfaceSamples& samples, const PointChunk& chunk) const;

    const Kernels* kernels_;
    Frame frame_;
    double texel_m_;
    SurfaceQueryOptions options_;
    float tolerance_m_;
};

}  // namespace pelagic
