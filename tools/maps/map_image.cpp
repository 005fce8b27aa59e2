#include "pelagic/tools/maps/map_image.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>

#include "pelagic/simd/half_float.hpp"
#include "pelagic/tools/maps/map_values.hpp"

namespace pelagic::tools {
namespace {

using Pixels = std::vector<std::byte>;

std::atomic<bool> halves_are_clamped = false;

template <class Value>
Pixels pixels_of(std::span<const Value> values) {
    const auto bytes = std::as_bytes(values);
    return {bytes.begin(), bytes.end()};
}

template <class Stored, class Convert>
Pixels converted(const std::vector<float>& values, Convert convert) {
    Pixels pixels(values.size() * sizeof(Stored));
    std::byte* to = pixels.data();
    for (const float value : values) {
        const Stored stored = convert(value);
        std::memcpy(to, &stored, sizeof(Stored));
        to += sizeof(Stored);
    }
    return pixels;
}

/// Quantises [0, 1] or [-1, 1] to [0, max]. Ties are rounded up, so that a flat normal map is
/// 128, 128, 255.
template <class Stored>
Pixels quantised(const std::vector<float>& values, float max, bool from_minus_one) {
    return converted<Stored>(values, [=](float value) {
        const float fraction = from_minus_one ? 0.5f * value + 0.5f : value;
        return static_cast<Stored>(fraction * max + 0.5f);
    });
}

Pixels in_halves(const std::vector<float>& values) {
    const auto is_beyond = [](float value) {
        return std::fabs(value) >= 65520; /* would round to infinity */
    };
    if (std::any_of(values.begin(), values.end(), is_beyond)) halves_are_clamped = true;
    return converted<std::uint16_t>(values, [](float value) { return static_cast<std::uint16_t>(half_of(value)); });
}

Pixels stored(const MapValues& of, MapKind map, Sample sample) {
    switch (sample) {
        case Sample::uint8: return quantised<std::uint8_t>(of.values, 255, map == MapKind::normal);
        case Sample::uint16: return quantised<std::uint16_t>(of.values, 65535, map == MapKind::normal);
        case Sample::half: return in_halves(of.values);
        case Sample::float32: return pixels_of(std::span<const float>(of.values));
    }
    return {};
}

/// Negates the green channel, the normal's z, for files with z up, whose horizontal axis has the
/// opposite direction. Byte 255 - b represents the exact negative of byte b.
void negate_green(Pixels& gradient) {
    for (std::size_t green = 1; green < gradient.size(); green += 4) gradient[green] = ~gradient[green];
}

/// Returns a level of the gradients, which the cascade stores as bytes.
Pixels gradient_bytes(const Cascade& cascade, int level, const MapOptions& options) {
    Pixels pixels = pixels_of(cascade.gradient_level(level));  // a texel's lowest byte is red
    if (options.up_axis == UpAxis::z) negate_green(pixels);
    return pixels;
}

/// Reverses the order of the rows.
void flip_rows(MapImage& image) {
    const auto side = static_cast<std::ptrdiff_t>(image.side);
    const auto row = static_cast<std::ptrdiff_t>(image.pixels.size()) / side;
    for (std::ptrdiff_t above = 0, below = side - 1; above < below; ++above, --below)
        std::swap_ranges(image.pixels.begin() + above * row, image.pixels.begin() + (above + 1) * row,
                         image.pixels.begin() + below * row);
}

}  // namespace

bool clamped_halves() { return halves_are_clamped; }

MapImage map_image(const Frame& frame, int cascade, MapKind map, int level, const MapOptions& options) {
    return map_levels(frame, cascade, map, level, 1, options).front();
}

std::vector<MapImage> map_levels(const Frame& frame, int number, MapKind map, int first_level, int levels,
                                 const MapOptions& options) {
    const Cascade& cascade = frame.cascades[static_cast<std::size_t>(number)];
    const Sample sample = options.sample_of(map);
    const bool has_bytes = map == MapKind::gradient;
    MapValues values = has_bytes ? MapValues{} : map_values(frame, number, map, options);
    std::vector<MapImage> images;
    for (int level = 0; level < first_level + levels; ++level) {
        if (level > 0 && !has_bytes) values = halved(values);
        if (level < first_level) continue;
        MapImage image{cascade.resolution() >> level, channels_of(map), sample, {}};
        if (has_bytes)
            image.pixels = gradient_bytes(cascade, level, options);
        else
            image.pixels = stored(map == MapKind::normal && level > 0 ? normalised(values) : values, map, sample);
        if (options.rows == FirstRow::bottom) flip_rows(image);
        images.push_back(std::move(image));
    }
    return images;
}

MapImage dynamic_waves_map_image(const DynamicWavesView& water, const MapOptions& options) {
    const auto side = static_cast<std::size_t>(water.resolution);
    const float factor = units_per_metre(options.unit);
    MapValues values{.side = water.resolution, .channels = channels_of(MapKind::dynamic_waves), .values = {}};
    values.values.reserve(3 * side * side);
    const auto in_torus = [&](std::int64_t first, std::size_t i) {
        return static_cast<std::size_t>((first + static_cast<std::int64_t>(i)) & (water.resolution - 1));
    };
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i) {
            const std::size_t texel = in_torus(water.first_z, j) * side + in_torus(water.first_x, i);
            for (const float value : {water.height_m[texel] * factor, water.vertical_velocity_mps[texel] * factor,
                                      static_cast<float>(water.foam[texel]) / 255})
                values.values.push_back(value);
        }
    const Sample sample = options.sample_of(MapKind::dynamic_waves);
    MapImage image{values.side, values.channels, sample, stored(values, MapKind::dynamic_waves, sample)};
    if (options.rows == FirstRow::bottom) flip_rows(image);
    return image;
}

MapImage foam_patch_image(const Frame& frame, const MapOptions& options) {
    const MapValues values = foam_values(frame, options.foam_patch->pixels, options.foam_patch->pixel_m(), 0.5);
    const Sample sample = options.sample_of(MapKind::foam);
    MapImage image{values.side, values.channels, sample, stored(values, MapKind::foam, sample)};
    if (options.rows == FirstRow::bottom) flip_rows(image);
    return image;
}

}  // namespace pelagic::tools
