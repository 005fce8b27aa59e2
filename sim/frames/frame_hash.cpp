#define XXH_INLINE_ALL
#include <xxhash.h>

#include <vector>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

static_assert(std::endian::native == std::endian::little, "the hash is defined over little-endian bytes");

std::uint64_t foam_hash_of(const Frame& frame) {
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    for (const Cascade& cascade : frame.cascades) {
        XXH3_64bits_update(&state, cascade.compression_r8.data(), cascade.compression_r8.size());
        for (const std::span<const std::uint32_t> image : cascade.snapshots_rgba8)
            XXH3_64bits_update(&state, image.data(), image.size_bytes());
        const double placed[] = {cascade.drift_columns, cascade.drift_rows,
                                 static_cast<double>(cascade.compression_scale)};
        XXH3_64bits_update(&state, placed, sizeof placed);
    }
    XXH3_64bits_update(&state, &frame.foam.level, sizeof frame.foam.level);
    XXH3_64bits_update(&state, frame.foam.age.data(), sizeof frame.foam.age);
    return XXH3_64bits_digest(&state);
}

std::uint64_t spray_hash_of(const Frame& frame) {
    static_assert(sizeof(SprayDroplet) == 3 * sizeof(double) + 6 * sizeof(float), "no padding");
    return XXH3_64bits(frame.droplets.data(), frame.droplets.size_bytes());
}

std::uint64_t hash_of(const Frame& frame) {
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    std::vector<float> row;
    for (const Cascade& cascade : frame.cascades) {
        row.resize(static_cast<std::size_t>(cascade.resolution()));
        for (const PlaneView* plane : {&cascade.dx, &cascade.height, &cascade.dz}) {
            if (!plane->data) continue;
            for (int j = 0; j < cascade.resolution(); ++j) {
                plane->copy_row(j, row.data());
                XXH3_64bits_update(&state, row.data(), row.size() * sizeof(float));
            }
        }
        XXH3_64bits_update(&state, cascade.displacement_rgba16f.data(), cascade.displacement_rgba16f.size_bytes());
        if (frame.cascades.size() == 1) {
            XXH3_64bits_update(&state, cascade.gradient_rgba8.data(), cascade.gradient_rgba8.size_bytes());
        } else {
            XXH3_64bits_update(&state, cascade.slopes_rgba8.data(), cascade.slopes_rgba8.size_bytes());
            XXH3_64bits_update(&state, cascade.moments_rgba8.data(), cascade.moments_rgba8.size_bytes());
        }
        const float bounds[] = {cascade.bounds.height_min_m, cascade.bounds.height_max_m,
                                cascade.bounds.horizontal_x_max_m, cascade.bounds.horizontal_z_max_m};
        XXH3_64bits_update(&state, bounds, sizeof bounds);
    }
    return XXH3_64bits_digest(&state);
}

}  // namespace pelagic
