#include "pelagic/sim/surface/surface_appearance.hpp"

#include <cmath>

namespace pelagic {

float smoothness_of(float roughness) { return 1.f - std::sqrt(roughness); }

std::int32_t smoothness_bits(float roughness) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(smoothness_of(roughness) * 255.f + 0.5f) << 24);
}

}  // namespace pelagic
