#include "sim/surface_look.hpp"

#include <cmath>

namespace pelagic {

float smoothness_of(float roughness) { return 1.f - std::sqrt(roughness); }

}  // namespace pelagic
