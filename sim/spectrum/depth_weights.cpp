#include "pelagic/sim/spectrum/depth_weights.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

/// Wave numbers of the fit, in equal ratios.
constexpr int fitted_waves = 48;

/// Price of the mean square of a filter's weights. With a tenth of it, waves of twice a footprint would keep 0.93
/// instead of 0.91, and weights, with the errors of levels, would be twice as large.
constexpr double price_of_weights = 1e-4;

using Column = std::array<double, 3>;

/// Solves the normal equations by elimination. They are positive definite: a small part of the
/// diagonal is added, because the waves of shallow water hardly tell the levels apart.
Column solved(std::array<Column, 3> matrix, Column right) {
    for (std::size_t i = 0; i < 3; ++i) matrix[i][i] *= 1 + 1e-9;
    for (std::size_t pivot = 0; pivot < 3; ++pivot)
        for (std::size_t row = pivot + 1; row < 3; ++row) {
            const double factor = matrix[row][pivot] / matrix[pivot][pivot];
            for (std::size_t column = pivot; column < 3; ++column)
                matrix[row][column] -= factor * matrix[pivot][column];
            right[row] -= factor * right[pivot];
        }
    for (std::size_t row = 3; row-- > 0;) {
        for (std::size_t column = row + 1; column < 3; ++column) right[row] -= matrix[row][column] * right[column];
        right[row] /= matrix[row][row];
    }
    return right;
}

/// Solves the normal equations of all waves: (A^T A + price) F = A^T, with a row of A for each wave.
void fit_filter(const DepthLadder& ladder, double DepthFactors::*factor, double water_m,
                DepthLadder::Filter::OfLevels& to) {
    constexpr std::size_t levels = DepthLadder::max_levels, waves = DepthLadder::Filter::waves;
    const std::size_t count = ladder.count;
    std::array<std::array<double, levels>, levels> matrix{};
    std::array<std::array<double, waves>, levels> right{};
    for (std::size_t wave = 0; wave < waves; ++wave)
        for (std::size_t level = 0; level < count; ++level)
            right[level][wave] =
                depth_factors(static_cast<double>(ladder.filter.k[wave]), ladder.depths_m[level], water_m).*factor;
    for (std::size_t row = 0; row < count; ++row) {
        for (std::size_t column = 0; column < count; ++column)
            for (std::size_t wave = 0; wave < waves; ++wave)
                matrix[row][column] += right[row][wave] * right[column][wave];
        matrix[row][row] += price_of_weights * waves;
    }
    for (std::size_t pivot = 0; pivot < count; ++pivot)
        for (std::size_t row = pivot + 1; row < count; ++row) {
            const double part = matrix[row][pivot] / matrix[pivot][pivot];
            for (std::size_t column = pivot; column < count; ++column)
                matrix[row][column] -= part * matrix[pivot][column];
            for (std::size_t wave = 0; wave < waves; ++wave) right[row][wave] -= part * right[pivot][wave];
        }
    for (std::size_t row = count; row-- > 0;)
        for (std::size_t wave = 0; wave < waves; ++wave) {
            for (std::size_t column = row + 1; column < count; ++column)
                right[row][wave] -= matrix[row][column] * right[column][wave];
            right[row][wave] /= matrix[row][row];
            to[row][wave] = static_cast<float>(right[row][wave]);
        }
}

}  // namespace

DepthFactors depth_factors(double k, double depth_m, double water_m) {
    const double fallen = det::exp(-k * depth_m), risen = det::exp(-k * (2 * water_m - depth_m));
    const double twice = det::exp(-2 * k * water_m);
    return {(fallen + risen) / (1 + twice), (fallen - risen) / (1 - twice), (fallen + risen) / (1 - twice)};
}

void fit_weights(DepthLadder& ladder, double min_k, double max_k, double water_m) {
    const double ratio = det::pow(max_k / min_k, 1.0 / (fitted_waves - 1));
    const auto& depths_m = ladder.depths_m;
    for (std::size_t i = 0; i + 1 < ladder.count; ++i) {
        const std::size_t first = DepthLadder::first_of(i);
        ladder.steps_per_m[i] = static_cast<float>(DepthLadder::steps / (depths_m[i + 1] - depths_m[i]));
        for (std::size_t step = 0; step <= DepthLadder::steps; ++step) {
            const double depth_m =
                depths_m[i] + (depths_m[i + 1] - depths_m[i]) * static_cast<double>(step) / DepthLadder::steps;
            std::array<Column, 3> matrix{}, of_slopes{};
            Column right{}, slopes{};
            double k = min_k;
            for (int wave = 0; wave < fitted_waves; ++wave, k *= ratio) {
                std::array<DepthFactors, 3> of;
                for (std::size_t level = 0; level < 3; ++level)
                    of[level] = depth_factors(k, depths_m[first + level], water_m);
                const DepthFactors between = depth_factors(k, depth_m, water_m);
                const double tanh_kd = det::tanh(k * water_m);
                const auto add = [&](double DepthFactors::*factor, double slope) {
                    for (std::size_t row = 0; row < 3; ++row) {
                        right[row] += of[row].*factor * (between.*factor);
                        slopes[row] += of[row].*factor * slope / k;
                        for (std::size_t column = 0; column < 3; ++column) {
                            const double product = of[row].*factor * (of[column].*factor);
                            matrix[row][column] += product;
                            of_slopes[row][column] += product / (k * k);
                        }
                    }
                };
                // d/dy is -k tanh(kd) rise of the head, and -k head / tanh(kd) of the rise
                add(&DepthFactors::head, -between.rise * tanh_kd);
                add(&DepthFactors::rise, -between.head / tanh_kd);
            }
            Column fitted = solved(matrix, right);
            const Column slope = solved(of_slopes, slopes);
            // exactly, so that pressure and velocity do not jump
            if (step == 0 || step == DepthLadder::steps) {
                fitted = {};
                fitted[i + step / DepthLadder::steps - first] = 1;
            }
            DepthWeights& weights = ladder.weights[i][step];
            for (std::size_t level = 0; level < 3; ++level) {
                weights.value[level] = static_cast<float>(fitted[level]);
                weights.slope[level] = static_cast<float>(slope[level]);
            }
        }
    }
}

void fit_filter(DepthLadder& ladder, double min_k, double max_k, double water_m) {
    const double ratio = det::pow(max_k / min_k, 1.0 / (DepthLadder::Filter::waves - 1));
    double k = min_k;
    for (float& wave : ladder.filter.k) {
        wave = static_cast<float>(k);
        k *= ratio;
    }
    fit_filter(ladder, &DepthFactors::head, water_m, ladder.filter.along);
    fit_filter(ladder, &DepthFactors::rise, water_m, ladder.filter.up);
}

}  // namespace pelagic
