#define XXH_INLINE_ALL
#include <xxhash.h>

#include <vector>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

static_assert(std::endian::native == std::endian::little, "the hash is defined over little-endian bytes");

std::uint64_t hash_of(const Frame& frame) {
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    std::vector<float> row(static_cast<std::size_t>(frame.resolution()));
    for (const PlaneView* plane : {&frame.dx, &frame.height, &frame.dz}) {
        for (int j = 0; j < frame.resolution(); ++j) {
            plane->copy_row(j, row.data());
            XXH3_64bits_update(&state, row.data(), row.size() * sizeof(float));
        }
    }
    XXH3_64bits_update(&state, frame.displacement_rgba16f.data(), frame.displacement_rgba16f.size_bytes());
    XXH3_64bits_update(&state, frame.gradient_rgba8.data(), frame.gradient_rgba8.size_bytes());
    const float bounds[] = {frame.bounds.height_min_m, frame.bounds.height_max_m, frame.bounds.sideways_x_max_m,
                            frame.bounds.sideways_z_max_m};
    XXH3_64bits_update(&state, bounds, sizeof bounds);
    return XXH3_64bits_digest(&state);
}

}  // namespace pelagic
