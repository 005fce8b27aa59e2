#include "pelagic/sim/surface/displacement_sampler.hpp"

#include <cmath>

namespace pelagic {

DisplacementSampler::DisplacementSampler(const Frame& frame)
    : frame_(frame), texels_per_m_(frame.resolution() / frame.sea.patch_size_m) {}

Displacement DisplacementSampler::at(double x_m, double z_m) const {
    const double x = x_m * texels_per_m_, z = z_m * texels_per_m_;
    const double column = std::floor(x), row = std::floor(z);
    const double right = x - column, down = z - row;
    // The resolution is a power of two, so a mask wraps negative texels too.
    const int mask = frame_.resolution() - 1;
    const int i0 = static_cast<int>(static_cast<long long>(column) & mask), i1 = (i0 + 1) & mask;
    const int j0 = static_cast<int>(static_cast<long long>(row) & mask), j1 = (j0 + 1) & mask;
    const auto between = [&](const PlaneView& plane) {
        const auto at = [&](int i, int j) { return static_cast<double>(plane.at(i, j)); };
        const double upper = at(i0, j0) + right * (at(i1, j0) - at(i0, j0));
        const double lower = at(i0, j1) + right * (at(i1, j1) - at(i0, j1));
        return upper + down * (lower - upper);
    };
    return {between(frame_.dx), between(frame_.height), between(frame_.dz)};
}

}  // namespace pelagic
