#include "pelagic/sim/cascades/water_level_runs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/spectrum/depth_weights.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

/// Depth of the first velocity below the surface, and shortest waves of the fits between levels, in texels.
constexpr double first_velocity = 6, shortest_of_velocity_fit = 16, shortest_of_head_fit = 8;
/// Shortest waves of a cascade that is given, and of one of a stack (spectrum/bands.cpp), in texels.
constexpr double shortest_of_grid = 2, shortest_of_band = 3;
/// A level replaces the bottom's if it lies higher than this part of the water's depth.
constexpr double highest_bottom = 0.6;
/// Texels of a plane over those of the cascade, times its depth in texels.
constexpr double texels_times_depth = 1.5;
constexpr int min_resolution = 16;
/// Smallest vertical velocity relative to the horizontal one at the bottom, and to the head of waves that
/// velocities leave out: packed waves hold the vertical velocity, and the others are multiples of it.
constexpr double least_rise = 1e-6;

/// Where a spectrum holds the wave (m, n) of each m.
class WavePlaces {
   public:
    WavePlaces(const FftPlan& plan, int resolution) : places_(static_cast<std::size_t>(resolution)) {
        const int radix = plan.tables().first_step().radix;
        std::uint32_t pair_number = 0;
        for (const GroupPair& pair : plan.pairs())
            for (int s = 0; s < radix; ++s, ++pair_number) {
                const auto position = static_cast<std::size_t>(pair.plus + s * (resolution / radix));
                places_[position] = {pair_number, false};
                if (!pair.is_own_negative())
                    places_[(places_.size() - position) % places_.size()] = {pair_number, true};
            }
    }
    struct Place {
        std::uint32_t pair = 0;
        bool is_minus = false;
    };
    Place at(int m) const { return places_[static_cast<std::size_t>(m) & (places_.size() - 1)]; }

   private:
    std::vector<Place> places_;
};

/// Returns the factor that makes samples of a wave the coefficients of a cubic B-spline.
double spline_factor(int m, int n, int resolution) {
    const auto mean = [resolution](int periods) {
        return (2 + det::sine_cosine_of_turns(static_cast<double>(periods) / resolution).cosine) / 3;
    };
    return 1 / (mean(m) * mean(n));
}

}  // namespace

void blend_waves(const Kernels& kernels, const PackedSpectrum& before, const PackedSpectrum& after,
                 std::size_t line_block, float weight, const std::vector<float>& band_weights, float* out) {
    if (band_weights.empty())
        kernels.blend_waves({.before = before.block(line_block),
                             .after = after.block(line_block),
                             .pairs = before.pairs,
                             .weight = weight,
                             .out = out});
    else
        kernels.blend_arriving_waves({.before = before.block(line_block),
                                      .after = after.block(line_block),
                                      .harmonics = before.block_harmonics(line_block),
                                      .pairs = before.pairs,
                                      .weights = band_weights.data(),
                                      .last_band = static_cast<std::int32_t>(band_weights.size()) - 1,
                                      .out = out});
}

WaterLevelRuns::WaterLevelRuns(int resolution, bool has_depth, const Kernels& kernels, const Allocator& memory)
    : resolution_(resolution), has_depth_(has_depth), kernels_(kernels), memory_(memory) {
    for (int size = min_resolution; size <= std::max(resolution / 2, min_resolution); size *= 2)
        transforms_.push_back(std::make_unique<const Transform>(size));
}

const WaterLevelRuns::Transform& WaterLevelRuns::transform_of(int resolution) const {
    return **std::find_if(transforms_.begin(), transforms_.end(),
                          [&](const auto& transform) { return transform->fft.size == resolution; });
}

/// The last grid lies at three quarters of the cascade's side or deeper.
std::size_t WaterLevelRuns::max_count() const {
    return has_depth_ ? static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(resolution_))) - 2 : 1;
}

