#include "pelagic/sim/query/water_sampler.hpp"

#include <algorithm>
#include <bit>

#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/sim/query/cascade_cell.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/four_floats.hpp"

namespace pelagic {
namespace {

/// Largest footprint over the depth of the water: of longer waves pressure and velocity hardly decrease with depth.
constexpr double max_footprint_depths = 2;

/// Returns what a footprint leaves of a wave: 0.94 of one of twice the footprint, 0.06 of one of half of it.
double remaining_of(double k, double footprint_m) {
    const double part = k * footprint_m / two_pi, square = part * part;
    return 1 / (1 + square * square);
}

/// The cubic B-spline's weights of four texels at t in [0, 1] from the second to the third of them.
FourFloats spline_weights(float t) {
    constexpr FourFloats constant{1.f / 6, 4.f / 6, 1.f / 6, 0}, linear{-0.5f, 0, 0.5f, 0},
        square{0.5f, -1, 0.5f, 0}, cube{-1.f / 6, 0.5f, -0.5f, 1.f / 6};
    const FourFloats at = four_times(t);
    return ((cube * at + square) * at + linear) * at + constant;
}

/// Their derivatives in t.
FourFloats spline_slopes(float t) {
    constexpr FourFloats constant{-0.5f, 0, 0.5f, 0}, linear{1, -2, 1, 0}, square{-0.5f, 1.5f, -1.5f, 0.5f};
    const FourFloats at = four_times(t);
    return (square * at + linear) * at + constant;
}

/// The 4 x 4 texels of a cubic B-spline around a position.
class SplineTaps {
   public:
    SplineTaps(const Cascade& cascade, const WaterGrid& grid, const ReferenceCell& at) : texels_(grid.texels) {
        // texels of a grid are 2, 4, ... texels of the cascade
        const int shift = std::countr_zero(static_cast<unsigned>(cascade.resolution())) -
                          std::countr_zero(static_cast<unsigned>(grid.resolution));
        const std::int32_t inside = (std::int32_t{1} << shift) - 1;
        scale = 1 / static_cast<float>(inside + 1);
        mask_ = static_cast<unsigned>(grid.resolution) - 1;
        first_column_ = (static_cast<unsigned>(at.column >> shift) - 1) & mask_;
        first_row_ = static_cast<unsigned>(at.row >> shift) - 1;
        row_floats_ = 4 * static_cast<std::size_t>(grid.resolution + WaterLevels::repeated);
        u_ = scale * (static_cast<float>(at.column & inside) + at.u);
        v_ = scale * (static_cast<float>(at.row & inside) + at.v);
    }

    FourFloats values() const { return sum(spline_weights(u_), spline_weights(v_)); }
    /// Of the values along the axes, for a texel of the grid.
    FourFloats along() const { return sum(spline_slopes(u_), spline_weights(v_)); }
    FourFloats across() const { return sum(spline_weights(u_), spline_slopes(v_)); }

    float scale;  ///< texels of the grid over those of the cascade

