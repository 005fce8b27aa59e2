#include "pelagic/sim/pressure_footprint.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/numeric_field.hpp"

namespace pelagic {
namespace {

using Footprint = PressureFootprint;
constexpr NumericField<Footprint> footprint_field_table[] = {
    {"x_m", &Footprint::x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"z_m", &Footprint::z_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"velocity_x_mps", &Footprint::velocity_x_mps, -1000, 1000, "[-1000, 1000]"},
    {"velocity_z_mps", &Footprint::velocity_z_mps, -1000, 1000, "[-1000, 1000]"},
    {"length_m", &Footprint::length_m, 0.001, 1000, "[0.001, 1000]"},
    {"beam_m", &Footprint::beam_m, 0.001, 1000, "[0.001, 1000]"},
    {"columns", &Footprint::columns, 1, Footprint::max_columns, "[1, 64]"},
    {"rows", &Footprint::rows, 1, Footprint::max_rows, "[1, 64]"},
};

}  // namespace

DepthAndSlope depth_and_slope_at(const PressureFootprint& of, double x_m, double z_m) {
    const double x = x_m - of.x_m, z = z_m - of.z_m;
    const double column = ((x * of.forward_x + z * of.forward_z) / of.length_m + 0.5) * of.columns - 0.5;
    const double row = ((z * of.forward_x - x * of.forward_z) / of.beam_m + 0.5) * of.rows - 0.5;
    if (!(column > -1 && column < of.columns && row > -1 && row < of.rows)) return {};
    const int left = static_cast<int>(std::floor(column)), top = static_cast<int>(std::floor(row));
    const double right_part = column - left, bottom_part = row - top;
    const auto cell = [&](int i, int j) -> double {
        if (i < 0 || i >= of.columns || j < 0 || j >= of.rows) return 0;
        return of.depth_m[static_cast<std::size_t>(j * of.columns + i)];
    };
    const double a = cell(left, top), b = cell(left + 1, top), c = cell(left, top + 1), d = cell(left + 1, top + 1);
    const double upper = (1 - right_part) * a + right_part * b, lower = (1 - right_part) * c + right_part * d;
    const double ahead = of.columns / of.length_m * ((1 - bottom_part) * (b - a) + bottom_part * (d - c));
    const double abeam = of.rows / of.beam_m * (lower - upper);
    return {(1 - bottom_part) * upper + bottom_part * lower, of.forward_x * ahead - of.forward_z * abeam,
            of.forward_z * ahead + of.forward_x * abeam};
}

double depth_at(const PressureFootprint& of, double x_m, double z_m) {
    return depth_and_slope_at(of, x_m, z_m).depth_m;
}

std::string check(const PressureFootprint& footprint) {
    if (std::string reason = check_fields(footprint, footprint_field_table); !reason.empty()) return reason;
    const double length = footprint.forward_x * footprint.forward_x + footprint.forward_z * footprint.forward_z;
    if (!(std::fabs(length - 1) <= 1e-6))
        return "forward_x, forward_z is not a unit vector, its square is " + number_text(length);
    const auto cells = static_cast<std::size_t>(footprint.columns * footprint.rows);
    if (footprint.depth_m.size() != cells)
        return invalid_value_message("depth_m's size", footprint.depth_m.size(),
                                     "columns x rows, " + number_text(cells));
    for (const float depth : footprint.depth_m)
        if (!(depth >= 0 && depth <= 100)) return invalid_value_message("depth_m", depth, "[0, 100] m");
    return {};
}

}  // namespace pelagic