WaterLayout WaterLevelRuns::layout_of(const CascadePlan& plan, double water_m) const {
    const double texel_m = plan.grid.side_m / plan.resolution;
    // A plane's shortest wave, of two texels, has an amplitude of 0.009 at its depth.
    const auto resolution_at = [&](double depth_m) {
        int side = std::max(resolution_ / 2, min_resolution);
        while (side > min_resolution && side / 2 * depth_m >= texels_times_depth * resolution_ * texel_m) side /= 2;
        return side;
    };
    WaterLayout layout;
    layout.levels.count = 1;
    layout.levels.grids[0].resolution = resolution_at(0);
    if (!has_depth_) return layout;
    DepthLadder &velocity = layout.velocity, &head = layout.head;
    const auto append = [](DepthLadder& ladder, double depth_m) { ladder.depths_m[ladder.count++] = depth_m; };
    const std::size_t max_levels = std::max(max_count(), std::size_t{3});
    append(velocity, 0);
    for (double depth_m = first_velocity * texel_m; velocity.count < max_levels && depth_m < highest_bottom * water_m;
         depth_m *= 2)
        append(velocity, depth_m);
    if (velocity.count == 1) append(velocity, water_m / 2);  // three levels are added
    if (velocity.count < max_levels) append(velocity, water_m);
    append(head, 0);
    append(head, velocity.depths_m[1] / 2);
    for (std::size_t level = 1; level < velocity.count; ++level) append(head, velocity.depths_m[level]);
    // Bands end where each sea's waves do, so weights are of what all seas of a forecast share.
    const double min_k = std::max(plan.min_k, plan.spacing());
    fit_weights(velocity, min_k, two_pi / (shortest_of_velocity_fit * texel_m), water_m);
    fit_weights(head, min_k, two_pi / (shortest_of_head_fit * texel_m), water_m);
    fit_filter(velocity, min_k, two_pi / (WaterLevels::shortest_velocity_texels * texel_m), water_m);
    fit_filter(head, min_k, two_pi / ((plan.is_banded() ? shortest_of_band : shortest_of_grid) * texel_m), water_m);
    layout.levels.count = velocity.count;
    layout.levels.water_m = water_m;
    layout.levels.longest_wave_m = two_pi / min_k;
    for (std::size_t i = 0; i < velocity.count; ++i) {
        WaterGrid& grid = layout.levels.grids[i];
        grid.velocity_depth_m = velocity.depths_m[i];
        grid.head_depth_m = head.depths_m[i + 1];
        grid.resolution = resolution_at(velocity.depths_m[i]);
    }
    return layout;
}

WaterLevelRuns::Spectra WaterLevelRuns::empty_spectra(const WaterLayout& layout) const {
    Spectra spectra;
    for (std::size_t i = 0; i < layout.levels.count; ++i) {
        const FftPlan& plan = transform_of(layout.levels.grids[i].resolution).plan;
        GridSpectra& of = spectra.emplace_back(GridSpectra{PackedSpectrum(plan, kernels_.lanes, memory_), {}});
        if (has_depth_) of.head_factors = AlignedBuffer<float>(of.velocity.harmonics.size(), memory_);
    }
    return spectra;
}

void WaterLevelRuns::set_layout(const WaterLayout& layout) {
    layout_ = layout;
    blended_.resize(layout.levels.count);
    for (std::size_t i = 0; i < blended_.size(); ++i) {
        const PackedSpectrum sizes(transform_of(layout.levels.grids[i].resolution).plan, kernels_.lanes);
        if (blended_[i].size() != sizes.block_floats())
            blended_[i] = AlignedBuffer<float>(sizes.block_floats(), memory_);
    }
}

