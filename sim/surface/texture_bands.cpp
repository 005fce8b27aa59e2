#include "pelagic/sim/surface/texture_bands.hpp"

#include <algorithm>

#include "pelagic/sim/kernels/wave_blocks.hpp"

namespace pelagic {
namespace {

constexpr std::size_t group_columns = 2 * partner_distance;

// A strip of 32,768 texels and its textures take 0.8 MB.
constexpr std::size_t strip_texels = 32768;

}  // namespace

// Wider bands have fewer edges, whose surface leaves the cache before the textures are computed.
// More bands keep more threads busy.
TextureBands::TextureBands(int resolution, std::size_t lanes)
    : pairs_a_group_(partner_distance / lanes),
      groups_(static_cast<std::size_t>(resolution) / group_columns),
      groups_per_band_((resolution < 512 ? 128 : 256) / group_columns),
      groups_a_strip_(std::clamp(strip_texels / static_cast<std::size_t>(resolution) / group_columns, std::size_t{1},
                                 groups_per_band_)) {}

std::size_t TextureBands::edge_pair(std::size_t edge) const {
    const std::size_t first_group = edge / 2 * groups_per_band_;
    return edge % 2 == 0 ? first_group * pairs_a_group_ : (first_group + groups_per_band_) * pairs_a_group_ - 1;
}

void TextureBands::process(std::size_t begin, std::size_t end, const TransformColumns& transform,
                           const std::function<void(const TextureStrip&)>& make) const {
    const std::size_t last_pair = end * pairs_a_group_ - 1;
    std::size_t pair = begin * pairs_a_group_ + 1;  // the first pair is an edge, and the last
    for (std::size_t group = begin; group < end; group += groups_a_strip_) {
        // The first pair after the strip has the block beside it.
        const std::size_t after_strip = (group + groups_a_strip_) * pairs_a_group_ + 1;
        for (; pair < std::min(after_strip, last_pair); ++pair) transform(pair);
        make({.first_column = group * group_columns, .columns = groups_a_strip_ * group_columns});
    }
}

}  // namespace pelagic