   private:
    FourFloats sum(const FourFloats& columns, const FourFloats& rows) const {
        const FourFloats across[] = {four_times(columns[0]), four_times(columns[1]), four_times(columns[2]),
                                     four_times(columns[3])};
        FourFloats all{};
        for (unsigned r = 0; r < 4; ++r) {
            const float* const row = texels_ + ((first_row_ + r) & mask_) * row_floats_ + 4 * first_column_;
            FourFloats of_row = across[0] * four_aligned_floats_at(row);
            for (std::size_t c = 1; c < 4; ++c) of_row += across[c] * four_aligned_floats_at(row + 4 * c);
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
    /// \param side_m      of the cascade, to fade beyond the last level
    /// \param has_slopes  whether the derivatives of the weights are wanted
    PELAGIC_INLINE LevelsAround(const DepthLadder& ladder, double depth_m, double side_m, bool has_slopes) {
        std::size_t above = 0;
        while (above + 2 < ladder.count && depth_m >= ladder.depths_m[above + 1]) ++above;
        const double top_m = ladder.depths_m[above], bottom_m = ladder.depths_m[above + 1];
        first = DepthLadder::first_of(above);
        if (depth_m >= bottom_m) {
            // Beyond the last level, which lies at the bottom or below the reach of all waves but the longest.
            const double k = two_pi / side_m, left = det::exp(-k * (depth_m - bottom_m));
            value[above + 1 - first] = static_cast<float>(left);
            slope[above + 1 - first] = static_cast<float>(-k * left);
            return;
        }
        const float steps = static_cast<float>(depth_m - top_m) * ladder.steps_per_m[above];
        const auto step = std::min(static_cast<std::size_t>(steps), DepthLadder::steps - 1);
        const float part = steps - static_cast<float>(step);
        const DepthWeights &from = ladder.weights[above][step], &to = ladder.weights[above][step + 1];
        for (std::size_t i = 0; i < 3; ++i) {
            value[i] = from.value[i] + part * (to.value[i] - from.value[i]);
            if (has_slopes) slope[i] = from.slope[i] + part * (to.slope[i] - from.slope[i]);
        }
    }

    std::size_t first = 0;  ///< the level of the first weight
    std::array<float, 3> value{}, slope{};
};

template <WaterDerivatives wanted>
WaterMotion motion_with(const Cascade& cascade, double depth_m, const ReferenceCell& at, const HeadSample& surface) {
    const WaterLevels& water = cascade.water;
    const LevelsAround velocity(*water.velocity, depth_m, cascade.grid.side_m, false),
        head(*water.head, depth_m, cascade.grid.side_m, wanted != WaterDerivatives::none);
    // Weights of grids: level g of the velocity and level g + 1 of the head are those of grid g.
    const auto weight_of = [](const std::array<float, 3>& weights, std::size_t first, std::size_t level) {
        return level - first < 3 ? weights[level - first] : 0.f;
    };
    WaterMotion motion;
    FourFloats sum{};  // the velocity, and the head
    if (head.first == 0)
        motion.head = {head.value[0] * surface.value, head.value[0] * surface.along, head.value[0] * surface.across,
                       head.slope[0] * surface.value};
    const std::size_t first = std::min(velocity.first, head.first > 0 ? head.first - 1 : 0);
    const std::size_t end = std::min(std::max(velocity.first + 3, head.first + 2), water.count);
    for (std::size_t grid = first; grid < end; ++grid) {
        const float of_velocity = weight_of(velocity.value, velocity.first, grid),
                    of_head = weight_of(head.value, head.first, grid + 1);
        if (of_velocity == 0 && of_head == 0 && wanted == WaterDerivatives::none) continue;
        const SplineTaps taps(cascade, water.grids[grid], at);
        const FourFloats values = taps.values();
        sum += FourFloats{of_velocity, of_velocity, of_velocity, of_head} * values;
        if (wanted == WaterDerivatives::none) continue;
        motion.head.down += weight_of(head.slope, head.first, grid + 1) * values[3];
        if (wanted == WaterDerivatives::down) continue;
        motion.head.along += of_head * (taps.scale * taps.along()[3]);
        motion.head.across += of_head * (taps.scale * taps.across()[3]);
    }
    const double stretched = 1 + 0.5 * water.drift_k * depth_m, square = stretched * stretched;
    const float remaining = static_cast<float>(1 / (square * square));
    motion.velocity_mps = {sum[0] + remaining * static_cast<float>(water.drift_x_mps), sum[1],
                           sum[2] + remaining * static_cast<float>(water.drift_z_mps)};
    motion.head.value += sum[3];
    return motion;
}

}  // namespace

std::array<float, 3> surface_velocity(const Cascade& cascade, const ReferenceCell& at) {
    const FourFloats values = SplineTaps(cascade, cascade.water.grids[0], at).values();
    return {values[0] + static_cast<float>(cascade.water.drift_x_mps), values[1],
            values[2] + static_cast<float>(cascade.water.drift_z_mps)};
}

HeadSample surface_head(const SurfaceTexels& texels, float level_m, const ReferenceCell& at,
                        Interpolation interpolation) {
    if (interpolation == Interpolation::cubic) {
        const CascadeCell::Value height =
            CascadeCell(texels, at.column, at.row, interpolation).at(texels.height, at.u, at.v);
        return {static_cast<float>(height.value - static_cast<double>(level_m)), static_cast<float>(height.along_u),
                static_cast<float>(height.along_v), 0};
    }
    const std::ptrdiff_t above = texel_offset(texels, 0, at.row), below = texel_offset(texels, 0, at.row + 1),
                         left = texel_offset(texels, at.column, 0), right = texel_offset(texels, at.column + 1, 0);
    const float a = texels.height[above + left], b = texels.height[above + right], c = texels.height[below + left],
                d = texels.height[below + right];
    const float low = a + at.u * (b - a), high = c + at.u * (d - c);
    return {low + at.v * (high - low) - level_m, (b - a) + at.v * ((d - c) - (b - a)), high - low, 0};
}

WaterMotion motion_at(const Cascade& cascade, double depth_m, const ReferenceCell& at, const HeadSample& surface,
                      WaterDerivatives wanted) {
    switch (wanted) {
        case WaterDerivatives::none: return motion_with<WaterDerivatives::none>(cascade, depth_m, at, surface);
        case WaterDerivatives::down: return motion_with<WaterDerivatives::down>(cascade, depth_m, at, surface);
        default: return motion_with<WaterDerivatives::all>(cascade, depth_m, at, surface);
    }
}

LevelSums sums_without(const Cascade& cascade, double footprint_m) {
    using Filter = DepthLadder::Filter;
    const WaterLevels& water = cascade.water;
    LevelSums sums;
    // Of such short waves less than 0.004 would remain.
    if (footprint_m > 4 * water.longest_wave_m) return sums;
    sums.is_zero = false;
    const double counts_m = std::min(footprint_m, max_footprint_depths * water.water_m);
    const auto weights_of = [&](const DepthLadder& ladder, const Filter::OfLevels& filter) {
        std::array<double, Filter::waves> remaining;
        for (std::size_t wave = 0; wave < Filter::waves; ++wave)
            remaining[wave] = remaining_of(static_cast<double>(ladder.filter.k[wave]), counts_m);
        LevelSums::Weights weights{};
        for (std::size_t level = 0; level < ladder.count; ++level) {
            double sum = 0;
            for (std::size_t wave = 0; wave < Filter::waves; ++wave)
                sum += static_cast<double>(filter[level][wave]) * remaining[wave];
            weights[level] = static_cast<float>(sum);
        }
        return weights;
    };
    sums.head = weights_of(*water.head, water.head->filter.along);
    sums.along = weights_of(*water.velocity, water.velocity->filter.along);
    sums.up = weights_of(*water.velocity, water.velocity->filter.up);
    return sums;
}

LevelSums sums_below(const Cascade& cascade, const LevelSums& surface, double depth_m) {
    const WaterLevels& water = cascade.water;
    LevelSums sums;
    sums.is_zero = surface.is_zero;
    if (sums.is_zero) return sums;
    const auto add = [&](const DepthLadder& ladder, auto&& use) {
        for (std::size_t level = 0; level < ladder.count; ++level) {
            const LevelsAround around(ladder, std::min(depth_m + ladder.depths_m[level], water.water_m),
                                      cascade.grid.side_m, true);
            for (std::size_t i = 0; i < 3; ++i) use(level, around, i);
        }
    };
    add(*water.head, [&](std::size_t level, const LevelsAround& around, std::size_t i) {
        sums.head[around.first + i] += surface.head[level] * around.value[i];
        sums.head_slope[around.first + i] += surface.head[level] * around.slope[i];
    });
    add(*water.velocity, [&](std::size_t level, const LevelsAround& around, std::size_t i) {
        sums.along[around.first + i] += surface.along[level] * around.value[i];
        sums.up[around.first + i] += surface.up[level] * around.value[i];
    });
    return sums;
}

WaterMotion motion_of(const Cascade& cascade, const LevelSums& sums, const ReferenceCell& at,
                      const HeadSample& surface, bool has_slopes) {
    const WaterLevels& water = cascade.water;
    WaterMotion motion;
    if (sums.is_zero) return motion;
    motion.head = {sums.head[0] * surface.value, sums.head[0] * surface.along, sums.head[0] * surface.across,
                   sums.head_slope[0] * surface.value};
    FourFloats sum{};  // the velocity, and the head
    for (std::size_t grid = 0; grid < water.count; ++grid) {
        const float of_head = sums.head[grid + 1];
        const SplineTaps taps(cascade, water.grids[grid], at);
        const FourFloats values = taps.values();
        sum += FourFloats{sums.along[grid], sums.up[grid], sums.along[grid], of_head} * values;
        motion.head.down += sums.head_slope[grid + 1] * values[3];
        if (!has_slopes) continue;
        motion.head.along += of_head * (taps.scale * taps.along()[3]);
        motion.head.across += of_head * (taps.scale * taps.across()[3]);
    }
    motion.velocity_mps = {sum[0], sum[1], sum[2]};
    motion.head.value += sum[3];
    return motion;
}

}  // namespace pelagic
