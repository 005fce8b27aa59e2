#include "pelagic/sim/sources/cascade.hpp"

#include <algorithm>
#include <utility>

#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/surface/item_stage.hpp"
#include "pelagic/sim/surface/slope_maps.hpp"
#include "pelagic/sim/tick_clock.hpp"

namespace pelagic {
namespace {

/// Stages `evolve+rows` and, with less, `columns+finalize`.
std::size_t transform_stack_bytes(int resolution, std::size_t lanes) {
    return 24 * static_cast<std::size_t>(resolution) * lanes + stack_margin;
}

// Lines a job: a wind change should not hold up frames.
constexpr std::size_t spectrum_batch = 2;

}  // namespace

Cascade::Cascade(FrameSlots& slots, std::size_t tile, const Kernels& kernels, const FrameExtras& extras)
    : slots_(slots),
      tile_(tile),
      kernels_(kernels),
      memory_(extras.memory),
      has_velocities_(extras.velocities),
      resolution_(slots.resolution()),
      plan_(resolution_),
      fft_(plan_.tables()),
      spectrum_(plan_, kernels_.lanes, memory_),
      part_bounds_(column_block_pairs(resolution_, kernels_.lanes)),
      velocity_bounds_(has_velocities_ ? part_bounds_.size() : 0) {}

void Cascade::add_spectrum_stage(JobGraph& graph) {
    graph.add({.name = stage_name("spectrum", tile_),
               .count = line_count(resolution_),
               .batch = spectrum_batch,
               .body = for_each_item([this](std::size_t line) { spectrum(line); }),
               .stack_bytes = stack_margin});
}

StageId Cascade::add_stages(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) {
    const std::size_t transforms = transform_stack_bytes(resolution_, kernels_.lanes);
    const auto surface = [this] { return slots_.buffers(tile_).surface.data(); };
    const bool is_tick = pass == Pass::tick;
    const StageId lines_done = graph.add({.name = stage_name(is_tick ? "tick evolve+rows" : "evolve+rows", tile_),
                                          .count = line_blocks(resolution_, kernels_.lanes),
                                          .waits_for = waits_for,
                                          .body = for_each_item([this, pass, surface](std::size_t block) {
                                              if (is_idle_[pass]) return;
                                              kernels_.evolve_rows(evolve_rows_job(pass, block, surface()));
                                          }),
                                          .stack_bytes = transforms});
    const StageId surface_done = graph.add({.name = stage_name(is_tick ? "tick columns" : "columns+finalize", tile_),
                                            .count = part_bounds_.size(),
                                            .waits_for = {lines_done},
                                            .body = for_each_item([this, pass, surface](std::size_t pair) {
                                                if (is_idle_[pass]) return;
                                                columns_finalize(pair, surface(), part_bounds_[pair]);
                                            }),
                                            .stack_bytes = transforms});
    if (has_velocities_ && !is_tick) add_velocity_stages(graph);
    return surface_done;
}

// The derivative in time of a sum of waves is a sum of waves, so its lines and columns are those of the surface.
void Cascade::add_velocity_stages(JobGraph& graph) {
    const std::size_t transforms = transform_stack_bytes(resolution_, kernels_.lanes);
    const auto velocity = [this] { return slots_.buffers(tile_).velocity.data(); };
    const StageId lines_done =
        graph.add({.name = stage_name("velocity rows", tile_),
                   .count = line_blocks(resolution_, kernels_.lanes),
                   .body = for_each_item([this, velocity](std::size_t block) {
                       kernels_.evolve_velocity_rows(evolve_rows_job(Pass::frame, block, velocity()));
                   }),
                   .stack_bytes = transforms});
    graph.add({.name = stage_name("velocity columns", tile_),
               .count = velocity_bounds_.size(),
               .waits_for = {lines_done},
               .body = for_each_item([this, velocity](std::size_t pair) {
                   columns_finalize(pair, velocity(), velocity_bounds_[pair]);
               }),
               .stack_bytes = transforms});
}

void Cascade::begin(Pass pass, const SeaMoment& moment, Tile& tile) {
    fraction_[pass] = loop_fraction(moment.time_s, loop_period_s_);
    tile.lattice = lattice_;
    tile.whitecap_jacobian = whitecaps_.jacobian;
    tile.whitecap_ramp = whitecaps_.ramp;
    is_idle_[pass] = pass == Pass::tick && !tile.makes_whitecaps();
    tile.slope_ranges = slope_ranges_;
}

FrameBounds Cascade::end_frame() {
    PartBounds all = part_bounds_.front();
    for (const PartBounds& part : part_bounds_) {
        all.height_min = std::min(all.height_min, part.height_min);
        all.height_max = std::max(all.height_max, part.height_max);
        all.sideways_x_max = std::max(all.sideways_x_max, part.sideways_x_max);
        all.sideways_z_max = std::max(all.sideways_z_max, part.sideways_z_max);
    }
    return {all.height_min, all.height_max, all.sideways_x_max, all.sideways_z_max};
}

void Cascade::begin_spectrum(const SeaState& sea, const TilePlan& plan, double whitecap_cover) {
    bake_.emplace(Bake{sea, whitecap_cover, TileWaves(sea, plan), PackedSpectrum(plan_, kernels_.lanes, memory_),
                       std::vector<LineFigures>(line_count(resolution_))});
}

LineFigures Cascade::adopt_spectrum() {
    LineFigures all;
    for (const LineFigures& line : bake_->lines) {
        all.height_variance += line.height_variance;
        all.mean_square_slope += line.mean_square_slope;
        all.folding += line.folding;
        all.slopes += line.slopes;
        all.stokes_x += line.stokes_x;
        all.stokes_z += line.stokes_z;
    }
    const SeaState& sea = bake_->sea;
    whitecaps_ = bake_->whitecap_cover > 0 ? whitecap_threshold(all.folding, sea.choppiness, bake_->whitecap_cover,
                                                                TickClock(sea.loop_period_s).tick_s())
                                           : WhitecapThreshold{.jacobian = Tile::no_whitecaps, .ramp = 1};
    slope_ranges_ = slope_ranges(all.mean_square_slope);
    lattice_ = bake_->waves.tile().lattice;
    loop_period_s_ = sea.loop_period_s;
    choppiness_ = static_cast<float>(sea.choppiness);
    spectrum_ = std::move(bake_->spectrum);
    bake_.reset();
    return all;
}

void Cascade::spectrum(std::size_t line) {
    bake_->lines[line] = bake_spectrum_line(bake_->sea, bake_->waves, plan_, line, bake_->spectrum);
}

EvolveRowsJob Cascade::evolve_rows_job(Pass pass, std::size_t line_block, float* lines) {
    constexpr double two_pi = 6.28318530717958647693;
    const std::size_t first_line = line_block * kernels_.lanes;
    return {.waves = spectrum_.block(line_block),
            .harmonics = spectrum_.block_harmonics(line_block),
            .fraction = fraction_[pass].turns,
            .first_line = first_line,
            .line_count = std::min(kernels_.lanes, line_count(resolution_) - first_line),
            .fft = &fft_,
            .lines = lines,
            .first_frequency = static_cast<float>(two_pi / loop_period_s_)};
}

void Cascade::columns_finalize(std::size_t number, float* surface, PartBounds& bounds) {
    ColumnsFinalizeJob job{.blocks = {},
                           .fft = &fft_,
                           .choppiness = choppiness_,
                           .cosine = static_cast<float>(lattice_.cosine),
                           .sine = static_cast<float>(lattice_.sine),
                           .bounds = &bounds};
    const std::size_t block_floats = column_block_floats(resolution_, kernels_.lanes);
    const ColumnBlockPair pair = column_block_pair(resolution_, kernels_.lanes, number);
    job.blocks[0] = surface + pair.first * block_floats;
    if (pair.has_second) job.blocks[1] = surface + pair.second * block_floats;
    kernels_.columns_finalize(job);
}

std::size_t Cascade::bytes() const {
    return sizeof(Cascade) + plan_.bytes() + spectrum_.bytes() +
           (part_bounds_.capacity() + velocity_bounds_.capacity()) * sizeof(PartBounds);
}

}  // namespace pelagic
