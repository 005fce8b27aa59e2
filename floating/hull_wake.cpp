#include "pelagic/floating/hull_wake.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Returns the number of cells for a size: at least two texels each, so that a pressure that moves
/// over the texels keeps its volume and makes no waves that the grid cannot carry.
int cells(double size_m, double texel_m) {
    return static_cast<int>(std::clamp(std::floor(size_m / (2 * texel_m)), 1.0, 64.0));
}

/// Fraction of a tick by which a frame may miss it, as for DynamicWaves.
constexpr double clock_slack = 0x1p-16;
constexpr double fastest_mps = 1000;  // of footprints
constexpr double longest_s = 1e6;     // between calls; more counts as this

/// A footprint for many positions: depth_and_slope_at() with what does not depend on them computed
/// once.
class FootprintSampler {
   public:
    FootprintSampler() = default;
    /// \param origin_x_m  added to positions, and origin_z_m
    FootprintSampler(const PressureFootprint& of, double origin_x_m, double origin_z_m)
        : depth_m_(of.depth_m.data()),
          columns_(of.columns),
          rows_(of.rows),
          from_x_m_(origin_x_m - of.x_m),
          from_z_m_(origin_z_m - of.z_m),
          forward_x_(of.forward_x),
          forward_z_(of.forward_z),
          columns_per_m_(of.columns / of.length_m),
          rows_per_m_(of.rows / of.beam_m),
          middle_column_((of.columns - 1) / 2.0),
          middle_row_((of.rows - 1) / 2.0) {}

    double depth_at(double x_m, double z_m) const {
        const Place at = place_of(x_m, z_m);
        if (!at.is_inside) return 0;
        const Corners corners(*this, at);
        return (1 - at.bottom) * corners.upper(at) + at.bottom * corners.lower(at);
    }
    DepthAndSlope depth_and_slope_at(double x_m, double z_m) const {
        const Place at = place_of(x_m, z_m);
        if (!at.is_inside) return {};
        const Corners corners(*this, at);
        const double upper = corners.upper(at), lower = corners.lower(at);
        const double ahead = columns_per_m_ * ((1 - at.bottom) * (corners.b - corners.a) +
                                               at.bottom * (corners.d - corners.c));
        const double abeam = rows_per_m_ * (lower - upper);
        return {(1 - at.bottom) * upper + at.bottom * lower, forward_x_ * ahead - forward_z_ * abeam,
                forward_z_ * ahead + forward_x_ * abeam};
    }

   private:
    /// A cell, from -1, and the position towards the next one.
    struct Place {
        bool is_inside = false;
        int column = 0, row = 0;
        double right = 0, bottom = 0;
    };
    Place place_of(double x_m, double z_m) const {
        const double x = x_m + from_x_m_, z = z_m + from_z_m_;
        const double column = (x * forward_x_ + z * forward_z_) * columns_per_m_ + middle_column_;
        const double row = (z * forward_x_ - x * forward_z_) * rows_per_m_ + middle_row_;
        if (!(column > -1 && column < columns_ && row > -1 && row < rows_)) return {};
        // Positive numbers are cut, which is faster than to floor.
        const int i = static_cast<int>(column + 1) - 1, j = static_cast<int>(row + 1) - 1;
        return {true, i, j, column - i, row - j};
    }
    struct Corners {
        double a = 0, b = 0, c = 0, d = 0;

