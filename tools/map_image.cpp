#include "pelagic/tools/map_image.hpp"

#include <cassert>
#include <cstring>
#include <span>

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

}  // namespace

std::size_t bytes_of(Sample sample) {
    switch (sample) {
        case Sample::uint8: return 1;
        case Sample::half: return 2;
        case Sample::float32: return 4;
    }
    return 0;
}

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

}  // namespace pelagic::tools
