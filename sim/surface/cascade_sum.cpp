#include "pelagic/sim/surface/cascade_sum.hpp"

#include <cmath>

namespace pelagic {

Displacement displacement_of(const Cascade& cascade, double x_m, double z_m) {
    const CascadeGrid::Place place = cascade.grid.in_cascade(x_m, z_m);
    const double texels_per_m = cascade.resolution() / cascade.grid.side_m;
    const double x = place.along * texels_per_m, z = place.across * texels_per_m;
    const double column = std::floor(x), row = std::floor(z);
    const double right = x - column, down = z - row;
    // The resolution is a power of two, so the mask also wraps negative indices.
    const int mask = cascade.resolution() - 1;
    const int i0 = static_cast<int>(static_cast<long long>(column) & mask), i1 = (i0 + 1) & mask;
    const int j0 = static_cast<int>(static_cast<long long>(row) & mask), j1 = (j0 + 1) & mask;
    const auto between = [&](const PlaneView& plane) {
        const auto at = [&](int i, int j) { return static_cast<double>(plane.at(i, j)); };
        const double upper = at(i0, j0) + right * (at(i1, j0) - at(i0, j0));
        const double lower = at(i0, j1) + right * (at(i1, j1) - at(i0, j1));
        return upper + down * (lower - upper);
    };
    return {between(cascade.dx), between(cascade.height), between(cascade.dz)};
}

Displacement displacement_of(const Frame& frame, double x_m, double z_m) {
    Displacement sum;
    for (const Cascade& cascade : frame.cascades) {
        const Displacement one = displacement_of(cascade, x_m, z_m);
        sum.dx += one.dx;
        sum.height += one.height;
        sum.dz += one.dz;
    }
    return sum;
}

}  // namespace pelagic
