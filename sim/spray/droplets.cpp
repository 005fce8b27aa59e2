#include "pelagic/sim/spray/droplets.hpp"

#include <bit>
#include <cmath>

#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

/// Spray begins to leave crests in this wind (lower end of Beaufort 5), and has its full amount at
/// the lower end of Beaufort 9, where spindrift begins.
constexpr double first_wind_mps = 8, gale_mps = 20.8;
/// Wind at the height of the droplets over the wind at 10 m: logarithmic profile at 1 m, with the
/// roughness length of 1 mm of a rough sea.
constexpr double wind_near_water = 0.75;
/// Returns the wind at a droplet: gusts differ in speed and direction.
SprayVector gust(const SprayWind& wind, SprayRandom& random) {
    const double along = 0.65 + 0.6 * random.next(), across = 0.12 * random.spread(), up = 0.06 * random.spread();
    const auto [x, y, z] = wind.velocity_mps;
    return {along * x - across * z, y + up * wind_near_water * wind.speed_mps, along * z + across * x};
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

}  // namespace

SprayWind SprayWind::of(const SeaState& sea) {
    const auto heading = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    const double speed = wind_near_water * sea.wind_speed_mps;
    return {sea.wind_speed_mps, {speed * heading.cosine, 0, speed * heading.sine}};
}
double SprayWind::rough() const {
    return std::clamp((speed_mps - first_wind_mps) / (gale_mps - first_wind_mps), 0.0, 1.0);
}
double SprayWind::spindrift() const { return std::clamp((speed_mps - gale_mps) / 8, 0.0, 1.0); }

StoredDroplet leaves_crest(const SprayVector& at_m, const SprayVector& velocity_mps, std::int64_t tick, double tick_s,
                           double longest_s, const SprayWind& wind, SprayRandom& random) {
    StoredDroplet droplet;
    // The point moves with the water until the launch.
    droplet.tick = tick;
    droplet.launch_s = tick_s * random.next();
    for (std::size_t axis = 0; axis < 3; ++axis)
        droplet.flight.start_m[axis] = at_m[axis] + velocity_mps[axis] * droplet.launch_s;
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
        droplet.flight.start_mps[axis] = of_flow * velocity_mps[axis] + of_wind * droplet.flight.wind_mps[axis] +
                                         spread_mps * random.spread() + (axis == 1 ? up_mps : 0);
    droplet.lifetime_s = static_cast<float>(longest_s * (0.45 + 0.55 * life));
    return droplet;
}

void leave_emitter(const SprayEmitter& emitter, std::size_t index, std::uint32_t seed, const SprayWind& wind,
                   const WaterFrame& water, DropletRing& droplets) {
    SprayRandom random(spray_key(spray_key(seed, std::bit_cast<std::int64_t>(emitter.time_s)),
                                 static_cast<std::int64_t>(index)));
    const WaterFrame::Origin origin = water.origin_at(emitter.time_s);
    for (int n = 0; n < emitter.count; ++n) {
        const SprayVector place = random.in_ball(), change = random.in_ball();
        StoredDroplet droplet;
        droplet.flight = {
            .start_m = {emitter.x_m - origin.x_m, emitter.y_m - origin.y_m, emitter.z_m - origin.z_m},
            .start_mps = {emitter.velocity_x_mps - water.current_x_mps, emitter.velocity_y_mps,
                          emitter.velocity_z_mps - water.current_z_mps},
            .wind_mps = gust(wind, random),
            .relaxation_s = relaxation_of(emitter.drop_mm)};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            droplet.flight.start_m[axis] += emitter.extent_m * place[axis];
            droplet.flight.start_mps[axis] += emitter.spread_mps * change[axis];
        }
        droplet.tick = 0;
        droplet.launch_s = emitter.time_s;
        droplet.lifetime_s = static_cast<float>(max_spray_lifetime_s * (0.45 + 0.55 * random.next()));
        droplet.radius_m = static_cast<float>(emitter.radius_m);
        droplet.growth_mps = 2 * droplet.radius_m;
        droplet.opacity = 0.6f;
        droplets.add(droplet);
    }
}

std::size_t write_droplets(const DropletRing& of_emitters, const DropletRing& of_crests, const SprayTime& time,
                           const WaterFrame& water, std::span<SprayDroplet> out) {
    const WaterFrame::Origin origin = water.origin_at(time.time_s);
    std::size_t count = 0;
    const auto show = [&](const DropletRing& ring, auto age_of) {
        for (std::size_t i = 0; i < ring.count() && count < out.size(); ++i) {
            const StoredDroplet& stored = ring.newest(i);
            const double age_s = age_of(stored);
            if (!(age_s >= 0 && age_s < static_cast<double>(stored.lifetime_s))) continue;
            SprayDroplet& droplet = out[count++] = droplet_at(stored, age_s);
            droplet.x_m += origin.x_m;
            droplet.y_m += origin.y_m;
            droplet.z_m += origin.z_m;
            droplet.velocity_x_mps += static_cast<float>(water.current_x_mps);
            droplet.velocity_z_mps += static_cast<float>(water.current_z_mps);
        }
    };
    show(of_emitters, [&](const StoredDroplet& stored) { return time.time_s - stored.launch_s; });
    // Equal in every loop, because it depends on differences of ticks.
    show(of_crests, [&](const StoredDroplet& stored) {
        return static_cast<double>(time.tick - stored.tick) * time.tick_s + time.since_s - stored.launch_s;
    });
    return count;
}

}  // namespace pelagic
