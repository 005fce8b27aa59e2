#include "pelagic/sim/sources/cascade.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/surface/surface_look.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// What a job's own functions take of the stack, beside the arrays that kernels.hpp states.
constexpr std::size_t stack_margin = 64 * 1024;
// Tiles are as large whatever N is.
constexpr std::size_t gradients_stack_bytes = 100 * 1024 + stack_margin;

/// Stages `evolve+rows` and, with less, `columns+finalize`.
std::size_t transform_stack_bytes(int resolution, std::size_t lanes) {
    return 24 * static_cast<std::size_t>(resolution) * lanes + stack_margin;
}

// Lines a job: a wind change should not hold up frames.
constexpr std::size_t spectrum_batch = 2;

struct TexelTiles {
    std::size_t across, down;
    std::size_t count() const { return across * down; }
};

TexelTiles tiles(int resolution) {
    const std::size_t n = static_cast<std::size_t>(resolution);
    return {std::max(n / GradientsJob::tile_columns, std::size_t{1}),
            std::max(n / GradientsJob::tile_rows, std::size_t{1})};
}

/// A stage whose items are independent, each in the default floating-point environment.
template <class Item>
JobBody for_each_item(Item item) {
    return [item](std::size_t begin, std::size_t end) {
        const DefaultFloatEnvironment environment;
        for (std::size_t i = begin; i < end; ++i) item(i);
    };
}

}  // namespace

Cascade::Slot::Slot(int n, std::size_t lanes, const CascadeExtras& extras)
    : surface(column_blocks(n, lanes) * column_block_floats(n, lanes), extras.memory),
      velocity(extras.velocities ? surface.size() : 0, extras.memory),
      rgba16f(4 * static_cast<std::size_t>(n) * n, extras.memory),
      rgba8(mip_offset(n, mip_levels(n)), extras.memory) {
    const auto view = [&](const AlignedBuffer<float>& planes, std::size_t component) {
        return PlaneView{planes.data() + component * lanes, n, static_cast<int>(lanes),
                         static_cast<std::ptrdiff_t>(surface_components * lanes),
                         static_cast<std::ptrdiff_t>(column_block_floats(n, lanes))};
    };
    frame.dx = view(surface, surface_dx);
    frame.height = view(surface, surface_height);
    frame.dz = view(surface, surface_dz);
    if (extras.velocities) {
        frame.velocity_x = view(velocity, surface_dx);
        frame.velocity_y = view(velocity, surface_height);
        frame.velocity_z = view(velocity, surface_dz);
    }
    if (extras.folds) frame.folds = folds.emplace(n, extras.memory).squares();
    frame.displacement_rgba16f = {rgba16f.data(), rgba16f.size()};
    frame.gradient_rgba8 = {rgba8.data(), rgba8.size()};
}

Cascade::Cascade(const SeaState& sea, Isa isa, CascadeExtras extras)
    : sea_(sea),
      isa_(isa),
      kernels_(kernels_for(isa)),
      extras_(extras),
      plan_(sea.resolution),
      fft_(plan_.tables()),
      spectrum_(plan_, kernels_.lanes, extras.memory),
      mip_averages_(sea.resolution, extras.memory),
      part_bounds_(column_block_pairs(sea.resolution, kernels_.lanes)),
      velocity_bounds_(extras.velocities ? part_bounds_.size() : 0),
      slots_{Slot(sea.resolution, kernels_.lanes, extras), Slot(sea.resolution, kernels_.lanes, extras)} {}

void Cascade::add_spectrum_stage(JobGraph& graph) {
    graph.add({.name = "spectrum",
               .count = line_count(sea_.resolution),
               .batch = spectrum_batch,
               .body = for_each_item([this](std::size_t line) { spectrum(line); }),
               .stack_bytes = stack_margin});
}

