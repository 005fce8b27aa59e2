#include "pelagic/sim/dynamic_waves/sources.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/kernels/dynamic_wave_jobs.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

constexpr double gauss_reach = 3;  ///< in radii

/// Returns the range of texels of the grid within `reach_m` of a position along an axis, its end
/// exclusive.
std::array<std::int64_t, 2> reached(double middle_m, double reach_m, const GridPlacement& placement,
                                    std::size_t axis) {
    const auto low = static_cast<std::int64_t>(std::ceil((middle_m - reach_m) / placement.texel_m()));
    const auto high = static_cast<std::int64_t>(std::floor((middle_m + reach_m) / placement.texel_m())) + 1;
    const std::int64_t first = placement.first()[axis], end = first + placement.resolution();
    return {std::clamp(low, first, end), std::clamp(high, first, end)};
}

struct SavedSourcesHeader {
    std::int64_t next_number, lasting, waiting, settled, footprints;
    double rain_drops, rain_radius, rain_height;
    std::int64_t rain_seed;
};

/// A saved source, or an impulse if number is 0. The struct has no padding.
struct SavedSource {
    std::int64_t number, since, shape, mode;
    double x, z, radius, length, heading, height, rate, velocity_x, velocity_z;
};

/// A saved footprint, whose depths follow, padded to a multiple of 8 bytes.
struct SavedFootprint {
    std::int64_t number, since, columns, rows;
    double x, z, forward_x, forward_z, velocity_x, velocity_z, length, beam;
};

std::size_t saved_depth_bytes(std::int64_t columns, std::int64_t rows) {
    return (static_cast<std::size_t>(columns * rows) * sizeof(float) + 7) / 8 * 8;
}

SavedFootprint saved_footprint(std::uint32_t number, std::int64_t since, const PressureFootprint& of) {
    return {number,       since,        of.columns,        of.rows,           of.x_m,      of.z_m,
            of.forward_x, of.forward_z, of.velocity_x_mps, of.velocity_z_mps, of.length_m, of.beam_m};
}

