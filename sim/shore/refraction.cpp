#include "pelagic/sim/shore/refraction.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/wave_numbers.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {
namespace {

// Upper bound of the rounds, of four sweeps each. Floors with islands need several.
constexpr int max_rounds = 64;
constexpr double still_rad = 1e-9;

// Bounds of the flux where contours diverge from the waves or converge towards them.
constexpr double min_flux = 0.25, max_flux = 2;

// Slope of the fitted plane below which the floor counts as level.
constexpr double min_slope = 1e-3;

// Lower bound of the inward component of the direction of a wave that enters across an edge.
constexpr double min_inward = 1e-9;

/// Wavelength of straight waves, in texels. The result does not depend on it.
constexpr double straight_texels = 8;

}  // namespace

Refraction::Refraction(const SeaBed& bed)
    : bed_(bed),
      k_(bed.texels()),
      phase_(bed.texels()),
      height_(bed.texels()),
      shoaling_(bed.texels()),
      flux_(bed.texels()),
      direction_x_(bed.texels()),
      direction_z_(bed.texels()),
      comes_in_(bed.texels()),
      may_change_(bed.texels()) {
    for (std::size_t texel = 0; texel < bed.texels(); ++texel)
        if (bed.is_water(texel)) water_.push_back(texel), water_depth_m_.push_back(bed.depth_m[texel]);
    water_k_.resize(water_.size());
    water_speed_mps_.resize(water_.size());
}

void Refraction::propagate(const IncomingWave& wave) {
    const double open_k = wave_number(wave.omega, wave.depth_m);
    const double open_speed = group_velocity(open_k, wave.depth_m);
    const double max_k = std::max(open_k, two_pi / (min_texels * bed_.texel_m));
    std::fill(k_.begin(), k_.end(), open_k);
    std::fill(shoaling_.begin(), shoaling_.end(), 1.0);
    wave_numbers(wave.omega, water_depth_m_, water_k_);
    group_velocities(water_k_, water_depth_m_, water_speed_mps_);
    for (std::size_t i = 0; i < water_.size(); ++i) {
        k_[water_[i]] = std::min(water_k_[i], max_k);
        shoaling_[water_[i]] = std::sqrt(open_speed / water_speed_mps_[i]);
    }
    propagate(wave, open_k);
}

void Refraction::propagate_straight(double along_x, double along_z) {
    const double open_k = two_pi / (straight_texels * bed_.texel_m);
    std::fill(k_.begin(), k_.end(), open_k);
    std::fill(shoaling_.begin(), shoaling_.end(), 1.0);
    propagate({.omega = 0, .along_x = along_x, .along_z = along_z, .depth_m = 1}, open_k);
}

/// \pre k_ and shoaling_ are those of the wave
void Refraction::propagate(const IncomingWave& wave, double open_k) {
    std::fill(phase_.begin(), phase_.end(), nowhere);
    std::fill(height_.begin(), height_.end(), 0.0);
    std::fill(flux_.begin(), flux_.end(), 0.0);
    std::fill(direction_x_.begin(), direction_x_.end(), 0.0f);
    std::fill(direction_z_.begin(), direction_z_.end(), 0.0f);
    std::fill(comes_in_.begin(), comes_in_.end(), std::uint8_t{0});
    come_in(wave, open_k);
    sweep();
    carry_energy();
    for (const std::uint32_t texel : order_) height_[texel] = std::sqrt(flux_[texel]) * shoaling_[texel];
}

void Refraction::come_in(const IncomingWave& wave, double open_k) {
    const double corner_x = bed_.x_m + (wave.along_x < 0 ? (bed_.columns - 1) * bed_.texel_m : 0);
    const double corner_z = bed_.z_m + (wave.along_z < 0 ? (bed_.rows - 1) * bed_.texel_m : 0);
    corner_phase_ = open_k * (wave.along_x * corner_x + wave.along_z * corner_z);
    come_in_along(wave, open_k, true);
    come_in_along(wave, open_k, false);
}

