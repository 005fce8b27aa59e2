#include "pelagic/tools/maps/map_image.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/simd/half_float.hpp"
#include "pelagic/simd/strict_floats.hpp"
#include "pelagic/tools/maps/cascade_differences.hpp"

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

using Vector = std::array<float, 3>;

/// Normalises a vector along the cascade's columns, its rows, and up. Returns up for a squared
/// length of at most 1e-30, far below the normals of visible waves.
Vector unit_vector(const Vector& of) {
    const float squared = of[0] * of[0] + of[1] * of[1] + of[2] * of[2];
    if (!(squared > 1e-30f)) return {0, 0, 1};
    const float length = std::sqrt(squared);
    return {of[0] / length, of[1] / length, of[2] / length};
}

/// Interleaves three planes that hold a vector along the world's axes.
std::vector<float> vectors(const std::array<PlaneView, 3>& planes, const MapOptions& options) {
    assert(planes[0].data);
    const auto side = static_cast<std::size_t>(planes[0].resolution);
    const float factor = units_per_metre(options.unit);
    std::array<std::vector<float>, 3> row = {std::vector<float>(side), std::vector<float>(side),
                                             std::vector<float>(side)};
    std::vector<float> values;
    values.reserve(3 * side * side);
    for (int j = 0; j < planes[0].resolution; ++j) {
        for (std::size_t c = 0; c < 3; ++c) planes[c].copy_row(j, row[c].data());
        for (std::size_t i = 0; i < side; ++i)
            for (const float component : in_axes(Vector{row[0][i], row[1][i], row[2][i]}, options.up_axis))
                values.push_back(component * factor);
    }
    return values;
}

float two_texels_m(const Cascade& cascade) { return static_cast<float>(2 * cascade.texel_m()); }

/// Returns unit vectors: along the columns, up or down the image, and out of the water. Vectors of
/// an overturned surface are horizontal, because a normal map cannot point down.
std::vector<float> normals(const Cascade& cascade, const MapOptions& options) {
    const auto cosine = static_cast<float>(cascade.grid.cosine), sine = static_cast<float>(cascade.grid.sine);
    const bool rows_go_up = options.rows == FirstRow::bottom, green_grows_up = options.normal_y == NormalY::up;
    const float green = rows_go_up == green_grows_up ? 1.f : -1.f;
    std::vector<float> values;
    for_each_difference(cascade, [&, across_texels_m = two_texels_m(cascade)](const TexelDifferences& differences) {
        const WorldVector normal = differences.normal(across_texels_m);
        const float along = cosine * normal.x + sine * normal.z, across = cosine * normal.z - sine * normal.x;
        const float up = normal.y > 0 ? normal.y : 0.f;
        for (const float component : unit_vector({along, green * across, up})) values.push_back(component);
    });
    return values;
}

std::vector<float> jacobians(const Cascade& cascade) {
    const double two_texels = 2 * cascade.texel_m();
    const auto factor = static_cast<float>(1 / (two_texels * two_texels));
    std::vector<float> values;
    for_each_difference(cascade, [&, across_texels_m = two_texels_m(cascade)](const TexelDifferences& differences) {
        values.push_back(differences.normal(across_texels_m).y * factor);
    });
    return values;
}

/// Returns slopes of the heights over reference positions. They can be added to those of other
/// cascades.
std::vector<float> slopes(const Cascade& cascade, UpAxis up_axis) {
    const auto per_metre = static_cast<float>(1 / (2 * cascade.texel_m()));
    const float z_sign = up_axis == UpAxis::z ? -1.f : 1.f;
    std::vector<float> values;
    for_each_difference(cascade, [&](const TexelDifferences& differences) {
        values.push_back(differences.height.x * per_metre);
        values.push_back(differences.height.z * (z_sign * per_metre));
    });
    return values;
}

std::vector<float> compressions(const Cascade& cascade) {
    const auto side = static_cast<std::size_t>(cascade.resolution());
    std::vector<float> values(side * side);
    copy_compression(cascade, values);
    return values;
}

std::vector<float> values_of_map(const Cascade& cascade, MapKind map, const MapOptions& options) {
    switch (map) {
        case MapKind::displacement: return vectors({cascade.dx, cascade.height, cascade.dz}, options);
        case MapKind::velocity: return vectors({cascade.velocity_x, cascade.velocity_y, cascade.velocity_z}, options);
        case MapKind::normal: return normals(cascade, options);
        case MapKind::jacobian: return jacobians(cascade);
        case MapKind::slope: return slopes(cascade, options.up_axis);
        case MapKind::compression: return compressions(cascade);
        case MapKind::foam:
        case MapKind::gradient:
        case MapKind::dynamic_waves: break;
    }
    assert(false && "gradients are bytes already, and foam and the grid are no cascade's");
    return {};
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

MapValues map_values(const Frame& frame, int number, MapKind map, const MapOptions& options) {
    const Cascade& cascade = frame.cascades[static_cast<std::size_t>(number)];
    if (map == MapKind::foam) return foam_values(frame, cascade.resolution(), cascade.texel_m(), 0);
    return {
        .side = cascade.resolution(), .channels = channels_of(map), .values = values_of_map(cascade, map, options)};
}

MapValues foam_values(const Frame& frame, int side, double spacing_m, double first) {
    const FoamSampler foam(frame);
    assert(foam.has_foam());
    MapValues values{.side = side, .channels = channels_of(MapKind::foam), .values = {}};
    values.values.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
            values.values.push_back(foam.at((i + first) * spacing_m, (j + first) * spacing_m));
    return values;
}

MapValues halved(const MapValues& finer) {
    const auto side = static_cast<std::size_t>(finer.side / 2), channels = static_cast<std::size_t>(finer.channels);
    MapValues level{.side = finer.side / 2, .channels = finer.channels, .values = {}};
    level.values.reserve(side * side * channels);
    for (std::size_t row = 0; row < side; ++row) {
        const float* above = finer.values.data() + 4 * row * side * channels;
        const float* below = above + 2 * side * channels;
        for (std::size_t column = 0; column < side; ++column, above += 2 * channels, below += 2 * channels)
            for (std::size_t c = 0; c < channels; ++c)
                level.values.push_back(0.25f * ((above[c] + above[c + channels]) + (below[c] + below[c + channels])));
    }
    return level;
}

MapValues normalised(MapValues normals) {
    for (std::size_t i = 0; i < normals.values.size(); i += 3) {
        const Vector unit = unit_vector({normals.values[i], normals.values[i + 1], normals.values[i + 2]});
        std::copy(unit.begin(), unit.end(), normals.values.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return normals;
}

}  // namespace pelagic::tools