void Cascade::add_frame_stages(JobGraph& graph) {
    const std::size_t transforms = transform_stack_bytes(sea_.resolution, kernels_.lanes);
    const StageId lines_done = graph.add({.name = "evolve+rows",
                                          .count = line_blocks(sea_.resolution, kernels_.lanes),
                                          .body = for_each_item([this](std::size_t block) {
                                              kernels_.evolve_rows(evolve_rows_job(block, back().surface.data()));
                                          }),
                                          .stack_bytes = transforms});
    const StageId surface_done = graph.add({.name = "columns+finalize",
                                            .count = part_bounds_.size(),
                                            .waits_for = {lines_done},
                                            .body = for_each_item([this](std::size_t pair) {
                                                columns_finalize(pair, back().surface.data(), part_bounds_[pair]);
                                            }),
                                            .stack_bytes = transforms});
    const StageId tiles_done =
        graph.add({.name = "gradients+mipmaps",
                   .count = tiles(sea_.resolution).count(),
                   .waits_for = {surface_done},
                   .body = for_each_item([this](std::size_t tile) { gradients_mipmaps(tile); }),
                   .stack_bytes = gradients_stack_bytes});
    const auto tail = [this](std::size_t) { mipmaps_tail(); };
    graph.add({.name = "mipmaps tail",
               .count = 1,
               .waits_for = {tiles_done},
               .body = for_each_item(tail),
               .stack_bytes = stack_margin});
    if (extras_.folds) add_fold_stages(graph, surface_done);
    if (extras_.velocities) add_velocity_stages(graph);
}

void Cascade::add_fold_stages(JobGraph& graph, StageId surface_done) {
    const StageId cells_done = graph.add(
        {.name = "folds",
         .count = back().folds->jobs(),
         .waits_for = {surface_done},
         .body = for_each_item([this](std::size_t job) { back().folds->find(back().frame, kernels_, job); }),
         .stack_bytes = stack_margin});
    const auto tail = [this](std::size_t) { back().folds->mark(back().frame); };
    graph.add({.name = "folds tail",
               .count = 1,
               .waits_for = {cells_done},
               .body = for_each_item(tail),
               .stack_bytes = stack_margin});
}

// The derivative in time of a sum of waves is a sum of waves, so its lines and columns are those of the surface.
void Cascade::add_velocity_stages(JobGraph& graph) {
    const std::size_t transforms = transform_stack_bytes(sea_.resolution, kernels_.lanes);
    const StageId lines_done =
        graph.add({.name = "velocity rows",
                   .count = line_blocks(sea_.resolution, kernels_.lanes),
                   .body = for_each_item([this](std::size_t block) {
                       kernels_.evolve_velocity_rows(evolve_rows_job(block, back().velocity.data()));
                   }),
                   .stack_bytes = transforms});
    graph.add({.name = "velocity columns",
               .count = velocity_bounds_.size(),
               .waits_for = {lines_done},
               .body = for_each_item([this](std::size_t pair) {
                   columns_finalize(pair, back().velocity.data(), velocity_bounds_[pair]);
               }),
               .stack_bytes = transforms});
}

void Cascade::begin_frame(double time_s) {
    const DefaultFloatEnvironment environment;
    back_ = 1 - back_;
    back().frame.time_s = time_s;
    back().frame.sea = sea_;
    back().frame.figures = figures_;
    back().frame.isa = isa_;
    fraction_ = loop_fraction(time_s, sea_.loop_period_s);
}

const Frame& Cascade::end_frame() {
    PartBounds all = part_bounds_.front();
    for (const PartBounds& part : part_bounds_) {
        all.height_min = std::min(all.height_min, part.height_min);
        all.height_max = std::max(all.height_max, part.height_max);
        all.sideways_x_max = std::max(all.sideways_x_max, part.sideways_x_max);
        all.sideways_z_max = std::max(all.sideways_z_max, part.sideways_z_max);
    }
    back().frame.bounds = {all.height_min, all.height_max, all.sideways_x_max, all.sideways_z_max};
    return back().frame;
}

void Cascade::begin_spectrum(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    bake_.emplace(Bake{sea, WaveSpectrum(sea), PackedSpectrum(plan_, kernels_.lanes, extras_.memory),
                       std::vector<LineFigures>(line_count(sea.resolution))});
}

