#include "pelagic/sim/ripple_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/cascades/input_grid.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr NumericField<Ripple> ripple_field_table[] = {
    // generated from schema/ripple.toml: table
    {"x_m", &Ripple::x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"z_m", &Ripple::z_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"wavelength_m", &Ripple::wavelength_m, 0.01, 1000, "[0.01, 1000]"},
    {"amplitude_m", &Ripple::amplitude_m, 0, 100, "[0, 100]"},
    {"reach_m", &Ripple::reach_m, 0, 1e5, "[0, 1e5]"},
    {"phase_rad", &Ripple::phase_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    // end of generated
};

}  // namespace

std::span<const NumericField<Ripple>> ripple_fields() { return ripple_field_table; }

std::string check(const Ripple& ripple) {
    if (std::string reason = check_fields(ripple, ripple_field_table); !reason.empty()) return reason;
    if (two_pi * ripple.amplitude_m > ripple.wavelength_m)
        return invalid_value_message(
            "amplitude_m", ripple.amplitude_m,
            "at most wavelength_m / (2 pi), " + rounded_text(ripple.wavelength_m / two_pi, 4));
    return {};
}

struct RippleInput::State {
    Ripple pending;  ///< applied by the next frame
    Ripple shown;
    Held held;
    std::uint32_t harmonic = 0;
    double centre_row = 0, texel_m = 1;
    /// Squared distance of each column from the nearest image of the centre, m^2.
    AlignedBuffer<float> along_squared;
    std::array<std::uint32_t, 2> starts{};  ///< phase at the centre, by InputMoment::pass_index

    /// Returns the squared distance, m^2, along one axis from a texel to the nearest periodic image
    /// of the centre.
    float squared_distance(double texel, double centre) const {
        const double n = static_cast<double>(along_squared.size()), offset = texel - centre;
        const double nearest = (offset - n * std::floor(offset / n + 0.5)) * texel_m;
        return static_cast<float>(nearest * nearest);
    }

    void hold(const InputMoment& moment) {
        shown = pending;
        held = {};
        const auto cascade = input_cascade_of(1 / shown.wavelength_m, moment);
        if (!cascade || shown.amplitude_m == 0) return;
        const CascadeGrid& grid = moment.grids[*cascade];
        const double half_m = grid.side_m / 2;
        harmonic = input_harmonic(1 / shown.wavelength_m, moment.loop_period_s);
        held = {*cascade, harmonic / moment.loop_period_s,
                shown.reach_m > 0 ? std::min(shown.reach_m, half_m) : half_m};
        const std::size_t n = static_cast<std::size_t>(moment.resolution);
        if (along_squared.size() != n) along_squared = AlignedBuffer<float>(n);
        texel_m = grid.side_m / moment.resolution;
        const auto [along, across] = grid.in_cascade(shown.x_m, shown.z_m);
        centre_row = across / texel_m;
        for (std::size_t i = 0; i < n; ++i)
            along_squared[i] = squared_distance(static_cast<double>(i), along / texel_m);
    }
};

RippleInput::RippleInput(const Ripple& ripple) : state_(std::make_unique<State>()) { set(ripple); }

RippleInput::~RippleInput() = default;

void RippleInput::set(const Ripple& ripple) {
    require(check(ripple));
    state_->pending = ripple;
}

RippleInput::Held RippleInput::held() const { return state_->held; }

void RippleInput::begin(const InputMoment& moment) {
    if (moment.pass_index == 0) state_->hold(moment);
    const double turns = input_turns(state_->shown.phase_rad / two_pi, state_->harmonic, moment.loop_turns);
    state_->starts[moment.pass_index] = static_cast<std::uint32_t>(static_cast<std::int64_t>(turns * 0x1p32));
}

bool RippleInput::adds_to(std::size_t cascade) const {
    return state_->held.reach_m > 0 && state_->held.cascade == cascade;
}

// The sum of three bounds, with R the reach:
//   slope of the wave:                 k A
//   slope of the decay sqrt(L / 2 / q): A / L, because q >= L / 2
//   slope of the fade (1 - u^2)^2:      16 / (6 sqrt 3) A / R = 1.54 A / R
double RippleInput::largest_slope(std::size_t cascade) const {
    if (!adds_to(cascade)) return 0;
    const Ripple& ripple = state_->shown;
    return ripple.amplitude_m * ((two_pi + 1) / ripple.wavelength_m + 1.54 / state_->held.reach_m);
}

void RippleInput::add(const InputRows& rows) const {
    const Kernels& kernels = kernels_for(rows.moment.isa);
    const Ripple& ripple = state_->shown;
    const double reach_squared = state_->held.reach_m * state_->held.reach_m;
    for (std::size_t row = 0; row < rows.row_count; ++row) {
        const float across_squared =
            state_->squared_distance(static_cast<double>(rows.first_row + row), state_->centre_row);
        if (static_cast<double>(across_squared) >= reach_squared) continue;
        kernels.add_ripple(
            {.along_squared = state_->along_squared.data(),
             .across_squared = across_squared,
             .columns = rows.resolution(),
             .reach_squared = static_cast<float>(reach_squared),
             .half_wave = static_cast<float>(ripple.wavelength_m / 2),
             .waves_per_m = static_cast<float>(1 / ripple.wavelength_m),
             .start = state_->starts[rows.moment.pass_index],
             .amplitude = static_cast<float>(ripple.amplitude_m),
             .vertical_velocity = static_cast<float>(two_pi * state_->held.frequency_hz * ripple.amplitude_m),
             .heights = rows.row_of(rows.height, row).data(),
             .vertical_velocities = rows.velocity_y.empty() ? nullptr : rows.row_of(rows.velocity_y, row).data()});
    }
}

}  // namespace pelagic
