#include "pelagic/gl/whitecaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pelagic::gl {

double whitecap_cover(double wind_speed_mps) { return std::min(0.4, 3.84e-6 * std::pow(wind_speed_mps, 3.41)); }

float whitecap_jacobian(const Frame& frame, double wind_speed_mps) {
    std::array<std::size_t, 256> histogram{};
    const auto texels = frame.gradient_level(0);
    for (const std::uint32_t texel : texels) ++histogram[texel >> 16 & 255];
    const double wanted = whitecap_cover(wind_speed_mps) * static_cast<double>(texels.size());
    double below = 0;
    std::size_t byte = 0;
    while (byte < 255 && below + static_cast<double>(histogram[byte]) < wanted)
        below += static_cast<double>(histogram[byte++]);
    // Between two bytes: by the part of the last one's texels that is needed.
    const double part = histogram[byte] > 0 ? (wanted - below) / static_cast<double>(histogram[byte]) : 0;
    return static_cast<float>((static_cast<double>(byte) - 0.5 + part) / 255 * 2 - 1);
}

}  // namespace pelagic::gl
