#include "pelagic/tools/preview/cascade_levels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace pelagic::tools {
namespace {

using Level = std::vector<glm::vec3>;

/// Approximates log2 linearly between integers, which suffices to blend two levels. Returns 0 below
/// 1.
float level_of(float texels) {
    const auto bits = std::bit_cast<std::uint32_t>(std::max(texels, 1.f));
    const int exponent = static_cast<int>(bits >> 23) - 127;
    const auto mantissa = std::bit_cast<float>((bits & 0x7FFFFF) | 0x3F800000);
    return static_cast<float>(exponent) + mantissa - 1;
}

Level level_0(const Cascade& cascade) {
    const auto n = static_cast<std::size_t>(cascade.resolution());
    Level texels(n * n);
    std::vector<float> dx(n), height(n), dz(n);
    for (std::size_t j = 0; j < n; ++j) {
        cascade.dx.copy_row(static_cast<int>(j), dx.data());
        cascade.height.copy_row(static_cast<int>(j), height.data());
        cascade.dz.copy_row(static_cast<int>(j), dz.data());
        for (std::size_t i = 0; i < n; ++i) texels[j * n + i] = {dx[i], height[i], dz[i]};
    }
    return texels;
}

/// Returns the means of 2 x 2 texels. \param side  side of the result
Level reduced(const Level& fine, std::size_t side) {
    Level coarse(side * side);
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i) {
            const glm::vec3* const upper = &fine[4 * j * side + 2 * i];
            const glm::vec3* const lower = upper + 2 * side;
            coarse[j * side + i] = 0.25f * ((upper[0] + upper[1]) + (lower[0] + lower[1]));
        }
    return coarse;
}

void add(SurfaceSlopes& sum, const SurfaceSlopes& slopes, double weight) {
    sum.h_x += weight * slopes.h_x;
    sum.h_z += weight * slopes.h_z;
    sum.d_xx += weight * slopes.d_xx;
    sum.d_zz += weight * slopes.d_zz;
    sum.d_xz += weight * slopes.d_xz;
    sum.var_xx += weight * slopes.var_xx;
    sum.var_zz += weight * slopes.var_zz;
}

}  // namespace

void CascadeLevels::take(const Cascade& cascade) {
    cascade_ = cascade;
    levels_ = {level_0(cascade)};
    for (int level = 1; level < mip_levels(cascade.resolution()); ++level)
        levels_.push_back(reduced(levels_.back(), static_cast<std::size_t>(cascade.resolution() >> level)));
}

CascadeSample CascadeLevels::at(double x_m, double z_m, float footprint_m) const {
    const CascadeGrid::Place place = cascade_.grid.in_cascade(x_m, z_m);
    const double u = place.along / cascade_.grid.side_m, v = place.across / cascade_.grid.side_m;
    const auto fraction_u = static_cast<float>(u - std::floor(u)), fraction_v = static_cast<float>(v - std::floor(v));
    const float level = std::min(level_of(footprint_m / static_cast<float>(cascade_.texel_m())),
                                 static_cast<float>(levels_.size() - 1));
    const int finer = static_cast<int>(level);
    const float coarser_weight = level - static_cast<float>(finer);
    CascadeSample sample;
    add_level(sample, fraction_u, fraction_v, finer, 1 - coarser_weight);
    if (coarser_weight > 0) add_level(sample, fraction_u, fraction_v, finer + 1, coarser_weight);
    return sample;
}

// Texels of level 0 are at integer positions. A texel of a coarser level is in the middle of its
// four finer texels.
void CascadeLevels::add_level(CascadeSample& sum, float u, float v, int level, float weight) const {
    const int side = cascade_.resolution() >> level;
    const float first = 0.5f - 0.5f / static_cast<float>(1 << level);
    const float x = u * static_cast<float>(side) - first, y = v * static_cast<float>(side) - first;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    const float right = x - static_cast<float>(column), lower = y - static_cast<float>(row);
    const Level& texels = levels_[static_cast<std::size_t>(level)];
    const auto slopes = cascade_.level_of(cascade_.slopes_rgba8, level),
               moments = cascade_.level_of(cascade_.moments_rgba8, level);
    glm::vec3 mean(0);
    for (const int j : {0, 1})
        for (const int i : {0, 1}) {
            const float texel_weight = weight * (i ? right : 1 - right) * (j ? lower : 1 - lower);
            const int wrapped = ((row + j) & (side - 1)) * side + ((column + i) & (side - 1));
            const auto texel = static_cast<std::size_t>(wrapped);
            mean += texel_weight * texels[texel];
            add(sum.slopes, slopes_of_texel(slopes[texel], moments[texel], cascade_.slope_ranges),
                static_cast<double>(texel_weight));
        }
    sum.displacement += mean;
}

}  // namespace pelagic::tools
