#include "pelagic/floating/hull_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr int verticals = 4;  // of a cell, along each axis

/// Vertical lines through the plan, and the range of heights at which each meets the mesh.
struct Verticals {
    Verticals(const HullMesh& mesh, int columns, int rows)
        : across_x(columns * verticals),
          across_z(rows * verticals),
          lower(mesh.lower_m()),
          step_x((mesh.upper_m().x - lower.x) / across_x),
          step_z((mesh.upper_m().z - lower.z) / across_z),
          low(static_cast<std::size_t>(across_x * across_z), std::numeric_limits<double>::infinity()),
          high(low.size(), -std::numeric_limits<double>::infinity()) {
        for (const auto& [a, b, c] : mesh.triangles())
            add(mesh.vertices()[a], mesh.vertices()[b], mesh.vertices()[c]);
    }

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const double twice = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
        if (twice == 0) return;  // seen edge-on
        const auto range = [](double first, double last, double from, double step, int count) {
            const double begin = std::ceil((first - from) / step - 0.5), end = std::floor((last - from) / step - 0.5);
            return std::pair(static_cast<int>(std::max(begin, 0.0)), static_cast<int>(std::min(end, count - 1.0)));
        };
        const auto [first_i, last_i] =
            range(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), lower.x, step_x, across_x);
        const auto [first_j, last_j] =
            range(std::min({a.z, b.z, c.z}), std::max({a.z, b.z, c.z}), lower.z, step_z, across_z);
        for (int j = first_j; j <= last_j; ++j)
            for (int i = first_i; i <= last_i; ++i) {
                const double x = lower.x + (i + 0.5) * step_x, z = lower.z + (j + 0.5) * step_z;
                const double of_b = ((x - a.x) * (c.z - a.z) - (c.x - a.x) * (z - a.z)) / twice;
                const double of_c = ((b.x - a.x) * (z - a.z) - (x - a.x) * (b.z - a.z)) / twice;
                if (of_b < 0 || of_c < 0 || of_b + of_c > 1) continue;
                const double y = a.y + of_b * (b.y - a.y) + of_c * (c.y - a.y);
                const auto at = static_cast<std::size_t>(j * across_x + i);
                low[at] = std::min(low[at], y);
                high[at] = std::max(high[at], y);
            }
    }

    int across_x, across_z;
    glm::dvec3 lower;
    double step_x, step_z;
    std::vector<double> low, high;
};

}  // namespace

HullPlan plan_of(const HullMesh& mesh, int columns, int rows) {
    for (const auto& [name, count] : {std::pair("columns", columns), {"rows", rows}})
        if (count < 1 || count > 1024)
            throw std::invalid_argument(invalid_value_message(name, count, "[1, 1024]"));
    const DefaultFloatEnvironment environment;
    const Verticals lines(mesh, columns, rows);
    const glm::dvec3 size = mesh.upper_m() - mesh.lower_m(), middle = 0.5 * (mesh.upper_m() + mesh.lower_m());
    HullPlan plan;
    plan.columns = columns;
    plan.rows = rows;
    plan.x_m = middle.x;
    plan.z_m = middle.z;
    plan.length_m = size.x;
    plan.beam_m = size.z;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            double low = 0, high = 0;
            int met = 0;
            for (int j = row * verticals; j < (row + 1) * verticals; ++j)
                for (int i = column * verticals; i < (column + 1) * verticals; ++i) {
                    const auto at = static_cast<std::size_t>(j * lines.across_x + i);
                    if (lines.low[at] > lines.high[at]) continue;
                    low += lines.low[at];
                    high += lines.high[at];
                    ++met;
                }
            plan.low_m.push_back(met ? static_cast<float>(low / met) : 0);
            plan.high_m.push_back(met ? static_cast<float>(high / met) : 0);
            plan.coverage.push_back(static_cast<float>(met) / (verticals * verticals));
        }
    return plan;
}

}  // namespace pelagic
