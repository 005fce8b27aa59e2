// Rain on dynamic waves (dynamic_waves.hpp): random drops that make rings.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pelagic/message/numeric_field.hpp"

namespace pelagic {

struct DynamicWavesOptions;

/// Rain. Each drop adds a crater and a rim of equal volume, height_m (q - 1) e^-q with
/// q = (r / radius_m)^2, so the volume of the water is constant. The drops depend only on the seed,
/// the tick and the position in the world.
struct Rain {
    // generated from schema/rain.toml: members
    /// Mean number of drops, at most the value that puts 16 on a texel in a tick; a finite number.
    /// 0: no rain.
    double drops_per_m2_s = 0;
    /// Radius of the crater at the rest level; [0.001, side_m / 16]. A crater narrower than a texel
    /// is a texel wide on the grid, flatter and with equal volume.
    double radius_m = 0.25;
    double height_m = 0.02;  ///< depth of a crater; [-10, 10]
    std::uint32_t seed = 1;  ///< seed of the drops
    // end of generated
};

/// Returns the table of its fields, which accept any number of their type. check() has the ranges,
/// which depend on the grid.
std::span<const NumericField<Rain>> rain_fields();

/// Returns an empty string for usable rain on such dynamic waves, else what is wrong: "radius_m 0
/// is out of range [0.001, 4], to a 16th of side_m". Rain of 0 drops is always usable.
/// \pre check(water).empty()
std::string check(const Rain& rain, const DynamicWavesOptions& water);

}  // namespace pelagic
