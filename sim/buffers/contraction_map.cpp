#include "pelagic/sim/buffers/contraction_map.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Upper bound of the relative rounding error of float sums.
constexpr double rounding = 1 + 1e-5;

std::size_t blocks_of(int resolution) { return static_cast<std::size_t>(resolution) * resolution / 4; }

}  // namespace

ContractionMap::ContractionMap(int resolution, const Allocator& memory)
    : resolution_(resolution),
      blocks_((4 * blocks_of(resolution) - 1) / 3, memory),
      around_(blocks_of(resolution), memory),
      scratch_(2 * blocks_of(resolution), memory),
      extremes_(static_cast<std::size_t>(resolution) / rows_per_job) {
    static_assert(rows_per_job % 2 == 0);
}

void ContractionMap::find(const Cascade& cascade, const Kernels& kernels, std::size_t job) {
    assert(cascade.resolution() == resolution_);
    assert(static_cast<std::size_t>(cascade.height.block_columns) >= kernels.lanes);
    kernels.find_contraction({.surface = texels_of(cascade),
                              .texels_per_m = static_cast<float>(1 / cascade.texel_m()),
                              .cosine = static_cast<float>(cascade.grid.cosine),
                              .sine = static_cast<float>(cascade.grid.sine),
                              .one = ContractionBound::one,
                              .first_row = job * rows_per_job,
                              .rows = rows_per_job,
                              .blocks = blocks_.data(),
                              .extremes = &extremes_[job]});
}

double ContractionMap::largest_m() const {
    float squared = 0;
    for (const ContractionExtremes& piece : extremes_) squared = std::max(squared, piece.displacement_squared);
    return std::sqrt(static_cast<double>(squared)) * rounding;
}

void ContractionMap::spread(Cascade& cascade, std::span<const ContractionMap* const> maps, std::size_t number,
                            double finest_texel_m, const Kernels& kernels) {
    // r_i of contraction_map.hpp, including the position error of a search.
    double reach_m = 0, reference_m = margin * finest_texel_m;
    for (std::size_t i = maps.size(); i-- > 0;) {
        reference_m += 2 * maps[i]->largest_m();
        if (i == number) reach_m = reference_m / (i == 0 ? 1 : min_slack);
    }
    reach_m = std::min(reach_m, reference_m);

    std::size_t side = static_cast<std::size_t>(resolution_) / 2;
    const std::uint8_t* from = blocks_.data();
    for (std::size_t finer = side; finer > 1; finer /= 2) {
        kernels.halve_contraction(
            {.from = from, .side = finer / 2, .to = const_cast<std::uint8_t*>(from) + finer * finer});
        from += finer * finer;
    }
    const double reach = std::ceil(reach_m / (2 * cascade.texel_m()));
    if (reach < static_cast<double>(side) / 2)
        kernels.spread_contraction({.from = blocks_.data(),
                                    .side = side,
                                    .reach = static_cast<std::size_t>(reach),
                                    .scratch = scratch_.data(),
                                    .to = around_.data()});
    else
        std::fill_n(around_.data(), around_.size(), *from);

    float stretch = 0, steepness_squared = 0;
    for (const ContractionExtremes& piece : extremes_) {
        stretch = std::max(stretch, piece.stretch);
        steepness_squared = std::max(steepness_squared, piece.steepness_squared);
    }
    cascade.contraction = {
        .blocks = {blocks_.data(), blocks_.size()},
        .around = {around_.data(), around_.size()},
        .largest_m = static_cast<float>(largest_m()),
        .stretch = static_cast<float>(static_cast<double>(stretch) * rounding),
        .steepness = static_cast<float>(std::sqrt(static_cast<double>(steepness_squared)) * rounding)};
}

void ContractionMap::update(std::span<Cascade> cascades, std::span<ContractionMap* const> maps,
                            const Kernels& kernels) {
    const DefaultFloatEnvironment environment;
    std::array<const ContractionMap*, max_cascades> all;
    for (std::size_t i = 0; i < cascades.size(); ++i) {
        for (std::size_t job = 0; job < maps[i]->jobs(); ++job) maps[i]->find(cascades[i], kernels, job);
        all[i] = maps[i];
    }
    for (std::size_t i = 0; i < cascades.size(); ++i)
        maps[i]->spread(cascades[i], {all.data(), cascades.size()}, i, cascades.back().texel_m(), kernels);
}

}  // namespace pelagic