void WaterLevelRuns::bake(const PackedSpectrum& of, const FftPlan& plan, const CascadePlan& cascade, double water_m,
                          const WaterGrid& grid, GridSpectra& spectra) const {
    PackedSpectrum& out = spectra.velocity;
    const Transform& transform = transform_of(grid.resolution);
    const int resolution = grid.resolution, radix = transform.fft.first_step().radix;
    const WavePlaces places(plan, resolution_);
    const double spacing = cascade.spacing();
    const double largest_k =
        two_pi / (WaterLevels::shortest_velocity_texels * cascade.grid.side_m / cascade.resolution);
    const std::size_t lanes = out.lanes;
    for (std::size_t line = 0; line < line_count(resolution); ++line) {
        const int n = static_cast<int>(line);
        float* to = out.block(line / lanes) + line % lanes;
        std::uint32_t* harmonic = out.block_harmonics(line / lanes) + line % lanes;
        const float* const waves = of.block(line / lanes) + line % lanes;
        const std::uint32_t* const harmonics = of.block_harmonics(line / lanes) + line % lanes;
        for (const GroupPair& pair : transform.plan.pairs())
            for (int s = 0; s < radix; ++s, to += wave_quantities * lanes, harmonic += lanes) {
                const int position = pair.plus + s * (resolution / radix);
                const int m = position < resolution / 2 ? position : position - resolution;
                if (m == -resolution / 2 || (m == 0 && n == 0)) continue;
                const double k = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n) * spacing;
                const bool moves = grid.velocity_depth_m > 0 || k <= largest_k;
                if (!moves && !has_depth_) continue;
                const DepthFactors velocity = depth_factors(k, grid.velocity_depth_m, water_m),
                                   head = depth_factors(k, grid.head_depth_m, water_m);
                const double rise = moves ? std::max(velocity.rise, least_rise * velocity.along_rise)
                                          : least_rise * head.head;
                const double factor = rise * spline_factor(m, n, resolution);
                const auto copy = [&](int of_m, WaveQuantity first) {
                    const WavePlaces::Place place = places.at(of_m);
                    const float* const from =
                        waves + (place.pair * wave_quantities + (place.is_minus ? minus_cos_re : plus_cos_re)) * lanes;
                    for (std::size_t i = 0; i < 4; ++i)
                        to[(first + i) * lanes] = static_cast<float>(static_cast<double>(from[i * lanes]) * factor);
                };
                copy(m, plus_cos_re);
                if (!pair.is_own_negative()) copy(-m, minus_cos_re);
                const double steps = k / spacing, along = moves ? velocity.along_rise / rise / steps : 0;
                to[direction_x * lanes] = static_cast<float>(m * along);
                to[direction_z * lanes] = static_cast<float>(n * along);
                *harmonic = harmonics[places.at(m).pair * lanes];
                if (has_depth_)
                    spectra.head_factors[static_cast<std::size_t>(harmonic - out.harmonics.data())] =
                        static_cast<float>(head.head / rise);
            }
    }
}

void WaterLevelRuns::compute(const Blend& blend, std::size_t number, WaterPlanes& planes) {
    if (number >= layout_.levels.count) return;
    const WaterGrid& grid = layout_.levels.grids[number];
    const FftTables& fft = transform_of(grid.resolution).fft;
    const GridSpectra& of = (*blend.before)[number];
    const PackedSpectrum& before = of.velocity;
    const std::size_t side = static_cast<std::size_t>(grid.resolution), all_lines = line_count(grid.resolution);
    const std::size_t lanes = kernels_.lanes, row_floats = 4 * WaterLayout::row_texels(grid);
    float* const texels = planes.of(number);
    for (std::size_t block = 0; block < line_blocks(grid.resolution, lanes); ++block) {
        if (blend.is_blend)
            blend_waves(kernels_, before, (*blend.after)[number].velocity, block, blend.weight, *blend.band_weights,
                        blended_[number].data());
        kernels_.water_rows(
            {.waves = blend.is_blend ? blended_[number].data() : before.block(block),
             .harmonics = before.block_harmonics(block),
             .head_factors = has_depth_ ? of.head_factors.data() + block * before.pairs * lanes : nullptr,
             .fraction = blend.fraction,
             .first_frequency = blend.first_frequency,
             .first_line = block * lanes,
             .line_count = std::min(lanes, all_lines - block * lanes),
             .fft = &fft,
             .texels = texels,
             .row_floats = row_floats});
    }
    for (std::size_t column = 0; column < side; column += lanes)
        kernels_.water_columns({.texels = texels,
                                .row_floats = row_floats,
                                .first_column = column,
                                .has_head = has_depth_,
                                .fft = &fft,
                                .cosine = blend.cosine,
                                .sine = blend.sine});
    for (std::size_t row = 0; row < side; ++row)
        std::memcpy(texels + row * row_floats + 4 * side, texels + row * row_floats,
                    4 * WaterLevels::repeated * sizeof(float));
}

std::size_t WaterLevelRuns::stack_bytes() const {
    return 32 * static_cast<std::size_t>(transforms_.back()->fft.size) * kernels_.lanes;
}

std::size_t WaterLevelRuns::bytes() const {
    std::size_t bytes = 0;
    for (const auto& transform : transforms_) bytes += sizeof(Transform) + transform->plan.bytes();
    for (const AlignedBuffer<float>& waves : blended_) bytes += sizeof waves + waves.bytes();
    return bytes;
}

}  // namespace pelagic
