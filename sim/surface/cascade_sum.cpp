#include "pelagic/sim/cascade_sum.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// A position in texels, along the axes of a cascade.
struct TexelPosition {
    double along, across;
};

TexelPosition position_in_texels(const Cascade& cascade, double x_m, double z_m) {
    const CascadeGrid::Vector at = cascade.grid.in_cascade(x_m, z_m);
    const double texels_per_m = cascade.resolution() / cascade.grid.side_m;
    return {at.along * texels_per_m, at.across * texels_per_m};
}

/// Interpolates three planes.
Displacement between(const SurfaceTexels& texels, const std::array<const float*, 3>& planes, const TexelPosition& at) {
    const double column = std::floor(at.along), row = std::floor(at.across);
    const double right = at.along - column, down = at.across - row;
    // The resolution is a power of two, so the mask also wraps negative indices.
    const int mask = texels.resolution - 1;
    const int i = static_cast<int>(static_cast<long long>(column) & mask);
    const int j = static_cast<int>(static_cast<long long>(row) & mask);
    const std::ptrdiff_t upper_left = texel_offset(texels, i, j), upper_right = texel_offset(texels, i + 1, j);
    const std::ptrdiff_t lower_left = texel_offset(texels, i, j + 1), lower_right = texel_offset(texels, i + 1, j + 1);
    const auto value = [&](const float* plane) {
        const auto texel = [plane](std::ptrdiff_t offset) { return static_cast<double>(plane[offset]); };
        const double upper = texel(upper_left) + right * (texel(upper_right) - texel(upper_left));
        const double lower = texel(lower_left) + right * (texel(lower_right) - texel(lower_left));
        return upper + down * (lower - upper);
    };
    return {value(planes[0]), value(planes[1]), value(planes[2])};
}

template <class Of>
Displacement summed(const Frame& frame, const Of& of) {
    Displacement sum;
    for (const Cascade& cascade : frame.cascades) {
        const Displacement one = of(cascade);
        sum.dx += one.dx;
        sum.height += one.height;
        sum.dz += one.dz;
    }
    return sum;
}

/// Four texels around a position, and their weights.
struct WeightedTexels {
    std::array<std::size_t, 4> index;
    std::array<float, 4> weight;
};

WeightedTexels texels_at(const Cascade& cascade, double columns, double rows) {
    const double n = cascade.resolution();
    const auto side = static_cast<std::size_t>(cascade.resolution());
    const double x = columns - std::floor(columns / n) * n, z = rows - std::floor(rows / n) * n;
    const double left = std::floor(x), upper = std::floor(z);
    const auto u = static_cast<float>(x - left), v = static_cast<float>(z - upper);
    // Rounding may move a position just below 0 to N.
    const std::size_t i = static_cast<std::size_t>(left) & (side - 1),
                      j = static_cast<std::size_t>(upper) & (side - 1);
    const std::size_t right = (i + 1) & (side - 1), lower = (j + 1) & (side - 1);
    return {{j * side + i, j * side + right, lower * side + i, lower * side + right},
            {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v}};
}

}  // namespace

Displacement displacement_of(const Cascade& cascade, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    const SurfaceTexels texels = texels_of(cascade);
    return environment.result(
        between(texels, {texels.dx, texels.height, texels.dz}, position_in_texels(cascade, x_m, z_m)));
}

Displacement displacement_of(const Frame& frame, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    return environment.result(
        summed(frame, [=](const Cascade& cascade) { return displacement_of(cascade, x_m, z_m); }));
}

Displacement velocity_of(const Cascade& cascade, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    const SurfaceTexels texels = texels_of(cascade);
    return environment.result(between(texels, {texels.velocity_x, texels.velocity_y, texels.velocity_z},
                                      position_in_texels(cascade, x_m, z_m)));
}

Displacement velocity_of(const Frame& frame, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    return environment.result(summed(frame, [=](const Cascade& cascade) { return velocity_of(cascade, x_m, z_m); }));
}

