// What roughness means for the smoothness channel: the two numbers that stage `gradients` writes on every texel.
#pragma once

#include <cstdint>

namespace pelagic {

/// Mean length of the normals of a surface of roughness r in [0, 1]: 1 - r (0.306 + r (0.113 - r 0.081)).
///
/// VR Ocean, equation 49, with its last sign turned (errata): 0.662 at r = 1, within 0.012 of the exact mean normal
/// of a GGX surface, 2/3, which is also where equation 53 begins.
constexpr float mean_normal_length(float roughness) {
    return 1.f - roughness * (0.306f + roughness * (0.113f - roughness * 0.081f));
}

/// 1 - sqrt(r), in [0, 1], as equation 53 ends; the paper's text has 1 - r for the base level (errata).
float smoothness_of(float roughness);

/// The same as the highest byte of a texel (VR Ocean, equation 51).
std::int32_t smoothness_bits(float roughness);

}  // namespace pelagic