        Corners(const FootprintSampler& of, const Place& at) {
            if (static_cast<unsigned>(at.column) < static_cast<unsigned>(of.columns_ - 1) &&
                static_cast<unsigned>(at.row) < static_cast<unsigned>(of.rows_ - 1)) {
                const float* const cells = of.depth_m_ + at.row * of.columns_ + at.column;
                a = cells[0], b = cells[1], c = cells[of.columns_], d = cells[of.columns_ + 1];
                return;
            }
            const bool has_left = at.column >= 0, has_right = at.column + 1 < of.columns_;
            const auto read = [&](int row, double& left, double& right) {
                if (row < 0 || row >= of.rows_) return;
                const float* const line = of.depth_m_ + row * of.columns_;
                if (has_left) left = line[at.column];
                if (has_right) right = line[at.column + 1];
            };
            read(at.row, a, b);
            read(at.row + 1, c, d);
        }
        double upper(const Place& at) const { return (1 - at.right) * a + at.right * b; }
        double lower(const Place& at) const { return (1 - at.right) * c + at.right * d; }
    };

    const float* depth_m_ = nullptr;
    int columns_ = 0, rows_ = 0;
    double from_x_m_ = 0, from_z_m_ = 0, forward_x_ = 1, forward_z_ = 0;
    double columns_per_m_ = 1, rows_per_m_ = 1, middle_column_ = 0, middle_row_ = 0;
};

/// Members of DynamicWavesSample.
struct HeightAndVelocity {
    double height_m = 0, velocity_mps = 0;
};

/// As sample(), without slopes and foam, which take most of its time.
HeightAndVelocity height_and_velocity_at(const DynamicWavesView& view, double x_m, double z_m) {
    if (!view) return {};
    const double u = x_m / view.texel_m - static_cast<double>(view.first_x);
    const double v = z_m / view.texel_m - static_cast<double>(view.first_z);
    const double end = view.resolution - 2;
    if (!(u >= 1 && v >= 1 && u < end && v < end)) return {};
    const double column = std::floor(u), row = std::floor(v);
    const std::size_t last = static_cast<std::size_t>(view.resolution) - 1;
    const auto first = [last](std::int64_t of_grid, double number) {
        return static_cast<std::size_t>(of_grid + static_cast<std::int64_t>(number)) & last;
    };
    const std::size_t left = first(view.first_x, column), right = (left + 1) & last;
    const std::size_t upper = first(view.first_z, row), lower = (upper + 1) & last;
    const std::size_t above = upper * (last + 1), below = lower * (last + 1);
    const double along = u - column, across = v - row;
    const auto mixed = [&](std::span<const float> texels) {
        const auto between = [](double a, double b, double fraction) { return a + fraction * (b - a); };
        const auto texel = [&](std::size_t at) { return static_cast<double>(texels[at]); };
        return between(between(texel(above + left), texel(above + right), along),
                       between(texel(below + left), texel(below + right), along), across);
    };
    return {mixed(view.height_m), mixed(view.vertical_velocity_mps)};
}

}  // namespace

