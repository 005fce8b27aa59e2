#include "pelagic/floating/hull_wake.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "pelagic/simd/constants.hpp"

namespace pelagic {
namespace {

/// Returns the number of cells for a size: at least a texel each, so that a pressure that moves
/// over the texels keeps its volume.
int cells(double size_m, double texel_m) {
    return static_cast<int>(std::clamp(std::floor(size_m / texel_m), 1.0, 64.0));
}

}  // namespace

HullWake::HullWake(DynamicWaves& waves, const Hull& hull) : waves_(&waves), hull_(&hull) {
    const double texel_m = waves.options().side_m / waves.options().resolution;
    const glm::dvec3 size = hull.mesh().upper_m() - hull.mesh().lower_m();
    plan_ = plan_of(hull.mesh(), cells(size.x, texel_m), cells(size.z, texel_m));
    for (PressureFootprint& footprint : footprints_) {
        footprint.columns = plan_.columns;
        footprint.rows = plan_.rows;
        footprint.length_m = plan_.length_m;
        footprint.beam_m = plan_.beam_m;
        footprint.depth_m.assign(plan_.low_m.size(), 0);
    }
}

HullWake::HullWake(DynamicWaves& waves, const Hull& hull, const HullState& state) : HullWake(waves, hull) {
    launch(state);
}

void HullWake::launch(const HullState& state) {
    hull_m_ = pressure_m_ = state.position_m;
    for (PressureFootprint& footprint : footprints_) {
        footprint.x_m = state.position_m.x;
        footprint.z_m = state.position_m.z;
    }
    source_ = waves_->add_footprint(footprints_[0]);
}

double HullWake::period_s() const { return std::sqrt(two_pi * plan_.length_m / gravity_mps2); }

double HullWake::launch_s() const { return 4 * period_s(); }

/// Depth of the hull in each cell: from the lowest point to the water's mean surface or the highest
/// point, along the hull's own vertical, scaled to the displaced volume.
void HullWake::shape(PressureFootprint& footprint, const HullState& state, const HullLoads* loads) const {
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    const double across = std::sqrt(axes[0].x * axes[0].x + axes[0].z * axes[0].z);
    if (across > 1e-3) {  // else the hull stands on its bow or stern, and keeps its last heading
        footprint.forward_x = axes[0].x / across;
        footprint.forward_z = axes[0].z / across;
    }
    const double fraction = std::min(afloat_s_ / launch_s(), 1.0),
                 launched = fraction * fraction * (3 - 2 * fraction);
    const glm::dvec3 middle = axes * (glm::dvec3(plan_.x_m, 0, plan_.z_m) - hull_->centre_of_mass_m());
    footprint.x_m = pressure_m_.x + middle.x;
    footprint.z_m = pressure_m_.z + middle.z;
    const double upright = axes[1].y;
    // A hull on its side has no columns along its own vertical: the limit leaves its volume to the
    // scale below.
    const double slant = std::copysign(std::max(std::fabs(upright), 0.2), upright);
    double volume = 0;
    const auto depth_of = [&](int column, int row) {
        const auto cell = static_cast<std::size_t>(row * plan_.columns + column);
        const glm::dvec3 foot = glm::dvec3(plan_.x_m + ((column + 0.5) / plan_.columns - 0.5) * plan_.length_m, 0,
                                           plan_.z_m + ((row + 0.5) / plan_.rows - 0.5) * plan_.beam_m) -
                                hull_->centre_of_mass_m();
        const glm::dvec3 at = axes * foot;
        const double surface = loads->water_height_m + loads->water_slope_x * at.x + loads->water_slope_z * at.z;
        const double waterline = (surface - state.position_m.y - at.y) / slant;
        const double low = plan_.low_m[cell], high = plan_.high_m[cell];
        const double wet =
            slant > 0 ? std::clamp(waterline - low, 0.0, high - low) : std::clamp(high - waterline, 0.0, high - low);
        return plan_.coverage[cell] * wet;
    };
    for (int row = 0; row < plan_.rows; ++row)
        for (int column = 0; column < plan_.columns; ++column) {
            const double depth = loads ? depth_of(column, row) : 0;
            footprint.depth_m[static_cast<std::size_t>(row * plan_.columns + column)] = static_cast<float>(depth);
            volume += depth;
        }
    volume *= plan_.length_m * plan_.beam_m / (plan_.columns * plan_.rows);
    const double scale = volume > 0 ? launched * loads->displaced_m3 / volume : 0;
    // Without a delay the hull would follow the water that its own change of draught moves, whose
    // inertia is already its added mass, and the two would excite each other.
    const double part = tick_s_ / (tick_s_ + period_s() / 3);
    for (std::size_t i = 0; i < footprint.depth_m.size(); ++i) {
        const double before = footprints_[1].depth_m[i];
        footprint.depth_m[i] =
            static_cast<float>(std::clamp(before + part * (scale * footprint.depth_m[i] - before), 0.0, 100.0));
    }
}

void HullWake::press(const Frame& frame, const HullState& state, const HullLoads& loads, double tick_s) {
    afloat_s_ += tick_s;
    tick_s_ = tick_s;
    // the current carries the grid, too
    const glm::dvec3 current(frame.water_frame.current_x_mps, 0, frame.water_frame.current_z_mps);
    pressure_m_ += state.position_m - hull_m_ - tick_s * (loads.water_velocity_mps - current);
    pressure_m_ += std::min(tick_s / return_s, 1.0) * (state.position_m - pressure_m_);
    hull_m_ = state.position_m;
    std::rotate(footprints_.begin(), footprints_.begin() + 2, footprints_.end());
    footprints_[0].forward_x = footprints_[1].forward_x;
    footprints_[0].forward_z = footprints_[1].forward_z;
    shape(footprints_[0], state, &loads);
    waves_->set_footprint(source_, footprints_[0]);
}

/// Returns the depth that the grid shows: bilinear between its texels.
/// \param place_s  time at which the footprint acted
/// \param x_m, z_m  in the water's frame
double HullWake::hollow_m(const PressureFootprint& footprint, const WaterFrame& water, double place_s, double x_m,
                          double z_m) const {
    const double texel = waves_->options().side_m / waves_->options().resolution;
    const WaterFrame::Origin origin = water.origin_at(place_s);
    const double i = std::floor(x_m / texel), j = std::floor(z_m / texel);
    const double right = x_m / texel - i, bottom = z_m / texel - j;
    const auto at = [&](double column, double row) {
        return depth_at(footprint, column * texel + origin.x_m, row * texel + origin.z_m);
    };
    return (1 - bottom) * ((1 - right) * at(i, j) + right * at(i + 1, j)) +
           bottom * ((1 - right) * at(i, j + 1) + right * at(i + 1, j + 1));
}

void HullWake::leave_out(const Frame& frame, std::span<const double> x, std::span<const double> z,
                         std::span<float> height_m, std::span<float> velocity_y_mps) const {
    const WaterFrame& water = frame.water_frame;
    const WaterFrame::Origin origin = water.origin_at(frame.time_s);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double in_x = x[i] - origin.x_m, in_z = z[i] - origin.z_m;
        const double before = hollow_m(footprints_[2], water, frame.time_s - tick_s_, in_x, in_z);
        const double after = hollow_m(footprints_[1], water, frame.time_s, in_x, in_z);
        height_m[i] = static_cast<float>(height_m[i] + before);
        if (tick_s_ > 0) velocity_y_mps[i] = static_cast<float>(velocity_y_mps[i] + (after - before) / tick_s_);
    }
}

}  // namespace pelagic
