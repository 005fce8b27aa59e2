#include "pelagic/tools/maps/map_values.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/simd/strict_floats.hpp"
#include "pelagic/tools/maps/cascade_differences.hpp"

namespace pelagic::tools {
namespace {

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
