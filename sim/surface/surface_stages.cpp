#include "pelagic/sim/surface/surface_stages.hpp"

#include <algorithm>
#include <utility>

#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/foam/snapshots.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/surface/surface_appearance.hpp"
#include "pelagic/simd/float_environment.hpp"

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

SurfaceStages::SurfaceStages(FrameSlots& slots, std::size_t cascade, const Kernels& kernels)
    : slots_(slots), cascade_(cascade), kernels_(kernels), resolution_(slots.resolution()) {
    if (slots.contents().gradients) gradient_averages_.emplace(resolution_, slots.memory());
    if (slots.contents().slopes) slope_averages_.emplace(resolution_, slots.memory(), slope_planes);
}

void SurfaceStages::add_to(JobGraph& graph, StageId surface_done) {
    StageId gradients_done = surface_done, slopes_done = surface_done;
    if (gradient_averages_)
        gradients_done = graph.add({.name = stage_name("gradients+mipmaps", cascade_),
                                    .count = pieces_of(resolution_).count(),
                                    .waits_for = {surface_done},
                                    .body = for_each_item([this](std::size_t piece) { gradients_mipmaps(piece); }),
                                    .stack_bytes = gradients_stack_bytes});
    if (slope_averages_)
        slopes_done = graph.add({.name = stage_name("slopes+mipmaps", cascade_),
                                 .count = slope_maps().jobs(),
                                 .waits_for = {surface_done},
                                 .body = for_each_item([this](std::size_t piece) {
                                     slope_maps(slots_.surface(cascade_)).make(kernels_, piece);
                                 }),
                                 .stack_bytes = slopes_stack_bytes});
    add_tails(graph, gradients_done, slopes_done);
}

void SurfaceStages::add_bands_to(JobGraph& graph, StageId lines_done, TransformColumns transform) {
    const std::size_t transform_bytes = 8 * static_cast<std::size_t>(resolution_) * kernels_.lanes + stack_margin;
    const TextureBands bands(resolution_, kernels_.lanes);
    const StageId edges_done =
        graph.add({.name = stage_name("edge columns", cascade_),
                   .count = bands.edges(),
                   .waits_for = {lines_done},
                   .body = for_each_item([bands, transform](std::size_t edge) { transform(bands.edge_pair(edge)); }),
                   .stack_bytes = transform_bytes});
    const auto process = [this, bands, transform](std::size_t begin, std::size_t end) {
        const DefaultFloatEnvironment environment;
        bands.process(begin, end, transform, [this](const TextureStrip& strip) { strip_textures(strip); });
    };
    const StageId textures_done = graph.add({.name = stage_name("columns+textures", cascade_),
                                             .count = bands.groups(),
                                             .batch = bands.groups_per_band(),
                                             .waits_for = {edges_done},
                                             .body = process,
                                             .stack_bytes = std::max(slopes_stack_bytes, transform_bytes)});
    add_tails(graph, textures_done, textures_done);
}

/// Adds the tails. The last one releases the surface, so it waits for all stages that read it.
void SurfaceStages::add_tails(JobGraph& graph, StageId gradients_done, StageId slopes_done) {
    const auto add = [&](const char* name, std::vector<StageId> waits_for, auto tail) {
        graph.add({.name = stage_name(name, cascade_),
                   .count = 1,
                   .waits_for = std::move(waits_for),
                   .body = for_each_item([tail](std::size_t) { tail(); }),
                   .stack_bytes = stack_margin});
    };
    if (gradient_averages_)
        add("mipmaps tail", {gradients_done}, [this] {
            if (!slope_averages_) slots_.release_surface(cascade_);
            mipmaps_tail();
        });
    if (slope_averages_)
        add("slopes tail", {gradients_done, slopes_done}, [this] {
            slots_.release_surface(cascade_);
            slope_maps().make_tail(kernels_);
        });
}

PresentCompression SurfaceStages::present_compression() {
    const Cascade& cascade = slots_.cascade(cascade_);
    PresentCompression compression = bytes_of_compression(cascade, slope_step(cascade.slope_ranges));
    compression.bytes = slots_.buffers(cascade_).compression.data();
    return compression;
}

GradientsJob SurfaceStages::gradients_job() {
    const auto roughness = static_cast<float>(slots_.frame().statistics.roughness);
    const CascadeGrid& grid = slots_.cascade(cascade_).grid;
    const double two_texels_m = 2 * grid.side_m / resolution_;
    const TextureTargets& textures = slots_.textures(cascade_);
    GradientsJob job{.surface = nullptr,
                     .resolution = static_cast<std::size_t>(resolution_),
                     .first_row = 0,
                     .first_column = 0,
                     .block_stride = column_block_floats(resolution_, kernels_.lanes),
                     .two_texels_m = static_cast<float>(two_texels_m),
                     .jacobian_factor = static_cast<float>(1 / (two_texels_m * two_texels_m)),
                     .normal_length = mean_normal_length(roughness),
                     .smoothness_bits = smoothness_bits(roughness),
                     .rgba16f = slopes_make_halves() ? nullptr : textures.displacement_rgba16f,
                     .levels = {},
                     .averages = gradient_averages_->level(GradientsJob::block_levels),
                     .average_stride = gradient_averages_->stride(GradientsJob::block_levels),
                     .cosine = static_cast<float>(grid.cosine),
                     .sine = static_cast<float>(grid.sine)};
    for (int level = 0; level <= GradientsJob::block_levels; ++level)
        job.levels[level] = textures.gradient_rgba8[static_cast<std::size_t>(level)];
    return job;
}

void SurfaceStages::gradients_mipmaps(std::size_t piece) {
    const Pieces all = pieces_of(resolution_);
    GradientsJob job = gradients_job();
    job.surface = slots_.surface(cascade_);
    job.first_row = piece / all.across * GradientsJob::block_rows;
    job.first_column = piece % all.across * GradientsJob::block_columns;
    kernels_.gradients(job);
}

void SurfaceStages::strip_textures(const TextureStrip& strip) {
    if (gradient_averages_) {
        GradientsJob job = gradients_job();
        job.surface = slots_.surface(cascade_);
        job.first_column = strip.first_column;
        job.narrow_columns = strip.columns;
        for (; job.first_row < job.resolution; job.first_row += GradientsJob::block_rows) kernels_.gradients(job);
    }
    if (slope_averages_) slope_maps(slots_.surface(cascade_)).make_strip(kernels_, strip);
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

SlopeMaps SurfaceStages::slope_maps(const float* surface) {
    const TextureTargets& textures = slots_.textures(cascade_);
    const Cascade& cascade = slots_.cascade(cascade_);
    return {.surface = surface,
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
