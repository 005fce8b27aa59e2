#include "pelagic/sim/cascades/wave_inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"

namespace pelagic {
namespace {

/// Texels that a job adds, for any resolution; the rows of its fields are on the stack.
constexpr std::size_t texels_per_job = 2048;
constexpr double largest_slopes = 100;

/// Upper bound of the five-texel derivative divided by the true one (SlopesJob's weights).
constexpr double overstated = 1.22;

/// Rows of dx, height and dz, or of their derivatives, before they are added.
struct Rows {
    alignas(64) std::array<std::array<float, texels_per_job>, input_fields> fields;
};

/// Stack of a job; the margin covers the inputs' own functions, whose stack is unknown.
constexpr std::size_t inputs_stack_bytes = 2 * sizeof(Rows) + stack_margin;

std::string name_of_input(std::size_t number) { return "inputs[" + std::to_string(number) + "]"; }

/// Throws for the first field and value for which Kernels::add_rows() returned false.
[[noreturn]] void reject_rows(std::size_t number, const Rows& rows, std::size_t texels,
                              const std::array<const char*, input_fields>& names) {
    for (std::size_t field = 0; field < input_fields; ++field)
        for (std::size_t i = 0; i < texels; ++i)
            if (const float value = rows.fields[field][i]; !(std::fabs(value) <= WaveInput::max_value))
                throw std::invalid_argument(invalid_value_message(name_of_input(number) + "'s " + names[field], value,
                                                                  "[-1000, 1000], metres or metres a second"));
    throw std::logic_error("an input is refused, and nothing is wrong with it");
}

}  // namespace

WaveInputs::WaveInputs(List inputs, FrameSlots& slots, Isa isa)
    : slots_(slots), kernels_(kernels_for(isa)), inputs_(std::move(inputs)) {
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        if (!inputs_[i]) throw std::invalid_argument(name_of_input(i) + " is null, expected an input");
    for (const Pass pass : {Pass::tick, Pass::frame}) {
        grids_[pass].resize(slots.cascade_count());
        adds_[pass].resize(slots.cascade_count());
        moments_[pass].pass_index = pass == Pass::frame ? 0 : 1;
        moments_[pass].grids = grids_[pass];
        moments_[pass].resolution = slots.resolution();
        moments_[pass].isa = isa;
    }
    bounds_.resize(slots.cascade_count() * jobs());
}

std::size_t WaveInputs::rows_per_job() const {
    const auto n = static_cast<std::size_t>(slots_.resolution());
    return std::min(n, texels_per_job / n);
}

FilledBy WaveInputs::add_cascade_stages(JobGraph& graph, Pass pass, std::size_t cascade, FilledBy filled) {
    std::vector<StageId> waits_for{filled.displacement};
    if (filled.velocity != filled.displacement) waits_for.push_back(filled.velocity);
    const StageId added =
        graph.add({.name = stage_name(pass == Pass::tick ? "tick inputs" : "inputs", cascade),
                   .count = jobs(),
                   .waits_for = waits_for,
                   .body = for_each_item([this, pass, cascade](std::size_t job) { add_rows(pass, cascade, job); }),
                   .stack_bytes = inputs_stack_bytes});
    return {added, added};
}

void WaveInputs::begin(const PassMoment& at) {
    for (std::size_t cascade = 0; cascade < at.cascades.size(); ++cascade)
        grids_[at.pass][cascade] = at.cascades[cascade].grid;
    InputMoment& moment = moments_[at.pass];
    moment.time_s = at.time_s;
    moment.loop_period_s = at.loop_period_s;
    moment.loop_turns = loop_fraction(at.time_in_loop_s, at.loop_period_s).turns;
    for (const auto& input : inputs_) input->begin(moment);
    for (std::size_t cascade = 0; cascade < at.cascades.size(); ++cascade)
        begin_cascade(at, cascade);
}

void WaveInputs::begin_cascade(const PassMoment& at, std::size_t cascade) {
    std::uint8_t& adds = adds_[at.pass][cascade] = 0;
    double steeper = 0;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        if (!inputs_[i]->adds_to(cascade)) continue;
        const double slope = inputs_[i]->largest_slope(cascade);
        if (!(slope >= 0 && slope <= largest_slopes))
            throw std::invalid_argument(
                invalid_value_message(name_of_input(i) + "'s largest_slope", slope, "[0, 100]"));
        steeper += overstated * slope;
        adds = 1;
    }
    Cascade& shown = at.cascades[cascade];
    // The source computes no surface then.
    if (at.whitecaps_only && !shown.makes_whitecaps()) adds = 0;
    shown.slope_ranges.slope += static_cast<float>(steeper);
    shown.slope_ranges.variance += static_cast<float>(steeper * steeper);
}

