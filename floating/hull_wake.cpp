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

/// Fraction of a tick by which a frame may miss it, as for DynamicWaves.
constexpr double clock_slack = 0x1p-16;
constexpr double fastest_mps = 1000;  // of footprints

}  // namespace

HullWake::HullWake(DynamicWaves& waves, const Hull& hull) : waves_(&waves), hull_(&hull) {
    const double texel_m = waves.options().side_m / waves.options().resolution;
    const glm::dvec3 size = hull.mesh().upper_m() - hull.mesh().lower_m();
    plan_ = plan_of(hull.mesh(), cells(size.x, texel_m), cells(size.z, texel_m));
    next_.columns = plan_.columns;
    next_.rows = plan_.rows;
    next_.length_m = plan_.length_m;
    next_.beam_m = plan_.beam_m;
    next_.depth_m.assign(plan_.low_m.size(), 0);
    depth_before_m_ = next_.depth_m;
    acted_.fill(next_);
}

HullWake::HullWake(DynamicWaves& waves, const Hull& hull, const HullState& state) : HullWake(waves, hull) {
    launch(state);
}

void HullWake::launch(const HullState& state) {
    hull_m_ = pressure_m_ = state.position_m;
    next_.x_m = state.position_m.x;
    next_.z_m = state.position_m.z;
    source_ = waves_->add_footprint(next_);
}

double HullWake::period_s() const { return std::sqrt(two_pi * plan_.length_m / gravity_mps2); }

double HullWake::launch_s() const { return 4 * period_s(); }

/// Time constant with which the pressure follows the submerged hull. A short one would let the hull
/// follow the water that its own change of draught moves, whose inertia is already its added mass,
/// and the two would excite each other.
double HullWake::shape_s() const { return 4 * period_s(); }

/// Fraction of the pressure.
double HullWake::launched_at(double afloat_s) const {
    const double fraction = std::clamp(afloat_s / launch_s(), 0.0, 1.0);
    return fraction * fraction * (3 - 2 * fraction);
}

/// Depth of the hull in each cell: from the lowest point to the water's mean surface or the highest
/// point, along the hull's own vertical, scaled to the displaced volume.
void HullWake::shape(PressureFootprint& footprint, const HullState& state, const HullLoads& loads, double step_s) {
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    const double across = std::sqrt(axes[0].x * axes[0].x + axes[0].z * axes[0].z);
    if (across > 1e-3) {  // else the hull stands on its bow or stern, and keeps its last heading
        footprint.forward_x = axes[0].x / across;
        footprint.forward_z = axes[0].z / across;
    }
    const double launched_before = launched_at(afloat_s_ - step_s), launched = launched_at(afloat_s_);
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
        const double surface = loads.water_height_m + loads.water_slope_x * at.x + loads.water_slope_z * at.z;
        const double waterline = (surface - state.position_m.y - at.y) / slant;
        const double low = plan_.low_m[cell], high = plan_.high_m[cell];
        const double wet =
            slant > 0 ? std::clamp(waterline - low, 0.0, high - low) : std::clamp(high - waterline, 0.0, high - low);
        return plan_.coverage[cell] * wet;
    };
    depth_before_m_ = footprint.depth_m;
    for (int row = 0; row < plan_.rows; ++row)
        for (int column = 0; column < plan_.columns; ++column) {
            const double depth = depth_of(column, row);
            footprint.depth_m[static_cast<std::size_t>(row * plan_.columns + column)] = static_cast<float>(depth);
            volume += depth;
        }
    const double cell_m2 = plan_.length_m * plan_.beam_m / (plan_.columns * plan_.rows);
    // At most the weight, because a hull that its own wave lowers would make a still larger wave.
    const double scale =
        volume > 0 ? launched * std::min(loads.displaced_m3, hull_->floating_m3()) / (volume * cell_m2) : 0;
    // The first step of the hull comes after its first pressure, which is 0 then.
    const bool presses = launched_before > 0 && std::any_of(depth_before_m_.begin(), depth_before_m_.end(),
                                                            [](float depth) { return depth > 0; });
    const double growth = presses ? launched / launched_before : 0;
    const double part = presses ? step_s / (step_s + shape_s()) : 1;
    double pressed = 0;
    for (std::size_t i = 0; i < footprint.depth_m.size(); ++i) {
        const double before = growth * depth_before_m_[i], now = scale * footprint.depth_m[i];
        footprint.depth_m[i] = static_cast<float>(std::clamp(before + part * (now - before), 0.0, 100.0));
        pressed += footprint.depth_m[i] * cell_m2;
    }
    // A hull in the air presses on nothing.
    if (pressed > loads.displaced_m3)
        for (float& depth : footprint.depth_m) depth = static_cast<float>(depth * (loads.displaced_m3 / pressed));
}

HullWake::FrameTick HullWake::tick_of(double time_s) const {
    const std::int64_t tick = waves_->tick_at(time_s);
    const double fraction = time_s * waves_->options().ticks_per_s - static_cast<double>(tick);
    return {tick, fraction < clock_slack ? 0 : fraction};
}

/// Returns the footprint of a tick, at most two before the last one.
HullWake::ActingFootprint HullWake::acting_at(std::int64_t tick) const {
    if (tick > tick_) return {&next_, static_cast<double>(tick - tick_ - 1) / waves_->options().ticks_per_s};
    return {&acted_[static_cast<std::size_t>(std::min<std::int64_t>(tick_ - tick, 2))], 0};
}

