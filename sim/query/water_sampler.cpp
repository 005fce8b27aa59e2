#include "pelagic/sim/query/water_sampler.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/four_floats.hpp"

namespace pelagic {
namespace {

using Four = std::array<float, 4>;

/// The 4 x 4 texels of a cubic B-spline around a position.
class SplineTaps {
   public:
    SplineTaps(const Cascade& cascade, const WaterGrid& grid, const TexelPosition& at) : texels_(grid.texels) {
        scale = static_cast<float>(grid.resolution) / static_cast<float>(cascade.resolution());
        const double column = at.column * static_cast<double>(scale), row = at.row * static_cast<double>(scale);
        const double left = std::floor(column), top = std::floor(row);
        mask_ = static_cast<unsigned>(grid.resolution) - 1;
        first_column_ = (static_cast<unsigned>(static_cast<std::int64_t>(left)) - 1) & mask_;
        first_row_ = static_cast<unsigned>(static_cast<std::int64_t>(top)) - 1;
        row_floats_ = 4 * static_cast<std::size_t>(grid.resolution + WaterLevels::repeated);
        u_ = static_cast<float>(column - left);
        v_ = static_cast<float>(row - top);
    }

    FourFloats values() const { return sum(weights(u_), weights(v_)); }
    /// Of the values along the axes, for a texel of the grid.
    FourFloats along() const { return sum(slopes(u_), weights(v_)); }
    FourFloats across() const { return sum(weights(u_), slopes(v_)); }

    float scale;  ///< texels of the grid over those of the cascade

   private:
    static Four weights(float t) {
        constexpr float sixth = 1.f / 6;
        const float s = 1 - t, t2 = t * t, s2 = s * s;
        return {sixth * (s * s2), 2.f / 3 - t2 + 0.5f * (t * t2), 2.f / 3 - s2 + 0.5f * (s * s2), sixth * (t * t2)};
    }
    static Four slopes(float t) {
        const float s = 1 - t;
        return {-0.5f * (s * s), (1.5f * t - 2) * t, (2 - 1.5f * s) * s, 0.5f * (t * t)};
    }
    FourFloats sum(const Four& columns, const Four& rows) const {
        const FourFloats across[] = {four_times(columns[0]), four_times(columns[1]), four_times(columns[2]),
                                     four_times(columns[3])};
        FourFloats all{};
        for (unsigned r = 0; r < 4; ++r) {
            const float* const row = texels_ + ((first_row_ + r) & mask_) * row_floats_ + 4 * first_column_;
            FourFloats of_row = across[0] * four_floats_at(row);
            for (std::size_t c = 1; c < 4; ++c) of_row += across[c] * four_floats_at(row + 4 * c);
            all += four_times(rows[r]) * of_row;
        }
        return all;
    }

    const float* texels_;
    std::size_t row_floats_;
    unsigned mask_, first_column_, first_row_;
    float u_, v_;
};

/// The levels of a ladder around a depth.
struct LevelsAround {
    /// \param side_m  of the cascade, to fade beyond the last level
    LevelsAround(const DepthLadder& ladder, double depth_m, double side_m) {
        std::size_t above = 0;
        while (above + 2 < ladder.count && depth_m >= ladder.depths_m[above + 1]) ++above;
        const double top_m = ladder.depths_m[above], bottom_m = ladder.depths_m[above + 1];
        first = DepthLadder::first_of(above);
        if (depth_m >= bottom_m) {
            // Beyond the last level, which lies at the bottom or below the reach of all waves but the longest.
            const double k = two_pi / side_m, left = det::exp(-k * (depth_m - bottom_m));
            weights.value[above + 1 - first] = static_cast<float>(left);
            weights.slope[above + 1 - first] = static_cast<float>(-k * left);
            return;
        }
        const float steps = static_cast<float>(depth_m - top_m) * ladder.steps_per_m[above];
        const auto step = std::min(static_cast<std::size_t>(steps), DepthLadder::steps - 1);
        const float part = steps - static_cast<float>(step);
        const DepthWeights &from = ladder.weights[above][step], &to = ladder.weights[above][step + 1];
        for (std::size_t i = 0; i < 3; ++i) {
            weights.value[i] = from.value[i] + part * (to.value[i] - from.value[i]);
            weights.slope[i] = from.slope[i] + part * (to.slope[i] - from.slope[i]);
        }
    }

    std::size_t first = 0;  ///< the level of the first weight
    DepthWeights weights;
};

}  // namespace

std::array<float, 3> surface_velocity(const Cascade& cascade, const TexelPosition& at) {
    const FourFloats values = SplineTaps(cascade, cascade.water.grids[0], at).values();
    return {values[0], values[1], values[2]};
}

WaterMotion motion_at(const Cascade& cascade, double depth_m, const TexelPosition& at, const HeadSample& surface,
                      bool has_derivatives) {
    const WaterLevels& water = cascade.water;
    const LevelsAround velocity(*water.velocity, depth_m, cascade.grid.side_m),
        head(*water.head, depth_m, cascade.grid.side_m);
    // Weights of grids: level g of the velocity and level g + 1 of the head are those of grid g.
    const auto weight_of = [](const LevelsAround& of, std::size_t level, const std::array<float, 3>& weights) {
        return level - of.first < 3 ? weights[level - of.first] : 0.f;
    };
    WaterMotion motion;
    FourFloats sum{};  // the velocity, and the head
    if (head.first == 0)
        motion.head = {head.weights.value[0] * surface.value, head.weights.value[0] * surface.along,
                       head.weights.value[0] * surface.across, head.weights.slope[0] * surface.value};
    const std::size_t first = std::min(velocity.first, head.first > 0 ? head.first - 1 : 0);
    const std::size_t end = std::min(std::max(velocity.first + 3, head.first + 2), water.count);
    for (std::size_t grid = first; grid < end; ++grid) {
        const float of_velocity = weight_of(velocity, grid, velocity.weights.value),
                    of_head = weight_of(head, grid + 1, head.weights.value);
        if (of_velocity == 0 && of_head == 0 && !has_derivatives) continue;
        const SplineTaps taps(cascade, water.grids[grid], at);
        const FourFloats values = taps.values();
        sum += FourFloats{of_velocity, of_velocity, of_velocity, of_head} * values;
        if (!has_derivatives) continue;
        motion.head.along += of_head * (taps.scale * taps.along()[3]);
        motion.head.across += of_head * (taps.scale * taps.across()[3]);
        motion.head.down += weight_of(head, grid + 1, head.weights.slope) * values[3];
    }
    motion.velocity_mps = {sum[0], sum[1], sum[2]};
    motion.head.value += sum[3];
    return motion;
}

}  // namespace pelagic
