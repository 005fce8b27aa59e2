#include "pelagic/sim/spray/crest_spray.hpp"

#include <cmath>

#include "pelagic/sim/frame.hpp"

namespace pelagic {
namespace {

/// Number of droplets of a cell in a second, where waves break violently in a gale.
constexpr double droplets_of_cell_per_s = 1200;
/// Compression above the level of foam at which a crest throws the full number, in standard
/// deviations. Less throws in proportion.
constexpr double full_excess = 0.6;
/// Crests throw in bursts. A burst has the size of these many cells and ticks.
constexpr std::int64_t cells_of_burst = 2, ticks_of_burst = 4;
/// A centre beyond this has no spray: cells would not have exact numbers.
constexpr double farthest_centre_m = 1e12;

}  // namespace

CrestSpray::CrestSpray(const SprayOptions& options, const Allocator& memory)
    : options_(options),
      cell_m_(options.reach_m / cells_of_reach),
      droplets_(memory),
      candidates_(rows * rows, memory),
      breaking_(max_in_tick, memory) {}

void CrestSpray::clear() {
    droplets_.clear();
    breaking_count_ = 0;
}

void CrestSpray::begin_tick(const Tick& tick, const BreakingSurface& surface) {
    tick_ = tick;
    surface_ = surface;
}

void CrestSpray::search_row(std::size_t row) {
    std::size_t& count = counts_[row] = 0;
    const double amount = options_.amount * tick_.wind.rough() * droplets_of_cell_per_s * tick_.tick_s;
    if (!(amount > 0) || tick_.foam_level == SeaStatistics::no_foam_level) return;
    if (!(std::abs(tick_.x_m) <= farthest_centre_m && std::abs(tick_.z_m) <= farthest_centre_m)) return;
    const std::uint64_t key = spray_key(split_mix(options_.seed + golden_gamma), tick_.in_loop);
    const auto first = [&](double centre_m) {
        return static_cast<std::int64_t>(std::floor(centre_m / cell_m_)) - cells_of_reach;
    };
    const std::int64_t first_x = first(tick_.x_m), cell_z = first(tick_.z_m) + static_cast<std::int64_t>(row);
    for (std::int64_t cell_x = first_x; cell_x < first_x + static_cast<std::int64_t>(rows); ++cell_x) {
        const std::uint64_t of_cell = spray_key(spray_key(key, cell_x), cell_z);
        SprayRandom random(of_cell);
        const double x = (static_cast<double>(cell_x) + random.next()) * cell_m_;
        const double z = (static_cast<double>(cell_z) + random.next()) * cell_m_;
        const double from_x = x - tick_.x_m, from_z = z - tick_.z_m;
        const double away = (from_x * from_x + from_z * from_z) / (options_.reach_m * options_.reach_m);
        if (away >= 1) continue;
        const double excess = surface_.compression(x, z) - tick_.foam_level;
        if (excess <= 0) continue;
        // Fewer droplets far away, where they are small in an image, and none at the end of the
        // reach, so that no edge is visible.
        const double fade = std::min(1.0, 3 * (1 - away)) / (1 + 4 * away);
        const double droplets = amount * fade * std::min(excess / full_excess, 1.0) * burst(cell_x, cell_z);
        candidates_[row * rows + count++] = {x, z, droplets, split_mix(of_cell)};
    }
}

void CrestSpray::launch() {
    launch_breaking();
    find_breaking();
}

void CrestSpray::launch_breaking() {
    const double longest_s = std::min(max_spray_lifetime_s, (launch_ticks - 1) * tick_.tick_s);
    for (std::size_t i = 0; i < breaking_count_; ++i) {
        const Breaking& from = breaking_[i];
        const SprayVector at = surface_.at(from.x_m, from.z_m);
        SprayVector velocity;
        for (std::size_t axis = 0; axis < at.size(); ++axis)
            velocity[axis] = (at[axis] - from.at_m[axis]) / tick_.tick_s;
        SprayRandom random(from.key);
        droplets_.add(leaves_crest(at, velocity, tick_.number, tick_.tick_s, longest_s, tick_.wind, random));
    }
}

void CrestSpray::find_breaking() {
    double all = 0;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t i = 0; i < counts_[row]; ++i) all += candidates_[row * rows + i].droplets;
    constexpr double max_mean = 0.9 * max_in_tick;
    const double kept = all > max_mean ? max_mean / all : 1;
    breaking_count_ = 0;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t i = 0; i < counts_[row]; ++i) {
            const Candidate& candidate = candidates_[row * rows + i];
            SprayRandom random(candidate.key);
            const auto droplets = static_cast<int>(std::floor(candidate.droplets * kept + random.next()));
            for (int n = 0; n < droplets && breaking_count_ < max_in_tick; ++n) {
                const double x = candidate.x_m + (n == 0 ? 0 : 0.75 * cell_m_ * random.spread());
                const double z = candidate.z_m + (n == 0 ? 0 : 0.75 * cell_m_ * random.spread());
                if (n > 0 && surface_.compression(x, z) < tick_.foam_level) continue;
                breaking_[breaking_count_++] = {x, z, surface_.at(x, z), spray_key(candidate.key, n)};
            }
        }
}

/// Returns the factor of bursts in a cell; its mean is 1.
double CrestSpray::burst(std::int64_t cell_x, std::int64_t cell_z) const {
    const auto block = [](std::int64_t at, std::int64_t size) { return (at >= 0 ? at : at - size + 1) / size; };
    const std::uint64_t of_time = spray_key(~std::uint64_t{options_.seed}, tick_.in_loop / ticks_of_burst);
    SprayRandom random(
        spray_key(spray_key(of_time, block(cell_x, cells_of_burst)), block(cell_z, cells_of_burst)));
    const double u = random.next();
    return 3 * u * u;
}

std::size_t CrestSpray::bytes() const { return droplets_.bytes() + candidates_.bytes() + breaking_.bytes(); }

}  // namespace pelagic
