// Position and breaking of water at reference positions of a tick, for spray.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/shore_surface.hpp"
#include "pelagic/sim/spray/flight.hpp"

namespace pelagic {

/// Samples cascades and a shore. Scalar code, so results are bit-identical on every machine.
class BreakingSurface {
   public:
    BreakingSurface() = default;
    /// \param at_tick  what sources set for the tick
    /// \param planes   cascades that view the tick's displacement; their other members are not read
    /// \param shore    of the tick, or empty
    BreakingSurface(std::span<const Cascade> at_tick, std::span<const Cascade> planes, const ShoreSurface& shore);

    /// Returns the sum of the weighted compressions of all cascades, in standard deviations
    /// (snapshot_foam.hpp). Compressions are central differences at the nearest texel.
    double compression(double x_m, double z_m) const;
    /// Returns the drawn position of a reference position: bilinear between texels, with the shore.
    SprayVector at(double x_m, double z_m) const;

   private:
    struct Texels {
        CascadeGrid grid;
        double compression_scale;
        CascadeGrid::Vector compression_front;  ///< along the cascade's axes
        SurfaceTexels texels;
    };
    std::array<float, max_cascades> weights_at(double x_m, double z_m) const;

    std::size_t count_ = 0;
    std::array<Texels, max_cascades> cascades_{};
    ShoreSurface shore_;
};

}  // namespace pelagic
