#define XXH_INLINE_ALL
#include <xxhash.h>

#include <vector>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

static_assert(std::endian::native == std::endian::little, "the hash is defined over little-endian bytes");

std::uint64_t hash_of(const Frame& frame) {
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    std::vector<float> row;
    for (const Tile& tile : frame.tiles) {
        row.resize(static_cast<std::size_t>(tile.resolution()));
        for (const PlaneView* plane : {&tile.dx, &tile.height, &tile.dz}) {
            for (int j = 0; j < tile.resolution(); ++j) {
                plane->copy_row(j, row.data());
                XXH3_64bits_update(&state, row.data(), row.size() * sizeof(float));
            }
        }
        XXH3_64bits_update(&state, tile.displacement_rgba16f.data(), tile.displacement_rgba16f.size_bytes());
        if (frame.tiles.size() == 1) {
            XXH3_64bits_update(&state, tile.gradient_rgba8.data(), tile.gradient_rgba8.size_bytes());
        } else {
            XXH3_64bits_update(&state, tile.slopes_rgba8.data(), tile.slopes_rgba8.size_bytes());
            XXH3_64bits_update(&state, tile.moments_rgba8.data(), tile.moments_rgba8.size_bytes());
        }
        const float bounds[] = {tile.bounds.height_min_m, tile.bounds.height_max_m, tile.bounds.sideways_x_max_m,
                                tile.bounds.sideways_z_max_m};
        XXH3_64bits_update(&state, bounds, sizeof bounds);
    }
    return XXH3_64bits_digest(&state);
}

}  // namespace pelagic
