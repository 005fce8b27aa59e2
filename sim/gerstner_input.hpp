// A batch of Gerstner waves for the cascades of an ocean.
//
// A cascade holds waves of its grid alone, with whole periods in a loop. Each wave goes to the nearest place of the grid of the
// finest cascade that has eight steps of its grid or more between it and k = 0, unless it has less than three texels of the one above:
// as those of an analytic sea (analytic_cascades.hpp). It keeps amplitude and phase, and runs as the wave that it has become does in deep
// water, but with as many periods in a loop as is nearest.
#pragma once

#include <cstddef>
#include <memory>

#include "pelagic/analytic/analytic_sea.hpp"
#include "pelagic/analytic/plane_waves.hpp"
#include "pelagic/sim/wave_input.hpp"

namespace pelagic {

class GerstnerInput final : public WaveInput {
   public:
    static constexpr std::size_t max_waves = 64;

    /// Throws what set() throws.
    explicit GerstnerInput(const AnalyticSea& waves = {});
    ~GerstnerInput() override;

    /// From the next schedule() on. Throws std::invalid_argument(check(waves)) and keeps what it had; without waves it adds nothing.
    void set(const AnalyticSea& waves);
    /// The waves as the frame scheduled last has them: what they add to its texels is what AnalyticSurface says of them. Left out are
    /// those of less than three texels of the finest cascade (two, where it is the only one), and those of twice the coarsest cascade's
    /// side and longer.
    PlaneWaves held() const;

    void begin(const InputMoment& moment) override;
    bool adds_to(std::size_t cascade) const override;
    double largest_slope(std::size_t cascade) const override;  ///< the sum of k A
    void add(const InputRows& rows) const override;

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
