#include "pelagic/quadtree/frustum.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

bool is_finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

/// Tests by Gaussian elimination. Columns and rows are scaled to a largest element of 1 first, so
/// that positions far from the origin or a tiny near plane do not make the matrix appear singular.
bool is_singular(glm::dmat4 m) {
    for (int c = 0; c < 4; ++c) {
        double largest = 0;
        for (int r = 0; r < 4; ++r) largest = std::max(largest, std::abs(m[c][r]));
        if (largest == 0) return true;
        m[c] /= largest;
    }
    m = glm::transpose(m);
    for (int r = 0; r < 4; ++r) {
        double largest = 0;
        for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(m[r][c]));
        if (largest == 0) return true;
        m[r] /= largest;
    }
    for (int step = 0; step < 4; ++step) {
        int row = step;
        for (int r = step; r < 4; ++r)
            if (std::abs(m[r][step]) > std::abs(m[row][step])) row = r;
        // Float matrices have errors of 1e-7; pivots of a regular matrix are far above 1e-12.
        if (std::abs(m[row][step]) < 1e-12) return true;
        std::swap(m[row], m[step]);
        for (int r = step + 1; r < 4; ++r) m[r] -= m[step] * (m[r][step] / m[step][step]);
    }
    return false;
}

}  // namespace

Frustum::Frustum(const glm::dmat4& clip_from_world, ClipDepth depth) {
    const DefaultFloatEnvironment environment;
    if (!is_finite(clip_from_world)) throw std::invalid_argument("clip_from_world holds NaN or infinity");
    if (is_singular(clip_from_world))
        throw std::invalid_argument("clip_from_world is singular; expected an invertible matrix");
    const glm::dmat4 rows = glm::transpose(clip_from_world);
    for (int axis = 0; axis < 3; ++axis) {
        planes[static_cast<std::size_t>(2 * axis)] = rows[3] + rows[axis];
        planes[static_cast<std::size_t>(2 * axis + 1)] = rows[3] - rows[axis];
    }
    if (depth == ClipDepth::zero_to_one) planes[4] = rows[2];
}

bool Frustum::may_see(const Box& box) const {
    for (const glm::dvec4& plane : planes) {
        const glm::dvec3 normal(plane);
        const glm::dvec3 size = glm::abs(normal);
        const double middle = glm::dot(normal, box.centre) + plane.w;
        const double reach = glm::dot(size, box.half);
        // Bound of the rounding error: a few units in the last place of the sum's largest term.
        const double rounding = 1e-14 * (glm::dot(size, glm::abs(box.centre)) + std::abs(plane.w) + reach);
        if (middle + reach + rounding < 0) return false;
    }
    return true;
}

}  // namespace pelagic
