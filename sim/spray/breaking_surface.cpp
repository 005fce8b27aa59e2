#include "pelagic/sim/spray/breaking_surface.hpp"

#include <cmath>

#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/sim/shore.hpp"

namespace pelagic {
namespace {

/// A position in a cascade, in texels, [0, N) up to rounding.
struct Columns {
    double along, across;
};

Columns columns_at(const CascadeGrid& grid, int resolution, double x_m, double z_m) {
    const CascadeGrid::Vector at = grid.in_cascade(x_m, z_m);
    const double n = resolution, texel_m = grid.side_m / n;
    const double along = at.along / texel_m, across = at.across / texel_m;
    return {along - std::floor(along / n) * n, across - std::floor(across / n) * n};
}

}  // namespace

BreakingSurface::BreakingSurface(std::span<const Cascade> at_tick, std::span<const Cascade> planes,
                                 const ShoreSurface& shore)
    : count_(at_tick.size()), shore_(shore) {
    for (std::size_t c = 0; c < count_; ++c)
        cascades_[c] = {at_tick[c].grid, static_cast<double>(at_tick[c].compression_scale),
                        at_tick[c].grid.in_cascade(double{at_tick[c].compression_front_x},
                                                   double{at_tick[c].compression_front_z}),
                        texels_of(planes[c])};
}

std::array<float, max_cascades> BreakingSurface::weights_at(double x_m, double z_m) const {
    if (shore_) return shore_weights_at(shore_, x_m, z_m);
    std::array<float, max_cascades> weights;
    weights.fill(1);
    return weights;
}

double BreakingSurface::compression(double x_m, double z_m) const {
    const auto weights = weights_at(x_m, z_m);
    double sum = 0;
    for (std::size_t c = 0; c < count_; ++c) {
        const auto& [grid, scale, front, texels] = cascades_[c];
        if (scale == 0) continue;
        const Columns columns = columns_at(grid, texels.resolution, x_m, z_m);
        const int i = static_cast<int>(columns.along + 0.5), j = static_cast<int>(columns.across + 0.5);
        const std::ptrdiff_t left = texel_offset(texels, i - 1, j), right = texel_offset(texels, i + 1, j);
        const std::ptrdiff_t above = texel_offset(texels, i, j - 1), below = texel_offset(texels, i, j + 1);
        const auto change = [](const float* plane, std::ptrdiff_t from, std::ptrdiff_t to) {
            return static_cast<double>(plane[to]) - static_cast<double>(plane[from]);
        };
        // x and z are at angles to the cascade's axes: d/dx = cos d/du - sin d/dv.
        const double along =
            grid.cosine * change(texels.dx, left, right) + grid.sine * change(texels.dz, left, right) +
            front.along * change(texels.height, left, right);
        const double across =
            grid.cosine * change(texels.dz, above, below) - grid.sine * change(texels.dx, above, below) +
            front.across * change(texels.height, above, below);
        sum -= static_cast<double>(weights[c]) * scale * (along + across) * texels.resolution / (2 * grid.side_m);
    }
    return sum;
}

SprayVector BreakingSurface::at(double x_m, double z_m) const {
    std::array<SprayVector, max_cascades> moved{};
    for (std::size_t c = 0; c < count_; ++c) {
        const SurfaceTexels& texels = cascades_[c].texels;
        const Columns columns = columns_at(cascades_[c].grid, texels.resolution, x_m, z_m);
        const int i = static_cast<int>(columns.along), j = static_cast<int>(columns.across);
        const double u = columns.along - i, v = columns.across - j;
        const std::array offsets = {texel_offset(texels, i, j), texel_offset(texels, i + 1, j),
                                    texel_offset(texels, i, j + 1), texel_offset(texels, i + 1, j + 1)};
        const std::array weights = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
        const std::array planes = {texels.dx, texels.height, texels.dz};
        for (std::size_t plane = 0; plane < planes.size(); ++plane)
            for (std::size_t texel = 0; texel < offsets.size(); ++texel)
                moved[c][plane] += weights[texel] * static_cast<double>(planes[plane][offsets[texel]]);
    }
    // A shore's weights are those of the drawn position, which depends on them. They change slowly,
    // so that two steps suffice, as in sea.vert.glsl.
    SprayVector sum{};
    for (int step = 0; step < (shore_ ? 3 : 1); ++step) {
        const auto weights = weights_at(x_m + sum[0], z_m + sum[2]);
        sum = {};
        for (std::size_t c = 0; c < count_; ++c)
            for (std::size_t plane = 0; plane < sum.size(); ++plane)
                sum[plane] += static_cast<double>(weights[c]) * moved[c][plane];
    }
    SprayVector point{x_m + sum[0], sum[1], z_m + sum[2]};
    if (shore_) point[1] += sample(shore_, point[0], point[2]).height_m;
    return point;
}

}  // namespace pelagic
