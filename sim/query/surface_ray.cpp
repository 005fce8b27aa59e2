#include "pelagic/sim/surface_ray.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "pelagic/sim/query/height_change.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// Places on the ray that are asked about together: the query's own pace.
constexpr std::size_t places = 64;

// The same far away from the water, where not all answers may be of use.
constexpr std::size_t far_places = 32;

/// A stretch of the ray by distance from the origin, metres.
struct Stretch {
    double begin, end;
};

class RayWalk {
   public:
    RayWalk(const SurfaceQuery& query, const SurfaceRay& ray) : query_(query), origin_(ray.origin_m) {
        const auto& d = ray.direction;
        const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        assert(length > 0 && std::isfinite(length) && ray.reach_m >= 0 && std::isfinite(ray.reach_m));
        direction_ = {d[0] / length, d[1] / length, d[2] / length};
    }

    std::array<double, 3> at(double distance) const {
        return {origin_[0] + distance * direction_[0], origin_[1] + distance * direction_[1],
                origin_[2] + distance * direction_[2]};
    }
    double upwards() const { return std::fabs(direction_[1]); }
    double along_ground() const { return std::sqrt(direction_[0] * direction_[0] + direction_[2] * direction_[2]); }

    /// How high the ray runs above the water at begin + i step.
    void clearances(double begin, double step, std::size_t count, double* clearance) const {
        double x[places], z[places];
        float height[places];
        for (std::size_t i = 0; i < count; ++i) {
            const std::array<double, 3> place = at(begin + static_cast<double>(i) * step);
            x[i] = place[0];
            clearance[i] = place[1];
            z[i] = place[2];
        }
        query_.sample({.x = {x, count}, .z = {z, count}}, {.height_m = {height, count}});
        for (std::size_t i = 0; i < count; ++i) clearance[i] -= static_cast<double>(height[i]);
    }

    /// The part of the ray that is between the lowest and the highest water, with a little more.
    Stretch near_water(double reach) const {
        const double margin = 1e-3 + 1e-6 * (std::fabs(origin_[1]) + reach);
        const double top = query_.bounds().height_max_m + margin, bottom = query_.bounds().height_min_m - margin;
        if (direction_[1] == 0) return origin_[1] >= bottom && origin_[1] <= top ? Stretch{0, reach} : Stretch{1, 0};
        const double to_top = (top - origin_[1]) / direction_[1], to_bottom = (bottom - origin_[1]) / direction_[1];
        return {std::max(0.0, std::min(to_top, to_bottom)), std::min(reach, std::max(to_top, to_bottom))};
    }

   private:
    const SurfaceQuery& query_;
    std::array<double, 3> origin_, direction_;
};

/// Cuts a stretch at whose ends the ray is on different sides until it is shorter than `tolerance`; each time into as
/// many parts as go through the query at once, of which the first with different sides goes on.
double crossing_in(const RayWalk& walk, Stretch stretch, bool below, double tolerance) {
    double clearance[places];
    for (;;) {
        const double step = (stretch.end - stretch.begin) / static_cast<double>(places - 1);
        walk.clearances(stretch.begin, step, places, clearance);
        std::size_t i = 1;
        while (i + 1 < places && (clearance[i] < 0) == below) ++i;
        const double begin = stretch.begin + static_cast<double>(i - 1) * step;
        if (step <= tolerance) {
            // Linear inside the last part; at a wall that is anywhere in it.
            const double change = clearance[i] - clearance[i - 1];
            const double part = change == 0 ? 0 : -clearance[i - 1] / change;
            return begin + std::clamp(part, 0.0, 1.0) * step;
        }
        stretch = {begin, begin + step};
    }
}

/// How many steps of a ray can't meet the water, from its clearance. Of a frame of one tile each step is looked at.
class FreeSteps {
   public:
    FreeSteps(const SurfaceQuery& query, const RayWalk& walk, double step_m)
        : ground_(walk.along_ground()), rise_(walk.upwards()), step_m_(step_m), unsure_m_(2 * query.tolerance_m()) {
        if (query.frame().tiles.size() > 1) change_.emplace(query.frame().tiles);
    }

    double from(double clearance_m, double most) const {
        if (!change_) return 0;
        return std::floor(change_->free_distance(sure(clearance_m), ground_, rise_, most * step_m_) / step_m_);
    }
    bool are_free(double steps, double clearance_m) const {
        return steps == 1 || change_->is_free(sure(clearance_m), ground_, rise_, steps * step_m_);
    }

   private:
    double sure(double clearance_m) const { return std::fabs(clearance_m) - unsure_m_; }

    double ground_, rise_, step_m_;
    double unsure_m_;  ///< a clearance may be off by this
    std::optional<HeightChange> change_;
};

}  // namespace

std::optional<SurfaceHit> first_hit(const SurfaceQuery& query, const SurfaceRay& ray) {
    const DefaultFloatEnvironment environment;
    const RayWalk walk(query, ray);
    const Stretch near = walk.near_water(ray.reach_m);
    if (near.begin > near.end) return {};

    const double length = near.end - near.begin, ground = length * walk.along_ground();
    const double steps = std::max(1.0, std::ceil(ground / (0.5 * query.texel_m())));
    const double step = length / steps;
    const double tolerance = std::max(query.tolerance_m(), 1e-9 * near.end);

    const auto hit_in = [&](Stretch stretch, bool below) {
        SurfaceHit hit{.distance_m = crossing_in(walk, stretch, below, tolerance),
                       .position_m = {},
                       .normal = {},
                       .from_below = below};
        hit.position_m = walk.at(hit.distance_m);
        query.sample(
            {.x = {&hit.position_m[0], 1}, .z = {&hit.position_m[2], 1}},
            {.normal_x = {&hit.normal[0], 1}, .normal_y = {&hit.normal[1], 1}, .normal_z = {&hit.normal[2], 1}});
        return hit;
    };

    const FreeSteps free_steps(query, walk, step);
    double clearance[places];
    walk.clearances(near.begin, 0, 1, clearance);
    const bool below = clearance[0] < 0;
    double here = clearance[0];
    for (double done = 0; done < steps;) {
        // Half of what is free from here, as often as it is free from there too, and single steps near the water.
        const double stride = std::max(1.0, std::floor(free_steps.from(here, steps - done) / 2));
        const std::size_t together = stride > 1 ? far_places : places;
        const auto count =
            static_cast<std::size_t>(std::min(static_cast<double>(together), std::floor((steps - done) / stride)));
        walk.clearances(near.begin + (done + stride) * step, stride * step, count, clearance);
        for (std::size_t i = 0; i < count; ++i) {
            if (!free_steps.are_free(stride, here)) break;
            const double end = near.begin + (done + stride) * step;
            if ((clearance[i] < 0) != below) return hit_in({end - stride * step, end}, below);
            here = clearance[i];
            done += stride;
        }
    }
    return {};
}

}  // namespace pelagic
