#include "pelagic/gl/water/exclusions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "pelagic/floating/hull_plan.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"

namespace pelagic::gl {
namespace {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

struct Heights {
    float lowest = std::numeric_limits<float>::infinity(), highest = -std::numeric_limits<float>::infinity();
};

Heights heights_of(const HullPlan& plan) {
    Heights heights;
    for (std::size_t i = 0; i < plan.coverage.size(); ++i)
        if (plan.coverage[i] > 0) {
            heights.lowest = std::min(heights.lowest, plan.low_m[i]);
            heights.highest = std::max(heights.highest, plan.high_m[i]);
        }
    return heights;
}

}  // namespace

std::string ExclusionMap::check(const HullPlan& plan) {
    constexpr int max_cells = 1024;
    for (const auto& [name, cells] : {std::pair("HullPlan::columns", plan.columns), {"HullPlan::rows", plan.rows}})
        if (cells < 1 || cells > max_cells) return invalid_value_message(name, cells, "[1, 1024]");
    for (const auto& [name, metres] :
         {std::pair("HullPlan::length_m", plan.length_m), {"HullPlan::beam_m", plan.beam_m}})
        if (!(metres > 0 && std::isfinite(metres))) return invalid_value_message(name, metres, "above 0 and finite");
    if (!std::isfinite(plan.x_m) || !std::isfinite(plan.z_m)) return "HullPlan::x_m and z_m must be finite";
    const std::size_t cells = static_cast<std::size_t>(plan.columns) * static_cast<std::size_t>(plan.rows);
    for (const auto& [name, values] :
         {std::pair("low_m", &plan.low_m), {"high_m", &plan.high_m}, {"coverage", &plan.coverage}}) {
        if (values->size() != cells)
            return "HullPlan::" + std::string(name) + " has " + std::to_string(values->size()) +
                   " elements, expected columns x rows, " + std::to_string(cells);
        if (!std::all_of(values->begin(), values->end(), [](float value) { return std::isfinite(value); }))
            return "HullPlan::" + std::string(name) + " has an element that is not finite";
    }
    const Heights heights = heights_of(plan);
    if (!(heights.lowest < heights.highest)) return "HullPlan covers no cell with a height above 0";
    return {};
}

ExclusionMap::ExclusionMap(const HullPlan& plan) {
    require(check(plan));
    columns_ = plan.columns;
    rows_ = plan.rows;
    const Heights heights = heights_of(plan);
    lower_m_ = {plan.x_m - plan.length_m / 2, heights.lowest, plan.z_m - plan.beam_m / 2};
    size_m_ = {plan.length_m, heights.highest - heights.lowest, plan.beam_m};
    const float height_m = heights.highest - heights.lowest;
    const auto cell = [&](int column, int row) {
        if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return Texel{};
        const auto at =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
        return Texel{(plan.low_m[at] - heights.lowest) / height_m, (plan.high_m[at] - heights.lowest) / height_m,
                     plan.coverage[at]};
    };
    // Cells beside the interior get the mean heights of their covered neighbours, so that linear
    // filtering changes only the coverage across the outline.
    const auto with_neighbours = [&](int column, int row) {
        Texel mean;
        int covered = 0;
        for (int j = row - 1; j <= row + 1; ++j)
            for (int i = column - 1; i <= column + 1; ++i)
                if (const Texel near = cell(i, j); near.coverage > 0) {
                    mean.low += near.low;
                    mean.high += near.high;
                    ++covered;
                }
        if (covered > 0) mean.low /= static_cast<float>(covered), mean.high /= static_cast<float>(covered);
        return mean;
    };
    for (int row = -1; row <= rows_; ++row)
        for (int column = -1; column <= columns_; ++column) {
            const Texel own = cell(column, row);
            texels_.push_back(own.coverage > 0 ? own : with_neighbours(column, row));
        }
}

bool ExclusionMap::contains(const glm::dvec3& point_m) const {
    const glm::dvec3 in_box = (point_m - lower_m_) / size_m_;
    for (int axis = 0; axis < 3; ++axis)
        if (!(in_box[axis] >= 0 && in_box[axis] <= 1)) return false;
    // Centres of texels are at whole numbers.
    const double x = in_box.x * columns_ + 0.5, z = in_box.z * rows_ + 0.5;
    const int column = std::min(static_cast<int>(x), columns_), row = std::min(static_cast<int>(z), rows_);
    const auto along_row = [&](int from_row, auto member) {
        const Texel* const first =
            &texels_[static_cast<std::size_t>(from_row) * static_cast<std::size_t>(columns_ + 2) +
                     static_cast<std::size_t>(column)];
        return glm::mix(static_cast<double>(first[0].*member), static_cast<double>(first[1].*member), x - column);
    };
    const auto filtered = [&](auto member) {
        return glm::mix(along_row(row, member), along_row(row + 1, member), z - row);
    };
    return filtered(&Texel::coverage) > 0.5 && in_box.y > filtered(&Texel::low) && in_box.y < filtered(&Texel::high);
}

std::string check(std::span<const Exclusion> exclusions, std::size_t maps) {
    if (exclusions.size() > max_exclusions)
        return "DrawInput::exclusions has " + std::to_string(exclusions.size()) + " elements, expected at most " +
               std::to_string(max_exclusions);
    for (std::size_t i = 0; i < exclusions.size(); ++i) {
        const std::string name = "DrawInput::exclusions[" + std::to_string(i) + "]";
        const Exclusion& exclusion = exclusions[i];
        if (exclusion.map >= maps)
            return name + ".map is " + std::to_string(exclusion.map) + ", expected less than the number of maps, " +
                   std::to_string(maps);
        if (!is_finite(exclusion.position_m)) return name + ".position_m is not finite";
        if (!(std::abs(glm::length(exclusion.orientation) - 1) <= 1e-3))
            return name + ".orientation is not a unit quaternion";
    }
    return {};
}

}  // namespace pelagic::gl
