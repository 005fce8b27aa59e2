// Coefficients of a hull from a panel method, instead of those of its sections: WAMIT's files .1 and .3, which
// Capytaine writes (wamit_files.hpp).
//
//   HullOptions options{.mass_kg = 4400};
//   const Hull plain(mesh, options);
//   options.coefficients = read_coefficients(plain, {.radiation = text_1, .excitation = text_3});
//   const Hull hull(mesh, options);
//
// A(inf) is the hull's added mass, and Cummins' equation with states of fixed size the rest of A and B
// (radiation_states.hpp). The pressure of undisturbed waves acts as on other hulls, on the moving hull below the waves'
// surface. With a file .3, a sum over the waves that carry 99 % of the sea's variance adds what the file's forces
// differ from that pressure on the hull at rest (wave_forces.hpp): in low waves, the force is that of the file.
// Without it, A and B act on the motion relative to the water. Drag is that of other hulls; roll_damping adds to B.
//
// Limitations. A, B and diffraction are linear: of a hull with less than half of its volume in the water, or with its
// top below the surface, they fade. Deep water and no forward speed. The mean drift, of second order, is not that of
// theory. Diffraction leaves out dynamic waves, wave inputs and waves faster than the file's; it is unavailable on a
// shore, in a pond, and while the sea changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/radiation_table.hpp"
#include "pelagic/floating/wamit_files.hpp"
#include "pelagic/floating/wave_forces.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

struct RadiationFit;

/// Coefficients of hulls of one kind. Immutable; any thread may use them.
class GivenCoefficients {
   public:
    /// Fits the radiation, which takes some 0.1 s.
    /// \param excitation  forces of waves; none: the pressure of undisturbed waves acts
    /// \throws std::invalid_argument  for a table that is not usable
    explicit GivenCoefficients(const RadiationTable& radiation, std::optional<ForceTable> excitation = {});
    ~GivenCoefficients();
    GivenCoefficients(const GivenCoefficients&) = delete;
    GivenCoefficients& operator=(const GivenCoefficients&) = delete;

    /// Returns the fit of the radiation.
    const RadiationFit& radiation() const { return *fit_; }
    /// Returns the forces of waves; null without.
    const ForceTable* excitation() const { return excitation_ ? &*excitation_ : nullptr; }
    /// Returns the XXH3 of the fit and of the forces.
    std::uint64_t digest() const { return digest_; }

   private:
    std::unique_ptr<const RadiationFit> fit_;
    std::optional<ForceTable> excitation_;
    std::uint64_t digest_ = 0;
};

/// Texts of WAMIT's files, and their names for messages.
struct CoefficientTexts {
    std::string_view radiation;        ///< of a file .1
    std::string_view excitation = {};  ///< of a file .3; empty: none
    std::string radiation_name = "the text of .1", excitation_name = "the text of .3";
};

/// Returns the scale of files whose origin is that of the mesh, raised or lowered to the water's surface, and whose
/// numbers are of this hull's water and a length of 1 m.
/// \throws std::invalid_argument  for a hull that sinks
WamitScale wamit_scale_of(const Hull& hull);

/// Reads the coefficients of a hull.
/// \param hull   a hull of the same mesh and mass without coefficients
/// \param scale  unset: wamit_scale_of(hull)
/// \throws std::invalid_argument  what read_wamit_1() and read_wamit_3() throw, after the file's name; for numbers that
///                                are not those of a hull of this size, as with units; for a hull that sinks
std::shared_ptr<const GivenCoefficients> read_coefficients(const Hull& hull, const CoefficientTexts& texts,
                                                           const std::optional<WamitScale>& scale = {});

/// Forces of the waves of the latest sea, for hulls of several kinds. One thread at a time uses an object.
class SeaForces {
   public:
    static constexpr double share = 0.99;  ///< of the variance, which the highest waves carry

    /// Returns the diffraction, which is valid until the sea changes. The first call in a sea computes it, which takes
    /// about 0.02 ms a wave and allocates.
    /// \pre the hull has a diffraction()
    /// \throws std::invalid_argument  in water without the waves of a frame's sea: "forces of waves are unavailable
    ///                                on a shore"
    const WaveForces& on(const Hull& hull, const WaterKinematics& water);

    /// Returns "on a shore" or why else a frame's waves are not those of its sea alone; empty if they are.
    /// \param frame  null: water without a frame
    static std::string reason_unavailable(const Frame* frame);

   private:
    struct Kind {
        std::shared_ptr<const ForceTable> of;
        std::unique_ptr<const WaveForces> forces;
    };
    std::optional<SeaState> sea_;
    std::vector<WaveComponent> waves_;
    std::vector<Kind> kinds_;
};

}  // namespace pelagic
