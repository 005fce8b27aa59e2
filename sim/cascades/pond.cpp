#include "pelagic/sim/cascades/pond.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "pelagic/analytic/pond_terms.hpp"
#include "pelagic/analytic/wave_phase.hpp"
#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/spectrum/mean_square_slope.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

/// Texels in one call of the kernel.
constexpr std::size_t chunk_texels = 256;

/// Rows in a job. One row takes as long as all columns of a spectral cascade.
constexpr std::size_t pond_rows_per_job = 4;

/// Outputs of the kernel for one chunk of a row. Computing heights only takes half the time.
struct RowChunk {
    alignas(64) std::array<float, chunk_texels> height, normal_x, normal_y, normal_z, vertical_velocity,
        slope_variance;

    PondOutputs outputs(bool with_velocities) {
        if (!with_velocities) return {.height = height.data()};
        return {height.data(),   normal_x.data(),          normal_y.data(),
                normal_z.data(), vertical_velocity.data(), slope_variance.data()};
    }
};

/// Writes `count` floats of a row, from column `first` on, to one component of a surface's blocks.
void store_row(const float* values, std::size_t count, std::size_t first, float* component, std::size_t lanes,
               std::size_t block_floats) {
    for (std::size_t i = 0; i < count; i += lanes)
        std::memcpy(component + (first + i) / lanes * block_floats, values + i, lanes * sizeof(float));
}

/// Returns an octave's phase at the origin, in turns: its initial phase minus harmonic * fraction.
/// The result is exact.
double start_of(const GridOctave& octave, LoopFraction fraction) {
    const std::uint64_t elapsed = std::uint64_t{octave.harmonic * fraction.turns} << 32;
    return static_cast<double>(static_cast<std::int64_t>(turned(1, octave.octave.phase_turns) - elapsed)) * 0x1p-64;
}

}  // namespace

Pond::Pond(FrameSlots& slots, std::size_t cascade, Isa isa)
    : slots_(slots),
      cascade_(cascade),
      lanes_(kernels_for(isa).lanes),
      kernels_(analytic_kernels_for(isa)),
      resolution_(slots.resolution()),
      row_bounds_(static_cast<std::size_t>(resolution_)) {
    for (int i = 0; i < resolution_; ++i) columns_.push_back(i);
    // Reserved, so that frames do not allocate.
    for (std::vector<double>& starts : starts_.values) starts.reserve(max_analytic_waves);
}

FilledBy Pond::add_stages(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) {
    const StageId filled = graph.add({.name = stage_name(pass == Pass::tick ? "tick octaves" : "octaves", cascade_),
                                      .count = static_cast<std::size_t>(resolution_),
                                      .batch = pond_rows_per_job,
                                      .waits_for = waits_for,
                                      .body = for_each_item([this, pass](std::size_t row) { fill_row(pass, row); }),
                                      .stack_bytes = stack_margin});
    return {filled, filled};
}

void Pond::begin(Pass pass, const SeaMoment& moment, Cascade& cascade) {
    const LoopFraction fraction = loop_fraction(moment.time_s, waves_.loop_period_s);
    std::vector<double>& starts = starts_[pass];
    starts.resize(waves_.octaves.size());
    for (std::size_t i = 0; i < starts.size(); ++i) starts[i] = start_of(waves_.octaves[i], fraction);
    cascade.grid = waves_.plan.grid;
    cascade.slope_ranges = waves_.slope_ranges;
}

