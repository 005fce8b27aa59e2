#include "pelagic/sim/dynamic_waves.hpp"

#include <array>
#include <algorithm>
#include <cmath>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/dynamic_waves/grid.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr NumericField<DynamicWavesOptions> dynamic_waves_field_table[] = {
    // generated from schema/dynamic_waves.toml: table
    {"resolution", &DynamicWavesOptions::resolution, 64, 1024,
     "64, 128, 256, 512 or 1024", Restriction::powers_of_two},
    {"side_m", &DynamicWavesOptions::side_m, 1, 10000, "[1, 10000]"},
    {"ticks_per_s", &DynamicWavesOptions::ticks_per_s, 10, 240, "[10, 240]"},
    {"border_m", &DynamicWavesOptions::border_m, 0.001, 2500,
     "[0.001, side_m / 4], or 0: none", Restriction::none, 0},
    {"depth_m", &DynamicWavesOptions::depth_m, 0.01, 11000, "[0.01, 11000]"},
    {"viscosity_m2ps", &DynamicWavesOptions::viscosity_m2ps, 0, 1, "[0, 1]"},
    {"wave_speed_mps", &DynamicWavesOptions::wave_speed_mps, 0, 1000, "(0, 1000]", Restriction::above_min},
    {"decay_per_s", &DynamicWavesOptions::decay_per_s, 0, 10, "[0, 10]"},
    {"foam_height_m", &DynamicWavesOptions::foam_height_m, 0.001, 100, "[0.001, 100]"},
    // end of generated
};

/// Samples at the texels of a view, with slopes from neighbouring texels.
class DynamicWaveTexels {
   public:
    explicit DynamicWaveTexels(const DynamicWavesView& water)
        : water_(water), last_(static_cast<std::size_t>(water.resolution) - 1) {}

    double height(std::int64_t x, std::int64_t z) const {
        return static_cast<double>(water_.height_m[texel_index(x, z)]);
    }
    DynamicWavesSample at(std::int64_t x, std::int64_t z) const {
        const double half = 0.5 / water_.texel_m;
        const std::size_t here = texel_index(x, z);
        return {.height_m = static_cast<double>(water_.height_m[here]),
                .slope_x = (height(x + 1, z) - height(x - 1, z)) * half,
                .slope_z = (height(x, z + 1) - height(x, z - 1)) * half,
                .vertical_velocity_mps = static_cast<double>(water_.vertical_velocity_mps[here]),
                .foam = static_cast<double>(water_.foam[here]) * (1.0 / 255)};
    }

   private:
    std::size_t texel_index(std::int64_t x, std::int64_t z) const {
        return (static_cast<std::size_t>(z) & last_) * (last_ + 1) + (static_cast<std::size_t>(x) & last_);
    }
    const DynamicWavesView& water_;
    std::size_t last_;
};

DynamicWavesSample sample_between(const DynamicWavesSample& a, const DynamicWavesSample& b, double fraction) {
    const auto mixed = [&](double DynamicWavesSample::*member) {
        return a.*member + fraction * (b.*member - a.*member);
    };
    return {mixed(&DynamicWavesSample::height_m), mixed(&DynamicWavesSample::slope_x),
            mixed(&DynamicWavesSample::slope_z), mixed(&DynamicWavesSample::vertical_velocity_mps),
            mixed(&DynamicWavesSample::foam)};
}

}  // namespace

std::span<const NumericField<DynamicWavesOptions>> dynamic_waves_fields() { return dynamic_waves_field_table; }

std::string check(const DynamicWavesOptions& options) {
    if (std::string reason = check_fields(options, dynamic_waves_field_table); !reason.empty()) return reason;
    if (options.border_m > options.side_m / 4)
        return invalid_value_message("border_m", options.border_m,
                                     "at most a quarter of side_m, " + number_text(options.side_m / 4));
    const double courant = DynamicWaveGrid::courant_number(options);
    if (options.step == DynamicWavesStep::verlet && courant * courant > DynamicWaveGrid::max_coupling)
        return invalid_value_message("wave_speed_mps", options.wave_speed_mps,
                                     "c = (wave_speed_mps / (ticks_per_s texel))^2 to be " +
                                         number_text(DynamicWaveGrid::max_coupling) + " at most, which is " +
                                         rounded_text(courant * courant, 3));
    return {};
}

double shown_part(const DynamicWavesOptions& options, std::int64_t from_edge) {
    const DefaultFloatEnvironment environment;
    if (from_edge < 0) return 0;
    if (options.border_m == 0) return 1;
    // The two outermost texels are flat, so that slopes are 0 at the grid's edge.
    const double texel_m = options.side_m / options.resolution;
    return environment.result(
        std::clamp(static_cast<double>(from_edge - 1) * texel_m / (0.5 * options.border_m), 0.0, 1.0));
}

DynamicWavesSample sample(const DynamicWavesView& view, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    if (!view) return {};
    const double u = x_m / view.texel_m - static_cast<double>(view.first_x);
    const double v = z_m / view.texel_m - static_cast<double>(view.first_z);
    // The outermost texels are 0, and their outer neighbours are on the other side of the torus.
    const double last = view.resolution - 2;
    if (!(u >= 1 && v >= 1 && u < last && v < last)) return {};
    const double column = std::floor(u), row = std::floor(v);
    const auto x = view.first_x + static_cast<std::int64_t>(column),
               z = view.first_z + static_cast<std::int64_t>(row);
    const DynamicWaveTexels texels(view);
    const DynamicWavesSample above = sample_between(texels.at(x, z), texels.at(x + 1, z), u - column);
    const DynamicWavesSample below = sample_between(texels.at(x, z + 1), texels.at(x + 1, z + 1), u - column);
    return environment.result(sample_between(above, below, v - row));
}

std::uint64_t hash_of(const DynamicWavesView& view) {
    if (!view) return 0;
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    const std::int64_t position[] = {view.resolution, view.first_x, view.first_z};
    XXH3_64bits_update(&state, position, sizeof position);
    XXH3_64bits_update(&state, view.height_m.data(), view.height_m.size_bytes());
    XXH3_64bits_update(&state, view.vertical_velocity_mps.data(), view.vertical_velocity_mps.size_bytes());
    XXH3_64bits_update(&state, view.foam.data(), view.foam.size_bytes());
    return XXH3_64bits_digest(&state);
}

}  // namespace pelagic
