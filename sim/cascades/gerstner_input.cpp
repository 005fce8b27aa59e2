#include "pelagic/sim/gerstner_input.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/message/require.hpp"
#include "pelagic/sim/cascades/input_grid.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {

// A wave's angle at texel (i, j) is the sum of a = m i / N turns and of the angle b at the row's
// first texel. The cosines and sines of a are a table of each wave. Those of b come from a table of
// N fractions of a turn, so no sine is computed per texel.
struct GerstnerInput::State {
    /// A wave on the grid of a cascade.
    struct Held {
        std::size_t cascade;
        GridIndex at;
        std::uint32_t harmonic;
        PlaneWave wave;
        double direction_x, direction_z;
    };

    explicit State(AnalyticSea waves) : pending(std::move(waves)) {}

    void resize_tables(std::size_t resolution) {
        circle.resize(resolution);
        for (std::size_t i = 0; i < resolution; ++i)
            circle[i] = det::sine_cosine_of_turns(static_cast<double>(i) / static_cast<double>(resolution));
        columns = AlignedBuffer<float>(2 * resolution * max_waves);
        columns_of.fill(std::numeric_limits<int>::min());
        held.reserve(max_waves);
    }

    /// Moves the pending waves to the grids of the cascades.
    void hold(const InputMoment& moment) {
        if (circle.size() != static_cast<std::size_t>(moment.resolution))
            resize_tables(static_cast<std::size_t>(moment.resolution));
        held.clear();
        choppiness = pending.choppiness;
        for (const AnalyticWave& wave : pending.waves) {
            const auto cascade = input_cascade_of(1 / wave.wavelength_m, moment);
            if (!cascade || wave.amplitude_m == 0) continue;
            const CascadeGrid& grid = moment.grids[*cascade];
            const auto [sine, cosine] = det::sine_cosine_of_turns(wave.direction_rad / two_pi);
            const GridIndex at = nearest_place(grid, cosine / wave.wavelength_m, sine / wave.wavelength_m);
            if (at == GridIndex{} || !is_on_grid(at, moment.resolution)) continue;
            const auto [x, z] = turns_per_m_of(grid, at);
            const double turns_per_m = at.steps() / grid.side_m;
            const std::uint32_t harmonic = input_harmonic(turns_per_m, moment.loop_period_s);
            make_columns(held.size(), at.m);
            held.push_back({*cascade,
                            at,
                            harmonic,
                            {.amplitude_m = wave.amplitude_m,
                             .turns_per_m_x = x,
                             .turns_per_m_z = z,
                             .frequency_hz = harmonic / moment.loop_period_s,
                             .phase_turns = wave.phase_rad / two_pi},
                            x / turns_per_m,
                            z / turns_per_m});
        }
    }

    /// Returns the sine and cosine of `steps` / N turns.
    const det::SineCosine& turn_fraction(std::int64_t steps) const {
        return circle[static_cast<std::size_t>(steps) & (circle.size() - 1)];
    }

    void make_columns(std::size_t wave, int m) {
        if (columns_of[wave] == m) return;
        const std::size_t n = circle.size();
        float* const cosines = columns.data() + 2 * n * wave;
        for (std::size_t i = 0; i < n; ++i) {
            const auto [sine, cosine] = turn_fraction(static_cast<std::int64_t>(i) * m);
            cosines[i] = static_cast<float>(cosine);
            cosines[n + i] = static_cast<float>(sine);
        }
        columns_of[wave] = m;
    }

    /// Returns the factors of a row: h = A cos(a + b) and D = -choppiness A k/|k| sin(a + b), where
    /// b is the wave's angle at the row's first texel.
    GridWaveRow row_of(std::size_t wave, std::size_t pass_index, std::size_t row) const {
        const Held& of = held[wave];
        const det::SineCosine& start = starts[pass_index][wave];
        const det::SineCosine& down = turn_fraction(static_cast<std::int64_t>(row) * of.at.n);
        const double height = of.wave.amplitude_m;
        const double cosine = start.cosine * down.cosine - start.sine * down.sine;
        const double sine = start.sine * down.cosine + start.cosine * down.sine;
        const double x = choppiness * height * of.direction_x, z = choppiness * height * of.direction_z;
        const float* const cosines = columns.data() + 2 * circle.size() * wave;
        return {.cosine = cosines,
                .sine = cosines + circle.size(),
                .of_cosine = {static_cast<float>(-x * sine), static_cast<float>(height * cosine),
                              static_cast<float>(-z * sine)},
                .of_sine = {static_cast<float>(-x * cosine), static_cast<float>(-height * sine),
                            static_cast<float>(-z * cosine)}};
    }

