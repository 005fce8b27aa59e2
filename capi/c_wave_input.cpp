// C interface of wave inputs.
#include "pelagic/capi/c_wave_input.hpp"

#include <string>
#include <utility>

#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/jobs/executor.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::capi {
namespace {

pelagic_input_rows c_rows_of(const InputRows& rows) {
    const InputMoment& moment = rows.moment;
    const CascadeGrid& grid = rows.grid();
    pelagic_input_rows out{};
    out.cascade = static_cast<std::int32_t>(rows.cascade);
    out.time_s = moment.time_s;
    out.loop_period_s = moment.loop_period_s;
    out.loop_turns = moment.loop_turns;
    out.is_tick = moment.pass_index == 0 ? 0 : 1;
    out.side_m = grid.side_m;
    out.cosine = grid.cosine;
    out.sine = grid.sine;
    out.resolution = moment.resolution;
    out.first_row = static_cast<std::int32_t>(rows.first_row);
    out.row_count = static_cast<std::int32_t>(rows.row_count);
    out.dx = rows.dx.data(), out.height = rows.height.data(), out.dz = rows.dz.data();
    out.velocity_x = rows.velocity_x.data();
    out.velocity_y = rows.velocity_y.data();
    out.velocity_z = rows.velocity_z.data();
    return out;
}

}  // namespace

AnalyticSea waves_of(const pelagic_waves* pointer) {
    const pelagic_waves from = read_struct(pointer, "waves");
    if (from.count > GerstnerInput::max_waves)
        reject(invalid_value_message("waves.count", from.count, "at most " + number_text(GerstnerInput::max_waves)));
    AnalyticSea sea{.waves = {}, .choppiness = from.choppiness};
    if (from.count == 0) return sea;
    needed(from.amplitude_m, "waves.amplitude_m");
    needed(from.wavelength_m, "waves.wavelength_m");
    needed(from.direction_rad, "waves.direction_rad");
    for (std::size_t i = 0; i < from.count; ++i)
        sea.waves.push_back({.amplitude_m = from.amplitude_m[i],
                             .wavelength_m = from.wavelength_m[i],
                             .direction_rad = from.direction_rad[i],
                             .phase_rad = from.phase_rad ? from.phase_rad[i] : 0});
    return sea;
}

Ripple ripple_of(const pelagic_ripple* pointer) {
    const pelagic_ripple from = read_struct(pointer, "ripple");
    Ripple to;
    // generated from schema/ripple.toml: c-reads
    to.x_m = from.x_m;
    to.z_m = from.z_m;
    to.wavelength_m = from.wavelength_m;
    to.amplitude_m = from.amplitude_m;
    to.reach_m = from.reach_m;
    to.phase_rad = from.phase_rad;
    // end of generated
    return to;
}

std::vector<std::shared_ptr<WaveInput>> inputs_of(pelagic_input* const* inputs, std::size_t count) {
    std::vector<std::shared_ptr<WaveInput>> ours;
    if (count == 0) return ours;
    needed(inputs, "inputs");
    for (std::size_t i = 0; i < count; ++i) {
        const std::string name = "inputs[" + number_text(i) + "]";
        if (needed(inputs[i], name.c_str()).has_ocean)
            reject(name + " belongs to another ocean, expected one that is new");
        ours.push_back(inputs[i]->input);
    }
    return ours;
}

}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_input_create_waves(const pelagic_waves* waves, pelagic_input** input) {
    return guarded([&] {
        pelagic_input*& out = needed(input, "input");
        out = nullptr;
        const auto made = std::make_shared<GerstnerInput>(waves_of(waves));
        out = new pelagic_input{.input = made, .waves = made};
    });
}

pelagic_status pelagic_input_set_waves(pelagic_input* input, const pelagic_waves* waves) {
    return guarded([&] {
        if (!needed(input, "input").waves)
            reject("input is not a batch of waves; expected one of pelagic_input_create_waves");
        input->waves->set(waves_of(waves));
    });
}

pelagic_status pelagic_input_create_ripple(const pelagic_ripple* ripple, pelagic_input** input) {
    return guarded([&] {
        pelagic_input*& out = needed(input, "input");
        out = nullptr;
        const auto made = std::make_shared<RippleInput>(ripple_of(ripple));
        out = new pelagic_input{.input = made, .ripple = made};
    });
}

pelagic_status pelagic_input_set_ripple(pelagic_input* input, const pelagic_ripple* ripple) {
    return guarded([&] {
        if (!needed(input, "input").ripple)
            reject("input is not a ripple; expected one of pelagic_input_create_ripple");
        input->ripple->set(ripple_of(ripple));
    });
}

pelagic_status pelagic_input_create_callback(const pelagic_input_callback* callback, pelagic_input** input) {
    return guarded([&] {
        pelagic_input*& out = needed(input, "input");
        out = nullptr;
        const pelagic_input_callback from = read_struct(callback, "callback");
        needed(from.add, "callback.add");
        if (!(from.largest_slope >= 0 && from.largest_slope <= 100))
            reject(invalid_value_message("callback.largest_slope", from.largest_slope, "[0, 100]"));
        const auto add = [from](const InputRows& rows) {
            const pelagic_input_rows theirs = c_rows_of(rows);
            try {
                from.add(from.user, &theirs);
            } catch (...) {
                throw ApplicationJobsError("an input's callback threw");
            }
        };
        const std::uint32_t cascades = from.cascades == 0 ? CallbackInput::all_cascades : from.cascades;
        out = new pelagic_input{.input = std::make_shared<CallbackInput>(add, from.largest_slope, cascades)};
    });
}

void pelagic_input_destroy(pelagic_input* input) { delete input; }
