#include "pelagic/sim/shore.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/buffers/shore_at.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/shore/sea_bed.hpp"
#include "pelagic/sim/shore/shore_waves.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double lowest_ground_m = -11000, highest_ground_m = 9000;

/// Wavelength in texels at which 97 % of the height remains in the middle between four texels.
constexpr double shore_texels_per_wave = 8;

constexpr NumericField<ShoreOptions> shore_field_table[] = {
    // generated from schema/shore.toml: table
    {"columns", &ShoreOptions::columns, 2, 4096, "2 to 4096"},
    {"rows", &ShoreOptions::rows, 2, 4096, "2 to 4096"},
    {"corner_x_m", &ShoreOptions::corner_x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"corner_z_m", &ShoreOptions::corner_z_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"metres_per_sample", &ShoreOptions::metres_per_sample, 0.001, 10000, "[0.001, 10000]"},
    {"resolution", &ShoreOptions::resolution, 64, 1024, "64, 128, 256, 512 or 1024", Restriction::powers_of_two},
    {"fade_m", &ShoreOptions::fade_m, 0, 1e8, "[0, half the field's shorter side]"},
    {"swash_m", &ShoreOptions::swash_m, 0, 10, "[0, 10], or -1: derived", Restriction::none, -1},
    // end of generated
};

}  // namespace

std::span<const NumericField<ShoreOptions>> shore_fields() { return shore_field_table; }

std::string check(const ShoreOptions& options) {
    if (std::string reason = check_fields(options, shore_field_table); !reason.empty()) return reason;
    const std::size_t samples = static_cast<std::size_t>(options.columns) * static_cast<std::size_t>(options.rows);
    if (options.heights_m.size() != samples)
        return invalid_value_message("heights_m' size", options.heights_m.size(),
                                     number_text(samples) + ", columns times rows");
    for (const float height : options.heights_m)
        if (!(static_cast<double>(height) >= lowest_ground_m && static_cast<double>(height) <= highest_ground_m))
            return invalid_value_message("heights_m", height, "[-11000, 9000]");
    const double shorter_m = (std::min(options.columns, options.rows) - 1) * options.metres_per_sample;
    if (options.fade_m > shorter_m / 2)
        return invalid_value_message("fade_m", options.fade_m,
                                     "at most half the field's shorter side, " + number_text(shorter_m / 2));
    return {};
}

std::string check(const ShoreOptions& options, const SeaState& sea) {
    if (std::string reason = check(options); !reason.empty()) return reason;
    if (is_of_fixed_model(sea))
        return invalid_value_message("waves", name_of(sea.waves), "spectrum or analytic where there is a shore");
    if (is_phillips_paper(sea))
        return invalid_value_message("spectrum", name_of(sea.spectrum),
                                     "one with a physical height where there is a shore");
    if (const int cascades = cascades_of(sea); cascades < 2)
        return invalid_value_message("cascades", cascades,
                                     "2 to 4 where there is a shore, which takes the coarsest cascade's waves");
    return {};
}

std::string warning_about(const ShoreOptions& options, const SeaState& sea) {
    const std::vector<ShoreWave> waves = shore_waves(sea, plan_cascades(sea).front());
    if (waves.empty()) return {};
    const double texel_m = SeaBed(options).texel_m;
    const double shortest_m = two_pi / wave_number(waves.back().omega, sea.depth_m);
    if (!(shortest_m < shore_texels_per_wave * texel_m)) return {};
    const auto metres = [](double m) { return number_text(std::floor(10 * m + 0.5) / 10) + " m"; };
    return "texels of " + metres(texel_m) + " are coarse for the shore's shortest long waves, " + metres(shortest_m) +
           ", which lose more than 3 % of their height between texels; texels of " +
           metres(std::floor(10 * shortest_m / shore_texels_per_wave) / 10) + " do not";
}

ShoreSample sample(const ShoreSurface& shore, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    if (!shore) return {};
    const ShoreAt at(shore, x_m, z_m);
    if (!at.is_place()) return {};
    const auto metres = [&](std::span<const float> plane) {
        return at.linear([plane](std::size_t texel) { return static_cast<double>(plane[texel]); });
    };
    ShoreSample sample{.depth_m = metres(shore.depth_m)};
    for (std::size_t cascade = 0; cascade < std::size(sample.weights); ++cascade)
        sample.weights[cascade] = at.weight(cascade);
    if (!at.is_within()) return sample;
    const ShoreAt::Cubic height = at.cubic(shore.height_m);
    const auto [x_mps, z_mps] = at.velocity();
    sample.height_m = height.value;
    sample.slope_x = height.along_x;
    sample.slope_z = height.along_z;
    sample.velocity_x_mps = x_mps;
    sample.vertical_velocity_mps = at.cubic(shore.vertical_velocity_mps).value;
    sample.velocity_z_mps = z_mps;
    sample.reach_m = metres(shore.reach_m);
    sample.foam = at.foam();
    return sample;
}

std::array<float, 4> shore_weights_at(const ShoreSurface& shore, double x_m, double z_m) {
    const DefaultFloatEnvironment environment;
    std::array<float, 4> weights = {1, 1, 1, 1};
    const ShoreAt at(shore, x_m, z_m);
    for (std::size_t cascade = 0; at.is_place() && cascade < weights.size(); ++cascade)
        weights[cascade] = static_cast<float>(at.weight(cascade));
    return weights;
}

std::uint64_t shore_hash_of(const Frame& frame) {
    const ShoreSurface& shore = frame.shore;
    if (!shore) return 0;
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    const auto add = [&](auto span) { XXH3_64bits_update(&state, span.data(), span.size_bytes()); };
    add(shore.depth_m);
    add(shore.weights_rgba8);
    add(shore.height_m);
    add(shore.vertical_velocity_mps);
    add(shore.potential_m2ps);
    add(shore.reach_m);
    add(shore.foam);
    return XXH3_64bits_digest(&state);
}

}  // namespace pelagic
