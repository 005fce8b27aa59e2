#include "pelagic/sim/surface_ray.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/query/height_change.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// Positions on the ray in one query: enough for the query's throughput, with few wasted. The first
// number is for single steps near the water, the second for longer strides.
constexpr std::size_t near_places = 32, far_places = 16;

// Positions on each side of the estimate, in the search for a crossing.
constexpr std::size_t side_places = 8;

/// An interval of the ray, by distance from the origin, metres.
struct Interval {
    double begin, end;
    double length() const { return end - begin; }
};

class RayWalk {
   public:
    RayWalk(const SurfaceQuery& query, const SurfaceRay& ray) : query_(query), origin_(ray.origin_m) {
        const auto& d = ray.direction;
        const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const auto need = [](bool is_usable, const char* name, double value, const char* accepted) {
            if (!is_usable) throw std::invalid_argument(invalid_value_message(name, value, accepted));
        };
        for (const double along : origin_) need(std::isfinite(along), "origin_m", along, "a finite number");
        need(length > 0 && std::isfinite(length), "direction's length", length, "a finite number above 0");
        need(ray.reach_m >= 0 && std::isfinite(ray.reach_m), "reach_m", ray.reach_m,
             "a finite number of 0 or more");
        direction_ = {d[0] / length, d[1] / length, d[2] / length};
    }

    std::array<double, 3> at(double distance) const {
        return {origin_[0] + distance * direction_[0], origin_[1] + distance * direction_[1],
                origin_[2] + distance * direction_[2]};
    }
    double vertical() const { return std::fabs(direction_[1]); }
    double horizontal() const { return std::sqrt(direction_[0] * direction_[0] + direction_[2] * direction_[2]); }

    /// Computes the height of the ray above the water at each distance.
    template <std::size_t max>
    void clearances(const double (&distance)[max], std::size_t count, double (&clearance)[max]) const {
        double x[max], z[max];
        float height[max];
        for (std::size_t i = 0; i < count; ++i) {
            const std::array<double, 3> place = at(distance[i]);
            x[i] = place[0];
            clearance[i] = place[1];
            z[i] = place[2];
        }
        query_.sample({.x = {x, count}, .z = {z, count}}, {.height_m = {height, count}});
        for (std::size_t i = 0; i < count; ++i) clearance[i] -= static_cast<double>(height[i]);
    }

    /// Returns the interval in which the ray is between the lowest and the highest water, with a
    /// margin.
    Interval near_water(double reach) const {
        const double margin = 1e-3 + 1e-6 * (std::fabs(origin_[1]) + reach);
        const double top = query_.bounds().height_max_m + margin, bottom = query_.bounds().height_min_m - margin;
        if (direction_[1] == 0)
            return origin_[1] >= bottom && origin_[1] <= top ? Interval{0, reach} : Interval{1, 0};
        const double to_top = (top - origin_[1]) / direction_[1], to_bottom = (bottom - origin_[1]) / direction_[1];
        return {std::max(0.0, std::min(to_top, to_bottom)), std::min(reach, std::max(to_top, to_bottom))};
    }

   private:
    const SurfaceQuery& query_;
    std::array<double, 3> origin_, direction_;
};

/// An interval at whose ends the ray is on different sides of the water, and its clearance there.
struct Crossing {
    Interval interval;
    double at_begin, at_end;

    /// Returns a linear estimate of the crossing. At a vertical face the crossing may be anywhere.
    double guess() const {
        const double change = at_end - at_begin;
        const double fraction = change == 0 ? 0 : -at_begin / change;
        return interval.begin + std::clamp(fraction, 0.0, 1.0) * interval.length();
    }
};

/// Divides a crossing until it is at most `tolerance` long: into equally many pieces on both sides
/// of the estimate, and a short piece around it, which usually holds the crossing. The first piece
/// whose ends are on different sides is divided next. It is at most an eighth of the interval.
double crossing_in(const RayWalk& walk, Crossing crossing, bool below, double tolerance) {
    constexpr std::size_t count = 2 * side_places;
    double distance[count], clearance[count];
    while (crossing.interval.length() > tolerance) {
        const auto [begin, end] = crossing.interval;
        const double guess = crossing.guess(), close = 0.4 * tolerance;
        const double before = std::max(begin, guess - close), behind = std::min(end, guess + close);
        for (std::size_t i = 0; i < side_places; ++i) {
            const double fraction = static_cast<double>(i) / static_cast<double>(side_places);
            distance[side_places - 1 - i] = before - fraction * (before - begin);
            distance[side_places + i] = behind + fraction * (end - behind);
        }
        walk.clearances(distance, count, clearance);
        std::size_t i = 0;
        while (i < count && (clearance[i] < 0) == below) ++i;
        if (i > 0) crossing.interval.begin = distance[i - 1], crossing.at_begin = clearance[i - 1];
        if (i < count) crossing.interval.end = distance[i], crossing.at_end = clearance[i];
    }
    return crossing.guess();
}