/// Reads saved values one after the other.
class SavedBytes {
   public:
    explicit SavedBytes(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
    template <class Value>
    Value next() {
        Value value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::span<const std::uint8_t> take(std::size_t count) {
        if (rest_.size() < count) throw_size();
        const auto taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }
    void expect_end() const {
        if (!rest_.empty()) throw_size();
    }
    [[noreturn]] void throw_size() const {
        throw std::invalid_argument(
            "the saved sources have a wrong size, expected as many bytes as their counts give");
    }

   private:
    std::span<const std::uint8_t> rest_;
};

PressureFootprint footprint_of(const SavedFootprint& saved, SavedBytes& bytes) {
    if (saved.columns < 1 || saved.columns > PressureFootprint::max_columns || saved.rows < 1 ||
        saved.rows > PressureFootprint::max_rows)
        throw std::invalid_argument("a saved footprint has " + number_text(saved.columns) + " x " +
                                    number_text(saved.rows) + " cells, expected 1 to 64 each");
    PressureFootprint footprint = {
        .x_m = saved.x,
        .z_m = saved.z,
        .forward_x = saved.forward_x,
        .forward_z = saved.forward_z,
        .velocity_x_mps = saved.velocity_x,
        .velocity_z_mps = saved.velocity_z,
        .length_m = saved.length,
        .beam_m = saved.beam,
        .columns = static_cast<int>(saved.columns),
        .rows = static_cast<int>(saved.rows),
        .depth_m = std::vector<float>(static_cast<std::size_t>(saved.columns * saved.rows))};
    const auto depths = bytes.take(saved_depth_bytes(saved.columns, saved.rows));
    std::memcpy(footprint.depth_m.data(), depths.data(), footprint.depth_m.size() * sizeof(float));
    require(check(footprint));
    return footprint;
}

/// Throws unless a saved number follows the last one and its tick is a completed one.
void check_saved(std::int64_t number, std::int64_t since, std::int64_t last, const SavedSourcesHeader& header,
                 std::int64_t ticks) {
    if (number <= last || number >= header.next_number)
        throw std::invalid_argument(
            invalid_value_message("a saved source's number", number, "more than the preceding number"));
    if (since < 0 || since > ticks)
        throw std::invalid_argument(invalid_value_message("a saved source's tick", since, "a completed tick"));
}

SavedSource saved_source(std::uint32_t number, std::int64_t since, const Disturbance& of) {
    return {number,
            since,
            static_cast<std::int64_t>(of.shape),
            static_cast<std::int64_t>(of.mode),
            of.x_m,
            of.z_m,
            of.radius_m,
            of.length_m,
            of.heading_rad,
            of.height_m,
            of.rate_per_s,
            of.velocity_x_mps,
            of.velocity_z_mps};
}

Disturbance disturbance_of(const SavedSource& saved) {
    if (saved.shape < 0 || saved.shape > static_cast<std::int64_t>(Disturbance::Shape::hull))
        throw std::invalid_argument(invalid_value_message("a saved source's shape", saved.shape, "0 or 1"));
    if (saved.mode < 0 || saved.mode > static_cast<std::int64_t>(Disturbance::Mode::foam))
        throw std::invalid_argument(invalid_value_message("a saved source's mode", saved.mode, "0 to 3"));
    const Disturbance source = {.shape = static_cast<Disturbance::Shape>(saved.shape),
                                .mode = static_cast<Disturbance::Mode>(saved.mode),
                                .x_m = saved.x,
                                .z_m = saved.z,
                                .radius_m = saved.radius,
                                .length_m = saved.length,
                                .heading_rad = saved.heading,
                                .height_m = saved.height,
                                .rate_per_s = saved.rate,
                                .velocity_x_mps = saved.velocity_x,
                                .velocity_z_mps = saved.velocity_z};
    require(check(source));
    return source;
}

RainDrops restored_rain(const SavedSourcesHeader& saved, const DynamicWavesOptions& water) {
    if (saved.rain_seed < 0 || saved.rain_seed > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument(invalid_value_message("the saved rain's seed", saved.rain_seed, "[0, 2^32)"));
    const auto seed = static_cast<std::uint32_t>(saved.rain_seed);
    const Rain rain{saved.rain_drops, saved.rain_radius, saved.rain_height, seed};
    require(check(rain, water));
    return {rain, water};
}

}  // namespace

void DynamicWaveSources::add_impulse(const Disturbance& disturbance) {
    assert(check(disturbance).empty() && waiting_.size() < max_count);
    waiting_.push_back(disturbance);
}

void DynamicWaveSources::set(std::uint32_t number, const Disturbance& source, std::int64_t ticks) {
    assert(check(source).empty());
    const auto at = std::lower_bound(sources_.begin(), sources_.end(), number,
                                     [](const Source& known, std::uint32_t wanted) { return known.number < wanted; });
    if (at != sources_.end() && at->number == number) {
        *at = {number, source, ticks};
        return;
    }
    assert(sources_.size() < max_count);
    sources_.insert(at, {number, source, ticks});
}

void DynamicWaveSources::set_footprint(std::uint32_t number, const PressureFootprint& footprint, std::int64_t ticks) {
    assert(check(footprint).empty());
    const auto at =
        std::lower_bound(footprints_.begin(), footprints_.end(), number,
                         [](const Footprint& known, std::uint32_t wanted) { return known.number < wanted; });
    if (at != footprints_.end() && at->number == number) {
        at->of = footprint;
        at->since = ticks;
        return;
    }
    assert(sources_.size() + footprints_.size() < max_count);
    footprints_.insert(at, {number, footprint, ticks});
}

bool DynamicWaveSources::has_footprint(std::uint32_t number) const {
    return std::any_of(footprints_.begin(), footprints_.end(),
                       [number](const Footprint& known) { return known.number == number; });
}

void DynamicWaveSources::remove(std::uint32_t number) {
    std::erase_if(sources_, [number](const Source& source) { return source.number == number; });
    std::erase_if(footprints_, [number](const Footprint& footprint) { return footprint.number == number; });
}

bool DynamicWaveSources::has(std::uint32_t number) const {
    return std::binary_search(sources_.begin(), sources_.end(),
                              Source{.number = number, .disturbance = {}, .since = 0},
                              [](const Source& a, const Source& b) { return a.number < b.number; });
}

std::vector<std::uint32_t> DynamicWaveSources::numbers() const {
    std::vector<std::uint32_t> numbers;
    for (const Source& source : sources_) numbers.push_back(source.number);
    for (const Footprint& footprint : footprints_) numbers.push_back(footprint.number);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

void DynamicWaveSources::begin_tick(const GridPlacement& placement, std::int64_t ticks, double tick_s) {
    tick_ = ticks;
    for (const Source& source : sources_) {
        Disturbance moved = source.disturbance;
        const double since_s = static_cast<double>(ticks - source.since) * tick_s;
        moved.x_m += since_s * moved.velocity_x_mps;
        moved.z_m += since_s * moved.velocity_z_mps;
        // A source that has left the valid range has no effect.
        if (check(moved).empty()) add_splash(moved, placement, tick_s);
    }
    for (Footprint& footprint : footprints_) {
        const double since_s = static_cast<double>(ticks - footprint.since) * tick_s;
        footprint.moved_x_m = since_s * footprint.of.velocity_x_mps;
        footprint.moved_z_m = since_s * footprint.of.velocity_z_mps;
        add_footprint_splash(footprint, placement);
    }
    for (const Disturbance& disturbance : waiting_) add_splash(disturbance, placement, tick_s);
    waiting_.clear();
    settled_ = 0;
}

void DynamicWaveSources::add_splash(const Disturbance& of, const GridPlacement& placement, double tick_s) {
    const bool is_hull = of.shape == Disturbance::Shape::hull;
    const double reach_m = is_hull ? std::max(of.length_m, of.radius_m) : gauss_reach * of.radius_m;
    const auto [first_x, end_x] = reached(of.x_m, reach_m, placement, 0);
    const auto [first_z, end_z] = reached(of.z_m, reach_m, placement, 1);
    if (first_x >= end_x || first_z >= end_z) return;
    const auto heading = det::sine_cosine_of_turns(of.heading_rad / two_pi);
    splashes_.push_back({.of = of,
                         .fraction = static_cast<float>(1 - det::exp(-of.rate_per_s * tick_s)),
                         .first_x = first_x,
                         .end_x = end_x,
                         .first_z = first_z,
                         .end_z = end_z,
                         .profile = profiles_.size(),
                         .cosine = heading.cosine,
                         .sine = heading.sine});
    if (!is_hull) add_profile(splashes_.back(), placement);
}

void DynamicWaveSources::add_footprint_splash(const Footprint& footprint, const GridPlacement& placement) {
    const PressureFootprint& of = footprint.of;
    const double x_m = of.x_m + footprint.moved_x_m, z_m = of.z_m + footprint.moved_z_m;
    if (!(std::fabs(x_m) <= farthest_position_m && std::fabs(z_m) <= farthest_position_m)) return;
    // the rectangle, and half a cell around it
    const double ahead = (of.length_m + of.length_m / of.columns) / 2, abeam = (of.beam_m + of.beam_m / of.rows) / 2;
    const double reach_x = std::fabs(of.forward_x) * ahead + std::fabs(of.forward_z) * abeam;
    const double reach_z = std::fabs(of.forward_z) * ahead + std::fabs(of.forward_x) * abeam;
    const auto [first_x, end_x] = reached(x_m, reach_x, placement, 0);
    const auto [first_z, end_z] = reached(z_m, reach_z, placement, 1);
    if (first_x >= end_x || first_z >= end_z) return;
    splashes_.push_back({.of = {.mode = Disturbance::Mode::pressure},
                         .fraction = 0,
                         .first_x = first_x,
                         .end_x = end_x,
                         .first_z = first_z,
                         .end_z = end_z,
                         .profile = 0,
                         .cosine = 1,
                         .sine = 0,
                         .footprint = &footprint});
}

void DynamicWaveSources::add_profile(const Splash& splash, const GridPlacement& placement) {
    const auto add_along = [&](double middle_m, std::int64_t first, std::int64_t end) {
        for (std::int64_t texel = first; texel < end; ++texel) {
            const double away = (static_cast<double>(texel) * placement.texel_m() - middle_m) / splash.of.radius_m;
            profiles_.push_back(static_cast<float>(det::exp(-away * away)));
        }
    };
    add_along(splash.of.x_m, splash.first_x, splash.end_x);
    add_along(splash.of.z_m, splash.first_z, splash.end_z);
}

/// Calls at_texel(index of the texel, shape, shape over its height) for each reached texel of the
/// rows.
template <class AtTexel>
void DynamicWaveSources::for_texels(const Splash& splash, const GridPlacement& placement, std::size_t first_row,
                                    std::size_t rows, AtTexel at_texel) const {
    const Disturbance& of = splash.of;
    const float height = static_cast<float>(of.height_m);
    const std::size_t stride = dynamic_row_stride(static_cast<std::size_t>(placement.resolution()));
    for (std::int64_t z = splash.first_z; z < splash.end_z; ++z) {
        const std::size_t row = placement.in_torus(z);
        if (row < first_row || row >= first_row + rows) continue;
        const std::size_t begin = row * stride;
        if (splash.footprint) {
            const Footprint& footprint = *splash.footprint;
            const double z_m = static_cast<double>(z) * placement.texel_m() - footprint.moved_z_m;
            for (std::int64_t x = splash.first_x; x < splash.end_x; ++x) {
                const double x_m = static_cast<double>(x) * placement.texel_m() - footprint.moved_x_m;
                at_texel(begin + placement.in_torus(x), -static_cast<float>(depth_at(footprint.of, x_m, z_m)), 1.f);
            }
            continue;
        }
        if (of.shape == Disturbance::Shape::gauss) {
            const float* const along_x = profiles_.data() + splash.profile;
            const float along_z = along_x[splash.end_x - splash.first_x + z - splash.first_z];
            for (std::int64_t x = splash.first_x; x < splash.end_x; ++x) {
                const float gauss = along_x[x - splash.first_x] * along_z;
                at_texel(begin + placement.in_torus(x), height * gauss, gauss);
            }
            continue;
        }
        const double away_z = static_cast<double>(z) * placement.texel_m() - of.z_m;
        for (std::int64_t x = splash.first_x; x < splash.end_x; ++x) {
            const double away_x = static_cast<double>(x) * placement.texel_m() - of.x_m;
            const double along = (away_x * splash.cosine + away_z * splash.sine) / of.length_m;
            const double across = (away_z * splash.cosine - away_x * splash.sine) / of.radius_m;
            const double inside = 1 - along * along - across * across;
            if (inside <= 0) continue;
            const float weight = static_cast<float>(std::sqrt(inside));
            at_texel(begin + placement.in_torus(x), height * weight, weight);
        }
    }
}

void DynamicWaveSources::push_rows(const GridPlacement& placement, std::size_t first_row, std::size_t rows,
                                   HeightPlanes heights) const {
    float *const now = heights.now, *const before = heights.before;
    for (const Splash& splash : splashes_) {
        const auto push = [&](auto at_texel) { for_texels(splash, placement, first_row, rows, at_texel); };
        switch (splash.of.mode) {
            case Disturbance::Mode::pressure:
                // The step advances the difference from the shape at rest. Verlet's has it at two
                // ticks.
                push([=](std::size_t texel, float shape, float) {
                    now[texel] -= shape;
                    if (before) before[texel] -= shape;
                });
                break;
            case Disturbance::Mode::relaxation:
                // Both of Verlet's heights change equally, here and below, so the added water has
                // no velocity.
                push([=, fraction = splash.fraction](std::size_t texel, float shape, float weight) {
                    const float brought = fraction * weight * (shape - now[texel]);
                    now[texel] += brought;
                    if (before) before[texel] += brought;
                });
                break;
            case Disturbance::Mode::impulse:
                push([=, tick_before = heights.tick_before](std::size_t texel, float shape, float) {
                    now[texel] += shape;
                    if (before) before[texel] += shape;
                    tick_before[texel] += shape;
                });
                break;
            case Disturbance::Mode::foam: break;  // foam_rows()
        }
    }
    rain_.push_rows(placement, tick_, first_row, rows, heights);
}

void DynamicWaveSources::lift_rows(const GridPlacement& placement, std::size_t first_row, std::size_t rows,
                                   HeightPlanes heights) const {
    float *const now = heights.now, *const before = heights.before;
    for (const Splash& splash : splashes_) {
        if (splash.of.mode != Disturbance::Mode::pressure) continue;
        for_texels(splash, placement, first_row, rows, [=](std::size_t texel, float shape, float) {
            now[texel] += shape;
            if (before) before[texel] += shape;
        });
    }
}

void DynamicWaveSources::foam_rows(const GridPlacement& placement, std::size_t first_row, std::size_t rows,
                                   float threshold, FoamPlane to) const {
    const auto n = static_cast<std::size_t>(placement.resolution());
    const std::size_t stride = dynamic_row_stride(n);
    for (const Splash& splash : splashes_) {
        if (splash.of.mode != Disturbance::Mode::foam) continue;
        for_texels(splash, placement, first_row, rows, [&](std::size_t texel, float shape, float) {
            const float above = std::clamp((shape - threshold) / threshold, 0.f, 1.f);
            const std::size_t row = texel / stride;
            std::uint8_t& foam = to.foam[row * n + texel % stride];
            foam = std::max(foam, static_cast<std::uint8_t>(255 * above));
            to.has_foam[row] = static_cast<std::uint8_t>(to.has_foam[row] | foam);
        });
    }
}

void DynamicWaveSources::end_tick() {
    splashes_.clear();
    profiles_.clear();
}

std::size_t DynamicWaveSources::saved_bytes() const {
    std::size_t bytes = sizeof(SavedSourcesHeader) + (sources_.size() + waiting_.size()) * sizeof(SavedSource);
    for (const Footprint& footprint : footprints_)
        bytes += sizeof(SavedFootprint) + saved_depth_bytes(footprint.of.columns, footprint.of.rows);
    return bytes;
}

void DynamicWaveSources::save(std::span<std::uint8_t> bytes) const {
    assert(bytes.size() == saved_bytes());
    const Rain& rain = rain_.rain();
    const SavedSourcesHeader header = {next_number_,
                                static_cast<std::int64_t>(sources_.size()),
                                static_cast<std::int64_t>(waiting_.size()),
                                static_cast<std::int64_t>(settled_),
                                static_cast<std::int64_t>(footprints_.size()),
                                rain.drops_per_m2_s,
                                rain.radius_m,
                                rain.height_m,
                                rain.seed};
    std::uint8_t* to = bytes.data();
    const auto put = [&to](const auto& saved) {
        std::memcpy(to, &saved, sizeof saved);
        to += sizeof saved;
    };
    put(header);
    for (const Source& source : sources_) put(saved_source(source.number, source.since, source.disturbance));
    for (const Disturbance& disturbance : waiting_) put(saved_source(0, 0, disturbance));
    for (const Footprint& footprint : footprints_) {
        put(saved_footprint(footprint.number, footprint.since, footprint.of));
        const std::size_t depths = footprint.of.depth_m.size() * sizeof(float);
        const std::size_t padded = saved_depth_bytes(footprint.of.columns, footprint.of.rows);
        std::memcpy(to, footprint.of.depth_m.data(), depths);
        std::memset(to + depths, 0, padded - depths);
        to += padded;
    }
}

DynamicWaveSources DynamicWaveSources::restored(std::span<const std::uint8_t> bytes, std::int64_t ticks,
                                                const DynamicWavesOptions& water) {
    SavedBytes from(bytes);
    const auto header = from.next<SavedSourcesHeader>();
    const auto can_be = [](std::int64_t count, std::int64_t at_most) { return count >= 0 && count <= at_most; };
    constexpr auto max_of_each = static_cast<std::int64_t>(max_count);
    if (!can_be(header.lasting, max_of_each) || !can_be(header.waiting, max_of_each) ||
        !can_be(header.footprints, max_of_each - header.lasting) || !can_be(header.settled, header.waiting))
        from.throw_size();
    if (header.next_number < 1 || header.next_number > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument(
            invalid_value_message("the saved state's next source", header.next_number, "[1, 2^32)"));
    DynamicWaveSources sources;
    sources.next_number_ = static_cast<std::uint32_t>(header.next_number);
    sources.rain_ = restored_rain(header, water);
    for (std::int64_t i = 0, last = 0; i < header.lasting; ++i) {
        const auto saved = from.next<SavedSource>();
        check_saved(saved.number, saved.since, last, header, ticks);
        sources.sources_.push_back({static_cast<std::uint32_t>(saved.number), disturbance_of(saved), saved.since});
        last = saved.number;
    }
    for (std::int64_t i = 0; i < header.waiting; ++i)
        sources.waiting_.push_back(disturbance_of(from.next<SavedSource>()));
    for (std::int64_t i = 0, last = 0; i < header.footprints; ++i) {
        const auto saved = from.next<SavedFootprint>();
        check_saved(saved.number, saved.since, last, header, ticks);
        const auto number = static_cast<std::uint32_t>(saved.number);
        if (sources.has(number))
            throw std::invalid_argument(
                invalid_value_message("a saved footprint's number", saved.number, "another than those of sources"));
        sources.footprints_.push_back({number, footprint_of(saved, from), saved.since});
        last = saved.number;
    }
    from.expect_end();
    sources.settled_ = static_cast<std::size_t>(header.settled);
    return sources;
}

std::size_t DynamicWaveSources::bytes() const {
    std::size_t depths = 0;
    for (const Footprint& footprint : footprints_) depths += footprint.of.depth_m.capacity() * sizeof(float);
    return depths + footprints_.capacity() * sizeof(Footprint) + sources_.capacity() * sizeof(Source) +
           waiting_.capacity() * sizeof(Disturbance) + splashes_.capacity() * sizeof(Splash) +
           profiles_.capacity() * sizeof(float) + rain_.bytes();
}

}  // namespace pelagic
