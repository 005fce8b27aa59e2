#include "pelagic/sim/spray/breaking_surface.hpp"

#include <cmath>

#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/shore.hpp"

namespace pelagic {
namespace {

/// A position in a cascade, in texels, [0, N) up to rounding.
struct Columns {
    double along, across;
};

Columns columns_at(const Cascade& cascade, double x_m, double z_m) {
    const CascadeGrid::Place place = cascade.grid.in_cascade(x_m, z_m);
    const double n = cascade.resolution(), texel_m = cascade.texel_m();
    const double along = place.along / texel_m, across = place.across / texel_m;
    return {along - std::floor(along / n) * n, across - std::floor(across / n) * n};
}

std::array<float, max_cascades> weights_at(const Frame& frame, double x_m, double z_m) {
    if (frame.shore) return shore_weights_at(frame.shore, x_m, z_m);
    std::array<float, max_cascades> weights;
    weights.fill(1);
    return weights;
}

}  // namespace

BreakingSurface::BreakingSurface(const Frame& frame) : frame_(frame) {
    for (std::size_t i = 0; i < frame.cascades.size(); ++i) texels_[i] = texels_of(frame.cascades[i]);
}

double BreakingSurface::compression(double x_m, double z_m) const {
    const auto weights = weights_at(frame_, x_m, z_m);
    double sum = 0;
    for (std::size_t c = 0; c < frame_.cascades.size(); ++c) {
        const Cascade& cascade = frame_.cascades[c];
        if (cascade.compression_scale == 0) continue;
        const SurfaceTexels& texels = texels_[c];
        const Columns columns = columns_at(cascade, x_m, z_m);
        const int i = static_cast<int>(columns.along + 0.5), j = static_cast<int>(columns.across + 0.5);
        const std::ptrdiff_t left = place_of(texels, i - 1, j), right = place_of(texels, i + 1, j);
        const std::ptrdiff_t above = place_of(texels, i, j - 1), below = place_of(texels, i, j + 1);
        const auto change = [](const float* plane, std::ptrdiff_t from, std::ptrdiff_t to) {
            return static_cast<double>(plane[to]) - static_cast<double>(plane[from]);
        };
        // x and z are at angles to the cascade's axes: d/dx = cos d/du - sin d/dv.
        const double along =
            cascade.grid.cosine * change(texels.dx, left, right) + cascade.grid.sine * change(texels.dz, left, right);
        const double across = cascade.grid.cosine * change(texels.dz, above, below) -
                              cascade.grid.sine * change(texels.dx, above, below);
        sum -=
            static_cast<double>(weights[c] * cascade.compression_scale) * (along + across) / (2 * cascade.texel_m());
    }
    return sum;
}

SurfacePoint BreakingSurface::at(double x_m, double z_m) const {
    std::array<std::array<double, 6>, max_cascades> moved{};
    for (std::size_t c = 0; c < frame_.cascades.size(); ++c) {
        const SurfaceTexels& texels = texels_[c];
        const Columns columns = columns_at(frame_.cascades[c], x_m, z_m);
        const int i = static_cast<int>(columns.along), j = static_cast<int>(columns.across);
        const double u = columns.along - i, v = columns.across - j;
        const std::array places = {place_of(texels, i, j), place_of(texels, i + 1, j), place_of(texels, i, j + 1),
                                   place_of(texels, i + 1, j + 1)};
        const std::array weights = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
        const std::array planes = {texels.dx,         texels.height,     texels.dz,
                                   texels.velocity_x, texels.velocity_y, texels.velocity_z};
        for (std::size_t plane = 0; plane < planes.size(); ++plane)
            for (std::size_t texel = 0; texel < places.size(); ++texel)
                moved[c][plane] += weights[texel] * static_cast<double>(planes[plane][places[texel]]);
    }
    // A shore's weights are those of the drawn position, which depends on them. They change slowly,
    // so that two steps suffice, as in sea.vert.glsl.
    std::array<double, 6> sum{};
    for (int step = 0; step < (frame_.shore ? 3 : 1); ++step) {
        const auto weights = weights_at(frame_, x_m + sum[0], z_m + sum[2]);
        sum = {};
        for (std::size_t c = 0; c < frame_.cascades.size(); ++c)
            for (std::size_t plane = 0; plane < sum.size(); ++plane)
                sum[plane] += static_cast<double>(weights[c]) * moved[c][plane];
    }
    SurfacePoint point{x_m + sum[0], sum[1], z_m + sum[2], {sum[3], sum[4], sum[5]}};
    if (frame_.dynamic_waves) {
        const DynamicWavesSample added = sample(frame_.dynamic_waves, point.x_m, point.z_m);
        point.y_m += added.height_m;
        point.velocity_mps[1] += added.vertical_velocity_mps;
    }
    if (frame_.shore) {
        const ShoreSample added = sample(frame_.shore, point.x_m, point.z_m);
        point.y_m += added.height_m;
        point.velocity_mps[1] += added.vertical_velocity_mps;
    }
    return point;
}

}  // namespace pelagic
