// A floating rigid box: a simple boat model that is correct at rest, for stability, and in long
// waves.
//
//   std::vector<FloatingBox> boats = {FloatingBox({.length_m = 12, .mass_kg = 9000})};
//   HullWater hull;
//   step(boats, SurfaceQuery(ocean.complete()), 1.0 / 60, hull);
//
// The box is divided into columns along its axis that is closest to vertical. Each column queries
// the water where it crosses the surface, and is submerged up to there. Forces:
//
//   weight       m g
//   pressure     rho V (g up + a) at the middle of a column's submerged volume V; a is the water's
//                acceleration. The pressure gradient is rho (g + a), Euler's equation. It is normal
//                to the surface, where the pressure is constant. A boat much smaller than a wave
//                therefore slides and heels with the slope (W. Froude, "On the rolling of ships",
//                1861). A vertical force alone would do neither. At rest it is Archimedes'.
//   added mass   A (a - dv/dt), the inertia of displaced water. Together with `pressure` it is
//                G. I. Taylor's force on a small body in a stream (Proc. Roy. Soc. A 120, 1928):
//                long waves carry the box with them for any A.
//   drag         1/2 rho Cd S |w| w along each axis of the box; w is the water's velocity relative
//                to the column, as in Morison's equation (Faltinsen, Sea Loads on Ships and
//                Offshore Structures, 1990, chapter 7)
//   radiation    c w along the vertical, a fraction of heave's critical damping (ibid., chapter 3)
//
// Only + - * / and sqrt are used, so results are bit-identical on every machine.
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::buoyancy {

/// Sea water, nominal; 1026 at 15 degrees C (ITTC 7.5-02-01-03).
inline constexpr double water_density_kgpm3 = 1025;

/// Along the box: x forward (length), y up (height), z to starboard (beam).
struct BoxOptions {
    double length_m = 4;          ///< (0, 1000]
    double height_m = 1;          ///< (0, 1000]
    double beam_m = 2;            ///< (0, 1000]
    double mass_kg = 2000;        ///< positive, and less than the mass of water of the box's volume
    double centre_of_mass_m = 0;  ///< above the box's middle, negative with ballast; within the box
    /// Moments of inertia about the axes through the centre of mass, positive; unset: those of a
    /// solid box.
    std::optional<glm::dvec3> inertia_kgm2 = {};
    /// Damping of heave by radiated waves as a fraction of critical damping; [0, 1). The default is
    /// a choice; real damping depends on the frequency.
    double heave_damping = 0.2;
    /// Cd; [0, 10]. The default is that of a cube, face on (Hoerner, Fluid-Dynamic Drag, 1965).
    double drag_coefficient = 1.05;
};

/// Returns an empty string if the options are valid, else a message about the first invalid field.
std::string check(const BoxOptions&);

/// State in world axes. The position is that of the centre of mass.
struct BoxState {
    glm::dvec3 position_m{};
    glm::dquat orientation{1, 0, 0, 0};  ///< world from box, unit
    glm::dvec3 velocity_mps{};
    glm::dvec3 spin_radps{};
};

/// Samples of the water at the columns of all boxes. Reuse it between steps to avoid allocations.
struct HullWater {
    std::vector<double> x, z;
    std::vector<float> height_m, velocity_x_mps, velocity_y_mps, velocity_z_mps;
};

class BoxWake;

class FloatingBox {
   public:
    /// Columns across each axis. The moment of the waterplane is 1/24^2 and 1/12^2 too small.
    static constexpr std::size_t columns_across[3] = {24, 12, 12};

    /// Creates a box upright and at rest, floating in still water at the origin.
    /// \throws std::invalid_argument  if check(options) is not empty
    explicit FloatingBox(const BoxOptions& options);

    const BoxOptions& options() const { return options_; }
    BoxState& state() { return state_; }
    const BoxState& state() const { return state_; }

    /// Returns the height of the centre of mass above still water, upright.
    double floating_height_m() const { return floating_height_m_; }
    double heave_m() const { return state_.position_m.y - floating_height_m_; }
    double displaced_kg() const { return displaced_kg_; }  ///< displaced water at the last step
    double heave_added_mass_kg() const;                    ///< at rest, upright
    /// Returns the mean velocity of the water under the box at the last step.
    glm::dvec3 water_velocity_mps() const { return water_velocity_mps_.value_or(glm::dvec3{}); }
    /// Returns the frequency of undamped heave in still water: sqrt(rho g L B / (m + A)).
    double heave_frequency_radps() const;

   private:
    friend void step(std::span<FloatingBox>, const SurfaceQuery&, double, HullWater&, std::span<const BoxWake>);

    void cut_columns();
    std::size_t column_count() const { return across_a_ * across_b_; }
    void append_places(HullWater& hull) const;
    void move(const HullWater& hull, std::size_t first, double step_s);
    glm::dvec3 column_middle(std::size_t column) const;

    BoxOptions options_;
    BoxState state_;
    glm::dvec3 size_m_, face_m2_, added_mass_kg_, inertia_kgm2_;
    double submerged_afloat_, floating_height_m_, wave_damping_;
    double displaced_kg_ = 0;
    std::optional<glm::dvec3> water_velocity_mps_;  ///< mean under the box at the last step

    // State of the current step: the box's axes, the columns' axis and its upward direction, and
    // the numbers of columns across it.
    glm::dmat3 axes_{1};
    int along_ = 1;
    glm::dvec3 upward_{0, 1, 0};
    std::size_t across_a_ = 0, across_b_ = 0;
};

/// Moves all boxes by one step of semi-implicit Euler, with one batch of queries for all boxes. A
/// step of at most 1/30 of the heave's period is short enough.
/// \pre the frames have velocities, and successive frames are `step_s` apart
void step(std::span<FloatingBox> boxes, const SurfaceQuery& water, double step_s, HullWater& hull);

/// Moves all boxes by one step in dynamic waves, whose tick must equal the step.
/// \param wakes  wakes of the boxes, in the order of the boxes
void step(std::span<FloatingBox> boxes, const SurfaceQuery& water, double step_s, HullWater& hull,
          std::span<const BoxWake> wakes);

}  // namespace pelagic::buoyancy
