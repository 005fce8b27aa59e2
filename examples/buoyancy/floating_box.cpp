#include "pelagic/examples/buoyancy/floating_box.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "pelagic/examples/buoyancy/box_wake.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::buoyancy {
namespace {

constexpr glm::dvec3 up{0, 1, 0};

/// Returns the added mass of a plate that moves along its normal in unbounded water, sides a <= b:
/// rho pi/4 a^2 b (Newman, Marine Hydrodynamics, 1977, table 4.3), times b / (b + 0.7 a) for its
/// ends. The result is within 3 % of the table of DNV-RP-C205, appendix D.
double plate_added_mass_kg(double side_m, double other_m) {
    const double a = std::min(side_m, other_m), b = std::max(side_m, other_m);
    return water_density_kgpm3 * std::numbers::pi / 4 * a * a * b * b / (b + 0.7 * a);
}

}  // namespace

std::string check(const BoxOptions& box) {
    if (!(box.length_m > 0 && box.length_m <= 1000))
        return invalid_value_message("length_m", box.length_m, "(0, 1000]");
    if (!(box.height_m > 0 && box.height_m <= 1000))
        return invalid_value_message("height_m", box.height_m, "(0, 1000]");
    if (!(box.beam_m > 0 && box.beam_m <= 1000)) return invalid_value_message("beam_m", box.beam_m, "(0, 1000]");
    const double max_kg = water_density_kgpm3 * box.length_m * box.height_m * box.beam_m;
    if (!(box.mass_kg > 0 && box.mass_kg < max_kg))
        return invalid_value_message("mass_kg", box.mass_kg, "(0, " + number_text(max_kg) + ") to float");
    if (!(std::fabs(box.centre_of_mass_m) <= box.height_m / 2))
        return invalid_value_message("centre_of_mass_m", box.centre_of_mass_m, "at most half the height");
    if (box.inertia_kgm2)
        for (int axis = 0; axis < 3; ++axis)
            if (!((*box.inertia_kgm2)[axis] > 0 && std::isfinite((*box.inertia_kgm2)[axis])))
                return invalid_value_message("inertia_kgm2", (*box.inertia_kgm2)[axis], "a positive number");
    if (!(box.heave_damping >= 0 && box.heave_damping < 1))
        return invalid_value_message("heave_damping", box.heave_damping, "[0, 1)");
    if (!(box.drag_coefficient >= 0 && box.drag_coefficient <= 10))
        return invalid_value_message("drag_coefficient", box.drag_coefficient, "[0, 10]");
    return {};
}

FloatingBox::FloatingBox(const BoxOptions& options)
    : options_(options), size_m_(options.length_m, options.height_m, options.beam_m) {
    if (const std::string problem = check(options); !problem.empty()) throw std::invalid_argument(problem);
    const glm::dvec3 squared = size_m_ * size_m_;
    inertia_kgm2_ = options.inertia_kgm2.value_or(
        options.mass_kg / 12 * glm::dvec3(squared.y + squared.z, squared.z + squared.x, squared.x + squared.y));
    face_m2_ = {size_m_.y * size_m_.z, size_m_.z * size_m_.x, size_m_.x * size_m_.y};
    added_mass_kg_ = {plate_added_mass_kg(size_m_.y, size_m_.z), plate_added_mass_kg(size_m_.z, size_m_.x),
                      plate_added_mass_kg(size_m_.x, size_m_.y)};
    submerged_afloat_ = options.mass_kg / (water_density_kgpm3 * face_m2_.y * size_m_.y);
    floating_height_m_ = size_m_.y / 2 + options.centre_of_mass_m - submerged_afloat_ * size_m_.y;
    state_.position_m.y = floating_height_m_;
    wave_damping_ = 2 * options.heave_damping * heave_frequency_radps() * (options.mass_kg + heave_added_mass_kg());
    cut_columns();
}

double FloatingBox::heave_added_mass_kg() const { return submerged_afloat_ * added_mass_kg_.y; }

double FloatingBox::heave_frequency_radps() const {
    return std::sqrt(water_density_kgpm3 * gravity_mps2 * face_m2_.y / (options_.mass_kg + heave_added_mass_kg()));
}

void FloatingBox::cut_columns() {
    axes_ = glm::mat3_cast(state_.orientation);
    along_ = 1;  // the height axis has priority
    for (const int axis : {0, 2})
        if (std::fabs(axes_[axis].y) > std::fabs(axes_[along_].y)) along_ = axis;
    upward_ = axes_[along_] * (axes_[along_].y < 0 ? -1.0 : 1.0);
    across_a_ = columns_across[(along_ + 1) % 3];
    across_b_ = columns_across[(along_ + 2) % 3];
}

/// Returns the middle of a column relative to the centre of mass.
glm::dvec3 FloatingBox::column_middle(std::size_t column) const {
    const int a = (along_ + 1) % 3, b = (along_ + 2) % 3;
    const double at_a = (static_cast<double>(column % across_a_) + 0.5) / static_cast<double>(across_a_) - 0.5;
    const double at_b = (static_cast<double>(column / across_a_) + 0.5) / static_cast<double>(across_b_) - 0.5;
    return axes_[a] * (at_a * size_m_[a]) + axes_[b] * (at_b * size_m_[b]) - axes_[1] * options_.centre_of_mass_m;
}

