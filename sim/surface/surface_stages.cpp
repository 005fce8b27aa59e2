#include "pelagic/sim/surface/surface_stages.hpp"

#include <algorithm>

#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/foam/foam_source.hpp"
#include "pelagic/sim/foam/snapshots.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/surface/surface_appearance.hpp"

namespace pelagic {
namespace {

// The stack size does not depend on N, because jobs process blocks of texels of fixed size.
constexpr std::size_t gradients_stack_bytes = 48 * 1024 + stack_margin;
constexpr std::size_t slopes_stack_bytes = 60 * 1024 + stack_margin;

struct Pieces {
    std::size_t across, down;
    std::size_t count() const { return across * down; }
};

Pieces pieces_of(int resolution) {
    const std::size_t n = static_cast<std::size_t>(resolution);
    return {std::max(n / GradientsJob::block_columns, std::size_t{1}),
            std::max(n / GradientsJob::block_rows, std::size_t{1})};
}

}  // namespace

SurfaceStages::SurfaceStages(FrameSlots& slots, std::size_t cascade, const Kernels& kernels,
                             const FrameExtras& extras)
    : slots_(slots), cascade_(cascade), kernels_(kernels), resolution_(slots.resolution()), has_foam_(extras.foam) {
    if (extras.gradients) gradient_averages_.emplace(resolution_, extras.memory);
    if (extras.slopes) slope_averages_.emplace(resolution_, extras.memory, slope_planes);
}

void SurfaceStages::add_to(JobGraph& graph, StageId surface_done) {
    if (gradient_averages_) add_gradient_stages(graph, surface_done);
    if (slope_averages_) add_slope_stages(graph, surface_done);
}

void SurfaceStages::add_gradient_stages(JobGraph& graph, StageId surface_done) {
    const StageId pieces_done =
        graph.add({.name = stage_name("gradients+mipmaps", cascade_),
                   .count = pieces_of(resolution_).count(),
                   .waits_for = {surface_done},
                   .body = for_each_item([this](std::size_t piece) { gradients_mipmaps(piece); }),
                   .stack_bytes = gradients_stack_bytes});
    if (slots_.cascade_count() == 1) add_foam_tail(graph, pieces_done);
    const auto tail = [this](std::size_t) { mipmaps_tail(); };
    graph.add({.name = stage_name("mipmaps tail", cascade_),
               .count = 1,
               .waits_for = {pieces_done},
               .body = for_each_item(tail),
               .stack_bytes = stack_margin});
}

void SurfaceStages::add_slope_stages(JobGraph& graph, StageId surface_done) {
    const StageId pieces_done =
        graph.add({.name = stage_name("slopes+mipmaps", cascade_),
                   .count = slope_maps().jobs(),
                   .waits_for = {surface_done},
                   .body = for_each_item([this](std::size_t piece) { slope_maps().make(kernels_, piece); }),
                   .stack_bytes = slopes_stack_bytes});
    const auto tail = [this](std::size_t) { slope_maps().make_tail(kernels_); };
    graph.add({.name = stage_name("slopes tail", cascade_),
               .count = 1,
               .waits_for = {pieces_done},
               .body = for_each_item(tail),
               .stack_bytes = stack_margin});
}

void SurfaceStages::add_foam_tail(JobGraph& graph, StageId foam_done) {
    if (!has_foam_) return;
    const auto tail = [this](std::size_t) {
        std::uint8_t* const chain = slots_.buffers(cascade_).foam.data();
        for (int level = 1; level < mip_levels(resolution_); ++level)
            kernels_.halve_foam({.from = chain + mip_offset(resolution_, level - 1),
                                 .side = static_cast<std::size_t>(resolution_) >> level,
                                 .to = chain + mip_offset(resolution_, level)});
    };
    graph.add({.name = stage_name("foam tail", cascade_),
               .count = 1,
               .waits_for = {foam_done},
               .body = for_each_item(tail),
               .stack_bytes = stack_margin});
}

ShownFoam SurfaceStages::shown_foam() {
    const RememberedFoam& remembered = slots_.remembered_foam();
    return {.source = foam_source(slots_.cascade(cascade_)),
            .remembered = remembered.bytes,
            .fade = remembered.fade,
            .bytes = slots_.buffers(cascade_).foam.data()};
}

PresentCompression SurfaceStages::present_compression() {
    const Cascade& cascade = slots_.cascade(cascade_);
    PresentCompression compression =
        bytes_of_compression(cascade.compression_scale * slope_step(cascade.slope_ranges));
    compression.bytes = slots_.buffers(cascade_).compression.data();
    return compression;
}

void SurfaceStages::gradients_mipmaps(std::size_t piece) {
    const auto roughness = static_cast<float>(slots_.frame().statistics.roughness);
    const CascadeGrid& grid = slots_.cascade(cascade_).grid;
    const double two_texels_m = 2 * grid.side_m / resolution_;
    const Pieces all = pieces_of(resolution_);
    const TextureTargets& textures = slots_.textures(cascade_);
    GradientsJob job{.surface = slots_.buffers(cascade_).surface.data(),
                     .resolution = static_cast<std::size_t>(resolution_),
                     .first_row = piece / all.across * GradientsJob::block_rows,
                     .first_column = piece % all.across * GradientsJob::block_columns,
                     .block_stride = column_block_floats(resolution_, kernels_.lanes),
                     .two_texels_m = static_cast<float>(two_texels_m),
                     .jacobian_factor = static_cast<float>(1 / (two_texels_m * two_texels_m)),
                     .normal_length = mean_normal_length(roughness),
                     .smoothness_bits = smoothness_bits(roughness),
                     .rgba16f = slopes_make_halves() ? nullptr : textures.displacement_rgba16f,
                     .foam = shown_foam(),
                     .levels = {},
                     .averages = gradient_averages_->level(GradientsJob::block_levels),
                     .average_stride = gradient_averages_->stride(GradientsJob::block_levels),
                     .cosine = static_cast<float>(grid.cosine),
                     .sine = static_cast<float>(grid.sine)};
    for (int level = 0; level <= GradientsJob::block_levels; ++level)
        job.levels[level] = textures.gradient_rgba8[static_cast<std::size_t>(level)];
    kernels_.gradients(job);
}

void SurfaceStages::mipmaps_tail() {
    for (int level = GradientsJob::block_levels + 1; level < mip_levels(resolution_); ++level)
        kernels_.mip_level({.finer = gradient_averages_->level(level - 1),
                            .finer_stride = gradient_averages_->stride(level - 1),
                            .side = static_cast<std::size_t>(resolution_) >> level,
                            .averages = gradient_averages_->level(level),
                            .stride = gradient_averages_->stride(level),
                            .texels = slots_.textures(cascade_).gradient_rgba8[static_cast<std::size_t>(level)]});
}

SlopeMaps SurfaceStages::slope_maps() {
    const TextureTargets& textures = slots_.textures(cascade_);
    const Cascade& cascade = slots_.cascade(cascade_);
    return {.surface = slots_.buffers(cascade_).surface.data(),
            .resolution = resolution_,
            .block_stride = column_block_floats(resolution_, kernels_.lanes),
            .side_m = cascade.grid.side_m,
            .cosine = cascade.grid.cosine,
            .sine = cascade.grid.sine,
            .ranges = cascade.slope_ranges,
            .rgba16f = slopes_make_halves() ? textures.displacement_rgba16f : nullptr,
            .compression = present_compression(),
            .slopes = textures.slopes_rgba8,
            .moments = textures.moments_rgba8,
            .averages = &*slope_averages_};
}

}  // namespace pelagic
