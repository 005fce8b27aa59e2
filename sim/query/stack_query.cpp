// There are two methods for reference points. A SIMD kernel finds one iteratively, and one byte of
// each cascade proves that it is the only one (contraction_map.hpp). If the bytes do not prove it,
// stack_search.hpp tries a proof for this point. If that fails, or the iteration did not converge,
// it finds all reference points.
#include "pelagic/sim/query/stack_query.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/buffers/contraction_map.hpp"
#include "pelagic/sim/shore.hpp"

namespace pelagic {
namespace {

// Bounds of the search's target: the lower one in units of 1 m plus the largest displacement, the
// upper one in finest texels. Above it, a false reference point might be accepted.
constexpr double min_stack_target = 1e-6, max_stack_target = 1.0 / 64;
static_assert(max_stack_target < ContractionMap::margin);

}  // namespace

StackQuery::StackQuery(const Frame& frame, const Kernels& kernels, const SurfaceQueryOptions& options)
    : kernels_(kernels),
      interpolation_(options.interpolation),
      cascades_(frame.cascades),
      shore_(frame.shore),
      foam_(frame),
      finest_texel_m_(cascades_.back().texel_m()) {
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        search_cascades_[t] = SearchCascade(cascades_[t], interpolation_);
        reach_m_ += static_cast<double>(search_cascades_[t].contraction.largest_m);
    }
    target_m_ = std::clamp(options.tolerance_m * query_aim, min_stack_target * (1 + reach_m_),
                           max_stack_target * finest_texel_m_);
}

void StackQuery::locate_points(PointChunk& chunk) const {
    if (shore_)
        for (std::size_t i = 0; i < chunk.padded; ++i) {
            const std::array<float, max_cascades> weights = shore_weights_at(shore_, chunk.x[i], chunk.z[i]);
            for (std::size_t t = 0; t < cascades_.size(); ++t) chunk.weight[t][i] = weights[t];
        }
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        const SearchCascade& cascade = search_cascades_[t];
        kernels_.split_positions({.x = chunk.x,
                                  .z = chunk.z,
                                  .texel_m = 0,
                                  .along = cascade.along,
                                  .across = cascade.across,
                                  .resolution = cascade.texels.resolution,
                                  .count = chunk.padded,
                                  .out = chunk.world[t].positions()});
    }
}

StackCascade StackQuery::stack_cascade(std::size_t cascade, PointChunk& chunk) const {
    return {.surface = search_cascades_[cascade].texels,
            .along = static_cast<float>(search_cascades_[cascade].along),
            .across = static_cast<float>(search_cascades_[cascade].across),
            .world = chunk.world[cascade].positions(),
            .weight = shore_ ? chunk.weight[cascade] : nullptr};
}

void StackQuery::find_reference_points(PointChunk& chunk) const {
    InvertStackJob job{.cascades = {},
                       .cascade_count = cascades_.size(),
                       .target = static_cast<float>(target_m_),
                       .reach = static_cast<float>(reach_m_),
                       .count = chunk.padded,
                       .offset_x = chunk.offset_x,
                       .offset_z = chunk.offset_z,
                       .error = chunk.error,
                       .blocks = {}};
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        job.cascades[t] = stack_cascade(t, chunk);
        job.blocks[t] = chunk.blocks[t];
    }
    kernels_.invert_stack.linear(job);
    if (interpolation_ == Interpolation::cubic) kernels_.invert_stack.cubic(job);
    for (std::size_t i = 0; i < chunk.count; ++i)
        if (!(chunk.error[i] <= static_cast<float>(target_m_) && is_only_one(chunk, i))) search(chunk, i);
}

bool StackQuery::is_only_one(const PointChunk& chunk, std::size_t point) const {
    int sum = 0;
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        const ContractionBound& bound = search_cascades_[t].contraction;
        sum += bound.around[static_cast<std::size_t>(chunk.blocks[t][point])];
        if (sum > bound.max_sum) return false;
    }
    return true;
}

void StackQuery::search(PointChunk& chunk, std::size_t point) const {
    StackPoint where;
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        where.cell_x[t] = chunk.world[t].cell_x[point];
        where.cell_z[t] = chunk.world[t].cell_z[point];
        where.u[t] = static_cast<double>(chunk.world[t].u[point]);
        where.v[t] = static_cast<double>(chunk.world[t].v[point]);
        if (shore_) where.weight[t] = static_cast<double>(chunk.weight[t][point]);
    }
    const Offset stepped{static_cast<double>(chunk.offset_x[point]), static_cast<double>(chunk.offset_z[point])};
    const bool has_converged = chunk.error[point] <= static_cast<float>(target_m_);
    const StackSearch all({search_cascades_.data(), cascades_.size()}, target_m_);
    if (has_converged && all.is_only_one(where, stepped)) return;
    const StackIntersection intersection = all.highest_intersection(where, has_converged ? &stepped : nullptr);
    if (!intersection.found) return;  // keep the iteration's result and error
    chunk.offset_x[point] = static_cast<float>(intersection.offset.x);
    chunk.offset_z[point] = static_cast<float>(intersection.offset.z);
    chunk.error[point] = static_cast<float>(intersection.error_m);
}

void StackQuery::read(const SampleSurfaceJob::Outputs& outputs, PointChunk& chunk) const {
    SampleStackJob job{.cascades = {},
                       .cascade_count = cascades_.size(),
                       .count = chunk.padded,
                       .offset_x = chunk.offset_x,
                       .offset_z = chunk.offset_z,
                       .out = outputs};
    for (std::size_t t = 0; t < cascades_.size(); ++t) job.cascades[t] = stack_cascade(t, chunk);
    (interpolation_ == Interpolation::cubic ? kernels_.sample_stack.cubic : kernels_.sample_stack.linear)(job);
}

ReferenceCell StackQuery::reference_cell(std::size_t cascade, const PointChunk& chunk, std::size_t point) const {
    const auto along = static_cast<float>(search_cascades_[cascade].along),
               across = static_cast<float>(search_cascades_[cascade].across);
    const PointChunk::World& world = chunk.world[cascade];
    const float x = chunk.offset_x[point], z = chunk.offset_z[point];
    // as the kernels do
    const float u = world.u[point] + (along * x + across * z), v = world.v[point] + (along * z - across * x);
    const std::int32_t column = floor_of(u), row = floor_of(v);
    return {world.cell_x[point] + column, world.cell_z[point] + row, u - static_cast<float>(column),
            v - static_cast<float>(row)};
}

void StackQuery::read_foam(const PointChunk& chunk, std::span<float> foam) const {
    for (std::size_t i = 0; i < foam.size(); ++i) {
        const double x = chunk.x[i] + static_cast<double>(chunk.offset_x[i]);
        const double z = chunk.z[i] + static_cast<double>(chunk.offset_z[i]);
        std::array<float, max_cascades> weights;
        for (std::size_t t = 0; shore_ && t < cascades_.size(); ++t) weights[t] = chunk.weight[t][i];
        foam[i] = foam_.at(x, z, std::span(weights).first(shore_ ? cascades_.size() : 0));
    }
}

}  // namespace pelagic
