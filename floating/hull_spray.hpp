// Spray and foam of a hull whose faces strike the surface: bow impact and planing.
//
//   HullSpray thrown(hull);
//   bodies.step(frame, tick_s);                                          // FloatingBodies
//   thrown.update(WaterQuery(frame), bodies.state(boat), bodies.loads(boat), tick_s, workspace,
//                 bodies.inputs(boat).wake);
//   ocean.emit(thrown.emitters());                                       // sim/spray.hpp
//   for (const Disturbance& foam : thrown.foam()) waves.add_impulse(foam);
//
// Let a face with the outward normal n cross the surface, with the velocity w relative to the
// water and the deadrise b, its angle to the surface. The edge of the wetted face moves over the
// water at the speed c, and throws a jet along the face, which has the velocity u relative to the
// water (H. Wagner, "Ueber Stoss- und Gleitvorgaenge an der Oberflaeche von Fluessigkeiten", ZAMM
// 12, 1932; S. D. Howison, J. R. Ockendon and S. K. Wilson, J. Fluid Mech. 222, 1991):
//
//   c = (1 + (pi/2 - 1) cos^2 b) w.n / sin b,   u = c (h + t)
//
// with h horizontal and outward, and t upward along the face. The first factor is Wagner's pi/2 for
// a flat bottom and 1 for a side, which does not pile water up. It is within 1 % of the solution of
// R. Zhao and O. Faltinsen (J. Fluid Mech. 246, 1993) for deadrises up to 30 degrees.
//
// By Wagner's theory a metre of jet takes the power rho pi/4 l (w.n)^2 c, with the wetted length l
// of the face; here l is the draught over sin b. All jets together take half of the work of an
// impact (Y.-M. Scolan and A. A. Korobkin, J. Fluids Struct. 17, 2003), so that half of
// HullLoads::impact_w limits them. Slow jets fall back as a bow wave, so the spray begins with jets
// whose head u^2 / 2g is the draught, and takes all of a jet from twice that head on; by eye.
//
// Drops have the largest stable diameter in air, at a Weber number of 12 (M. Pilch and C. A.
// Erdman, Int. J. Multiphase Flow 13, 1987). Foam is that of a bore whose thrust on a metre,
// rho g h^2 / 2, is the force of the impact on the faces that throw water.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "pelagic/floating/hull.hpp"
#include "pelagic/message/numeric_field.hpp"
#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic {

struct HullSprayOptions {
    double radius_m = 0.08;  ///< of a droplet, a clump of drops, as it leaves; [0.001, 1]
    double clump_kg = 0.5;   ///< water of a droplet; [1e-6, 1e6]
    int max_droplets = 64;   ///< of an update; if exceeded, each holds more water; [0, 8192]
};

/// Returns the table of the options.
std::span<const NumericField<HullSprayOptions>> hull_spray_fields();
/// Returns an empty string for usable options, else what is wrong.
std::string check(const HullSprayOptions& options);

/// Spray and foam of one hull. Results are bit-identical on every machine. A copy keeps the state
/// for a rollback, and save_state() for another process. Spray has no rollback: emit each tick's
/// droplets once. One thread at a time uses an object.
class HullSpray {
   public:
    static constexpr int max_foam = 8;  ///< disturbances of an update

    /// \pre hull outlives this object
    /// \throws std::invalid_argument  check(options), unless it is empty
    explicit HullSpray(const Hull& hull, const HullSprayOptions& options = {});

    /// Computes the water thrown in a step. Allocates nothing in Pelagic's code once the vectors
    /// have reached their size.
    /// \param water  of the step's frame, with velocities
    /// \param state, loads  after the step
    /// \param step_s  of Hull::step(); of a divided step, the spray is that of its last part
    /// \param wake  HullInputs::wake of the step
    /// \throws std::invalid_argument  Hull::check(state), or what Hull::check_step() throws
    void update(const WaterKinematics& water, const HullState& state, const HullLoads& loads, double step_s,
                HullWorkspace& workspace, const HullWake* wake = nullptr);

    /// Returns emitters of one droplet each, which leave within a step from the frame's time on.
    std::span<const SprayEmitter> emitters() const { return emitters_; }
    /// Returns the water of each emitter, kg. Relative to the water, its kinetic energies sum up to
    /// at most step_s impact_w / 2, and its momenta to at most step_s impact_n.
    std::span<const double> masses_kg() const { return masses_kg_; }
    /// Returns impulses of foam for DynamicWaves::add_impulse().
    std::span<const Disturbance> foam() const { return foam_; }

    /// Returns all that later updates depend on, 8 bytes. FloatingBodies::save_state() leaves it
    /// out, because a set has no spray.
    std::vector<std::uint8_t> save_state() const;
    /// Restores a saved state, on any machine of equal byte order. The results of the last update
    /// stay until the next.
    /// \throws std::invalid_argument  for another number of bytes; nothing is changed then
    void restore_state(std::span<const std::uint8_t> saved);

   private:
    /// The jet along a piece of the waterline.
    struct Jet {
        glm::dvec3 from_m, to_m;         ///< ends, from the centre of mass
        glm::dvec3 out;                  ///< unit vector along the surface, away from the face
        glm::dvec3 jet_mps;              ///< relative to the water
        glm::dvec3 hull_mps, water_mps;  ///< of hull and water there
        double energy_j;
    };
    void add_jets(const HullLoads& loads, const HullState& state, double step_s, const HullWorkspace& workspace);
    void add_droplets(const HullLoads& loads, const HullState& state, double step_s, double time_s);
    void add_foam(const HullLoads& loads, const HullState& state, double step_s);
    /// Calls at(jet, position from the centre of mass) `count` times, at equal steps of energy.
    template <class At>
    void for_places(int count, At&& at);
    double next_fraction(std::size_t sequence);

    const Hull* hull_;
    HullSprayOptions options_;
    double draught_m_;
    std::array<std::uint32_t, 2> sequences_{};  ///< of fractions of 2^32
    double energy_j_ = 0;                       ///< of all jets
    std::vector<Jet> jets_;
    std::vector<SprayEmitter> emitters_;
    std::vector<double> masses_kg_;
    std::vector<Disturbance> foam_;
};

}  // namespace pelagic