void Cascade::adopt_spectrum() {
    const DefaultFloatEnvironment environment;
    spectrum_ = std::move(bake_->spectrum);
    sea_ = bake_->sea;
    LineFigures all;
    for (const LineFigures& line : bake_->lines) {
        all.height_variance += line.height_variance;
        all.folding += line.folding;
    }
    figures_ = {4 * std::sqrt(all.height_variance),
                whitecap_jacobian(all.folding, sea_.choppiness, whitecap_cover(sea_.wind_speed_mps))};
    bake_.reset();
}

void Cascade::spectrum(std::size_t line) {
    bake_->lines[line] = bake_spectrum_line(bake_->sea, bake_->model, plan_, line, bake_->spectrum);
}

EvolveRowsJob Cascade::evolve_rows_job(std::size_t line_block, float* lines) {
    constexpr double two_pi = 6.28318530717958647693;
    const std::size_t first_line = line_block * kernels_.lanes;
    return {.waves = spectrum_.block(line_block),
            .harmonics = spectrum_.block_harmonics(line_block),
            .fraction = fraction_.turns,
            .first_line = first_line,
            .line_count = std::min(kernels_.lanes, line_count(sea_.resolution) - first_line),
            .fft = &fft_,
            .lines = lines,
            .first_frequency = static_cast<float>(two_pi / sea_.loop_period_s)};
}

void Cascade::columns_finalize(std::size_t number, float* surface, PartBounds& bounds) {
    ColumnsFinalizeJob job{
        .blocks = {}, .fft = &fft_, .choppiness = static_cast<float>(sea_.choppiness), .bounds = &bounds};
    const std::size_t block_floats = column_block_floats(sea_.resolution, kernels_.lanes);
    const ColumnBlockPair pair = column_block_pair(sea_.resolution, kernels_.lanes, number);
    job.blocks[0] = surface + pair.first * block_floats;
    if (pair.has_second) job.blocks[1] = surface + pair.second * block_floats;
    kernels_.columns_finalize(job);
}

void Cascade::gradients_mipmaps(std::size_t tile) {
    const auto roughness = static_cast<float>(sea_.roughness);
    const double two_texels_m = 2 * sea_.patch_size_m / sea_.resolution;
    const TexelTiles all = tiles(sea_.resolution);
    GradientsJob job{.surface = back().surface.data(),
                     .resolution = static_cast<std::size_t>(sea_.resolution),
                     .first_row = tile / all.across * GradientsJob::tile_rows,
                     .first_column = tile % all.across * GradientsJob::tile_columns,
                     .block_stride = column_block_floats(sea_.resolution, kernels_.lanes),
                     .two_texels_m = static_cast<float>(two_texels_m),
                     .jacobian_factor = static_cast<float>(1 / (two_texels_m * two_texels_m)),
                     .normal_length = mean_normal_length(roughness),
                     .smoothness_bits = smoothness_bits(roughness),
                     .rgba16f = back().rgba16f.data(),
                     .levels = {},
                     .averages = mip_averages_.level(GradientsJob::tile_levels),
                     .average_stride = mip_averages_.stride(GradientsJob::tile_levels)};
    for (int level = 0; level <= GradientsJob::tile_levels; ++level)
        job.levels[level] = back().rgba8.data() + mip_offset(sea_.resolution, level);
    kernels_.gradients(job);
}

void Cascade::mipmaps_tail() {
    for (int level = GradientsJob::tile_levels + 1; level < mip_levels(sea_.resolution); ++level)
        kernels_.mip_level({.finer = mip_averages_.level(level - 1),
                            .finer_stride = mip_averages_.stride(level - 1),
                            .side = static_cast<std::size_t>(sea_.resolution) >> level,
                            .averages = mip_averages_.level(level),
                            .stride = mip_averages_.stride(level),
                            .texels = back().rgba8.data() + mip_offset(sea_.resolution, level)});
}

std::size_t Cascade::bytes() const {
    return plan_.bytes() + spectrum_.bytes() + mip_averages_.bytes() +
           (part_bounds_.capacity() + velocity_bounds_.capacity()) * sizeof(PartBounds) + slots_[0].bytes() +
           slots_[1].bytes();
}

}  // namespace pelagic
