// Rain on dynamic waves (dynamic_waves.hpp): drops that fall anywhere, at any time, and leave rings.
#pragma once

#include <cstdint>
#include <string>

namespace pelagic {

struct DynamicWavesOptions;

/// Each drop digs a crater whose water stands around it as a rim, height_m (q - 1) e^-q with q = (r / radius_m)^2, so rain adds no
/// water. Which drops fall follows from the seed, the tick and the place in the world alone.
struct Rain {
    double drops_per_m2_s =
        0;  ///< on the mean: their number is Poisson's; 0: no rain. At most as many as put 16 on a texel in a tick
    /// Of the crater at the height of rest; [0.001, side_m / 16]. What is narrower than a texel is drawn a texel wide, and flatter, with
    /// as much water.
    double radius_m = 0.25;
    double height_m = 0.02;  ///< how deep a crater is; [-10, 10]
    std::uint32_t seed = 1;
};

/// Empty, or what is wrong with such rain on such water, of no rain nothing: "radius_m is 0, needs [0.001, 4], to a 16th of side_m".
/// \pre check(water).empty()
std::string check(const Rain& rain, const DynamicWavesOptions& water);

}  // namespace pelagic
