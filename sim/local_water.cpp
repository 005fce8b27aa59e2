#include "pelagic/sim/local_water.hpp"

#include <array>
#include <cmath>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/message/refusal.hpp"
#include "pelagic/sim/sources/local_grid.hpp"

namespace pelagic {
namespace {

constexpr std::array fields = {
    NumericField<LocalWaterOptions>{"resolution", &LocalWaterOptions::resolution, 64, 1024,
                                    "64, 128, 256, 512 or 1024", Among::powers_of_two},
    NumericField<LocalWaterOptions>{"side_m", &LocalWaterOptions::side_m, 1, 10000, "[1, 10000]"},
    NumericField<LocalWaterOptions>{"ticks_per_s", &LocalWaterOptions::ticks_per_s, 10, 240, "[10, 240]"},
    NumericField<LocalWaterOptions>{"border_m", &LocalWaterOptions::border_m, 0.001, 2500,
                                    "[0.001, side_m / 4], or 0: none", Among::all, 0},
    NumericField<LocalWaterOptions>{"depth_m", &LocalWaterOptions::depth_m, 0.01, 11000, "[0.01, 11000]"},
    NumericField<LocalWaterOptions>{"viscosity_m2ps", &LocalWaterOptions::viscosity_m2ps, 0, 1, "[0, 1]"},
    NumericField<LocalWaterOptions>{"wave_speed_mps", &LocalWaterOptions::wave_speed_mps, 0, 1000, "(0, 1000]",
                                    Among::above_least},
    NumericField<LocalWaterOptions>{"decay_per_s", &LocalWaterOptions::decay_per_s, 0, 10, "[0, 10]"},
    NumericField<LocalWaterOptions>{"foam_height_m", &LocalWaterOptions::foam_height_m, 0.001, 100, "[0.001, 100]"},
};

/// Texels of a frame's window, with their neighbours.
class LocalTexels {
   public:
    explicit LocalTexels(const LocalSurface& water)
        : water_(water), last_(static_cast<std::size_t>(water.resolution) - 1) {}

    double height(std::int64_t x, std::int64_t z) const { return static_cast<double>(water_.height_m[place(x, z)]); }
    LocalSample at(std::int64_t x, std::int64_t z) const {
        const double half = 0.5 / water_.texel_m;
        const std::size_t here = place(x, z);
        return {.height_m = static_cast<double>(water_.height_m[here]),
                .slope_x = (height(x + 1, z) - height(x - 1, z)) * half,
                .slope_z = (height(x, z + 1) - height(x, z - 1)) * half,
                .rise_mps = static_cast<double>(water_.rise_mps[here]),
                .foam = static_cast<double>(water_.foam[here]) * (1.0 / 255)};
    }

   private:
    std::size_t place(std::int64_t x, std::int64_t z) const {
        return (static_cast<std::size_t>(z) & last_) * (last_ + 1) + (static_cast<std::size_t>(x) & last_);
    }
    const LocalSurface& water_;
    std::size_t last_;
};

LocalSample between(const LocalSample& a, const LocalSample& b, double part) {
    const auto mixed = [&](double LocalSample::*member) { return a.*member + part * (b.*member - a.*member); };
    return {mixed(&LocalSample::height_m), mixed(&LocalSample::slope_x), mixed(&LocalSample::slope_z),
            mixed(&LocalSample::rise_mps), mixed(&LocalSample::foam)};
}

}  // namespace

std::string check(const LocalWaterOptions& options) {
    if (std::string reason = check_fields(options, fields); !reason.empty()) return reason;
    if (options.border_m > options.side_m / 4)
        return refusal("border_m", options.border_m,
                       "at most a quarter of side_m, " + number_text(options.side_m / 4));
    const double courant = LocalGrid::courant_number(options);
    if (options.step == LocalStep::verlet && courant * courant > LocalGrid::most_coupling)
        return refusal("wave_speed_mps", options.wave_speed_mps,
                       "c = (wave_speed_mps / (ticks_per_s texel))^2 to be " + number_text(LocalGrid::most_coupling) +
                           " at most, which is " + rounded_text(courant * courant, 3));
    return {};
}

LocalSample sample(const LocalSurface& water, double x_m, double z_m) {
    if (!water) return {};
    const double u = x_m / water.texel_m - static_cast<double>(water.first_x);
    const double v = z_m / water.texel_m - static_cast<double>(water.first_z);
    // The outermost texels have neighbours on the other side of the window only, and are 0.
    const double last = water.resolution - 2;
    if (!(u >= 1 && v >= 1 && u < last && v < last)) return {};
    const double column = std::floor(u), row = std::floor(v);
    const auto x = water.first_x + static_cast<std::int64_t>(column),
               z = water.first_z + static_cast<std::int64_t>(row);
    const LocalTexels texels(water);
    const LocalSample above = between(texels.at(x, z), texels.at(x + 1, z), u - column);
    const LocalSample below = between(texels.at(x, z + 1), texels.at(x + 1, z + 1), u - column);
    return between(above, below, v - row);
}

std::uint64_t local_hash_of(const Frame& frame) {
    const LocalSurface& water = frame.local;
    if (!water) return 0;
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    const std::int64_t place[] = {water.resolution, water.first_x, water.first_z};
    XXH3_64bits_update(&state, place, sizeof place);
    XXH3_64bits_update(&state, water.height_m.data(), water.height_m.size_bytes());
    XXH3_64bits_update(&state, water.rise_mps.data(), water.rise_mps.size_bytes());
    XXH3_64bits_update(&state, water.foam.data(), water.foam.size_bytes());
    return XXH3_64bits_digest(&state);
}

}  // namespace pelagic