void FloatingBox::append_places(HullWater& hull) const {
    // Columns cross the surface on average at the waterline of the box at rest.
    const glm::dvec3 waterline = upward_ * ((submerged_afloat_ - 0.5) * size_m_[along_]);
    for (std::size_t column = 0; column < column_count(); ++column) {
        const glm::dvec3 place = state_.position_m + column_middle(column) + waterline;
        hull.x.push_back(place.x);
        hull.z.push_back(place.z);
    }
}

void FloatingBox::move(const HullWater& hull, std::size_t first, double step_s) {
    const std::size_t count = column_count();
    const double share = 1 / static_cast<double>(count);  // a column's fraction of the box
    const auto water_velocity = [&](std::size_t column) {
        return glm::dvec3(hull.velocity_x_mps[first + column], hull.velocity_y_mps[first + column],
                          hull.velocity_z_mps[first + column]);
    };
    glm::dvec3 mean_velocity{};
    for (std::size_t column = 0; column < count; ++column) mean_velocity += share * water_velocity(column);
    const glm::dvec3 acceleration = (mean_velocity - water_velocity_mps_.value_or(mean_velocity)) / step_s;
    water_velocity_mps_ = mean_velocity;

    const double box_kg = water_density_kgpm3 * face_m2_.y * size_m_.y;  // full of water
    const double rise = upward_.y * size_m_[along_];                     // height of a column
    double submerged = 0;
    glm::dvec3 force = -options_.mass_kg * gravity_mps2 * up, torque{};
    for (std::size_t column = 0; column < count; ++column) {
        const glm::dvec3 middle = column_middle(column);
        const double depth = hull.height_m[first + column] - (state_.position_m.y + middle.y - rise / 2);
        const double wet = std::clamp(depth / rise, 0.0, 1.0);
        if (wet == 0) continue;
        submerged += share * wet;
        // To the middle of the submerged section.
        const glm::dvec3 arm = middle + upward_ * ((wet - 1) / 2 * size_m_[along_]);
        const glm::dvec3 relative = water_velocity(column) - state_.velocity_mps - glm::cross(state_.spin_radps, arm);
        const glm::dvec3 in_box = relative * axes_;  // multiplication by the transpose
        const glm::dvec3 drag =
            axes_ * (0.5 * water_density_kgpm3 * options_.drag_coefficient * face_m2_ * glm::abs(in_box) * in_box) +
            wave_damping_ / submerged_afloat_ * relative.y * up;
        const glm::dvec3 pressure = box_kg * (gravity_mps2 * up + acceleration);
        const glm::dvec3 push = share * wet * (pressure + drag);
        force += push;
        torque += glm::cross(arm, push);
    }
    displaced_kg_ = submerged * box_kg;

    // A plate at the surface has water on one side only, which halves its added mass. Between the
    // two cases the mass is proportional to the submerged fraction.
    const glm::dvec3 added = submerged * added_mass_kg_;
    const glm::dvec3 force_in_box = force * axes_ + added * (acceleration * axes_);
    state_.velocity_mps += step_s * (axes_ * (force_in_box / (options_.mass_kg + added)));
    state_.position_m += step_s * state_.velocity_mps;

    glm::dvec3 spin = state_.spin_radps * axes_;
    spin += step_s * (torque * axes_ - glm::cross(spin, inertia_kgm2_ * spin)) / inertia_kgm2_;
    state_.spin_radps = axes_ * spin;
    const glm::dquat rotated =
        state_.orientation + 0.5 * step_s * (glm::dquat(0, state_.spin_radps) * state_.orientation);
    state_.orientation = rotated / std::sqrt(glm::dot(rotated, rotated));
}

void step(std::span<FloatingBox> boxes, const SurfaceQuery& water, double step_s, HullWater& hull) {
    step(boxes, water, step_s, hull, {});
}

void step(std::span<FloatingBox> boxes, const SurfaceQuery& water, double step_s, HullWater& hull,
          std::span<const BoxWake> wakes) {
    assert(wakes.empty() || wakes.size() == boxes.size());
    hull.x.clear();
    hull.z.clear();
    for (FloatingBox& box : boxes) {
        box.cut_columns();
        box.append_places(hull);
    }
    for (auto* values : {&hull.height_m, &hull.velocity_x_mps, &hull.velocity_y_mps, &hull.velocity_z_mps})
        values->resize(hull.x.size());
    water.sample({.x = hull.x, .z = hull.z}, {.height_m = hull.height_m,
                                              .velocity_x_mps = hull.velocity_x_mps,
                                              .velocity_y_mps = hull.velocity_y_mps,
                                              .velocity_z_mps = hull.velocity_z_mps});
    std::size_t first = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const std::size_t columns = boxes[i].column_count();
        if (!wakes.empty()) wakes[i].leave_out(hull, first, columns, step_s);
        boxes[i].move(hull, first, step_s);
        first += columns;
    }
}

}  // namespace pelagic::buoyancy