/// Sets phase, flux and direction along the first column or row that a wave reaches, starting at
/// the corner of both. The wave vector keeps its component along the contours of the floor (Snell),
/// and the energy between two rays is constant.
void Refraction::come_in_along(const IncomingWave& wave, double open_k, bool along_column) {
    const int step_i = wave.along_x < 0 ? -1 : 1, step_j = wave.along_z < 0 ? -1 : 1;
    const int first_i = step_i < 0 ? bed_.columns - 1 : 0, first_j = step_j < 0 ? bed_.rows - 1 : 0;
    // s along the edge, n into the rectangle.
    const double direction_s = std::fabs(along_column ? wave.along_z : wave.along_x);
    const double direction_n = std::fabs(along_column ? wave.along_x : wave.along_z);
    if (direction_n < min_inward) return;
    // Unit vectors: g down the slope, c along the contours. Over a level floor the contours are
    // taken as perpendicular to the wave's direction, so the wave is not refracted.
    const double steepness = std::sqrt(bed_.slope_x * bed_.slope_x + bed_.slope_z * bed_.slope_z);
    const double slope_s = along_column ? bed_.slope_z * step_j : bed_.slope_x * step_i;
    const double slope_n = along_column ? bed_.slope_x * step_i : bed_.slope_z * step_j;
    const bool is_even = steepness < min_slope;
    const double g_s = is_even ? direction_s : slope_s / steepness, g_n = is_even ? direction_n : slope_n / steepness;
    const int count = along_column ? bed_.rows : bed_.columns;
    double phase = 0, slowness_before = 0;
    for (int s = 0; s < count; ++s) {
        const std::size_t texel =
            along_column ? bed_.at(first_i, first_j + s * step_j) : bed_.at(first_i + s * step_i, first_j);
        const double c_s = g_n, c_n = 0 - g_s;
        const double kept = open_k * (direction_s * c_s + direction_n * c_n),
                     across = direction_s * g_s + direction_n * g_n;
        const double k = std::max(k_[texel], std::fabs(kept));
        const double turned = std::sqrt(k * k - kept * kept) * (across < 0 ? -1 : 1);
        const double slowness = std::max(0.0, kept * c_s + turned * g_s);
        const double inward = std::max(0.0, kept * c_n + turned * g_n);
        if (s > 0) phase += 0.5 * (slowness_before + slowness) * bed_.texel_m;
        slowness_before = slowness;
        if (!bed_.is_water(texel)) continue;
        const double length = std::sqrt(slowness * slowness + inward * inward);
        const double direction_along = length > 0 ? slowness / length : 0,
                     direction_in = length > 0 ? inward / length : 1;
        const double spread = std::fabs(turned) > 0 ? std::fabs(across) * k / std::fabs(turned) : 1;
        phase_[texel] = phase;
        comes_in_[texel] = 1;
        flux_[texel] = std::clamp(spread, min_flux, max_flux);
        direction_x_[texel] = static_cast<float>((along_column ? direction_in : direction_along) * step_i);
        direction_z_[texel] = static_cast<float>((along_column ? direction_along : direction_in) * step_j);
    }
}

// A texel changes only after a neighbour with an earlier phase has changed, so all others are
// skipped (locking: Bak, McLaughlin and Renzi 2010, SIAM J. Sci. Comput. 32, 2853-2874). The result
// is that of plain sweeps.
void Refraction::sweep() {
    std::fill(may_change_.begin(), may_change_.end(), std::uint8_t{0});
    for (int j = 0; j < bed_.rows; ++j)
        for (int i = 0; i < bed_.columns; ++i)
            if (comes_in_[bed_.at(i, j)]) mark_later_neighbours(i, j);
    for (int round = 0; round < max_rounds; ++round) {
        bool has_moved = false;
        for (const int order : {0, 1, 2, 3}) {
            const bool left = (order & 1) != 0, up = (order & 2) != 0;
            for (int row = 0; row < bed_.rows; ++row) {
                const int j = up ? bed_.rows - 1 - row : row;
                for (int column = 0; column < bed_.columns; ++column) {
                    const int i = left ? bed_.columns - 1 - column : column;
                    if (may_change_[bed_.at(i, j)]) has_moved |= arrive(i, j);
                }
            }
        }
        if (!has_moved) break;
    }
}

/// A neighbour that the wave reached earlier keeps its phase.
void Refraction::mark_later_neighbours(int i, int j) {
    const std::size_t here = bed_.at(i, j), columns = static_cast<std::size_t>(bed_.columns);
    const double earliest = phase_[here] - still_rad;
    const auto mark = [&](std::size_t texel) {
        if (phase_[texel] > earliest) may_change_[texel] = 1;
    };
    if (i > 0) mark(here - 1);
    if (i + 1 < bed_.columns) mark(here + 1);
    if (j > 0) mark(here - columns);
    if (j + 1 < bed_.rows) mark(here + columns);
}

