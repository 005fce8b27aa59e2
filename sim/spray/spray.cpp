#include "pelagic/sim/spray.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/spray/breaking_surface.hpp"
#include "pelagic/sim/spray/flight.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"
#include "pelagic/simd/split_mix.hpp"

namespace pelagic {
namespace {

/// Candidates along the radius of the reach. A candidate stands for a cell, 2 m wide by default.
constexpr int cells_of_reach = 40;
constexpr double ticks_per_s = 10;
/// Rounding of times up to 1e9 s, in ticks.
constexpr double max_rounding = 1e-4;
/// Largest number of ticks that launched a droplet which is still in the air.
constexpr std::int64_t lifetime_ticks = 16;
/// Droplets of crests in a tick. 16 ticks have no more than max_droplets. The mean is kept below,
/// so that a tick seldom has too many.
constexpr std::size_t max_in_tick = Spray::max_droplets / lifetime_ticks;
constexpr double max_mean_in_tick = 0.9 * max_in_tick;
/// Number of droplets of a cell in a tick, where waves break violently in a gale.
constexpr double droplets_of_cell = 120;
/// Spray begins to leave crests in this wind (lower end of Beaufort 5), and has its full amount at
/// the lower end of Beaufort 9, where spindrift begins.
constexpr double first_wind_mps = 8, gale_mps = 20.8;
/// Wind at the height of the droplets over the wind at 10 m: logarithmic profile at 1 m, with the
/// roughness length of 1 mm of a rough sea.
constexpr double wind_near_water = 0.75;
/// Compression above the level of foam at which a crest throws the full number, in standard
/// deviations. Less throws in proportion.
constexpr double full_excess = 0.6;
/// Crests throw in bursts. A burst has the size of these many cells and ticks.
constexpr std::int64_t cells_of_burst = 2, ticks_of_burst = 4;

constexpr std::array option_fields = {
    NumericField<SprayOptions>{"reach_m", &SprayOptions::reach_m, 10, 200, "[10, 200]"},
    NumericField<SprayOptions>{"amount", &SprayOptions::amount, 0, 10, "[0, 10]"},
    NumericField<SprayOptions>{"seed", &SprayOptions::seed, 0, UINT32_MAX, "a whole number from 0 to 4294967295"},
    NumericField<SprayOptions>{"loop_period_s", &SprayOptions::loop_period_s, 1, 1e6, "[1, 1e6], or 0 for no loop",
                               Restriction::none, 0.0},
};

constexpr std::array emitter_fields = {
    NumericField<SprayEmitter>{"time_s", &SprayEmitter::time_s, -1e9, 1e9, "[-1e9, 1e9]"},
    NumericField<SprayEmitter>{"x_m", &SprayEmitter::x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<SprayEmitter>{"y_m", &SprayEmitter::y_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<SprayEmitter>{"z_m", &SprayEmitter::z_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<SprayEmitter>{"extent_m", &SprayEmitter::extent_m, 0, 100, "[0, 100]"},
    NumericField<SprayEmitter>{"velocity_x_mps", &SprayEmitter::velocity_x_mps, -100, 100, "[-100, 100]"},
    NumericField<SprayEmitter>{"velocity_y_mps", &SprayEmitter::velocity_y_mps, -100, 100, "[-100, 100]"},
    NumericField<SprayEmitter>{"velocity_z_mps", &SprayEmitter::velocity_z_mps, -100, 100, "[-100, 100]"},
    NumericField<SprayEmitter>{"spread_mps", &SprayEmitter::spread_mps, 0, 100, "[0, 100]"},
    NumericField<SprayEmitter>{"radius_m", &SprayEmitter::radius_m, 0.001, 1, "[0.001, 1]"},
    NumericField<SprayEmitter>{"drop_mm", &SprayEmitter::drop_mm, 0.1, 5, "[0.1, 5]"},
    NumericField<SprayEmitter>{"count", &SprayEmitter::count, 0, static_cast<double>(Spray::max_droplets),
                               "[0, 8192]"},
};

/// Random numbers of a key.
class Random {
   public:
    explicit Random(std::uint64_t key) : state_(key) {}
    /// Returns a number in [0, 1).
    double next() {
        state_ += golden_gamma;
        return static_cast<double>(split_mix(state_) >> 11) * two_to_minus_53;
    }
    /// Returns a number in (-1, 1), with the density of a sum of two.
    double spread() {
        const double a = next();
        return a + next() - 1;
    }
    /// Returns a point in the unit ball. After eight trials outside, which is less probable than
    /// 0.003, it returns the centre.
    SprayVector in_ball() {
        for (int trial = 0; trial < 8; ++trial) {
            SprayVector at;
            for (double& axis : at) axis = 2 * next() - 1;
            if (at[0] * at[0] + at[1] * at[1] + at[2] * at[2] <= 1) return at;
        }
        return {};
    }

   private:
    std::uint64_t state_;
};

/// Returns a key for a number under another key.
std::uint64_t key_of(std::uint64_t key, std::int64_t number) {
    return split_mix(key + static_cast<std::uint64_t>(number) + golden_gamma);
}

}  // namespace

struct StoredDroplet {
    Flight flight;
    double launch_s;
    float lifetime_s, radius_m, growth_mps, opacity;
};

/// Droplets in the order of their launches, of which a new one replaces the oldest.
class DropletRing {
   public:
    explicit DropletRing(const Allocator& memory) : droplets_(Spray::max_droplets, memory) {}
    void clear() { count_ = 0; }
    void add(const StoredDroplet& droplet) {
        droplets_[next_] = droplet;
        next_ = (next_ + 1) % droplets_.size();
        count_ = std::min(count_ + 1, droplets_.size());
    }
    std::size_t count() const { return count_; }
    /// Returns a droplet; 0 is the newest.
    const StoredDroplet& newest(std::size_t i) const {
        return droplets_[(next_ + droplets_.size() - 1 - i) % droplets_.size()];
    }
    std::size_t bytes() const { return droplets_.bytes(); }

   private:
    AlignedBuffer<StoredDroplet> droplets_;
    std::size_t next_ = 0, count_ = 0;
};

/// A cell in which water breaks.
struct SprayCandidate {
    double x_m, z_m;  ///< reference position
    double droplets;  ///< mean number
    std::uint64_t key;
};

/// Wind near the water.
struct SprayWind {
    double speed_mps = 0;  ///< at 10 m
    SprayVector velocity_mps{};

    static SprayWind of(const SeaState& sea) {
        const auto heading = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
        const double speed = wind_near_water * sea.wind_speed_mps;
        return {sea.wind_speed_mps, {speed * heading.cosine, 0, speed * heading.sine}};
    }
    /// 0 to 1: the amount of spray.
    double rough() const { return std::clamp((speed_mps - first_wind_mps) / (gale_mps - first_wind_mps), 0.0, 1.0); }
    /// 0 below Beaufort 9, 1 from Beaufort 11 on: the amount of spindrift.
    double spindrift() const { return std::clamp((speed_mps - gale_mps) / 8, 0.0, 1.0); }
};

namespace {

/// Returns the wind at a droplet: gusts differ in speed and direction.
SprayVector gust(const SprayWind& wind, Random& random) {
    const double along = 0.65 + 0.6 * random.next(), across = 0.12 * random.spread(), up = 0.06 * random.spread();
    const auto [x, y, z] = wind.velocity_mps;
    return {along * x - across * z, y + up * wind_near_water * wind.speed_mps, along * z + across * x};
}

/// Returns a droplet that leaves the water at a point. There are three kinds: drops of splashes,
/// mist, and spindrift.
StoredDroplet launched(const SurfacePoint& water, double tick_time_s, double tick_s, const SprayWind& wind,
                       Random& random) {
    StoredDroplet droplet;
    const SprayVector& flow = water.velocity_mps;
    // The point moves with the water until the launch.
    const double after_s = tick_s * random.next();
    droplet.flight.start_m = {water.x_m + flow[0] * after_s, water.y_m + flow[1] * after_s,
                              water.z_m + flow[2] * after_s};
    droplet.launch_s = tick_time_s + after_s;
    droplet.flight.wind_mps = gust(wind, random);
    const double kind = random.next(), size = random.next(), energy = random.next(), life = random.next();
    const double spindrift = wind.spindrift(), strength = 0.4 + 0.6 * wind.rough();
    // Water of a breaking crest is faster than in linear theory, up to the phase speed.
    double of_flow = 1.8, of_wind, up_mps, spread_mps, drop_mm;
    if (kind < 0.3 - 0.2 * spindrift) {  // splash
        drop_mm = 1 + 2 * size * size;
        of_wind = 0;
        up_mps = 0.6 + 2.6 * energy * strength;
        spread_mps = 0.9;
        droplet.radius_m = static_cast<float>(0.010 + 0.022 * size * size);
        droplet.growth_mps = 0.01f;
        droplet.opacity = 0.85f;
    } else {  // mist; spindrift is finer and leaves along the wind
        const bool is_torn = random.next() < spindrift;
        drop_mm = is_torn ? 0.15 + 0.25 * size : 0.25 + 0.55 * size;
        of_wind = is_torn ? 0.45 : 0.1 * energy;
        up_mps = is_torn ? 0.3 + 1.2 * energy : 0.3 + 1.8 * energy * strength;
        spread_mps = 0.5;
        droplet.radius_m = static_cast<float>(is_torn ? 0.12 + 0.25 * size : 0.08 + 0.14 * size);
        droplet.growth_mps = static_cast<float>((is_torn ? 0.9 : 0.35) * (1 + random.next()));
        droplet.opacity = 0.6f;
    }
    droplet.flight.relaxation_s = relaxation_of(drop_mm);
    for (std::size_t axis = 0; axis < 3; ++axis)
        droplet.flight.start_mps[axis] = of_flow * flow[axis] + of_wind * droplet.flight.wind_mps[axis] +
                                         spread_mps * random.spread() + (axis == 1 ? up_mps : 0);
    const double longest_s = std::min(Spray::max_lifetime_s, (lifetime_ticks - 1) * tick_s);
    droplet.lifetime_s = static_cast<float>(longest_s * (0.45 + 0.55 * life));
    return droplet;
}

/// Returns the droplet at an age. Its radius grows, and its opacity falls with the growth and at
/// the end of its life.
SprayDroplet droplet_at(const StoredDroplet& stored, double age_s) {
    const FlightPoint point = flown(stored.flight, age_s);
    const auto age = static_cast<float>(age_s);
    const float radius = stored.radius_m + stored.growth_mps * age, lived = age / stored.lifetime_s;
    return {.x_m = point.place_m[0],
            .y_m = point.place_m[1],
            .z_m = point.place_m[2],
            .velocity_x_mps = static_cast<float>(point.velocity_mps[0]),
            .velocity_y_mps = static_cast<float>(point.velocity_mps[1]),
            .velocity_z_mps = static_cast<float>(point.velocity_mps[2]),
            .radius_m = radius,
            .opacity = stored.opacity * (stored.radius_m / radius) * (1 - lived * lived),
            .age_s = age};
}

std::int64_t ticks_in(double loop_period_s) {
    return loop_period_s == 0 ? 0 : static_cast<std::int64_t>(std::floor(loop_period_s * ticks_per_s + 0.5));
}

void require_time(double time_s) {
    if (!(time_s >= -1e9 && time_s <= 1e9))
        throw std::invalid_argument(invalid_value_message("time_s", time_s, "[-1e9, 1e9]"));
}

}  // namespace

std::span<const NumericField<SprayEmitter>> spray_emitter_fields() { return emitter_fields; }
std::span<const NumericField<SprayOptions>> spray_fields() { return option_fields; }
std::string check(const SprayEmitter& emitter) { return check_fields(emitter, emitter_fields); }
std::string check(const SprayOptions& options) { return check_fields(options, option_fields); }

struct Spray::State {
    State(const SprayOptions& wanted, const Allocator& memory)
        : options(wanted),
          ticks_a_loop(ticks_in(wanted.loop_period_s)),
          tick_s(ticks_a_loop == 0 ? 1 / ticks_per_s : wanted.loop_period_s / static_cast<double>(ticks_a_loop)),
          cell_m(wanted.reach_m / cells_of_reach),
          emitted(memory),
          of_crests(memory),
          candidates(4 * (cells_of_reach + 1) * (cells_of_reach + 1), memory),
          shown(max_droplets, memory) {}

    double time_of(std::int64_t tick) const { return static_cast<double>(tick) * tick_s; }
    std::int64_t tick_at(double time_s) const {
        // A tick's own time may round to just below it.
        return static_cast<std::int64_t>(std::floor(time_s / tick_s + max_rounding));
    }
    /// Returns the key of a tick, equal in all loops.
    std::uint64_t key_of_tick(std::int64_t tick) const {
        if (ticks_a_loop != 0) tick = (tick % ticks_a_loop + ticks_a_loop) % ticks_a_loop;
        return key_of(split_mix(options.seed + golden_gamma), tick);
    }
    /// Returns the factor of bursts in a cell; its mean is 1.
    double burst(std::int64_t tick, std::int64_t cell_x, std::int64_t cell_z) const {
        const auto block = [](std::int64_t at, std::int64_t size) { return (at >= 0 ? at : at - size + 1) / size; };
        if (ticks_a_loop != 0) tick = (tick % ticks_a_loop + ticks_a_loop) % ticks_a_loop;
        Random random(key_of(
            key_of(key_of(~std::uint64_t{options.seed}, block(tick, ticks_of_burst)), block(cell_x, cells_of_burst)),
            block(cell_z, cells_of_burst)));
        const double u = random.next();
        return 3 * u * u;
    }

    /// Finds the cells in which water breaks. Returns their number.
    std::size_t find_candidates(const Frame& frame, const BreakingSurface& surface, std::int64_t tick, double x_m,
                                double z_m) {
        const double amount = options.amount * SprayWind::of(frame.sea).rough() * droplets_of_cell;
        if (!(amount > 0) || frame.statistics.foam_level == SeaStatistics::no_foam_level) return 0;
        const std::uint64_t key = key_of_tick(tick);
        const auto first_x = static_cast<std::int64_t>(std::floor(x_m / cell_m)) - cells_of_reach;
        const auto first_z = static_cast<std::int64_t>(std::floor(z_m / cell_m)) - cells_of_reach;
        std::size_t count = 0;
        for (std::int64_t j = 0; j <= 2 * cells_of_reach; ++j)
            for (std::int64_t i = 0; i <= 2 * cells_of_reach; ++i) {
                const std::int64_t cell_x = first_x + i, cell_z = first_z + j;
                const std::uint64_t of_cell = key_of(key_of(key, cell_x), cell_z);
                Random random(of_cell);
                const double x = (static_cast<double>(cell_x) + random.next()) * cell_m;
                const double z = (static_cast<double>(cell_z) + random.next()) * cell_m;
                const double away =
                    ((x - x_m) * (x - x_m) + (z - z_m) * (z - z_m)) / (options.reach_m * options.reach_m);
                if (away >= 1) continue;
                const double excess = surface.compression(x, z) - frame.statistics.foam_level;
                if (excess <= 0) continue;
                // Fewer droplets far away, where they are small in an image, and none at the end of
                // the reach, so that no edge is visible.
                const double fade = std::min(1.0, 3 * (1 - away)) / (1 + 4 * away);
                const double droplets =
                    amount * fade * std::min(excess / full_excess, 1.0) * burst(tick, cell_x, cell_z);
                candidates[count++] = {x, z, droplets, of_cell};
            }
        return count;
    }

    void launch(const Frame& frame, std::int64_t tick, double x_m, double z_m) {
        const BreakingSurface surface(frame);
        wind = SprayWind::of(frame.sea);
        water_frame = frame.water_frame;
        const WaterFrame::Origin origin = water_frame.origin_at(frame.time_s);
        const std::size_t count = find_candidates(frame, surface, tick, x_m - origin.x_m, z_m - origin.z_m);
        double all = 0;
        for (std::size_t i = 0; i < count; ++i) all += candidates[i].droplets;
        const double kept = std::min(1.0, max_mean_in_tick / all);
        std::size_t launches = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const SprayCandidate& candidate = candidates[i];
            Random random(split_mix(candidate.key));
            const auto droplets = static_cast<int>(std::floor(candidate.droplets * kept + random.next()));
            for (int n = 0; n < droplets && launches < max_in_tick; ++n, ++launches) {
                const double x = candidate.x_m + (n == 0 ? 0 : 0.75 * cell_m * random.spread());
                const double z = candidate.z_m + (n == 0 ? 0 : 0.75 * cell_m * random.spread());
                if (n > 0 && surface.compression(x, z) < frame.statistics.foam_level) continue;
                of_crests.add(launched(surface.at(x, z), time_of(tick), tick_s, wind, random));
            }
        }
    }

    void launch(const SprayEmitter& emitter, std::size_t index) {
        Random random(key_of(key_of(options.seed, std::bit_cast<std::int64_t>(emitter.time_s)),
                             static_cast<std::int64_t>(index)));
        const WaterFrame::Origin origin = water_frame.origin_at(emitter.time_s);
        for (int n = 0; n < emitter.count; ++n) {
            const SprayVector place = random.in_ball(), change = random.in_ball();
            StoredDroplet droplet;
            droplet.flight = {
                .start_m = {emitter.x_m - origin.x_m, emitter.y_m - origin.y_m, emitter.z_m - origin.z_m},
                .start_mps = {emitter.velocity_x_mps - water_frame.current_x_mps, emitter.velocity_y_mps,
                              emitter.velocity_z_mps - water_frame.current_z_mps},
                .wind_mps = gust(wind, random),
                .relaxation_s = relaxation_of(emitter.drop_mm)};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                droplet.flight.start_m[axis] += emitter.extent_m * place[axis];
                droplet.flight.start_mps[axis] += emitter.spread_mps * change[axis];
            }
            droplet.launch_s = emitter.time_s;
            droplet.lifetime_s = static_cast<float>(max_lifetime_s * (0.45 + 0.55 * random.next()));
            droplet.radius_m = static_cast<float>(emitter.radius_m);
            droplet.growth_mps = 2 * droplet.radius_m;
            droplet.opacity = 0.6f;
            emitted.add(droplet);
        }
    }

    SprayDroplet in_world(SprayDroplet droplet, double time_s) const {
        const WaterFrame::Origin origin = water_frame.origin_at(time_s);
        droplet.x_m += origin.x_m;
        droplet.y_m += origin.y_m;
        droplet.z_m += origin.z_m;
        droplet.velocity_x_mps += static_cast<float>(water_frame.current_x_mps);
        droplet.velocity_z_mps += static_cast<float>(water_frame.current_z_mps);
        return droplet;
    }

    void show(const DropletRing& ring, double time_s) {
        for (std::size_t i = 0; i < ring.count() && shown_count < max_droplets; ++i) {
            const StoredDroplet& stored = ring.newest(i);
            const double age_s = time_s - stored.launch_s;
            if (age_s >= 0 && age_s < static_cast<double>(stored.lifetime_s))
                shown[shown_count++] = in_world(droplet_at(stored, age_s), time_s);
        }
    }

    SprayOptions options;
    std::int64_t ticks_a_loop;  ///< 0: no loop
    double tick_s, cell_m;
    DropletRing emitted, of_crests;
    AlignedBuffer<SprayCandidate> candidates;
    AlignedBuffer<SprayDroplet> shown;
    std::size_t shown_count = 0;
    /// Ticks that of_crests holds, none if the first is after the last.
    std::int64_t first_tick = 0, last_tick = -1;
    SprayWind wind;
    WaterFrame water_frame;  ///< of the last tick; flights are in the water's frame
};

Spray::Spray(const SprayOptions& options, const Allocator& memory) {
    require(check(options));
    const DefaultFloatEnvironment environment;
    state_ = std::make_unique<State>(options, memory);
}

Spray::~Spray() = default;

std::optional<double> Spray::missing_tick_s(double time_s) const {
    require_time(time_s);
    const DefaultFloatEnvironment environment(time_s);
    const State& s = *state_;
    const std::int64_t last = s.tick_at(time_s), first = last - lifetime_ticks + 1;
    const bool has_first = s.first_tick <= first && s.last_tick >= first && s.last_tick <= last;
    if (!has_first) return environment.result(s.time_of(first));
    if (s.last_tick == last) return {};
    return environment.result(s.time_of(s.last_tick + 1));
}

void Spray::add_tick(const Frame& frame, double center_x_m, double center_z_m) {
    const auto require_place = [](const char* name, double value) {
        if (!(value >= -1e8 && value <= 1e8))
            throw std::invalid_argument(invalid_value_message(name, value, "[-1e8, 1e8]"));
    };
    require_place("center_x_m", center_x_m);
    require_place("center_z_m", center_z_m);
    require_time(frame.time_s);
    if (!frame.cascades.front().velocity_y.data)
        throw std::invalid_argument("spray needs frames of an ocean with velocities");
    const DefaultFloatEnvironment environment(center_x_m, center_z_m);
    State& s = *state_;
    const std::int64_t tick = s.tick_at(frame.time_s);
    if (std::abs(frame.time_s - s.time_of(tick)) > max_rounding * s.tick_s)
        throw std::invalid_argument(invalid_value_message("time_s", frame.time_s, "a time of missing_tick_s()"));
    if (s.last_tick < s.first_tick || tick != s.last_tick + 1) {
        s.of_crests.clear();
        s.first_tick = tick;
    }
    s.last_tick = tick;
    s.launch(frame, tick, center_x_m, center_z_m);
}

void Spray::emit(std::span<const SprayEmitter> emitters) {
    std::size_t all = 0;
    for (const SprayEmitter& emitter : emitters) {
        require(check(emitter));
        all += static_cast<std::size_t>(emitter.count);
    }
    if (all > max_droplets)
        throw std::invalid_argument(invalid_value_message("count", all, "[0, 8192] for all emitters of a call"));
    const DefaultFloatEnvironment environment;
    for (std::size_t i = 0; i < emitters.size(); ++i) state_->launch(emitters[i], i);
}

std::span<const SprayDroplet> Spray::droplets_at(double time_s) {
    require_time(time_s);
    const DefaultFloatEnvironment environment(time_s);
    State& s = *state_;
    s.shown_count = 0;
    s.show(s.emitted, time_s);
    s.show(s.of_crests, time_s);
    return {s.shown.data(), s.shown_count};
}

const SprayOptions& Spray::options() const { return state_->options; }
double Spray::tick_s() const { return state_->tick_s; }

std::size_t Spray::memory_bytes() const {
    const State& s = *state_;
    return sizeof(State) + s.emitted.bytes() + s.of_crests.bytes() + s.candidates.bytes() + s.shown.bytes();
}

}  // namespace pelagic