// Interpolation commutes with differences of whole texels, so these are the interpolated slopes of
// the texels.
SurfaceSlopes slopes_of(const Cascade& cascade, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    const SurfaceTexels texels = texels_of(cascade);
    const TexelPosition at = position_in_texels(cascade, x_m, z_m);
    const auto derivative = [&](double along, double across) {
        const auto difference = [&](double reach) {
            const auto moved = [&](double by) {
                return between(texels, {texels.dx, texels.height, texels.dz},
                               {at.along + by * along, at.across + by * across});
            };
            const Displacement ahead = moved(reach), behind = moved(-reach);
            return Displacement{ahead.dx - behind.dx, ahead.height - behind.height, ahead.dz - behind.dz};
        };
        const Displacement near = difference(1), far = difference(2);
        const auto per_m = [&](double one, double two) {
            return (SlopesJob::near_weight * one + SlopesJob::far_weight * two) / cascade.texel_m();
        };
        return Displacement{per_m(near.dx, far.dx), per_m(near.height, far.height), per_m(near.dz, far.dz)};
    };
    const Displacement u = derivative(1, 0), v = derivative(0, 1);
    const double cosine = cascade.grid.cosine, sine = cascade.grid.sine;
    const auto along_x = [=](double of_u, double of_v) { return cosine * of_u - sine * of_v; };
    const auto along_z = [=](double of_u, double of_v) { return sine * of_u + cosine * of_v; };
    return environment.result(SurfaceSlopes{.h_x = along_x(u.height, v.height),
                                            .h_z = along_z(u.height, v.height),
                                            .d_xx = along_x(u.dx, v.dx),
                                            .d_zz = along_z(u.dz, v.dz),
                                            .d_xz = 0.5 * (along_z(u.dx, v.dx) + along_x(u.dz, v.dz))});
}

SurfaceSlopes slopes_of(const Frame& frame, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    SurfaceSlopes sum;
    for (const Cascade& cascade : frame.cascades) sum += slopes_of(cascade, x_m, z_m);
    return environment.result(sum);
}

double jacobian_of(const Frame& frame, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    return environment.result(normal_of(slopes_of(frame, x_m, z_m)).y);
}

double compression_of(const Frame& frame, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    double sum = 0;
    for (const Cascade& cascade : frame.cascades) {
        if (cascade.compression_scale == 0) continue;
        const SurfaceSlopes slopes = slopes_of(cascade, x_m, z_m);
        sum -= double{cascade.compression_scale} *
               (slopes.d_xx + slopes.d_zz + double{cascade.compression_front_x} * slopes.h_x +
                double{cascade.compression_front_z} * slopes.h_z);
    }
    return environment.result(sum);
}

FoamSampler::FoamSampler(const Frame& frame)
    : cascades_(frame.cascades), foam_(frame.foam), has_foam_(frame.has_foam) {
    for (std::size_t slot = 0; slot < SnapshotFoam::slots; ++slot)
        if (foam_.age[slot] < 1) slots_[slot_count_++] = static_cast<std::uint8_t>(slot);
    std::sort(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(slot_count_),
              [&](std::uint8_t a, std::uint8_t b) { return foam_.age[a] < foam_.age[b]; });
}

float FoamSampler::at(double x_m, double z_m, std::span<const float> weights) const {
    const DefaultFloatEnvironment environment(x_m, z_m);
    std::array<WeightedTexels, max_cascades> drifted;
    std::array<const Cascade*, max_cascades> cascades;
    std::array<float, max_cascades> factors;
    std::size_t count = 0;
    float present = 0;
    for (std::size_t i = 0; i < cascades_.size(); ++i) {
        const Cascade& cascade = cascades_[i];
        if (cascade.compression_r8.empty()) continue;
        const CascadeGrid::Vector at = cascade.grid.in_cascade(x_m, z_m);
        const double columns = at.along / cascade.texel_m(), rows = at.across / cascade.texel_m();
        const WeightedTexels here = texels_at(cascade, columns, rows);
        drifted[count] = texels_at(cascade, columns - cascade.drift_columns, rows - cascade.drift_rows);
        factors[count] = weights.empty() ? 1 : weights[i];
        float byte = 0;
        for (std::size_t t = 0; t < 4; ++t)
            byte += here.weight[t] * static_cast<float>(cascade.compression_r8[here.index[t]]);
        present += factors[count] * (SnapshotFoam::lowest + SnapshotFoam::step * byte);
        cascades[count++] = &cascade;
    }
    float foam = foam_.fresh(present);
    for (std::size_t s = 0; s < slot_count_ && 1 - foam_.age[slots_[s]] > foam; ++s) {
        const std::size_t image = slots_[s] / 4;
        const std::uint32_t shift = 8 * (slots_[s] % 4u);
        float sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t* const words = cascades[i]->snapshots_rgba8[image].data();
            float byte = 0;
            for (std::size_t t = 0; t < 4; ++t)
                byte += drifted[i].weight[t] * static_cast<float>(words[drifted[i].index[t]] >> shift & 255);
            sum += factors[i] * (SnapshotFoam::lowest + SnapshotFoam::step * byte);
        }
        foam = std::max(foam, foam_.fresh(sum) - foam_.age[slots_[s]]);
    }
    return environment.result(foam);
}

}  // namespace pelagic
