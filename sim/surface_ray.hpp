// Where a ray meets the water.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

struct SurfaceRay {
    std::array<double, 3> origin_m;   ///< x, y, z
    std::array<double, 3> direction;  ///< of any length but 0
    double reach_m;                   ///< how far to look, finite and not negative
};

struct SurfaceHit {
    double distance_m;  ///< from the origin
    std::array<double, 3> position_m;
    std::array<float, 3> normal;  ///< of the surface there, as SurfaceQuery gives it, whichever side is hit
    bool from_below;              ///< the ray comes out of the water
};

/// Empty if an application may ask that, which bounds the time that it takes, too; else what is bad first: "reach_m is nan, needs 0 to a million
/// texels of the coarsest cascade". Coordinates are within 1e9, the direction's length within [1e-100, 1e100].
std::string check(const SurfaceRay& ray, const Frame& frame);

/// The first place where the ray passes through the surface, from above or from below; none within its reach.
///
/// The surface is the linear one, which is drawn, also where the query is cubic: its highest intersection, as SurfaceQuery gives it; where a crest hangs over, its front is a wall. The ray is
/// looked at every half texel of the finest cascade along the ground between the lowest and the highest water, but where the
/// waters around are proven to stay away from it; so no crest or trough is missed through which it passes for half such a
/// texel (along the ground) or longer; one that it only grazes may be. The distance is within the query's tolerance, or 1e-9 of itself where that is more.
///
/// Const and thread-safe as the query, without allocations; the same bits everywhere.
/// \pre finite numbers, a direction that is not 0, a reach that is not negative (asserted)
std::optional<SurfaceHit> first_hit(const SurfaceQuery& query, const SurfaceRay& ray);

}  // namespace pelagic