void WaveInputs::add_rows(Pass pass, std::size_t cascade, std::size_t job) {
    if (adds_[pass][cascade] == 0) return;
    const std::size_t n = static_cast<std::size_t>(slots_.resolution()), row_count = rows_per_job();
    const std::size_t first_row = job * row_count, texels = row_count * n;
    const bool with_velocities = slots_.contents().has_drawn_velocities() && pass == Pass::frame;
    CascadeBuffers& buffers = slots_.buffers(cascade);
    Rows surface, velocity;
    FrameBounds bounds;
    const auto spans_of = [texels](Rows& rows, std::size_t field) {
        return std::span<float>(rows.fields[field].data(), texels);
    };
    const auto add_to = [&](std::size_t number, const Rows& rows, AlignedBuffer<float>& planes, FrameBounds& extremes,
                            const std::array<const char*, input_fields>& names) {
        if (!kernels_.add_rows({.rows = {rows.fields[0].data(), rows.fields[1].data(), rows.fields[2].data()},
                                .resolution = n,
                                .first_row = first_row,
                                .row_count = row_count,
                                .surface = planes.data(),
                                .block_stride = column_block_floats(slots_.resolution(), kernels_.lanes),
                                .max = WaveInput::max_value,
                                .bounds = &extremes}))
            reject_rows(number, rows, texels, names);
    };
    for (std::size_t number = 0; number < inputs_.size(); ++number) {
        const WaveInput& input = *inputs_[number];
        if (!input.adds_to(cascade)) continue;
        InputRows rows{.moment = moments_[pass],
                       .cascade = cascade,
                       .first_row = first_row,
                       .row_count = row_count,
                       .dx = spans_of(surface, surface_dx),
                       .height = spans_of(surface, surface_height),
                       .dz = spans_of(surface, surface_dz),
                       .velocity_x = {},
                       .velocity_y = {},
                       .velocity_z = {}};
        if (with_velocities) {
            rows.velocity_x = spans_of(velocity, surface_dx);
            rows.velocity_y = spans_of(velocity, surface_height);
            rows.velocity_z = spans_of(velocity, surface_dz);
        }
        for (const std::span<float> field :
             {rows.dx, rows.height, rows.dz, rows.velocity_x, rows.velocity_y, rows.velocity_z})
            std::fill(field.begin(), field.end(), 0.f);
        input.add(rows);
        add_to(number, surface, buffers.surface, bounds, {"dx", "height", "dz"});
        FrameBounds of_velocity;
        if (with_velocities)
            add_to(number, velocity, buffers.velocity, of_velocity, {"velocity_x", "velocity_y", "velocity_z"});
    }
    if (pass == Pass::frame) bounds_[cascade * jobs() + job] = bounds;
}

void WaveInputs::end(Frame&) {
    for (std::size_t cascade = 0; cascade < slots_.cascade_count(); ++cascade)
        if (adds_[Pass::frame][cascade] != 0) slots_.cascade(cascade).bounds = bounds(cascade);
}

FrameBounds WaveInputs::bounds(std::size_t cascade) const {
    const FrameBounds* const job_bounds = bounds_.data() + cascade * jobs();
    FrameBounds all = *job_bounds;
    for (std::size_t job = 1; job < jobs(); ++job) all.extend(job_bounds[job]);
    return all;
}

std::size_t WaveInputs::bytes() const {
    return sizeof *this + inputs_.capacity() * sizeof inputs_[0] + bounds_.capacity() * sizeof(FrameBounds);
}

}  // namespace pelagic
