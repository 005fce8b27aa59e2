// Droplets in flight: their launch from crests and emitters, and what a frame shows of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spray.hpp"
#include "pelagic/sim/spray/flight.hpp"
#include "pelagic/sim/water_frame.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/split_mix.hpp"

namespace pelagic {

/// Random numbers of a key.
class SprayRandom {
   public:
    explicit SprayRandom(std::uint64_t key) : state_(key) {}
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
inline std::uint64_t spray_key(std::uint64_t key, std::int64_t number) {
    return split_mix(key + static_cast<std::uint64_t>(number) + golden_gamma);
}

/// A droplet's launch, in the frame of the water. Its bytes are saved, so it has no padding.
struct StoredDroplet {
    Flight flight;
    std::int64_t tick;  ///< before the launch; 0 for an emitter
    double launch_s;    ///< since the tick, or the time for an emitter
    float lifetime_s, radius_m, growth_mps, opacity;
};
static_assert(sizeof(StoredDroplet) == 12 * sizeof(double) + 4 * sizeof(float));

/// Droplets in the order of their launches, of which a new one replaces the oldest.
class DropletRing {
   public:
    explicit DropletRing(const Allocator& memory) : droplets_(max_spray_droplets, memory) {}
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

/// Wind near the water.
struct SprayWind {
    double speed_mps = 0;  ///< at 10 m
    SprayVector velocity_mps{};

    static SprayWind of(const SeaState& sea);
    /// 0 to 1: the amount of spray.
    double rough() const;
    /// 0 below Beaufort 9, 1 from Beaufort 11 on: the amount of spindrift.
    double spindrift() const;
};

/// Returns a droplet that leaves a crest. There are three kinds: drops of splashes, mist, and
/// spindrift.
/// \param at_m, velocity_mps  water at the tick before the launch
/// \param tick_s  droplets leave within this time from the tick on
/// \param longest_s  upper bound of the lifetime
StoredDroplet leaves_crest(const SprayVector& at_m, const SprayVector& velocity_mps, std::int64_t tick, double tick_s,
                           double longest_s, const SprayWind& wind, SprayRandom& random);

/// Adds the droplets of an emitter. \pre check(emitter) is empty
/// \param index  of the emitter in its call
void leave_emitter(const SprayEmitter& emitter, std::size_t index, std::uint32_t seed, const SprayWind& wind,
                   const WaterFrame& water, DropletRing& droplets);

/// The time of a frame.
struct SprayTime {
    double time_s = 0;
    std::int64_t tick = 0;  ///< last tick
    double since_s = 0;     ///< time since that tick
    double tick_s = 0;      ///< interval of ticks
};

/// Writes the droplets in the air, in the world, first those of emitters, each ring with the newest
/// first. Returns their number.
std::size_t write_droplets(const DropletRing& of_emitters, const DropletRing& of_crests, const SprayTime& time,
                           const WaterFrame& water, std::span<SprayDroplet> out);

}  // namespace pelagic
