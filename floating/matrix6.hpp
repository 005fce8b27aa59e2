// 6 x 6 matrices of rigid bodies: products, and the solution of linear systems.
#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "pelagic/floating/hull_matrix.hpp"

namespace pelagic {

inline Vector6 joined(const glm::dvec3& first, const glm::dvec3& second) {
    return {first.x, first.y, first.z, second.x, second.y, second.z};
}
inline glm::dvec3 first_half(const Vector6& v) { return {v[0], v[1], v[2]}; }
inline glm::dvec3 second_half(const Vector6& v) { return {v[3], v[4], v[5]}; }

inline double dot(const Vector6& a, const Vector6& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i) sum += a[i] * b[i];
    return sum;
}

inline Vector6 product(const HullMatrix& matrix, const Vector6& v) {
    Vector6 result{};
    for (std::size_t row = 0; row < 6; ++row) result[row] = dot(matrix[row], v);
    return result;
}

/// Adds factor times a 3 x 3 matrix to a quarter of a matrix. GLM's matrices are columns of rows.
inline void add_block(HullMatrix& matrix, std::size_t row, std::size_t column, double factor,
                      const glm::dmat3& block) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            matrix[row + static_cast<std::size_t>(i)][column + static_cast<std::size_t>(j)] += factor * block[j][i];
}

/// Returns the matrix of the cross product: cross_matrix(a) * b is a x b.
inline glm::dmat3 cross_matrix(const glm::dvec3& a) {
    return {glm::dvec3{0, a.z, -a.y}, glm::dvec3{-a.z, 0, a.x}, glm::dvec3{a.y, -a.x, 0}};
}

/// Solves matrix x = right by elimination without pivots, which is stable for a matrix whose
/// symmetric part is positive definite.
inline Vector6 solve(HullMatrix matrix, Vector6 right) {
    for (std::size_t pivot = 0; pivot < 6; ++pivot)
        for (std::size_t row = pivot + 1; row < 6; ++row) {
            const double factor = matrix[row][pivot] / matrix[pivot][pivot];
            for (std::size_t column = pivot + 1; column < 6; ++column)
                matrix[row][column] -= factor * matrix[pivot][column];
            right[row] -= factor * right[pivot];
        }
    for (std::size_t row = 6; row-- > 0;) {
        for (std::size_t column = row + 1; column < 6; ++column) right[row] -= matrix[row][column] * right[column];
        right[row] /= matrix[row][row];
    }
    return right;
}

}  // namespace pelagic