void HullWake::keep_acted(std::int64_t tick) {
    const std::int64_t passed = tick - tick_;
    if (passed <= 0) return;
    const auto acted = static_cast<std::size_t>(std::min<std::int64_t>(passed, 3));
    std::rotate(acted_.begin(), acted_.end() - acted, acted_.end());
    for (std::size_t before = 0; before < acted; ++before)
        acting_at(tick - static_cast<std::int64_t>(before)).copy_to(acted_[before]);
}

void HullWake::ActingFootprint::copy_to(PressureFootprint& moved) const {
    moved = *footprint;
    moved.x_m += moved_s * moved.velocity_x_mps;
    moved.z_m += moved_s * moved.velocity_z_mps;
}

void HullWake::press(const Frame& frame, const HullState& state, const HullLoads& loads, double step_s) {
    const FrameTick now = tick_of(frame.time_s);
    if (afloat_s_ > 0) keep_acted(now.tick);
    tick_ = now.tick;
    afloat_s_ += step_s;
    // the current carries the grid, too
    const glm::dvec3 current(frame.water_frame.current_x_mps, 0, frame.water_frame.current_z_mps);
    const glm::dvec3 pressure_before_m = pressure_m_;
    pressure_m_ += state.position_m - hull_m_ - step_s * (loads.water_velocity_mps - current);
    pressure_m_ += std::min(step_s / return_s, 1.0) * (state.position_m - pressure_m_);
    hull_m_ = state.position_m;
    const glm::dvec3 velocity_mps = (pressure_m_ - pressure_before_m) / step_s;
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    const glm::dvec3 middle = axes * (glm::dvec3(plan_.x_m, 0, plan_.z_m) - hull_->centre_of_mass_m());
    // The next tick shows the hull as it was at the last one.
    const double since_tick_s = now.fraction / waves_->options().ticks_per_s;
    next_.x_m = pressure_m_.x + middle.x - since_tick_s * velocity_mps.x;
    next_.z_m = pressure_m_.z + middle.z - since_tick_s * velocity_mps.z;
    next_.velocity_x_mps = std::clamp(velocity_mps.x, -fastest_mps, fastest_mps);
    next_.velocity_z_mps = std::clamp(velocity_mps.z, -fastest_mps, fastest_mps);
    shape(next_, state, loads, step_s);
    waves_->set_footprint(source_, next_);
}

/// Returns the depth that the grid shows: bilinear between its texels.
/// \param place_s  time of the footprint's tick
/// \param x_m, z_m  in the water's frame
double HullWake::hollow_m(const ActingFootprint& of, const WaterFrame& water, double place_s, double x_m,
                          double z_m) const {
    const double texel = waves_->options().side_m / waves_->options().resolution;
    WaterFrame::Origin origin = water.origin_at(place_s);
    origin.x_m -= of.moved_s * of.footprint->velocity_x_mps;
    origin.z_m -= of.moved_s * of.footprint->velocity_z_mps;
    const double i = std::floor(x_m / texel), j = std::floor(z_m / texel);
    const double right = x_m / texel - i, bottom = z_m / texel - j;
    const auto at = [&](double column, double row) {
        return depth_at(*of.footprint, column * texel + origin.x_m, row * texel + origin.z_m);
    };
    return (1 - bottom) * ((1 - right) * at(i, j) + right * at(i + 1, j)) +
           bottom * ((1 - right) * at(i, j + 1) + right * at(i + 1, j + 1));
}

void HullWake::leave_out(const Frame& frame, std::span<const double> x, std::span<const double> z,
                         std::span<float> height_m, std::span<float> velocity_y_mps) const {
    const WaterFrame& water = frame.water_frame;
    const WaterFrame::Origin origin = water.origin_at(frame.time_s);
    const FrameTick now = tick_of(frame.time_s);
    const ActingFootprint last[] = {acting_at(now.tick), acting_at(now.tick - 1), acting_at(now.tick - 2)};
    const double tick_s = 1.0 / waves_->options().ticks_per_s, now_s = frame.time_s - now.fraction * tick_s;
    const glm::dvec3 moved = pressure_m_ - hull_m_;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double at_x = x[i] - origin.x_m, at_z = z[i] - origin.z_m;
        const double in_x = at_x + moved.x, in_z = at_z + moved.z;
        const DynamicWavesSample here = sample(frame.dynamic_waves, at_x, at_z),
                                 there = sample(frame.dynamic_waves, in_x, in_z);
        double hollow[3];
        for (std::size_t tick = 0; tick < 3; ++tick)
            hollow[tick] = hollow_m(last[tick], water, now_s - static_cast<double>(tick) * tick_s, in_x, in_z);
        // as DynamicWavesView interpolates ticks
        const double change = hollow[0] - hollow[1], change_before = hollow[1] - hollow[2];
        const double depth_m = hollow[1] + now.fraction * change;
        const double sinking_mps = (change + (now.fraction - 0.5) * (change - change_before)) / tick_s;
        height_m[i] = static_cast<float>(height_m[i] + there.height_m - here.height_m + depth_m);
        velocity_y_mps[i] = static_cast<float>(velocity_y_mps[i] + there.vertical_velocity_mps -
                                               here.vertical_velocity_mps + sinking_mps);
    }
}

}  // namespace pelagic
