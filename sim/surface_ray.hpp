// Intersection of a ray with the surface.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

struct SurfaceRay {
    std::array<double, 3> origin_m;   ///< x, y, z
    std::array<double, 3> direction;  ///< of any length but 0
    double reach_m;                   ///< maximum distance, finite and not negative
};

struct SurfaceHit {
    double distance_m;  ///< from the origin
    std::array<double, 3> position_m;
    std::array<float, 3> normal;  ///< as from SurfaceQuery, whichever side is hit
    bool from_below;              ///< the ray leaves the water
};

/// Returns an empty string for a ray that first_hit() accepts, else a message about the first
/// invalid value: "reach_m is nan, expected 0 to a million texels of the coarsest cascade".
/// Coordinates must be in [-1e9, 1e9], the direction's length in [1e-100, 1e100]. The check also
/// bounds the time of first_hit().
std::string check(const SurfaceRay& ray, const Frame& frame);

/// Finds the first intersection of the ray with the surface, from above or from below. Returns
/// nothing if there is none within reach_m.
///
/// The surface is the linear one, which is drawn, also for a cubic query. Where it intersects
/// itself, its highest point counts, as in SurfaceQuery: the front of an overhanging crest is a
/// vertical wall.
///
/// The search samples the ray between the lowest and the highest water, every half texel of the
/// finest cascade along the ground, and skips distances over which bounds exclude an intersection.
/// So it finds every crest or trough that the ray crosses for half such a texel (along the ground)
/// or longer. It may miss one that the ray only grazes. The distance is accurate to the query's
/// tolerance, or to 1e-9 of the distance where that is larger.
///
/// Thread-safe; allocates nothing; results are bit-identical on every machine.
/// \throws std::invalid_argument  for a number that is not finite, a direction of 0, and a negative
///                                reach
std::optional<SurfaceHit> first_hit(const SurfaceQuery& query, const SurfaceRay& ray);

}  // namespace pelagic
