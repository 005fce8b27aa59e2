#include "pelagic/sim/shore.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/message/refusal.hpp"

namespace pelagic {
namespace {

constexpr double lowest_m = -11000, highest_m = 9000;

constexpr std::array fields = {
    NumericField<ShoreOptions>{"columns", &ShoreOptions::columns, 2, ShoreOptions::most_samples_a_side, "2 to 4096"},
    NumericField<ShoreOptions>{"rows", &ShoreOptions::rows, 2, ShoreOptions::most_samples_a_side, "2 to 4096"},
    NumericField<ShoreOptions>{"corner_x_m", &ShoreOptions::corner_x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<ShoreOptions>{"corner_z_m", &ShoreOptions::corner_z_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<ShoreOptions>{"metres_a_sample", &ShoreOptions::metres_a_sample, 0.001, 10000, "[0.001, 10000]"},
    NumericField<ShoreOptions>{"resolution", &ShoreOptions::resolution, 64, 1024, "64, 128, 256, 512 or 1024",
                               Among::powers_of_two},
    NumericField<ShoreOptions>{"fade_m", &ShoreOptions::fade_m, 0, 1e8, "[0, half the field's shorter side]"},
    NumericField<ShoreOptions>{"swash_m", &ShoreOptions::swash_m, 0, 10, "[0, 10]"},
};

/// Texels of a shore, with their neighbours.
class ShoreTexels {
   public:
    explicit ShoreTexels(const ShoreSurface& shore) : shore_(shore) {}

    ShoreSample at(int i, int j) const {
        const std::size_t here = place(i, j);
        const double half = 0.5 / shore_.texel_m;
        ShoreSample sample{.depth_m = static_cast<double>(shore_.depth_m[here]),
                           .height_m = static_cast<double>(shore_.height_m[here]),
                           .slope_x = (height(i + 1, j) - height(i - 1, j)) * half,
                           .slope_z = (height(i, j + 1) - height(i, j - 1)) * half,
                           .rise_mps = static_cast<double>(shore_.rise_mps[here]),
                           .reach_m = static_cast<double>(shore_.reach_m[here]),
                           .foam = static_cast<double>(shore_.foam[here]) * (1.0 / 255)};
        for (int tile = 0; tile < 4; ++tile)
            sample.parts[tile] = static_cast<double>(shore_.parts_rgba8[here] >> 8 * tile & 255) * (1.0 / 255);
        return sample;
    }

   private:
    std::size_t place(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(shore_.columns) + static_cast<std::size_t>(i);
    }
    /// 0 beyond the edges.
    double height(int i, int j) const {
        if (i < 0 || j < 0 || i >= shore_.columns || j >= shore_.rows) return 0;
        return static_cast<double>(shore_.height_m[place(i, j)]);
    }
    const ShoreSurface& shore_;
};

ShoreSample between(const ShoreSample& a, const ShoreSample& b, double part) {
    const auto mix = [part](double from, double to) { return from + part * (to - from); };
    ShoreSample mixed{.depth_m = mix(a.depth_m, b.depth_m),
                      .height_m = mix(a.height_m, b.height_m),
                      .slope_x = mix(a.slope_x, b.slope_x),
                      .slope_z = mix(a.slope_z, b.slope_z),
                      .rise_mps = mix(a.rise_mps, b.rise_mps),
                      .reach_m = mix(a.reach_m, b.reach_m),
                      .foam = mix(a.foam, b.foam)};
    for (int tile = 0; tile < 4; ++tile) mixed.parts[tile] = mix(a.parts[tile], b.parts[tile]);
    return mixed;
}

}  // namespace

std::string check(const ShoreOptions& options) {
    if (std::string reason = check_fields(options, fields); !reason.empty()) return reason;
    const std::size_t samples = static_cast<std::size_t>(options.columns) * static_cast<std::size_t>(options.rows);
    if (options.heights_m.size() != samples)
        return refusal("heights_m' size", options.heights_m.size(), number_text(samples) + ", columns times rows");
    for (const float height : options.heights_m)
        if (!(static_cast<double>(height) >= lowest_m && static_cast<double>(height) <= highest_m))
            return refusal("heights_m", height, "[-11000, 9000]");
    const double shorter_m = (std::min(options.columns, options.rows) - 1) * options.metres_a_sample;
    if (options.fade_m > shorter_m / 2)
        return refusal("fade_m", options.fade_m,
                       "at most half the field's shorter side, " + number_text(shorter_m / 2));
    return {};
}

std::string check(const ShoreOptions& options, const SeaState& sea) {
    if (std::string reason = check(options); !reason.empty()) return reason;
    if (sea.waves == WaveModel::exp_sine)
        return refusal("waves", name_of(sea.waves), "spectrum or analytic where there is a shore");
    if (has_papers_spectrum(sea))
        return refusal("spectrum", name_of(sea.spectrum), "one with a physical height where there is a shore");
    if (const int tiles = cascades_of(sea); tiles < 2)
        return refusal("cascades", tiles, "2 to 4 where there is a shore, which takes the coarsest tile's waves");
    return {};
}

ShoreSample sample(const ShoreSurface& shore, double x_m, double z_m) {
    if (!shore) return {};
    const double u = (x_m - shore.x_m) / shore.texel_m, v = (z_m - shore.z_m) / shore.texel_m;
    if (!(u >= 0 && v >= 0 && u < shore.columns - 1 && v < shore.rows - 1)) return {};
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const ShoreTexels texels(shore);
    return between(between(texels.at(i, j), texels.at(i + 1, j), u - i),
                   between(texels.at(i, j + 1), texels.at(i + 1, j + 1), u - i), v - j);
}

std::uint64_t shore_hash_of(const Frame& frame) {
    const ShoreSurface& shore = frame.shore;
    if (!shore) return 0;
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    const auto add = [&](auto span) { XXH3_64bits_update(&state, span.data(), span.size_bytes()); };
    add(shore.depth_m);
    add(shore.parts_rgba8);
    add(shore.height_m);
    add(shore.rise_mps);
    add(shore.reach_m);
    add(shore.foam);
    return XXH3_64bits_digest(&state);
}

}  // namespace pelagic
