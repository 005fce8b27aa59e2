// Wave input: a batch of Gerstner waves.
//
// A cascade holds only waves of its grid, with whole numbers of periods in a loop. Each wave moves
// to the nearest grid point of the finest cascade in which it is at least eight grid steps from
// k = 0. A wave of less than three texels of the next coarser cascade stays in the finer one.
// analytic_cascades.hpp has this rule too. A wave keeps amplitude and phase. Its frequency is that
// of the moved wave in deep water, rounded to a whole number of periods.
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

    /// \throws std::invalid_argument  what set() throws
    explicit GerstnerInput(const AnalyticSea& waves = {});
    ~GerstnerInput() override;

    /// Replaces the waves from the next schedule() on; without waves the input adds nothing.
    /// \throws std::invalid_argument  check(waves), unless it is empty; nothing is changed then
    void set(const AnalyticSea& waves);
    /// Returns the waves of the frame scheduled last. AnalyticSurface evaluates what they add to
    /// its texels. Left out are waves of less than three texels of the finest cascade (two, if it
    /// is the only one), and waves of twice the coarsest cascade's side or longer.
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
