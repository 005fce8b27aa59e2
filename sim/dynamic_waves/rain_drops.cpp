#include "pelagic/sim/dynamic_waves/rain_drops.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/kernels/dynamic_wave_jobs.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"
#include "pelagic/simd/split_mix.hpp"

namespace pelagic {
namespace {

/// Texels along a side of a cell of the world, which has one sequence of random numbers a tick.
constexpr std::int64_t cell_texels = 8;
/// Positions of drops within a texel along an axis, for which shapes are computed in advance.
constexpr std::size_t subtexels = 8;
/// Extent of a drop, in radii; beyond it the shape is less than 1e-3 of its height.
constexpr double reach_radii = 3;
/// Maximum mean number of drops that reach a texel in a tick, which limits the time of a tick.
constexpr double max_at_a_texel = 16;
/// Maximum number of drops of a cell and tick. Their mean is at most 16, and the probability of 100
/// is below the resolution of a random number of 53 bits.
constexpr int max_in_a_cell = 100;

constexpr NumericField<Rain> rain_field_table[] = {
    // generated from schema/rain.toml: table
    {"drops_per_m2_s", &Rain::drops_per_m2_s, -std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
     "a finite number"},
    {"radius_m", &Rain::radius_m, -std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
     "a finite number"},
    {"height_m", &Rain::height_m, -std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
     "a finite number"},
    {"seed", &Rain::seed, 0, 4294967295.0, "a whole number from 0 to 4294967295"},
    // end of generated
};

double texel_of(const DynamicWavesOptions& water) { return water.side_m / water.resolution; }
double grid_radius(const Rain& rain, const DynamicWavesOptions& water) {
    return std::max(rain.radius_m, texel_of(water));
}
std::int64_t reach_in_texels(const Rain& rain, const DynamicWavesOptions& water) {
    return static_cast<std::int64_t>(std::ceil(reach_radii * grid_radius(rain, water) / texel_of(water)));
}
double max_drops(const Rain& rain, const DynamicWavesOptions& water) {
    const double side_m = static_cast<double>(2 * reach_in_texels(rain, water) + 2) * texel_of(water);
    return max_at_a_texel * water.ticks_per_s / (side_m * side_m);
}

/// Returns the range of cells along an axis whose drops may reach texels [first, end), its end
/// exclusive.
std::array<std::int64_t, 2> cells_reaching(std::int64_t first, std::int64_t end, std::int64_t reach) {
    // Shifts round down, also for negative numbers.
    static_assert(cell_texels == 8);
    return {(first - reach - 1) >> 3, ((end - 1 + reach) >> 3) + 1};
}

}  // namespace

std::span<const NumericField<Rain>> rain_fields() { return rain_field_table; }

std::string check(const Rain& rain, const DynamicWavesOptions& water) {
    if (rain.drops_per_m2_s == 0) return {};  // without rain the other values are unused
    const double widest = water.side_m / 16;
    if (!(rain.radius_m >= 0.001 && rain.radius_m <= widest))
        return invalid_value_message("radius_m", rain.radius_m,
                                     "[0.001, " + number_text(widest) + "], to a 16th of side_m");
    if (!(rain.height_m >= -10 && rain.height_m <= 10))
        return invalid_value_message("height_m", rain.height_m, "[-10, 10]");
    const double max = max_drops(rain, water);
    if (!(rain.drops_per_m2_s >= 0 && rain.drops_per_m2_s <= max))
        return invalid_value_message("drops_per_m2_s", rain.drops_per_m2_s,
                                     "[0, " + rounded_text(max, 6) + "] for drops of this radius on this grid");
    return {};
}

/// The centre of a drop: the texel below it and the position above that texel in units of 1/8
/// texel.
struct RainDrops::Drop {
    std::int64_t x, z;
    std::size_t subtexel_x, subtexel_z;
};

RainDrops::RainDrops(const Rain& rain, const DynamicWavesOptions& water) {
    assert(check(rain, water).empty());
    const DefaultFloatEnvironment environment;
    if (rain.drops_per_m2_s == 0) return;
    rain_ = rain;
    const double texel_m = texel_of(water), radius = grid_radius(rain, water), narrower = rain.radius_m / radius;
    const double cell_m = static_cast<double>(cell_texels) * texel_m;
    mean_ = rain.drops_per_m2_s * cell_m * cell_m / water.ticks_per_s;
    none_ = det::exp(-mean_);
    height_ = static_cast<float>(rain.height_m * narrower * narrower);
    reach_ = reach_in_texels(rain, water);
    shapes_.resize(subtexels * width());
    for (std::size_t subtexel = 0; subtexel < subtexels; ++subtexel) {
        const auto middle =
            static_cast<double>(reach_) + static_cast<double>(subtexel) / static_cast<double>(subtexels);
        const auto squared = [&](std::size_t texel) {
            const double away = (static_cast<double>(texel) - middle) * texel_m / radius;
            return away * away;
        };
        // The integral of rim is 0, but its sum over texels is not quite. The sum is corrected to
        // 0, so that rain adds no water.
        double e_sum = 0, rim_sum = 0;
        for (std::size_t texel = 0; texel < width(); ++texel) {
            const double e = det::exp(-squared(texel));
            e_sum += e;
            rim_sum += (squared(texel) - 0.5) * e;
        }
        for (std::size_t texel = 0; texel < width(); ++texel) {
            const double e = det::exp(-squared(texel));
            shapes_[subtexel * width() + texel] = {static_cast<float>(e),
                                                   static_cast<float>((squared(texel) - 0.5 - rim_sum / e_sum) * e)};
        }
    }
}

template <class OfDrop>
void RainDrops::for_drops(std::uint64_t state, std::int64_t cell_x, std::int64_t cell_z, OfDrop of_drop) const {
    const double u = static_cast<double>(split_mix(state) >> 11) * two_to_minus_53;
    double likely = none_, up_to = none_;
    for (int drop = 1; drop <= max_in_a_cell && u >= up_to; ++drop) {
        // One random number gives the position, of which a cell has 64 along each axis.
        const std::uint64_t bits = split_mix(state + static_cast<std::uint64_t>(drop) * golden_gamma);
        of_drop(Drop{.x = cell_x * cell_texels + static_cast<std::int64_t>(bits >> 61),
                     .z = cell_z * cell_texels + static_cast<std::int64_t>(bits >> 55 & 7),
                     .subtexel_x = static_cast<std::size_t>(bits >> 58 & 7),
                     .subtexel_z = static_cast<std::size_t>(bits >> 52 & 7)});
        likely *= mean_ / drop;
        up_to += likely;
    }
}

void RainDrops::push_rows(const GridPlacement& placement, std::int64_t tick, std::size_t first_row, std::size_t rows,
                          HeightPlanes heights) const {
    if (shapes_.empty()) return;
    const std::int64_t side = placement.resolution(), count = static_cast<std::int64_t>(width());
    const std::int64_t first_x = placement.first()[0], first_z = placement.first()[1];
    const std::size_t stride = dynamic_row_stride(static_cast<std::size_t>(side));

    const auto add_row = [&](const Drop& drop, std::int64_t z) {
        const Shape along_z = shape_at(drop.subtexel_z)[z - (drop.z - reach_)];
        const float e = height_ * along_z.e, rim = height_ * along_z.rim;
        const Shape* const along_x = shape_at(drop.subtexel_x);
        const std::size_t row = placement.in_torus(z) * stride;
        for (std::int64_t i = 0; i < count; ++i) {
            const std::size_t texel = row + placement.in_torus(drop.x - reach_ + i);
            const float height = along_x[i].rim * e + along_x[i].e * rim;
            heights.now[texel] += height;
            if (heights.before) heights.before[texel] += height;  // no initial velocity
            heights.tick_before[texel] += height;
        }
    };
    const auto add_drops = [&](std::int64_t from_z, std::int64_t to_z) {
        const auto [begin_x, end_x] = cells_reaching(first_x, first_x + side, reach_);
        const auto [begin_z, end_z] = cells_reaching(from_z, to_z, reach_);
        const std::uint64_t of_tick =
            split_mix(split_mix(rain_.seed + golden_gamma) + static_cast<std::uint64_t>(tick) + golden_gamma);
        for (std::int64_t z = begin_z; z < end_z; ++z) {
            const std::uint64_t of_row = split_mix(of_tick + static_cast<std::uint64_t>(z) + golden_gamma);
            for (std::int64_t x = begin_x; x < end_x; ++x)
                for_drops(split_mix(of_row + static_cast<std::uint64_t>(x) + golden_gamma), x, z,
                          [&](const Drop& drop) {
                              const auto is_whole = [&](std::int64_t at, std::int64_t first) {
                                  return at - reach_ >= first && at - reach_ + count <= first + side;
                              };
                              if (!is_whole(drop.x, first_x) || !is_whole(drop.z, first_z)) return;
                              const std::int64_t end = std::min(drop.z - reach_ + count, to_z);
                              for (std::int64_t row = std::max(drop.z - reach_, from_z); row < end; ++row)
                                  add_row(drop, row);
                          });
        }
    };

    // Rows of the torus are those of the grid, beginning at the row of first_z and wrapping around
    // once.
    const std::int64_t begins = static_cast<std::int64_t>(placement.in_torus(first_z));
    const std::int64_t from = static_cast<std::int64_t>(first_row), to = static_cast<std::int64_t>(first_row + rows);
    const std::int64_t cut = std::clamp(begins, from, to);
    if (cut < to) add_drops(first_z + cut - begins, first_z + to - begins);
    if (from < cut) add_drops(first_z + side + from - begins, first_z + side + cut - begins);
}

}  // namespace pelagic
