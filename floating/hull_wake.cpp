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
#include "pelagic/simd/four_floats.hpp"

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

FourFloats smaller(FourFloats a, FourFloats b) { return a < b ? a : b; }
FourFloats larger(FourFloats a, FourFloats b) { return a > b ? a : b; }

/// Four footprints of one hull, a lane each, at the texels of a grid. Depths are linear between the middles
/// of cells, and fall to 0 half a cell outside the outermost ones.
class FourFootprints {
   public:
    /// Sets a lane. \param x_m, z_m  of texel (0, 0), from the middle of the footprint
    void set(std::size_t lane, const PressureFootprint& of, double x_m, double z_m, double texel_m) {
        const double columns_per_m = of.columns / of.length_m, rows_per_m = of.rows / of.beam_m;
        depth_m_[lane] = of.depth_m.data();
        row_cells_ = of.columns;
        const auto axis = [&](Axis& to, int cells, double first, double along, double across, double per_m) {
            to.last = four_times(static_cast<float>(cells - 1));
            to.last_cell = four_times(static_cast<float>(std::max(cells - 2, 0)));
            to.first[lane] = static_cast<float>(first * per_m + (cells - 1) / 2.0);
            to.along[lane] = static_cast<float>(along * per_m * texel_m);
            to.across[lane] = static_cast<float>(across * per_m * texel_m);
        };
        axis(columns_, of.columns, x_m * of.forward_x + z_m * of.forward_z, of.forward_x, of.forward_z, columns_per_m);
        axis(rows_, of.rows, z_m * of.forward_x - x_m * of.forward_z, -of.forward_z, of.forward_x, rows_per_m);
        right_ = of.columns > 1 ? 1 : 0;
        below_ = of.rows > 1 ? of.columns : 0;
    }

    /// Returns the depths at a texel.
    [[gnu::always_inline]] FourFloats depths_m(int x, int z) const {
        const Between column = columns_.between(x, z), row = rows_.between(x, z);
        const FourFloats within = column.within * row.within;
        if (!((within[0] + within[1]) + (within[2] + within[3]) > 0)) return FourFloats{};
        const Four cell = __builtin_convertvector(
            row.cell * four_times(static_cast<float>(row_cells_)) + column.cell, Four);
        const float* const cells[] = {depth_m_[0] + cell[0], depth_m_[1] + cell[1], depth_m_[2] + cell[2],
                                      depth_m_[3] + cell[3]};
        const auto corners = [&](std::ptrdiff_t offset) {
            return FourFloats{cells[0][offset], cells[1][offset], cells[2][offset], cells[3][offset]};
        };
        const FourFloats upper = lerp(corners(0), corners(right_), column.part);
        const FourFloats lower = lerp(corners(below_), corners(below_ + right_), column.part);
        return within * lerp(upper, lower, row.part);
    }
    /// Returns the derivatives of a lane's depth along x and z, times a texel.
    std::array<float, 2> slope(std::size_t lane, int x, int z) const {
        const float column = columns_.at(lane, x, z), row = rows_.at(lane, x, z);
        const float last_column = columns_.last[0], last_row = rows_.last[0];
        if (!(column > -1 && row > -1 && column < last_column + 1 && row < last_row + 1)) return {};
        const auto floor_of = [](float number) {  // column + 1 could round up to the next cell
            const int cut = static_cast<int>(number);
            return cut - (static_cast<float>(cut) > number);
        };
        const int i = floor_of(column), j = floor_of(row);
        const float* const cells = depth_m_[lane] + j * row_cells_ + i;
        float a = 0, b = 0, c = 0, d = 0;
        if (i >= 0 && j >= 0 && column < last_column && row < last_row) [[likely]] {
            a = cells[0], b = cells[1], c = cells[row_cells_], d = cells[row_cells_ + 1];
        } else {  // cells around the outermost ones are 0
            const bool has_right = column < last_column, has_lower = row < last_row;
            if (i >= 0 && j >= 0) a = cells[0];
            if (has_right && j >= 0) b = cells[1];
            if (i >= 0 && has_lower) c = cells[row_cells_];
            if (has_right && has_lower) d = cells[row_cells_ + 1];
        }
        const float right = column - static_cast<float>(i), bottom = row - static_cast<float>(j);
        const float ahead = (b - a) + bottom * ((d - c) - (b - a)), abeam = (c - a) + right * ((d - b) - (c - a));
        return {ahead * columns_.along[lane] + abeam * rows_.along[lane],
                ahead * columns_.across[lane] + abeam * rows_.across[lane]};
    }