void Pond::fill_row(Pass pass, std::size_t row) {
    const std::size_t block_floats = column_block_floats(resolution_, lanes_);
    float *const surface = slots_.surface(cascade_), *const velocity = slots_.buffers(cascade_).velocity.data();
    const auto component = [&](float* planes, SurfaceComponent of) {
        return planes + (row * surface_components + of) * lanes_;
    };
    const bool with_velocities = slots_.contents().has_drawn_velocities() && pass == Pass::frame;
    const std::size_t n = static_cast<std::size_t>(resolution_), count = std::min(n, chunk_texels);
    std::array<double, chunk_texels> z;
    std::array<float, chunk_texels> footprint;
    z.fill(static_cast<double>(row));
    footprint.fill(static_cast<float>(waves_.plan.grid.side_m / resolution_));
    static constexpr std::array<float, chunk_texels> none{};
    RowChunk chunk;
    FrameBounds bounds{.height_min_m = 3.4e38f, .height_max_m = -3.4e38f};
    for (std::size_t first = 0; first < n; first += count) {
        kernels_.pond({.octaves = waves_.terms.data(),
                       .starts = starts_[pass].data(),
                       .octave_count = static_cast<int>(waves_.terms.size()),
                       .count = count,
                       .x = columns_.data() + first,
                       .z = z.data(),
                       .footprint = footprint.data(),
                       .out = chunk.outputs(with_velocities)});
        const auto store = [&](const float* values, float* planes, SurfaceComponent of) {
            store_row(values, count, first, component(planes, of), lanes_, block_floats);
        };
        store(chunk.height.data(), surface, surface_height);
        store(none.data(), surface, surface_dx);
        store(none.data(), surface, surface_dz);
        if (with_velocities) {
            store(chunk.vertical_velocity.data(), velocity, surface_height);
            store(none.data(), velocity, surface_dx);
            store(none.data(), velocity, surface_dz);
        }
        for (std::size_t i = 0; i < count; ++i) {
            bounds.height_min_m = std::min(bounds.height_min_m, chunk.height[i]);
            bounds.height_max_m = std::max(bounds.height_max_m, chunk.height[i]);
        }
    }
    row_bounds_[row] = bounds;
}

FrameBounds Pond::end_frame() {
    FrameBounds all = row_bounds_.front();
    for (const FrameBounds& row : row_bounds_) all.extend(row);
    return {.height_min_m = all.height_min_m + 0.f, .height_max_m = all.height_max_m + 0.f};  // no negative zeros
}

void Pond::add_spectrum_stage(JobGraph& graph) {
    graph.add({.name = stage_name("spectrum", cascade_),
               .count = 1,
               .body = for_each_item([](std::size_t) {}),  // begin_spectrum() computes the octaves
               .stack_bytes = stack_margin});
}

Pond::Waves Pond::waves_of(const SeaState& sea, const CascadePlan& plan) {
    Waves waves{.plan = plan,
                .loop_period_s = sea.loop_period_s,
                .octaves = grid_octaves(sea, plan),
                .terms = {},
                .slope_ranges = {}};
    std::erase_if(waves.octaves, [](const GridOctave& octave) { return octave.shown == 0; });
    for (const GridOctave& octave : waves.octaves) {
        PondTerms terms = pond_terms_of(octave.octave);
        terms.phase = {static_cast<double>(octave.at.m) / plan.resolution,
                       static_cast<double>(octave.at.n) / plan.resolution};
        waves.terms.push_back(terms);
    }
    const double mean_square_slope = statistics_of(waves).mean_square_slope;
    waves.slope_ranges = slope_ranges(mean_square_slope, mean_square_slope);
    return waves;
}

LineStatistics Pond::statistics_of(const Waves& waves) {
    const double texel_m = waves.plan.grid.side_m / waves.plan.resolution;
    const auto difference = [&](int periods) {  // response of central differences to a wave number
        return det::sine_cosine_of_turns(static_cast<double>(periods) / waves.plan.resolution).sine / texel_m;
    };
    LineStatistics statistics;
    for (const GridOctave& octave : waves.octaves) {
        const double shown = octave.shown * octave.shown;
        statistics.height_variance += octave.height_variance();
        statistics.mean_square_slope += shown * octave.slope_variance();
        const double height = octave.octave.height_m;
        statistics.slopes.add_wave(pond_slope_variance * (height * height) * shown, difference(octave.at.m),
                                   difference(octave.at.n));
    }
    return statistics;
}

void Pond::begin_spectrum(const SeaState& sea, const CascadePlan& plan) { bake_ = waves_of(sea, plan); }

LineStatistics Pond::adopt_spectrum(std::size_t, std::size_t) {
    waves_ = *std::exchange(bake_, std::nullopt);
    return statistics_of(waves_);
}

std::size_t Pond::bytes() const {
    return sizeof(Pond) + columns_.capacity() * sizeof(double) + row_bounds_.capacity() * sizeof(FrameBounds) +
           waves_.octaves.capacity() * sizeof(GridOctave) + waves_.terms.capacity() * sizeof(PondTerms);
}

}  // namespace pelagic
