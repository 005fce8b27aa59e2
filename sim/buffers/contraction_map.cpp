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

constexpr std::size_t block_rows = FindContractionJob::block_rows;

std::size_t blocks_of(int resolution) { return static_cast<std::size_t>(resolution) * resolution / block_rows; }

/// Returns the number of bytes of ContractionBound::blocks.
std::size_t bytes_of_levels(int resolution) {
    const std::size_t squares = static_cast<std::size_t>(resolution) / block_rows;
    return blocks_of(resolution) * 3 / 2 + (4 * squares * squares - 1) / 3;
}

}  // namespace

ContractionMap::ContractionMap(int resolution, const Allocator& memory)
    : resolution_(resolution),
      blocks_(bytes_of_levels(resolution), memory),
      around_(blocks_of(resolution), memory),
      scratch_(2 * blocks_of(resolution) + SpreadContractionJob::margin, memory),
      extremes_(static_cast<std::size_t>(resolution) / rows_per_job),
      steepness_(std::make_unique<std::atomic<float>>(-1.f)) {
    static_assert(rows_per_job % block_rows == 0);
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

int ContractionMap::largest_byte() const {
    int largest = 0;
    for (const ContractionExtremes& piece : extremes_) largest = std::max(largest, int{piece.byte});
    return largest;
}

void ContractionMap::spread(Cascade& cascade, std::span<const ContractionMap* const> maps, std::size_t number,
                            double finest_texel_m, const Kernels& kernels) {
    constexpr int one = ContractionBound::one;
    constexpr int max_but_last = static_cast<int>(one * (1 - min_slack));
    constexpr int max_of_all = static_cast<int>(one * (1 - min_slack_of_all));
    static_assert(max_but_last < 255 && max_of_all < 255, "the largest byte must fail");
    // r_i of contraction_map.hpp, including the position error of a search.
    double reach_m = 0, reference_m = margin * finest_texel_m;
    int coarser = 0;
    for (std::size_t i = 0; i < number; ++i) coarser += maps[i]->largest_byte();
    const double slack = 1 - static_cast<double>(std::min(coarser, max_but_last)) / one;
    for (std::size_t i = maps.size(); i-- > 0;) {
        reference_m += 2 * maps[i]->largest_m();
        if (i == number) reach_m = reference_m / slack;
    }
    reach_m = std::min(reach_m, reference_m);

    const std::size_t n = static_cast<std::size_t>(resolution_);
    std::uint8_t* from = blocks_.data();
    for (std::size_t columns = n, rows = n / block_rows; columns > 1;) {
        std::uint8_t* const to = from + columns * rows;
        const std::size_t rows_each = columns > rows ? 1 : 2;
        columns /= 2;
        rows /= rows_each;
        kernels.halve_contraction({.from = from, .columns = columns, .rows = rows, .rows_each = rows_each, .to = to});
        from = to;
    }
    const double reach_x = std::ceil(reach_m / cascade.texel_m());
    const double reach_z = std::ceil(reach_m / (block_rows * cascade.texel_m()));
    if (2 * reach_x < static_cast<double>(n) && 2 * block_rows * reach_z < static_cast<double>(n))
        kernels.spread_contraction({.from = blocks_.data(),
                                    .columns = n,
                                    .rows = n / block_rows,
                                    .reach_x = static_cast<std::size_t>(reach_x),
                                    .reach_z = static_cast<std::size_t>(reach_z),
                                    .scratch = scratch_.data(),
                                    .to = around_.data()});
    else
        std::fill_n(around_.data(), around_.size(), *from);

    float stretch_squared = 0;
    for (const ContractionExtremes& piece : extremes_)
        stretch_squared = std::max(stretch_squared, piece.stretch_squared);
    steepness_->store(-1, std::memory_order_relaxed);
    cascade.contraction = {
        .blocks = {blocks_.data(), blocks_.size()},
        .around = {around_.data(), around_.size()},
        .max_sum = number + 1 == maps.size() ? max_of_all : std::min(coarser + largest_byte(), max_but_last),
        .largest_m = static_cast<float>(largest_m()),
        .stretch = static_cast<float>(std::sqrt(static_cast<double>(stretch_squared)) * rounding),
        .steepness = steepness_.get()};
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