    /// Returns the derivative in time. An angle falls by w rad/s, so the derivative of cos(angle)
    /// is w sin(angle), and the derivative of sin(angle) is -w cos(angle).
    static GridWaveRow derivative_of(const GridWaveRow& row, double frequency_hz) {
        const float omega = static_cast<float>(two_pi * frequency_hz);
        GridWaveRow derivative = row;
        for (std::size_t field = 0; field < input_fields; ++field) {
            derivative.of_cosine[field] = -omega * row.of_sine[field];
            derivative.of_sine[field] = omega * row.of_cosine[field];
        }
        return derivative;
    }

    AnalyticSea pending;  ///< applied by the next frame
    std::vector<Held> held;
    double choppiness = 0;
    std::vector<det::SineCosine> circle;    ///< of i / N turns
    AlignedBuffer<float> columns;           ///< N cosines and N sines for each wave
    std::array<int, max_waves> columns_of;  ///< m of each wave's columns
    /// Sine and cosine of each wave's angle at texel (0, 0), by InputMoment::pass_index.
    std::array<std::array<det::SineCosine, max_waves>, 2> starts;
};

GerstnerInput::GerstnerInput(const AnalyticSea& waves) : state_(std::make_unique<State>(AnalyticSea{})) {
    set(waves);
}

GerstnerInput::~GerstnerInput() = default;

void GerstnerInput::set(const AnalyticSea& waves) {
    const DefaultFloatEnvironment environment;
    if (!waves.waves.empty()) require(check(waves));
    state_->pending = waves;
}

PlaneWaves GerstnerInput::held() const {
    PlaneWaves waves{.waves = {}, .choppiness = state_->choppiness};
    for (const State::Held& held : state_->held) waves.waves.push_back(held.wave);
    return waves;
}

void GerstnerInput::begin(const InputMoment& moment) {
    if (moment.pass_index == 0) state_->hold(moment);
    for (std::size_t i = 0; i < state_->held.size(); ++i) {
        const State::Held& held = state_->held[i];
        state_->starts[moment.pass_index][i] =
            det::sine_cosine_of_turns(input_turns(held.wave.phase_turns, held.harmonic, moment.loop_turns));
    }
}

bool GerstnerInput::adds_to(std::size_t cascade) const {
    const auto& held = state_->held;
    return std::any_of(held.begin(), held.end(),
                       [cascade](const State::Held& wave) { return wave.cascade == cascade; });
}

double GerstnerInput::largest_slope(std::size_t cascade) const {
    double sum = 0;
    for (const State::Held& held : state_->held)
        if (held.cascade == cascade) sum += two_pi * held.wave.turns_per_m() * held.wave.amplitude_m;
    return sum;
}

void GerstnerInput::add(const InputRows& rows) const {
    const Kernels& kernels = kernels_for(rows.moment.isa);
    const bool with_velocities = !rows.velocity_x.empty();
    std::array<GridWaveRow, max_waves> waves, derivatives;
    for (std::size_t row = 0; row < rows.row_count; ++row) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < state_->held.size(); ++i) {
            const State::Held& held = state_->held[i];
            if (held.cascade != rows.cascade) continue;
            waves[count] = state_->row_of(i, rows.moment.pass_index, rows.first_row + row);
            if (with_velocities) derivatives[count] = State::derivative_of(waves[count], held.wave.frequency_hz);
            ++count;
        }
        const auto add_to = [&](const std::array<GridWaveRow, max_waves>& of, std::span<float> x, std::span<float> y,
                                std::span<float> z) {
            kernels.add_waves(
                {.waves = of.data(),
                 .count = count,
                 .columns = rows.resolution(),
                 .rows = {rows.row_of(x, row).data(), rows.row_of(y, row).data(), rows.row_of(z, row).data()}});
        };
        add_to(waves, rows.dx, rows.height, rows.dz);
        if (with_velocities) add_to(derivatives, rows.velocity_x, rows.velocity_y, rows.velocity_z);
    }
}

}  // namespace pelagic
