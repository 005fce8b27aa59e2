// A rigid box that floats: a boat as simple as it can be and still be right about rest, stability and long waves.
//
//   std::vector<FloatingBox> boats = {FloatingBox({.length_m = 12, .mass_kg = 9000})};
//   HullWater hull;
//   step(boats, SurfaceQuery(ocean.complete()), 1.0 / 60, hull);
//
// The box is cut into columns along the one of its axes that is closest to vertical. Each column asks for the water
// where it crosses the surface, and is wet up to there. Forces:
//
//   weight       m g
//   pressure     rho V (g up + a), V what is wet of a column, at the middle of it, a the water's acceleration. The
//                pressure's gradient is rho (g + a), Euler's equation, and at the surface, where pressure is constant,
//                it stands on the surface: a boat much smaller than a wave slides and heels with the slope (W. Froude,
//                "On the rolling of ships", 1861). A vertical force alone would do neither. At rest it is Archimedes'.
//   added mass   A (a - dv/dt): water that has to make way. With `pressure` this is G. I. Taylor's force on a small
//                body in a stream (Proc. Roy. Soc. A 120, 1928): long waves carry the box with them, whatever A.
//   drag         1/2 rho Cd S |w| w along each axis of the box, w the water's velocity relative to the column, as in
//                Morison's equation (Faltinsen, Sea Loads on Ships and Offshore Structures, 1990, chapter 7)
//   waves made   c w along the vertical, a share of heave's critical damping (ibid., chapter 3)
//
// Only + - * / and sqrt: the same water gives the same bits everywhere.
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
    double mass_kg = 2000;        ///< positive, and less than the water's that the box holds: it has to float
    double centre_of_mass_m = 0;  ///< above the box's middle, ballast makes it negative; within the box
    /// About its axes through the centre of mass. None: that of a solid box. Positive.
    std::optional<glm::dvec3> inertia_kgm2 = {};
    /// Waves made by heave take away this share of the critical damping; [0, 1). A choice: in truth it depends on
    /// the frequency.
    double heave_damping = 0.2;
    double drag_coefficient = 1.05;  ///< Cd; a cube face on, Hoerner, Fluid-Dynamic Drag, 1965; [0, 10]
};

/// Empty if usable, else the first bad field.
std::string check(const BoxOptions&);

/// World axes; the position is that of the centre of mass.
struct BoxState {
    glm::dvec3 position_m{};
    glm::dquat orientation{1, 0, 0, 0};  ///< world from box, unit
    glm::dvec3 velocity_mps{};
    glm::dvec3 spin_radps{};
};

/// The water at the columns of all boxes; kept from step to step so that its memory is.
struct HullWater {
    std::vector<double> x, z;
    std::vector<float> height_m, velocity_x_mps, velocity_y_mps, velocity_z_mps;
};

class BoxWake;

class FloatingBox {
   public:
    /// Columns across each axis: the moment of the waterplane is 1/24^2 and 1/12^2 too small.
    static constexpr std::size_t columns_across[3] = {24, 12, 12};

    /// Upright and at rest, floating in still water at the origin. Throws std::invalid_argument(check(options)).
    explicit FloatingBox(const BoxOptions& options);

    const BoxOptions& options() const { return options_; }
    BoxState& state() { return state_; }
    const BoxState& state() const { return state_; }

    double floating_height_m() const {
        return floating_height_m_;
    }  ///< of the centre of mass above still water, upright
    double heave_m() const { return state_.position_m.y - floating_height_m_; }
    double displaced_kg() const { return displaced_kg_; }  ///< water, at the last step
    double heave_added_mass_kg() const;                    ///< at rest, upright
    /// Mean under the box, at the last step.
    glm::dvec3 water_velocity_mps() const { return water_velocity_mps_.value_or(glm::dvec3{}); }
    double heave_frequency_radps() const;  ///< of free heave in still water, undamped: sqrt(rho g L B / (m + A))

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
    std::optional<glm::dvec3> water_velocity_mps_;  ///< mean under the box, at the step before

    // Of the present step: the columns' axis, its upward direction and height, and the axes across it.
    glm::dmat3 axes_{1};
    int along_ = 1;
    glm::dvec3 upward_{0, 1, 0};
    std::size_t across_a_ = 0, across_b_ = 0;
};

/// Moves all boxes on by one step of semi-implicit Euler: one batch of queries, then each box by itself. A 30th
/// of the heave's period is a step that is short enough. \pre frames with velocities, of seas `step_s` apart
void step(std::span<FloatingBox> boxes, const SurfaceQuery& water, double step_s, HullWater& hull);

/// The same in dynamic waves, of ticks as long as steps. \param wakes  of the boxes, in their order
void step(std::span<FloatingBox> boxes, const SurfaceQuery& water, double step_s, HullWater& hull,
          std::span<const BoxWake> wakes);

}  // namespace pelagic::buoyancy
