// Conversion of roughness to the length of mean normals and to the smoothness channel, for stage
// `gradients`.
#pragma once

#include <cstdint>

namespace pelagic {

/// Returns the mean length of the normals of a surface of roughness r in [0, 1]: 1 - r (0.306 + r
/// (0.113 - r 0.081)).
///
/// VR Ocean, equation 49, with the last sign inverted (errata). The length is 0.662 at r = 1,
/// within 0.012 of the exact mean normal of a GGX surface, 2/3. Equation 53 begins at 2/3, too.
constexpr float mean_normal_length(float roughness) {
    return 1.f - roughness * (0.306f + roughness * (0.113f - roughness * 0.081f));
}

/// Returns the smoothness 1 - sqrt(r), in [0, 1], as at the end of equation 53. The paper's text
/// has 1 - r for the base level (errata).
float smoothness_of(float roughness);

/// Returns smoothness_of(roughness) as the highest byte of a texel (VR Ocean, equation 51).
std::int32_t smoothness_bits(float roughness);

}  // namespace pelagic
