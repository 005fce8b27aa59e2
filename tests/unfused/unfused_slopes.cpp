#include "pelagic/tests/unfused/unfused_slopes.hpp"

#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic::unfused {
namespace {

/// Values that mip levels average.
struct Slopes {
    float h_x, h_z, d_xx, d_zz, d_xz;
    float h_x_h_x, h_z_h_z, h_x_h_z;
};
constexpr std::array components = {&Slopes::h_x,  &Slopes::h_z,     &Slopes::d_xx,    &Slopes::d_zz,
                                   &Slopes::d_xz, &Slopes::h_x_h_x, &Slopes::h_z_h_z, &Slopes::h_x_h_z};

std::uint32_t byte_of(float steps) {
    return static_cast<std::uint32_t>(std::clamp(static_cast<int>(std::nearbyint(steps)), -128, 127) + 128);
}

std::uint32_t slopes_word(const Slopes& s) {
    return byte_of(s.h_x) | byte_of(s.h_z) << 8 | byte_of(s.d_xx) << 16 | byte_of(s.d_zz) << 24;
}

std::uint32_t moments_word(const Slopes& s, float variance_factor) {
    const float from_zero = 255.f * variance_factor, around_zero = 127.f * variance_factor;
    return byte_of(s.d_xz) | byte_of((s.h_x_h_x - s.h_x * s.h_x) * from_zero + -128.f) << 8 |
           byte_of((s.h_z_h_z - s.h_z * s.h_z) * from_zero + -128.f) << 16 |
           byte_of((s.h_x_h_z - s.h_x * s.h_z) * around_zero) << 24;
}

struct Along {
    float x, z;
};

class SlopeGrid {
   public:
    SlopeGrid(const CascadePlanes& planes, const SlopeRanges& ranges)
        : planes_(planes),
          n_(static_cast<std::size_t>(planes.resolution)),
          factor_(static_cast<float>(SlopesJob::near_weight /
                                     (double{ranges.slope / 127.f} * (planes.side_m / planes.resolution)))) {}

    Slopes slopes_at(std::size_t x, std::size_t z) const {
        const Along h = along(planes_.height, x, z), dx = along(planes_.dx, x, z), dz = along(planes_.dz, x, z);
        Slopes s{.h_x = h.x * factor_,
                 .h_z = h.z * factor_,
                 .d_xx = dx.x * factor_,
                 .d_zz = dz.z * factor_,
                 .d_xz = (dx.z + dz.x) * (0.5f * factor_),
                 .h_x_h_x = 0,
                 .h_z_h_z = 0,
                 .h_x_h_z = 0};
        s.h_x_h_x = s.h_x * s.h_x;
        s.h_z_h_z = s.h_z * s.h_z;
        s.h_x_h_z = s.h_x * s.h_z;
        return s;
    }

    std::array<float, 4> displacement_at(std::size_t texel) const {
        return {planes_.dx[texel], planes_.height[texel], planes_.dz[texel], 0.f};
    }

   private:
    Along along(const std::vector<float>& plane, std::size_t x, std::size_t z) const {
        const auto at = [&](std::size_t i, std::size_t j) { return plane[j % n_ * n_ + i % n_]; };
        constexpr auto far_weight = static_cast<float>(SlopesJob::far_weight / SlopesJob::near_weight);
        const Along grid = {(at(x + 1, z) - at(x + n_ - 1, z)) + far_weight * (at(x + 2, z) - at(x + n_ - 2, z)),
                            (at(x, z + 1) - at(x, z + n_ - 1)) + far_weight * (at(x, z + 2) - at(x, z + n_ - 2))};
        if (planes_.sine == 0 && planes_.cosine == 1) return grid;
        return {grid.x * planes_.cosine - grid.z * planes_.sine, grid.x * planes_.sine + grid.z * planes_.cosine};
    }

    const CascadePlanes& planes_;
    std::size_t n_;
    float factor_;
};

}  // namespace

CascadeSlopes slopes_of(const CascadePlanes& planes, const SlopeRanges& ranges) {
    const auto n = static_cast<std::size_t>(planes.resolution);
    const float step = ranges.slope / 127.f;
    const float variance_factor = step * step / ranges.variance;
    const SlopeGrid cascade(planes, ranges);
    CascadeSlopes out;
    std::vector<Slopes> level(n * n);
    for (std::size_t i = 0; i < level.size(); ++i) {
        level[i] = cascade.slopes_at(i % n, i / n);
        out.slopes.push_back(slopes_word(level[i]));
        out.moments.push_back(byte_of(level[i].d_xz) | 0x80000000u);
        for (const float value : cascade.displacement_at(i)) out.halves.push_back(Imath::half(value).bits());
    }
    for (int number = 1; number < mip_levels(planes.resolution); ++number) {
        const std::size_t side = n >> number;
        std::vector<Slopes> coarser(side * side);
        for (std::size_t i = 0; i < coarser.size(); ++i) {
            const Slopes* above = &level[2 * (i / side) * 2 * side + 2 * (i % side)];
            const Slopes* below = above + 2 * side;
            Slopes& s = coarser[i];
            for (float Slopes::*part : components)
                s.*part = ((above[0].*part + below[0].*part) + (above[1].*part + below[1].*part)) * 0.25f;
            const auto shown = [](float square, float product) { return product + (square - product) * (1.f / 3.f); };
            if (number == 1) {
                s.h_x_h_x = shown(s.h_x_h_x, s.h_x * s.h_x);
                s.h_z_h_z = shown(s.h_z_h_z, s.h_z * s.h_z);
                s.h_x_h_z = shown(s.h_x_h_z, s.h_x * s.h_z);
            }
            out.slopes.push_back(slopes_word(s));
            out.moments.push_back(moments_word(s, variance_factor));
        }
        level = std::move(coarser);
    }
    return out;
}

}  // namespace pelagic::unfused