/// Computes from the clearance how many steps of a ray cannot meet the water. With one cascade
/// there is no bound, and each step is sampled.
class FreeSteps {
   public:
    FreeSteps(const SurfaceQuery& query, const RayWalk& walk, double step_m)
        : horizontal_(walk.horizontal()),
          vertical_(walk.vertical()),
          step_m_(step_m),
          error_m_(2 * query.tolerance_m()) {
        const DynamicWavesView& dynamic_waves = query.frame().dynamic_waves;
        const ShoreSurface& shore = query.frame().shore;
        if (!query.frame().cascades.front().contraction.empty())
            change_.emplace(
                query.frame().cascades,
                kernels_for(query.frame().isa),
                static_cast<double>(dynamic_waves.bounds.height_max_m - dynamic_waves.bounds.height_min_m) +
                    static_cast<double>(shore.bounds.height_max_m - shore.bounds.height_min_m),
                static_cast<double>(shore.weights_change_per_m));
    }

    /// Returns the number of positions in the first query, before a clearance is known.
    std::size_t first_places() const { return change_ ? 1 : near_places; }
    /// Returns the number of steps from a position that cannot meet the water.
    double from(double clearance_m, double max) const {
        if (!change_) return 0;
        return std::floor(change_->free_distance(certain(clearance_m), horizontal_, vertical_, max * step_m_) /
                          step_m_);
    }
    /// Returns whether the steps between two positions cannot meet the water: all of them from the
    /// first position, or half of them from each.
    bool are_free(double steps, double first_m, double second_m) const {
        return steps == 1 || is_free(steps, first_m) || (is_free(steps / 2, first_m) && is_free(steps / 2, second_m));
    }

   private:
    bool is_free(double steps, double clearance_m) const {
        return change_->is_free(certain(clearance_m), horizontal_, vertical_, steps * step_m_);
    }
    double certain(double clearance_m) const { return std::fabs(clearance_m) - error_m_; }

    double horizontal_, vertical_, step_m_;
    double error_m_;  ///< error bound of a clearance
    std::optional<HeightChange> change_;
};

}  // namespace

std::string check(const SurfaceRay& ray, const Frame& frame) {
    constexpr double far_m = 1e9, max_texels = 1e6;
    const auto is_within = [](double value, double min, double max) { return value >= min && value <= max; };
    for (const double along : ray.origin_m)
        if (!is_within(along, -far_m, far_m)) return invalid_value_message("origin_m", along, "[-1e9, 1e9]");
    const auto& d = ray.direction;
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!is_within(length, 1e-100, 1e100))
        return invalid_value_message("direction's length", length, "[1e-100, 1e100]");
    if (!is_within(ray.reach_m, 0, max_texels * frame.cascades.front().texel_m()))
        return invalid_value_message("reach_m", ray.reach_m, "0 to a million texels of the coarsest cascade");
    return {};
}

std::optional<SurfaceHit> first_hit(const SurfaceQuery& any_query, const SurfaceRay& ray) {
    const DefaultFloatEnvironment environment;
    const SurfaceQuery query = any_query.with(Interpolation::linear);
    const RayWalk walk(query, ray);
    const Interval near = walk.near_water(ray.reach_m);
    if (near.begin > near.end) return {};

    const double length = near.end - near.begin, ground = length * walk.horizontal();
    const double steps = std::max(1.0, std::ceil(ground / (0.5 * query.texel_m())));
    const double step = length / steps;
    const double tolerance = std::max(query.tolerance_m(), 1e-9 * near.end);

    const auto hit_in = [&](const Crossing& crossing, bool below) {
        SurfaceHit hit{.distance_m = crossing_in(walk, crossing, below, tolerance),
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
    double distance[near_places], clearance[near_places];
    bool below = false;
    double here = 0;
    for (double done = -1; done < steps;) {
        // Strides of the free distance as long as they are proven, and single steps near the water.
        const double stride = done < 0 ? 1 : std::max(1.0, free_steps.from(here, steps - done));
        const std::size_t together = stride > 1 ? far_places : done < 0 ? free_steps.first_places() : near_places;
        const auto count =
            static_cast<std::size_t>(std::min(static_cast<double>(together), std::floor((steps - done) / stride)));
        for (std::size_t i = 0; i < count; ++i)
            distance[i] = near.begin + (done + static_cast<double>(i + 1) * stride) * step;
        walk.clearances(distance, count, clearance);
        if (done < 0) below = clearance[0] < 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (!free_steps.are_free(stride, here, clearance[i])) break;
            if ((clearance[i] < 0) != below)
                return hit_in({{near.begin + done * step, distance[i]}, here, clearance[i]}, below);
            here = clearance[i];
            done += stride;
        }
    }
    return {};
}

}  // namespace pelagic