    /// Returns the first texel of a row that a lane's footprint reaches, or one before it, and the end.
    std::array<int, 2> reached(std::size_t lane, int z, int first, int end) const {
        float low = static_cast<float>(first), high = static_cast<float>(end);
        for (const Axis& axis : {columns_, rows_}) {
            const float at_0 = axis.at(lane, 0, z), step = axis.along[lane];
            if (std::fabs(step) < 1e-3f) continue;
            const float one = (-1 - at_0) / step, other = (axis.last[lane] + 1 - at_0) / step;
            low = std::max(low, std::min(one, other) - 1);
            high = std::min(high, std::max(one, other) + 2);
        }
        return {static_cast<int>(low), static_cast<int>(high)};
    }

   private:
    using Four = std::int32_t __attribute__((vector_size(16)));

    static FourFloats lerp(FourFloats a, FourFloats b, FourFloats part) { return a + part * (b - a); }

    /// Cells, and the position between their middles and the next ones'.
    struct Between {
        FourFloats cell, part;
        FourFloats within;  ///< factor of the depth: falls from 1 outside
    };
    struct Axis {
        FourFloats first, along, across;  ///< of texel (0, 0), and per texel
        FourFloats last, last_cell;       ///< middles, and cells that have a next one

        float at(std::size_t lane, int x, int z) const {
            return first[lane] + (along[lane] * static_cast<float>(x) + across[lane] * static_cast<float>(z));
        }
        Between between(int x, int z) const {
            const FourFloats zero{}, one = four_times(1);
            const FourFloats at =
                first + (along * four_times(static_cast<float>(x)) + across * four_times(static_cast<float>(z)));
            const FourFloats inside = larger(smaller(at, last), zero), outside = at - inside;
            const FourFloats whole = __builtin_convertvector(__builtin_convertvector(inside, Four), FourFloats);
            const FourFloats cell = smaller(whole, last_cell);
            return {cell, inside - cell, larger(one - larger(outside, -outside), zero)};
        }
    };

    std::array<const float*, 4> depth_m_{};
    Axis columns_{}, rows_{};
    int row_cells_ = 0;
    std::ptrdiff_t right_ = 0, below_ = 0;  ///< from a cell to the next ones
};

/// Height and vertical velocity of dynamic waves: lanes 0 and 1.
FourFloats height_and_velocity(const DynamicWavesView& view, std::size_t texel) {
    return FourFloats{view.height_m[texel], view.vertical_velocity_mps[texel], 0, 0};
}

/// A cell of a grid, and the position in it.
struct GridCell {
    bool is_inside;
    int column, row;
    float right, bottom;

    /// \param u, v  texels from the grid's edges
    GridCell(const DynamicWavesView& view, double u, double v) {
        const double outside = view.resolution;
        u = std::min(std::max(u, 0.0), outside);
        v = std::min(std::max(v, 0.0), outside);
        column = static_cast<int>(u);
        row = static_cast<int>(v);
        const auto end = static_cast<unsigned>(view.resolution - 3);  // as DynamicWavesSample
        is_inside = static_cast<unsigned>(column - 1) < end && static_cast<unsigned>(row - 1) < end;
        right = static_cast<float>(u - column);
        bottom = static_cast<float>(v - row);
    }
    FourFloats between(FourFloats a, FourFloats b, FourFloats c, FourFloats d) const {
        const FourFloats along = four_times(right);
        const FourFloats upper = a + along * (b - a), lower = c + along * (d - c);
        return upper + four_times(bottom) * (lower - upper);
    }
};

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

