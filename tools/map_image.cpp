#include "pelagic/tools/map_image.hpp"

#include <cassert>
#include <cstring>
#include <span>

#include "pelagic/tools/half_float.hpp"

namespace pelagic::tools {
namespace {

template <class Value>
std::vector<std::byte> bytes_of(std::span<const Value> values) {
    const auto bytes = std::as_bytes(values);
    return {bytes.begin(), bytes.end()};
}

/// Several planes of a tile, their values side by side.
template <std::size_t count>
std::vector<std::byte> interleaved(const std::array<PlaneView, count>& planes) {
    const auto side = static_cast<std::size_t>(planes.front().resolution);
    std::vector<std::byte> bytes(count * side * side * sizeof(float));
    std::vector<float> row(side);
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t channel = 0; channel < count; ++channel) {
            planes[channel].copy_row(static_cast<int>(j), row.data());
            std::byte* to = bytes.data() + (j * side * count + channel) * sizeof(float);
            for (std::size_t i = 0; i < side; ++i, to += count * sizeof(float))
                std::memcpy(to, &row[i], sizeof(float));
        }
    }
    return bytes;
}

/// The first three of the tile's four halves a texel: the fourth is foam.
std::vector<std::byte> three_halves(const Tile& tile) {
    std::vector<std::uint16_t> pixels;
    pixels.reserve(tile.displacement_rgba16f.size() / 4 * 3);
    for (std::size_t texel = 0; texel < tile.displacement_rgba16f.size(); texel += 4) {
        const std::uint16_t* halves = tile.displacement_rgba16f.data() + texel;
        pixels.insert(pixels.end(), halves, halves + 3);
    }
    return bytes_of(std::span<const std::uint16_t>(pixels));
}

std::vector<std::byte> pixels_of(const Tile& tile, MapKind map, int level, Sample sample) {
    switch (map) {
        case MapKind::displacement:
            assert(level == 0);
            return sample == Sample::half ? three_halves(tile)
                                          : interleaved(std::array{tile.dx, tile.height, tile.dz});
        // A texel's lowest byte is its red one, in memory the first.
        case MapKind::gradient: return bytes_of(tile.gradient_level(level));
        case MapKind::foam: return bytes_of(tile.level_of(tile.foam_r8, level));
    }
    return {};
}

/// The means of 2 x 2 texels of floats.
MapImage halved(const MapImage& finer) {
    MapImage coarser{finer.side / 2, finer.channels, Sample::float32, {}};
    const auto side = static_cast<std::size_t>(coarser.side), channels = static_cast<std::size_t>(finer.channels);
    coarser.pixels.resize(side * side * channels * sizeof(float));
    const auto value = [&](std::size_t column, std::size_t row, std::size_t channel) {
        float number = 0;
        std::memcpy(&number, &finer.pixels[((row * 2 * side + column) * channels + channel) * sizeof(float)],
                    sizeof(float));
        return number;
    };
    std::byte* to = coarser.pixels.data();
    for (std::size_t j = 0; j < 2 * side; j += 2)
        for (std::size_t i = 0; i < 2 * side; i += 2)
            for (std::size_t channel = 0; channel < channels; ++channel, to += sizeof(float)) {
                const float upper = value(i, j, channel) + value(i + 1, j, channel);
                const float lower = value(i, j + 1, channel) + value(i + 1, j + 1, channel);
                const float mean = 0.25f * (upper + lower);
                std::memcpy(to, &mean, sizeof(float));
            }
    return coarser;
}

MapImage as_halves(const MapImage& floats) {
    MapImage halves{floats.side, floats.channels, Sample::half, {}};
    halves.pixels.resize(floats.pixels.size() / 2);
    for (std::size_t i = 0; i < halves.pixels.size() / 2; ++i) {
        float value = 0;
        std::memcpy(&value, &floats.pixels[4 * i], sizeof(float));
        const std::uint16_t half = half_of(value);
        std::memcpy(&halves.pixels[2 * i], &half, sizeof(half));
    }
    return halves;
}

}  // namespace

int channels_of(MapKind map) {
    switch (map) {
        case MapKind::displacement: return 3;
        case MapKind::gradient: return 4;
        case MapKind::foam: return 1;
    }
    return 0;
}

MapImage map_image(const Tile& tile, MapKind map, int level, Sample sample) {
    return {.side = tile.resolution() >> level,
            .channels = channels_of(map),
            .sample = sample,
            .pixels = pixels_of(tile, map, level, sample)};
}

std::vector<MapImage> map_levels(const Tile& tile, MapKind map, int levels, Sample sample) {
    std::vector<MapImage> images;
    if (has_chain(map) || levels == 1) {
        for (int level = 0; level < levels; ++level) images.push_back(map_image(tile, map, level, sample));
        return images;
    }
    MapImage floats = map_image(tile, map, 0, Sample::float32);
    for (int level = 0; level < levels; ++level) {
        if (level > 0) floats = halved(floats);
        images.push_back(sample == Sample::half ? as_halves(floats) : floats);
    }
    return images;
}

}  // namespace pelagic::tools