bool Refraction::arrive(int i, int j) {
    const std::size_t here = bed_.at(i, j);
    may_change_[here] = 0;
    if (comes_in_[here] || !bed_.is_water(here)) return false;
    const double left = i > 0 ? phase_[here - 1] : nowhere, right = i + 1 < bed_.columns ? phase_[here + 1] : nowhere;
    const double up = j > 0 ? phase_[bed_.at(i, j - 1)] : nowhere;
    const double down = j + 1 < bed_.rows ? phase_[bed_.at(i, j + 1)] : nowhere;
    const double a = std::min(left, right), b = std::min(up, down), first = std::min(a, b);
    if (first == nowhere) return false;
    const double step = k_[here] * bed_.texel_m, apart = std::max(a, b) - first;
    const double phase = apart >= step ? first + step : 0.5 * (a + b + std::sqrt(2 * step * step - apart * apart));
    if (!(phase < phase_[here])) return false;
    const bool is_new = phase_[here] == nowhere || phase_[here] - phase > still_rad;
    phase_[here] = phase;
    mark_later_neighbours(i, j);
    return is_new;
}

Refraction::Upstream Refraction::upstream(std::size_t texel) const {
    const auto columns = static_cast<std::size_t>(bed_.columns);
    // Divides 32 bits, which is faster.
    const std::uint32_t j = static_cast<std::uint32_t>(texel) / static_cast<std::uint32_t>(bed_.columns);
    const std::size_t i = texel - j * columns;
    const auto earlier = [&](bool has_before, std::size_t before, bool has_after, std::size_t after) {
        const double at_before = has_before ? phase_[before] : nowhere,
                     at_after = has_after ? phase_[after] : nowhere;
        if (at_before == nowhere && at_after == nowhere) return texel;
        return at_before <= at_after ? before : after;
    };
    Upstream from{
        .x = earlier(i > 0, texel - 1, i + 1 < columns, texel + 1),
        .z = earlier(j > 0, texel - columns, j + 1 < static_cast<std::uint32_t>(bed_.rows), texel + columns),
        .share_x = 0,
        .share_z = 0};
    const auto phase_from = [&](std::size_t other) {
        return phase_[other] < phase_[texel] ? phase_[texel] - phase_[other] : 0.0;
    };
    const double x = phase_from(from.x), z = phase_from(from.z), squared = x * x + z * z;
    if (squared > 0) from.share_x = x * x / squared, from.share_z = z * z / squared;
    return from;
}

/// Sets order_: by phase, and by texel at equal phases. The bits of doubles that are not negative
/// sort as the doubles do, so this is a radix sort, from the lowest digit up.
void Refraction::sort_by_arrival() {
    constexpr int digit_bits = 11, digits = 6;
    constexpr std::uint64_t last = (1u << digit_bits) - 1;
    arrivals_.clear();
    for (std::size_t texel = 0; texel < phase_.size(); ++texel)
        if (phase_[texel] < nowhere)
            // A sum with 0 is never -0.
            arrivals_.push_back(
                {std::bit_cast<std::uint64_t>(phase_[texel] + 0.0), static_cast<std::uint32_t>(texel)});
    sorted_.resize(arrivals_.size());
    std::vector<std::uint32_t> offsets(last + 1);
    for (int digit = 0; digit < digits; ++digit) {
        const auto digit_of = [&](const Arrival& arrival) { return arrival.phase_bits >> digit * digit_bits & last; };
        std::fill(offsets.begin(), offsets.end(), 0u);
        for (const Arrival& arrival : arrivals_) ++offsets[digit_of(arrival)];
        std::exclusive_scan(offsets.begin(), offsets.end(), offsets.begin(), 0u);
        for (const Arrival& arrival : arrivals_) sorted_[offsets[digit_of(arrival)]++] = arrival;
        arrivals_.swap(sorted_);
    }
    order_.clear();
    for (const Arrival& arrival : arrivals_) order_.push_back(arrival.texel);
}

// An upwind, conservative scheme: the energy that leaves a texel through a side is its flux times
// the component of its direction across that side.
void Refraction::carry_energy() {
    sort_by_arrival();
    for (const std::uint32_t texel : order_) {
        if (comes_in_[texel]) continue;
        const Upstream from = upstream(texel);
        const double toward_x = from.x < texel ? 1 : -1, toward_z = from.z < texel ? 1 : -1;
        const double direction_x = std::sqrt(from.share_x), direction_z = std::sqrt(from.share_z);
        double comes = 0;
        if (direction_x > 0)
            comes += std::max(0.0, static_cast<double>(direction_x_[from.x]) * toward_x) * flux_[from.x];
        if (direction_z > 0)
            comes += std::max(0.0, static_cast<double>(direction_z_[from.z]) * toward_z) * flux_[from.z];
        if (direction_x + direction_z > 0)
            flux_[texel] = std::min(comes / (direction_x + direction_z), max_focus * max_focus);
        direction_x_[texel] = static_cast<float>(direction_x * toward_x);
        direction_z_[texel] = static_cast<float>(direction_z * toward_z);
    }
}

}  // namespace pelagic