void HullWake::shift(double x_m, double z_m) {
    for (glm::dvec3* const at : {&hull_m_, &pressure_m_}) *at += glm::dvec3(x_m, 0, z_m);
    for (PressureFootprint* const footprint : {&next_, &acted_[0], &acted_[1], &acted_[2]}) {
        footprint->x_m += x_m;
        footprint->z_m += z_m;
    }
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

/// The hull's own hollow in the dynamic waves of a frame. Texels are numbered from the grid's edges.
///
/// It is interpolated as DynamicWavesView interpolates ticks. A pressure that moves once a tick is that of
/// an even motion at the middle of the tick, so the hollow at its end is the mean of this tick's and the
/// next one's.
struct HullWake::Hollow {
    const DynamicWavesOptions& options;
    const DynamicWavesView& view;
    double texel_m;
    const PressureFootprint& pressed;   ///< of the last tick
    WaterFrame::Origin pressed_origin;  ///< where its position is that of the water's origin
    int base_x, base_z;                 ///< a texel near the pressure, from which its positions are exact
    std::size_t wrap_x, wrap_z, last;   ///< from texels to those in memory
    int whole_from;                     ///< texels from the grid's edge at which it shows the whole depth
    FourFootprints footprints;          ///< of the next tick, of the last one, and before it
    /// Weights of their depths, for the height and its velocity.
    std::array<FourFloats, 4> weights;

    /// \pre the frame has dynamic waves
    Hollow(const HullWake& wake, const Frame& frame)
        : options(wake.waves_->options()),
          view(frame.dynamic_waves),
          texel_m(options.side_m / options.resolution),
          pressed(*wake.acting_at(wake.tick_of(frame.time_s).tick, wake.tick_of(frame.time_s).tick).footprint),
          wrap_x(static_cast<std::size_t>(view.first_x)),
          wrap_z(static_cast<std::size_t>(view.first_z)),
          last(static_cast<std::size_t>(view.resolution) - 1),
          whole_from(static_cast<int>(0.5 * options.border_m / texel_m) + 3) {
        const FrameTick now = wake.tick_of(frame.time_s);
        const double tick_s = 1.0 / options.ticks_per_s, now_s = frame.time_s - now.fraction * tick_s;
        std::array<ActingFootprint, 4> acting;
        std::array<WaterFrame::Origin, 4> origins;
        for (std::size_t i = 0; i < acting.size(); ++i) {
            acting[i] = wake.acting_at(now.tick + 1 - static_cast<std::int64_t>(i), now.tick);
            origins[i] = frame.water_frame.origin_at(now_s + (1 - static_cast<double>(i)) * tick_s);
            origins[i].x_m -= acting[i].moved_s * acting[i].footprint->velocity_x_mps;
            origins[i].z_m -= acting[i].moved_s * acting[i].footprint->velocity_z_mps;
        }
        pressed_origin = origins[1];
        const auto base_of = [&](double at_m, std::int64_t first) {
            return static_cast<int>(
                std::clamp(at_m / texel_m - static_cast<double>(first), 0.0, static_cast<double>(view.resolution)));
        };
        base_x = base_of(pressed.x_m - pressed_origin.x_m, view.first_x);
        base_z = base_of(pressed.z_m - pressed_origin.z_m, view.first_z);
        for (std::size_t i = 0; i < acting.size(); ++i) {
            const PressureFootprint& of = *acting[i].footprint;
            footprints.set(i, of, static_cast<double>(view.first_x + base_x) * texel_m + (origins[i].x_m - of.x_m),
                           static_cast<double>(view.first_z + base_z) * texel_m + (origins[i].z_m - of.z_m),
                           texel_m);
        }
        const auto fraction = static_cast<float>(now.fraction), rate = static_cast<float>(options.ticks_per_s);
        weights = {FourFloats{fraction / 2, rate * (0.5f + fraction) / 2, 0, 0},
                   FourFloats{0.5f, rate * (0.5f - fraction) / 2, 0, 0},
                   FourFloats{(1 - fraction) / 2, -rate * (0.5f + fraction) / 2, 0, 0},
                   FourFloats{0, -rate * (0.5f - fraction) / 2, 0, 0}};
    }

    std::size_t row_in_memory(int z) const { return ((wrap_z + static_cast<std::size_t>(z)) & last) * (last + 1); }
    std::size_t column_in_memory(int x) const { return (wrap_x + static_cast<std::size_t>(x)) & last; }
    /// Returns height and vertical velocity of dynamic waves. \pre the cell is inside
    FourFloats with(const GridCell& cell) const {
        const std::size_t left = column_in_memory(cell.column), right = column_in_memory(cell.column + 1);
        const std::size_t upper = row_in_memory(cell.row), lower = row_in_memory(cell.row + 1);
        return cell.between(height_and_velocity(view, upper + left), height_and_velocity(view, upper + right),
                            height_and_velocity(view, lower + left), height_and_velocity(view, lower + right));
    }
    /// Returns the part of a texel's depth that the frame shows.
    float shown(int x, int z) const {
        const auto part = [&](int texel) {
            const int from_edge = std::min(texel, view.resolution - 1 - texel);
            return from_edge >= whole_from ? 1.f : static_cast<float>(shown_part(options, from_edge));
        };
        return part(x) * part(z);
    }
    /// Returns height and vertical velocity without the hollow at a texel.
    FourFloats without(int x, int z) const {
        const FourFloats depths_m = footprints.depths_m(x - base_x, z - base_z);
        FourFloats hollow = four_times(depths_m[0]) * weights[0];
        for (std::size_t i = 1; i < weights.size(); ++i) hollow += four_times(depths_m[i]) * weights[i];
        return height_and_velocity(view, row_in_memory(z) + column_in_memory(x)) + four_times(shown(x, z)) * hollow;
    }
};

/// Samples of dynamic waves without a hollow. Vertices of a hull have texels in common, so each texel is
/// kept in a table by the last bits of its column and row, until another texel takes its place. The order
/// of samples does not change them.
class HullWake::HollowSampler {
   public:
    explicit HollowSampler(const Hollow& hollow) : hollow_(hollow) { number_.fill(-1); }

    /// Bilinear between texels, as the grid. \pre the cell is inside
    FourFloats at(const GridCell& cell) {
        const int x = cell.column, z = cell.row;
        const int left = x & (columns - 1), right = (x + 1) & (columns - 1);
        const int upper = (z & (rows - 1)) * columns, lower = ((z + 1) & (rows - 1)) * columns;
        const int number = number_of(x, z);
        return cell.between(texel(upper + left, number), texel(upper + right, number + number_of(1, 0)),
                            texel(lower + left, number + number_of(0, 1)),
                            texel(lower + right, number + number_of(1, 1)));
    }
    FourFloats at(int x, int z) {
        return texel((z & (rows - 1)) * columns + (x & (columns - 1)), number_of(x, z));
    }

   private:
    static constexpr int columns = 32, rows = 16;

    static int number_of(int x, int z) { return z << 12 | x; }
    FourFloats texel(int place, int number) {
        const auto at = static_cast<std::size_t>(place);
        if (number_[at] != number) [[unlikely]] compute(at, number);
        return texels_[at];
    }
    [[gnu::noinline]] void compute(std::size_t place, int number) {
        number_[place] = number;
        texels_[place] = hollow_.without(number & 0xfff, number >> 12);
    }

    const Hollow& hollow_;
    std::array<std::int32_t, columns * rows> number_;
    std::array<FourFloats, columns * rows> texels_;
};

void HullWake::leave_out(const Frame& frame, std::span<const double> x, std::span<const double> z,
                         std::span<float> height_m, std::span<float> velocity_y_mps,
                         std::span<double> wake_m, std::span<double> wake_up_mps) const {
    leave_out_and_push(frame, nullptr, x, z, height_m, velocity_y_mps, wake_m, wake_up_mps);
}

HullForce HullWake::push(const Frame& frame, const HullState& state) const {
    return leave_out_and_push(frame, &state, {}, {}, {}, {}, {}, {});
}

HullForce HullWake::leave_out_and_push(const Frame& frame, const HullState* state, std::span<const double> x,
                                       std::span<const double> z, std::span<float> height_m,
                                       std::span<float> velocity_y_mps, std::span<double> wake_m,
                                       std::span<double> wake_up_mps) const {
    const std::size_t count = x.size();
    if (z.size() != count || height_m.size() != count || velocity_y_mps.size() != count ||
        !(wake_m.empty() || wake_m.size() == count) || !(wake_up_mps.empty() || wake_up_mps.size() == count))
        throw std::invalid_argument("x, z, height_m, velocity_y_mps, wake_m and wake_up_mps differ in length");
    const DefaultFloatEnvironment environment;
    const DynamicWavesView& view = frame.dynamic_waves;
    if (!view) {
        std::fill(wake_m.begin(), wake_m.end(), 0);
        std::fill(wake_up_mps.begin(), wake_up_mps.end(), 0);
        return {};
    }
    const Hollow hollow(*this, frame);
    HollowSampler without_hollow(hollow);
    const WaterFrame::Origin origin = frame.water_frame.origin_at(frame.time_s);
    const glm::dvec3 moved = pressure_m_ - hull_m_;
    const double texels_per_m = 1 / hollow.texel_m;
    const double edge_x = origin.x_m * texels_per_m + static_cast<double>(view.first_x),
                 edge_z = origin.z_m * texels_per_m + static_cast<double>(view.first_z);
    const double moved_x = moved.x * texels_per_m, moved_z = moved.z * texels_per_m;
    for (std::size_t i = 0; i < count; ++i) {
        const double u = x[i] * texels_per_m - edge_x, v = z[i] * texels_per_m - edge_z;
        const GridCell cell(view, u, v), cell_there(view, u + moved_x, v + moved_z);
        const FourFloats here = cell.is_inside ? hollow.with(cell) : FourFloats{};
        const FourFloats there = cell_there.is_inside ? without_hollow.at(cell_there) : FourFloats{};
        if (!wake_m.empty()) wake_m[i] = static_cast<double>(there[0]);
        if (!wake_up_mps.empty()) wake_up_mps[i] = static_cast<double>(there[1]);
        height_m[i] += there[0] - here[0];
        velocity_y_mps[i] += there[1] - here[1];
    }
    return state ? push(hollow, without_hollow, *state) : HullForce{};
}

HullForce HullWake::push(const Hollow& hollow, HollowSampler& without_hollow, const HullState& state) const {
    const DynamicWavesView& view = hollow.view;
    const double texel_m = hollow.texel_m;
    const PressureFootprint& pressed = hollow.pressed;
    const WaterFrame::Origin at = hollow.pressed_origin;
    // the rectangle, and half a cell around it
    const double ahead = (pressed.length_m + pressed.length_m / pressed.columns) / 2,
                 abeam = (pressed.beam_m + pressed.beam_m / pressed.rows) / 2;
    const double reach_x = std::fabs(pressed.forward_x) * ahead + std::fabs(pressed.forward_z) * abeam;
    const double reach_z = std::fabs(pressed.forward_z) * ahead + std::fabs(pressed.forward_x) * abeam;
    const double middle_x = pressed.x_m - at.x_m, middle_z = pressed.z_m - at.z_m;
    // The texels of the grid that it reaches, its end exclusive.
    const auto reached = [&](double middle_m, double reach_m, std::int64_t first) {
        const auto texel = [&](double at_m) { return at_m / texel_m - static_cast<double>(first); };
        const double side = view.resolution;
        return std::pair(static_cast<int>(std::clamp(std::ceil(texel(middle_m - reach_m)), 0.0, side)),
                         static_cast<int>(std::clamp(std::floor(texel(middle_m + reach_m)) + 1, 0.0, side)));
    };
    const auto [first_x, end_x] = reached(middle_x, reach_x, view.first_x);
    const auto [first_z, end_z] = reached(middle_z, reach_z, view.first_z);
    // Sums in texels from the base: of h grad d, and of its torque.
    double force_x = 0, force_z = 0, torque = 0;
    for (int row = first_z; row < end_z; ++row) {
        const int z = row - hollow.base_z;
        const auto [first, end] = hollow.footprints.reached(1, z, first_x - hollow.base_x, end_x - hollow.base_x);
        double of_row = 0;
        for (int x = first; x < end; ++x) {
            const auto [slope_x, slope_z] = hollow.footprints.slope(1, x, z);
            if (slope_x == 0 && slope_z == 0) continue;
            const float height = without_hollow.at(x + hollow.base_x, row)[0];
            const double along = static_cast<double>(height * slope_x), across = static_cast<double>(height * slope_z);
            of_row += along;
            force_z += across;
            torque -= x * across;
        }
        force_x += of_row;
        torque += z * of_row;
    }
    // Slopes are of a texel. The torque is about the centre of mass at the pressure.
    const glm::dvec3 middle = middle_of_plan_m(state);
    const double base_x_m = static_cast<double>(view.first_x + hollow.base_x) * texel_m - (middle_x - middle.x),
                 base_z_m = static_cast<double>(view.first_z + hollow.base_z) * texel_m - (middle_z - middle.z);
    const glm::dvec3 force_n(force_x / texel_m, 0, force_z / texel_m);
    const glm::dvec3 torque_nm(0, torque + base_z_m * force_n.x - base_x_m * force_n.z, 0);
    // The launch makes waves that no hull would, and they would set it in motion.
    const double launched = launched_at(afloat_s_ - launch_s());
    const double weight = launched * hull_->options_.water_density_kgpm3 * gravity_mps2 * texel_m * texel_m;
    return {weight * force_n, weight * torque_nm};
}

}  // namespace pelagic
