// Wave input: rings around a point, in the cascade that holds waves of their length.
//
//   h(r, t) = A (1 - (r / R)^2)^2 sqrt(L / 2 / q) cos(2 pi ((q - L / 2) / L - f t) + phase),
//   q = sqrt(r^2 + (L / 2)^2)
//
// within the radius R, and exactly 0 beyond it. L is the wavelength far from the centre. f is the
// frequency in deep water, rounded to a whole number of periods in a loop. At the centre the rings
// have the amplitude A and are smooth; outwards they decay as r^(-1/2). The displacement is
// vertical only.
//
// A cascade repeats, and so do the rings, with the cascade's side. R is at most half of it, so that
// rings do not overlap. Dynamic waves (dynamic_waves.hpp) make rings that do not repeat.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "pelagic/message/numeric_field.hpp"
#include "pelagic/sim/wave_input.hpp"

namespace pelagic {

struct Ripple {
    // generated from schema/ripple.toml: members
    double x_m = 0, z_m = 0;  ///< centre; [-1e8, 1e8]
    double wavelength_m = 1;  ///< wavelength; [0.01, 1000]
    /// Amplitude at the centre, at most wavelength_m / (2 pi), a slope of 1; [0, 100].
    double amplitude_m = 0;
    /// Radius R beyond which the rings are 0; [0, 1e5]. 0 or more than half of the cascade's side:
    /// half of that side.
    double reach_m = 0;
    double phase_rad = 0;  ///< phase at the centre at t = 0, where 0 is a crest; [-2 pi, 2 pi]
    // end of generated
};

/// Returns the table of its numeric fields.
std::span<const NumericField<Ripple>> ripple_fields();

/// Returns an empty string for a usable ripple, else what is wrong: "wavelength_m 0 is out of
/// range [0.01, 1000]".
std::string check(const Ripple& ripple);

class RippleInput final : public WaveInput {
   public:
    /// \throws std::invalid_argument  what set() throws
    explicit RippleInput(const Ripple& ripple = {});
    ~RippleInput() override;

    /// Replaces the rings from the next schedule() on.
    /// \throws std::invalid_argument  check(ripple), unless it is empty; nothing is changed then
    void set(const Ripple& ripple);

    /// The rings of the frame scheduled last.
    struct Held {
        std::size_t cascade = 0;
        double frequency_hz = 0;
        /// 0 if no cascade has three texels of the wave (two, if there is one cascade), or if the
        /// amplitude is 0.
        double reach_m = 0;
    };
    /// Returns what the cascades hold, after moving the rings to their grids.
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