HullWake::HullWake(DynamicWaves& waves, const Hull& hull) : waves_(&waves), hull_(&hull) {
    const DefaultFloatEnvironment environment;
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
    const DefaultFloatEnvironment environment;
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
void HullWake::shape(PressureFootprint& footprint, const HullState& state, const HullLoads& loads, double tick_s) {
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    const double across = std::sqrt(axes[0].x * axes[0].x + axes[0].z * axes[0].z);
    if (across > 1e-3) {  // else the hull stands on its bow or stern, and keeps its last heading
        footprint.forward_x = axes[0].x / across;
        footprint.forward_z = axes[0].z / across;
    }
    const double launched_before = launched_at(afloat_s_ - tick_s), launched = launched_at(afloat_s_);
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
        volume > 0 ? launched * std::clamp(loads.displaced_m3, 0.0, hull_->floating_m3()) / (volume * cell_m2) : 0;
    // The first step of the hull comes after its first pressure, which is 0 then.
    const bool presses = launched_before > 0 && std::any_of(depth_before_m_.begin(), depth_before_m_.end(),
                                                            [](float depth) { return depth > 0; });
    const double growth = presses ? launched / launched_before : 0;
    const double part = presses ? tick_s / (tick_s + shape_s()) : 1;
    // Waves do not feel what lies deeper than half of their length, and the shortest that a hull
    // makes are as long as it is wide.
    const double deepest_m = std::min({plan_.length_m / 2, plan_.beam_m / 2, 100.0});
    double pressed = 0;
    for (std::size_t i = 0; i < footprint.depth_m.size(); ++i) {
        const double before = growth * depth_before_m_[i], now = scale * footprint.depth_m[i];
        footprint.depth_m[i] = static_cast<float>(std::clamp(before + part * (now - before), 0.0, deepest_m));
        pressed += footprint.depth_m[i] * cell_m2;
    }
    // A hull in the air presses on nothing. Steep water can make the displaced volume negative.
    const double displaced = std::max(loads.displaced_m3, 0.0);
    if (pressed > displaced)
        for (float& depth : footprint.depth_m) depth = static_cast<float>(depth * (displaced / pressed));
}

HullWake::FrameTick HullWake::tick_of(double time_s) const {
    const std::int64_t tick = waves_->tick_at(time_s);
    const double fraction = time_s * waves_->options().ticks_per_s - static_cast<double>(tick);
    return {tick, fraction < clock_slack ? 0 : fraction};
}

/// Returns the footprint of a tick, at most two before the last one.
/// \param now  tick of the frame: after a longer time than it computes, the grid leaves ticks out,
///     and footprints stand still in them
HullWake::ActingFootprint HullWake::acting_at(std::int64_t tick, std::int64_t now) const {
    if (tick <= tick_) return {&acted_[static_cast<std::size_t>(std::min<std::int64_t>(tick_ - tick, 2))], 0};
    const double rate = waves_->options().ticks_per_s;
    const auto left_out =
        std::max<std::int64_t>(0, now - tick_ - static_cast<std::int64_t>(DynamicWaves::max_jump_s * rate));
    return {&next_, static_cast<double>(std::max<std::int64_t>(0, tick - tick_ - 1 - left_out)) / rate};
}

void HullWake::keep_acted(std::int64_t tick) {
    const std::int64_t passed = tick - tick_;
    if (passed <= 0) return;
    const auto acted = static_cast<std::size_t>(std::min<std::int64_t>(passed, 3));
    std::rotate(acted_.begin(), acted_.end() - acted, acted_.end());
    for (std::size_t before = 0; before < acted; ++before)
        acting_at(tick - static_cast<std::int64_t>(before), tick).copy_to(acted_[before]);
}

void HullWake::ActingFootprint::copy_to(PressureFootprint& moved) const {
    moved = *footprint;
    moved.x_m += moved_s * moved.velocity_x_mps;
    moved.z_m += moved_s * moved.velocity_z_mps;
}

glm::dvec3 HullWake::middle_of_plan_m(const HullState& state) const {
    return glm::mat3_cast(state.orientation) * (glm::dvec3(plan_.x_m, 0, plan_.z_m) - hull_->centre_of_mass_m());
}

void HullWake::check_tick(double tick_s) {
    if (!(tick_s >= 0 && std::isfinite(tick_s)))
        throw std::invalid_argument(invalid_value_message("tick_s", tick_s, "[0, inf) s"));
}

void HullWake::press(const Frame& frame, const HullState& state, const HullLoads& loads, double tick_s) {
    const DefaultFloatEnvironment environment(tick_s);
    check_tick(tick_s);
    if (tick_s == 0) return;
    tick_s = std::min(tick_s, longest_s);
    const FrameTick now = tick_of(frame.time_s);
    if (afloat_s_ > 0) keep_acted(now.tick);
    tick_ = now.tick;
    afloat_s_ += tick_s;
    // the current carries the grid, too
    const glm::dvec3 current(frame.water_frame.current_x_mps, 0, frame.water_frame.current_z_mps);
    const glm::dvec3 pressure_before_m = pressure_m_;
    pressure_m_ += state.position_m - hull_m_ - tick_s * (loads.water_velocity_mps - current);
    pressure_m_ += std::min(tick_s / return_s, 1.0) * (state.position_m - pressure_m_);
    hull_m_ = state.position_m;
    const glm::dvec3 velocity_mps = (pressure_m_ - pressure_before_m) / tick_s;
    const glm::dvec3 middle = middle_of_plan_m(state);
    // The frame after the next tick shows that tick's water, whose hollow lies half a tick ahead of
    // the pressure.
    const double ahead_s = (1.5 - now.fraction) / waves_->options().ticks_per_s;
    next_.x_m = pressure_m_.x + middle.x + ahead_s * velocity_mps.x;
    next_.z_m = pressure_m_.z + middle.z + ahead_s * velocity_mps.z;
    next_.velocity_x_mps = std::clamp(velocity_mps.x, -fastest_mps, fastest_mps);
    next_.velocity_z_mps = std::clamp(velocity_mps.z, -fastest_mps, fastest_mps);
    shape(next_, state, loads, tick_s);
    waves_->set_footprint(source_, next_);
}

/// The hull's own hollow in the dynamic waves of a frame. Positions are in the water's frame.
struct HullWake::Hollow {
    const DynamicWavesOptions& options;
    const DynamicWavesView& view;
    double texel_m, tick_s, fraction;
    std::array<ActingFootprint, 4> last;   ///< of the next tick, of the last one, and before it
    std::array<FootprintSampler, 4> depth;  ///< of the water's positions
    /// Where the position of the last tick's footprint is that of the water's origin.
    WaterFrame::Origin pressed_origin;
    std::int64_t whole_from;  ///< texels from the grid's edge at which it shows the whole depth

    Hollow(const HullWake& wake, const Frame& frame)
        : options(wake.waves_->options()),
          view(frame.dynamic_waves),
          texel_m(wake.waves_->options().side_m / wake.waves_->options().resolution),
          tick_s(1.0 / wake.waves_->options().ticks_per_s),
          whole_from(static_cast<std::int64_t>(0.5 * options.border_m / texel_m) + 3) {
        const FrameTick now = wake.tick_of(frame.time_s);
        fraction = now.fraction;
        const double now_s = frame.time_s - now.fraction * tick_s;
        for (std::size_t i = 0; i < last.size(); ++i) {
            last[i] = wake.acting_at(now.tick + 1 - static_cast<std::int64_t>(i), now.tick);
            WaterFrame::Origin origin =
                frame.water_frame.origin_at(now_s + (1 - static_cast<double>(i)) * tick_s);
            origin.x_m -= last[i].moved_s * last[i].footprint->velocity_x_mps;
            origin.z_m -= last[i].moved_s * last[i].footprint->velocity_z_mps;
            depth[i] = FootprintSampler(*last[i].footprint, origin.x_m, origin.z_m);
            if (i == 1) pressed_origin = origin;
        }
    }

    /// Returns the part of a texel's depth that the frame shows; 0 outside the grid.
    double shown(std::int64_t x, std::int64_t z) const {
        const auto part = [&](std::int64_t texel, std::int64_t first) {
            const std::int64_t from_edge = std::min(texel - first, first + view.resolution - 1 - texel);
            return from_edge >= whole_from ? 1 : shown_part(options, from_edge);
        };
        return part(x, view.first_x) * part(z, view.first_z);
    }

    struct Depth {
        double depth_m = 0, sinking_mps = 0;
    };
    /// The hollow at a texel, as DynamicWavesView interpolates ticks. A pressure that moves once a
    /// tick is that of an even motion at the middle of the tick, so the hollow at its end is the mean
    /// of this tick's and the next one's.
    Depth at_texel(std::int64_t column, std::int64_t row) const {
        const double x = static_cast<double>(column) * texel_m, z = static_cast<double>(row) * texel_m;
        double at[4];
        for (std::size_t i = 0; i < depth.size(); ++i) at[i] = depth[i].depth_at(x, z);
        if (at[0] == 0 && at[1] == 0 && at[2] == 0 && at[3] == 0) return {};
        const double hollow[] = {(at[0] + at[1]) / 2, (at[1] + at[2]) / 2, (at[2] + at[3]) / 2};
        const double change = hollow[0] - hollow[1], change_before = hollow[1] - hollow[2];
        const double part = shown(column, row);
        return {part * (hollow[1] + fraction * change),
                part * ((change + (fraction - 0.5) * (change - change_before)) / tick_s)};
    }
};

/// Samples of a hollow. Vertices of a hull have texels in common, so each texel's hollow is kept in a
/// table by the last bits of its column and row, until another texel takes its place. The order of
/// samples does not change them.
class HullWake::HollowSampler {
   public:
    explicit HollowSampler(const Hollow& hollow) : hollow_(hollow) { column_.fill(none); }

    /// Bilinear between texels, as the grid.
    Hollow::Depth at(double x_m, double z_m) {
        const double u = x_m / hollow_.texel_m, v = z_m / hollow_.texel_m;
        const double column = std::floor(u), row = std::floor(v);
        if (!(std::fabs(column) < 0x1p40 && std::fabs(row) < 0x1p40)) return {};
        const double right = u - column, bottom = v - row;
        const auto i = static_cast<std::int64_t>(column), j = static_cast<std::int64_t>(row);
        const Hollow::Depth upper = between(texel(i, j), texel(i + 1, j), right);
        const Hollow::Depth lower = between(texel(i, j + 1), texel(i + 1, j + 1), right);
        return between(upper, lower, bottom);
    }

   private:
    static constexpr std::int64_t columns = 32, rows = 16;
    static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();

    static Hollow::Depth between(const Hollow::Depth& a, const Hollow::Depth& b, double fraction) {
        return {a.depth_m + fraction * (b.depth_m - a.depth_m),
                a.sinking_mps + fraction * (b.sinking_mps - a.sinking_mps)};
    }
    Hollow::Depth texel(std::int64_t column, std::int64_t row) {
        const auto place = static_cast<std::size_t>((row & (rows - 1)) * columns + (column & (columns - 1)));
        if (column_[place] != column || row_[place] != row) {
            column_[place] = column;
            row_[place] = row;
            depth_[place] = hollow_.at_texel(column, row);
        }
        return depth_[place];
    }

    const Hollow& hollow_;
    std::array<std::int64_t, columns * rows> column_, row_;
    std::array<Hollow::Depth, columns * rows> depth_;
};

void HullWake::leave_out(const Frame& frame, std::span<const double> x, std::span<const double> z,
                         std::span<float> height_m, std::span<float> velocity_y_mps,
                         std::span<double> wake_m, std::span<double> wake_up_mps) const {
    const std::size_t count = x.size();
    if (z.size() != count || height_m.size() != count || velocity_y_mps.size() != count ||
        !(wake_m.empty() || wake_m.size() == count) || !(wake_up_mps.empty() || wake_up_mps.size() == count))
        throw std::invalid_argument("x, z, height_m, velocity_y_mps, wake_m and wake_up_mps differ in length");
    const DefaultFloatEnvironment environment;
    const Hollow hollow(*this, frame);
    HollowSampler own_hollow(hollow);
    const WaterFrame::Origin origin = frame.water_frame.origin_at(frame.time_s);
    const glm::dvec3 moved = pressure_m_ - hull_m_;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double at_x = x[i] - origin.x_m, at_z = z[i] - origin.z_m;
        const double in_x = at_x + moved.x, in_z = at_z + moved.z;
        const HeightAndVelocity here = height_and_velocity_at(frame.dynamic_waves, at_x, at_z),
                                there = height_and_velocity_at(frame.dynamic_waves, in_x, in_z);
        const Hollow::Depth own = own_hollow.at(in_x, in_z);
        if (!wake_m.empty()) wake_m[i] = there.height_m + own.depth_m;
        if (!wake_up_mps.empty()) wake_up_mps[i] = there.velocity_mps + own.sinking_mps;
        height_m[i] = static_cast<float>(height_m[i] + there.height_m - here.height_m + own.depth_m);
        velocity_y_mps[i] =
            static_cast<float>(velocity_y_mps[i] + there.velocity_mps - here.velocity_mps + own.sinking_mps);
    }
}

