#include "pelagic/bench/peers/scalar_query.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/buffers/surface_texels.hpp"

namespace pelagic::peers {
namespace {

struct CellPosition {
    int cell_x, cell_z;
    float u, v;
};

CellPosition position_in_texels(const Frame& frame, double x_m, double z_m) {
    const double texel_m = frame.cascades[0].texel_m();
    const double x = x_m / texel_m, z = z_m / texel_m;
    const auto floor_of = [](double t) {
        const auto cut = static_cast<std::int64_t>(t);
        return cut - (static_cast<double>(cut) > t);
    };
    const std::int64_t i = floor_of(x), j = floor_of(z), last = frame.cascades[0].resolution() - 1;
    return {static_cast<int>(i & last), static_cast<int>(j & last), static_cast<float>(x - static_cast<double>(i)),
            static_cast<float>(z - static_cast<double>(j))};
}

float between(float a, float b, float t) { return a + t * (b - a); }

float bilinear(float v00, float v10, float v01, float v11, float u, float v) {
    return between(between(v00, v10, u), between(v01, v11, u), v);
}

/// The step from one position to the next, as in the kernel.
void move(int& cell, float& within, float by) {
    const float moved = within - by;
    const auto cut = static_cast<float>(static_cast<int>(moved));
    const float whole = cut - (cut > moved ? 1.f : 0.f);
    cell += static_cast<int>(whole);
    within = moved - whole;
}

struct HorizontalDisplacement {
    float value, along_u, along_v;
};

HorizontalDisplacement horizontal(const SurfaceTexels& surface, const float* plane, const CellPosition& at,
                                  float texels_per_m) {
    const float v00 = plane[texel_offset(surface, at.cell_x, at.cell_z)];
    const float v10 = plane[texel_offset(surface, at.cell_x + 1, at.cell_z)];
    const float v01 = plane[texel_offset(surface, at.cell_x, at.cell_z + 1)];
    const float v11 = plane[texel_offset(surface, at.cell_x + 1, at.cell_z + 1)];
    const float low = between(v00, v10, at.u), high = between(v01, v11, at.u);
    return {between(low, high, at.v) * texels_per_m, between(v10 - v00, v11 - v01, at.v) * texels_per_m,
            (high - low) * texels_per_m};
}

struct Slopes {
    float value, x, z;
};

Slopes slopes(const SurfaceTexels& surface, const float* plane, const CellPosition& at) {
    const auto texel = [&](int i, int j) { return plane[texel_offset(surface, at.cell_x + i, at.cell_z + j)]; };
    const auto along = [&](int i, int j) {
        return bilinear(texel(i, j) - texel(-i, -j), texel(1 + i, j) - texel(1 - i, -j),
                        texel(i, 1 + j) - texel(-i, 1 - j), texel(1 + i, 1 + j) - texel(1 - i, 1 - j), at.u, at.v);
    };
    return {bilinear(texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1), at.u, at.v), along(1, 0), along(0, 1)};
}

}  // namespace

ScalarSample scalar_query(const Frame& frame, double x_m, double z_m, double tolerance_m) {
    const SurfaceTexels surface = texels_of(frame.cascades[0]);
    const double texel_m = frame.cascades[0].texel_m();
    const auto texels_per_m = static_cast<float>(1 / texel_m);
    const auto target = static_cast<float>(std::clamp(tolerance_m / 64 / texel_m, 4e-6, 1.0 / 64));
    const CellPosition world = position_in_texels(frame, x_m, z_m);
    CellPosition at = world;
    float squared = 0;
    for (int step = 0;; ++step) {
        const HorizontalDisplacement dx = horizontal(surface, surface.dx, at, texels_per_m);
        const HorizontalDisplacement dz = horizontal(surface, surface.dz, at, texels_per_m);
        const float off_x = static_cast<float>(at.cell_x - world.cell_x) + (at.u - world.u) + dx.value;
        const float off_z = static_cast<float>(at.cell_z - world.cell_z) + (at.v - world.v) + dz.value;
        squared = off_x * off_x + off_z * off_z;
        if (squared <= target * target || step == InvertSurfaceJob::max_steps) break;
        const float j_xx = 1 + dx.along_u, j_zz = 1 + dz.along_v;
        const float determinant = j_xx * j_zz - dx.along_v * dz.along_u;
        if (determinant > InvertSurfaceJob::min_determinant &&
            std::max(std::fabs(off_x), std::fabs(off_z)) < InvertSurfaceJob::newton_reach) {
            const float inverse = 1 / determinant;
            move(at.cell_x, at.u, (j_zz * off_x - dx.along_v * off_z) * inverse);
            move(at.cell_z, at.v, (j_xx * off_z - dz.along_u * off_x) * inverse);
        } else {
            move(at.cell_x, at.u, off_x);
            move(at.cell_z, at.v, off_z);
        }
    }
    const Slopes dx = slopes(surface, surface.dx, at), h = slopes(surface, surface.height, at),
                 dz = slopes(surface, surface.dz, at);
    const auto two_texels = static_cast<float>(2 * texel_m);
    const float j_xx = two_texels + dx.x, j_zz = two_texels + dz.z;
    const float n_x = h.z * dz.x - h.x * j_zz;
    const float n_y = j_xx * j_zz - dx.z * dz.x;
    const float n_z = h.x * dx.z - h.z * j_xx;
    const float inverse = 1 / std::sqrt(std::max(n_x * n_x + n_y * n_y + n_z * n_z, 1e-30f));
    return {h.value, n_x * inverse, n_y * inverse, n_z * inverse, std::sqrt(squared) * static_cast<float>(texel_m)};
}

float scalar_lookup(const Frame& frame, double x_m, double z_m) {
    const SurfaceTexels surface = texels_of(frame.cascades[0]);
    const CellPosition at = position_in_texels(frame, x_m, z_m);
    const auto texel = [&](int i, int j) {
        return surface.height[texel_offset(surface, at.cell_x + i, at.cell_z + j)];
    };
    return bilinear(texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1), at.u, at.v);
}

}  // namespace pelagic::peers
