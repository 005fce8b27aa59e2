// Rings around a place, for the cascade of an ocean that takes waves of their length.
//
//   h(r, t) = A (1 - (r / R)^2)^2 sqrt(L / 2 / q) cos(2 pi ((q - L / 2) / L - f t) + phase),  q = sqrt(r^2 + (L / 2)^2)
//
// within the reach R, and exactly 0 beyond it. L is the wavelength, far from the middle; f that of deep water, but with as many periods
// in a loop as is nearest. In the middle the rings are as high as A and smooth, and fall as rings do, as r^(-1/2). Water moves up and down
// alone. A cascade repeats, and so do the rings, each side of it: R is at most half of it, so that none meets its neighbour's. For rings
// that don't repeat there is dynamic waves (dynamic_waves.hpp).
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "pelagic/sim/wave_input.hpp"

namespace pelagic {

struct Ripple {
    double x_m = 0, z_m = 0;  ///< the middle; [-1e8, 1e8]
    double wavelength_m = 1;  ///< [0.01, 1000]
    double amplitude_m = 0;   ///< [0, 100], and at most wavelength_m / (2 pi): no slope over 1
    double reach_m = 0;       ///< R; [0, 1e5], 0 and more than half of the cascade's side: that
    double phase_rad = 0;     ///< in the middle at t = 0, a crest by default; [-2 pi, 2 pi]
};

/// Empty, or what is wrong: "wavelength_m is 0, needs [0.01, 1000]".
std::string check(const Ripple& ripple);

class RippleInput final : public WaveInput {
   public:
    /// Throws what set() throws.
    explicit RippleInput(const Ripple& ripple = {});
    ~RippleInput() override;

    /// From the next schedule() on. Throws std::invalid_argument(check(ripple)) and keeps what it had.
    void set(const Ripple& ripple);

    /// The rings as the frame scheduled last has them.
    struct Held {
        std::size_t cascade = 0;
        double frequency_hz = 0;
        double reach_m =
            0;  ///< 0: no cascade has three texels of the wave (two, where there is one cascade), or the amplitude is 0
    };
    Held held() const;

    void begin(const InputMoment& moment) override;
    bool adds_to(std::size_t cascade) const override;
    double largest_slope(std::size_t cascade) const override;
    void add(const InputRows& rows) const override;

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
