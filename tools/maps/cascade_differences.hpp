// Central differences of a cascade's surface in plain C++, bit-identical to
// sim/kernels/gradients.kernel.hpp.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "pelagic/sim/cascade.hpp"

namespace pelagic::tools {

/// Central difference of Dx, height or Dz: between the neighbours on both sides, two texels apart,
/// in metres.
struct Difference {
    float x, z;
};

/// A vector along the world's axes.
struct WorldVector {
    float x, y, z;
};

/// Central differences at a texel along the world's x and z.
struct TexelDifferences {
    Difference dx, height, dz;

    /// Returns the surface's normal, which points up unless the surface is overturned; its y is the
    /// Jacobian. The vector is that of VR Ocean, equations 45 to 48, times (2 L/N)^2.
    /// \param two_texels_m  2 L/N
    WorldVector normal(float two_texels_m) const {
        const float j_xx = two_texels_m + dx.x, j_zz = two_texels_m + dz.z;
        return {height.z * dz.x - height.x * j_zz, j_xx * j_zz - dx.z * dz.x, height.x * dx.z - height.z * j_xx};
    }
};

/// A row of a plane and its two neighbours.
class NeighbourRows {
   public:
    explicit NeighbourRows(const PlaneView& plane) : plane_(plane), rows_(3 * side()) {}

    void go_to_row(int row) {
        const int n = plane_.resolution;
        plane_.copy_row((row + n - 1) % n, rows_.data());
        plane_.copy_row(row, rows_.data() + side());
        plane_.copy_row((row + 1) % n, rows_.data() + 2 * side());
    }
    /// Returns the difference along the cascade's own axes.
    Difference at(std::size_t column) const {
        const std::size_t n = side(), last = n - 1;  // n is a power of two, so last is a bit mask
        const float *above = rows_.data(), *here = above + n, *below = here + n;
        return {here[(column + 1) & last] - here[(column - 1) & last], below[column] - above[column]};
    }

   private:
    std::size_t side() const { return static_cast<std::size_t>(plane_.resolution); }

    PlaneView plane_;
    std::vector<float> rows_;
};

/// Calls take(differences) for each texel, row by row from row 0. Neighbours wrap around at the
/// edges, because the cascade is periodic.
template <class Take>
void for_each_difference(const Cascade& cascade, Take take) {
    const auto cosine = static_cast<float>(cascade.grid.cosine), sine = static_cast<float>(cascade.grid.sine);
    const auto in_world = [&](Difference along) -> Difference {
        if (!cascade.grid.is_rotated()) return along;
        return {along.x * cosine - along.z * sine, along.x * sine + along.z * cosine};
    };
    NeighbourRows dx(cascade.dx), height(cascade.height), dz(cascade.dz);
    for (int row = 0; row < cascade.resolution(); ++row) {
        for (NeighbourRows* plane : {&dx, &height, &dz}) plane->go_to_row(row);
        for (std::size_t column = 0; column < static_cast<std::size_t>(cascade.resolution()); ++column)
            take(TexelDifferences{in_world(dx.at(column)), in_world(height.at(column)), in_world(dz.at(column))});
    }
}

}  // namespace pelagic::tools