HullForce HullWake::push(const Frame& frame, const HullState& state) const {
    const DefaultFloatEnvironment environment;
    const DynamicWavesView& view = frame.dynamic_waves;
    if (!view) return {};
    const Hollow hollow(*this, frame);
    const double texel_m = hollow.texel_m;
    const PressureFootprint& pressed = *hollow.last[1].footprint;
    const WaterFrame::Origin at = hollow.pressed_origin;
    // the rectangle, and half a cell around it
    const double ahead = (pressed.length_m + pressed.length_m / pressed.columns) / 2,
                 abeam = (pressed.beam_m + pressed.beam_m / pressed.rows) / 2;
    const double reach_x = std::fabs(pressed.forward_x) * ahead + std::fabs(pressed.forward_z) * abeam;
    const double reach_z = std::fabs(pressed.forward_z) * ahead + std::fabs(pressed.forward_x) * abeam;
    const double middle_x = pressed.x_m - at.x_m, middle_z = pressed.z_m - at.z_m;
    // The texels of the grid that it reaches, its end exclusive.
    const auto reached = [&](double middle_m, double reach_m, std::int64_t first) {
        const double low = static_cast<double>(first), high = low + view.resolution;
        return std::pair(
            static_cast<std::int64_t>(std::clamp(std::ceil((middle_m - reach_m) / texel_m), low, high)),
            static_cast<std::int64_t>(std::clamp(std::floor((middle_m + reach_m) / texel_m) + 1, low, high)));
    };
    const auto [first_x, end_x] = reached(middle_x, reach_x, view.first_x);
    const auto [first_z, end_z] = reached(middle_z, reach_z, view.first_z);
    // the centre of mass at the pressure
    const glm::dvec3 middle = middle_of_plan_m(state);
    const double mass_x = middle_x - middle.x, mass_z = middle_z - middle.z;
    const auto last = static_cast<std::size_t>(view.resolution) - 1;
    HullForce sum;
    for (std::int64_t row = first_z; row < end_z; ++row)
        for (std::int64_t column = first_x; column < end_x; ++column) {
            const double x = static_cast<double>(column) * texel_m, z = static_cast<double>(row) * texel_m;
            const DepthAndSlope here = hollow.depth[1].depth_and_slope_at(x, z);
            if (here.slope_x == 0 && here.slope_z == 0) continue;
            // the depth of Hollow::at_texel()
            double depth_m = 0.5 * here.depth_m + (1 - hollow.fraction) / 2 * hollow.depth[2].depth_at(x, z);
            if (hollow.fraction > 0) depth_m += hollow.fraction / 2 * hollow.depth[0].depth_at(x, z);
            const std::size_t texel = (static_cast<std::size_t>(row) & last) * (last + 1) +
                                      (static_cast<std::size_t>(column) & last);
            const double height_m =
                static_cast<double>(view.height_m[texel]) + hollow.shown(column, row) * depth_m;
            const glm::dvec3 force(height_m * here.slope_x, 0, height_m * here.slope_z);
            sum.force_n += force;
            sum.torque_nm += glm::cross(glm::dvec3(x - mass_x, 0, z - mass_z), force);
        }
    // The launch makes waves that no hull would, and they would set it in motion.
    const double launched = launched_at(afloat_s_ - launch_s());
    const double weight = launched * hull_->options_.water_density_kgpm3 * gravity_mps2 * texel_m * texel_m;
    return {weight * sum.force_n, weight * sum.torque_nm};
}

}  // namespace pelagic
