// Forces of the water on a rigid hull, from its triangle mesh.
//
//   const Hull hull(HullMesh(vertices, triangles), {.mass_kg = 900});
//   HullState boat = hull.at_rest(0, 0);
//   HullWorkspace workspace;
//   hull.step(WaterQuery(ocean.complete()), boat, 1.0 / 60, {}, workspace);
//
// An application with a physics engine sets the pose and the velocity of the state, calls loads()
// and applies the result. Forces, with w the velocity of the hull relative to the water at a
// triangle, n its outward normal and S its area below the waterline:
//
//   pressure    -n S p, with p at rest and of waves at the depth of each vertex (water_kinematics.hpp);
//               linear on each triangle, and integrated exactly over triangles cut at the waterline
//               (J. Kerner, "Water interaction model for boats in video games", Gamasutra 2015).
//               Triangles are divided until no edge that reaches below the waterline at rest extends
//               farther along an axis than a tenth of the hull's length, or 4096 vertices sample the water.
//   added mass  A (a_w - du/dt), with u velocity and rotation, a_w the rate of change of the
//               water's velocity at the moving hull (J. N. Newman, Marine Hydrodynamics, MIT Press
//               1977, chapters 4 and 7): its mean over the displaced water, which follows from the
//               pressure by Gauss' theorem. Vertically the part (b / 3 T)^2 of it, at most all, and the
//               rest of the mean over the faces that look down, b the breadth and T the mean draught:
//               deep hulls push the water below them, and this weight fits what is known of flat ones
//               (tests/hull_response_test.cpp)
//   drag        1/2 rho C S |w.n| w.n along -n, C for faces that advance and for faces that
//               retreat; and 1/2 rho C_f S |w_t| w_t for the friction along a face
//   radiation   linear damping of heave and pitch on strips across the length, by the waves that they
//               make (lewis_sections.hpp), and of roll. Of a hull
//               whose top is s below the surface exp(-2 k s) remains, with k of the waves that it makes
//               when it heaves afloat: by Haskind's relation, damping goes with the square of the
//               waves' force (Newman, chapter 6)
//   skeg        -1/2 rho S (1.56 |u| + 1.17 |v|) v across the hull, u and v the velocities ahead and
//               across of the skeg: the lift of a fin whose aspect ratio with its mirror image is 1
//               (L. F. Whicker and L. F. Fehlner, DTMB report 933, 1958), and the drag of a plate
//               (Hoerner 1965)
//   slamming    -(dA/dt) w while the added mass increases (T. von Karman, NACA TN 321, 1929)
//   air         1/2 rho_air C_a S (w.n)^2 on faces above the water that meet the wind
//
// Results are bit-identical on every machine: only + - * / and square roots are used.
//
// Limitations. Water inside an open hull, lift of foils, and the moment of a fluid on a
// body in oblique flow (Munk) are left out. Added mass is given at rest and scales with the
// displaced volume, at most by 1. Friction does not depend on the Reynolds number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/floating/hull_matrix.hpp"
#include "pelagic/floating/hull_mesh.hpp"
#include "pelagic/message/numeric_field.hpp"
#include "pelagic/sim/water_query.hpp"

namespace pelagic {

class GivenCoefficients;
class HullSpray;
class HullWake;
class SeaForces;
class WaveForces;
struct ForceTable;

struct HullOptions {
    // generated from schema/hull.toml: members
    double mass_kg = 0;  ///< mass, which has no default; [1e-6, 1e10]
    /// Centre of mass in the axes of the mesh. Unset: the centre of the mesh's volume.
    std::optional<glm::dvec3> centre_of_mass_m = {};
    /// Moments of inertia about the axes through the centre of mass; [1e-15, 1e16]. Unset: those of
    /// a body that fills the mesh evenly.
    std::optional<glm::dvec3> inertia_kgm2 = {};
    /// Added mass at rest, symmetric and positive semi-definite. Unset: that of the Lewis forms of
    /// the hull's sections at the resonance of heave (lewis_sections.hpp).
    std::optional<HullMatrix> added_mass = {};
    /// Added mass, radiation and wave forces of a panel method (given_coefficients.hpp), instead of
    /// those of sections. Excludes added_mass and heave_damping.
    std::shared_ptr<const GivenCoefficients> coefficients = {};
    /// Fraction of critical damping of heave, for pitch too; 0: by the waves that Lewis sections
    /// make; [0, 0.999].
    double heave_damping = 0;
    double roll_damping = 0.05;         ///< fraction of critical damping of roll at |GM|; [0, 0.999]
    double pressure_coefficient = 0.7;  ///< drag of advancing faces; [0, 10]
    /// Drag of retreating faces; with pressure_coefficient 0.7 the drag is that of a cube, 1.05
    /// (Hoerner 1965); [0, 10].
    double suction_coefficient = 0.35;
    /// Friction along faces; ITTC 1957 at a Reynolds number of 3e6; [0, 1].
    double friction_coefficient = 4e-3;
    double air_coefficient = 1;         ///< drag of faces above the water; [0, 10]
    double water_density_kgpm3 = 1025;  ///< density of the water; [500, 2000]
    double air_density_kgpm3 = 1.225;   ///< density of the air; [0, 10]
    /// Lateral area of a skeg, keel or fin in the middle plane, which keeps the course of a hull
    /// under thrust; [0, 1e4]. 0: none.
    double skeg_m2 = 0;
    /// Middle of the skeg in the axes of the mesh; [-1000, 1000].
    double skeg_x_m = 0, skeg_y_m = 0;
    // end of generated
};

/// Returns the table of the numeric options.
std::span<const NumericField<HullOptions>> hull_fields();

/// A rigid body in world axes, and what the water's forces remember of the previous step.
struct HullState {
    glm::dvec3 position_m{};              ///< of the centre of mass
    glm::dquat orientation{1, 0, 0, 0};   ///< world from hull, unit
    glm::dvec3 velocity_mps{};            ///< of the centre of mass
    glm::dvec3 angular_velocity_radps{};  ///< in world axes
    /// Of the previous step: mean vertical velocity and rotation of the dynamic waves that HullWake acts on, and
    /// the fraction of the added mass.
    double wake_velocity_y_mps = 0;
    glm::dvec3 wake_rotation_radps{};
    double submersion = 0;
    bool has_previous_step = false;  ///< false: no acceleration of dynamic waves and no slamming
    RadiationState radiation = {};   ///< of HullOptions::coefficients
};

/// A force and its torque about the centre of mass, in world axes.
struct HullForce {
    glm::dvec3 force_n{}, torque_nm{};

    /// Adds another force and its torque.
    HullForce& operator+=(const HullForce& other) {
        force_n += other.force_n;
        torque_nm += other.torque_nm;
        return *this;
    }
};

/// Forces of water and air on a hull. `total()` leaves out weight and -A du/dt.
struct HullLoads {
    HullForce pressure;    ///< of the water's weight and acceleration, and diffraction
    HullForce added_mass;  ///< A a_w
    HullForce drag;        ///< drag, radiation damping and air
    HullForce slamming;
    /// Of given coefficients: radiation without -A(inf) du/dt. Its change with the mean velocity of a step is minus
    /// radiation_damping, in axes of the hull; radiation_share scales both with the hull in the water.
    HullForce radiation;
    HullMatrix radiation_damping{};
    double radiation_share = 0;
    /// Impact on the water, of slamming and of the pressure on advancing faces: the magnitudes of
    /// both forces, and the power that they take from the motion relative to the water.
    double impact_n = 0, impact_w = 0;
    double displaced_m3 = 0;
    double submersion = 0;  ///< displaced over floating volume, at most 1: scales added mass
    /// The plane through the water's surface at the hull: height at the centre of mass, and slopes.
    double water_height_m = 0, water_slope_x = 0, water_slope_z = 0;
    glm::dvec3 water_velocity_mps{};    ///< mean along the hull's bottom
    glm::dvec3 water_rotation_radps{};  ///< of the water along the hull's bottom, about x and z
    glm::dvec3 water_acceleration_mps2{};  ///< what acts on the added mass
    HullMatrix mass{};       ///< of the hull, and its added mass now; axes of the hull
    HullMatrix stiffness{};  ///< -d pressure / d pose; axes of the hull

    /// Returns the sum of all forces.
    HullForce total() const {
        HullForce sum = pressure;
        return sum += added_mass, sum += drag, sum += slamming, sum += radiation;
    }
};

/// What else acts on a hull in a step.
struct HullInputs {
    HullForce force;  ///< of engines, tow lines and contacts
    glm::dvec3 wind_mps{};
    /// If not null, the hollow of the hull's own pressure is left out.
    const HullWake* wake = nullptr;
    /// Of a hull with Hull::diffraction(): its forces in the sea (SeaForces), which FloatingBodies sets. Null for other
    /// hulls.
    const WaveForces* diffraction = nullptr;
};

/// The hull at rest in still water, upright: the mesh's y axis is vertical.
struct HullAfloat {
    bool floats = false;   ///< false: heavier than its volume of water; the rest is 0 then
    double draught_m = 0;  ///< of the lowest vertex
    double height_m = 0;   ///< of the centre of mass above the water
    double waterplane_m2 = 0;
    double roll_gm_m = 0, pitch_gm_m = 0;  ///< metacentric heights
    /// Periods of small motions without damping, 2 pi sqrt((M + A) / C); 0 for one that does not return.
    double heave_period_s = 0, roll_period_s = 0, pitch_period_s = 0;
};

/// Memory of a step, reused so that steps allocate nothing after the first.
struct HullWorkspace {
    std::vector<double> x, y, z;
    std::vector<float> depth_m, pressure_pa, velocity_x_mps, velocity_y_mps, velocity_z_mps, acceleration_y_mps2;
    std::vector<float> depth_with_wake_m;
    /// The points of a hull: those up to `end`, from that of the hull before.
    struct Part {
        std::size_t end;
        double footprint_m;
        bool has_rise;  ///< whether the vertical acceleration is wanted
    };
    std::vector<Part> parts;
    std::vector<double> wake_m, wake_up_mps;
    HullForce wake_push;  ///< of HullWake::push()
    struct Vertex {
        glm::dvec3 arm_m;         ///< from the centre of mass, world axes
        glm::dvec3 relative_mps;  ///< velocity of the hull relative to the water
        double depth_m;           ///< below the surface, negative above it
        double head_m;            ///< pressure over density and gravity
        double rise_mps2 = 0;     ///< vertical acceleration of the water
        double wake_m = 0;        ///< of the head, that of waves that HullWake acts on
        double wake_up_mps = 0;   ///< vertical velocity of these waves
    };
    std::vector<Vertex> vertices;

    /// Removes all points.
    void clear();
    /// Samples the water at (x, y, z).
    void sample(const WaterKinematics& water);
};

/// The immutable part of hulls of one kind: mesh, mass and coefficients. Any thread may use it.
class Hull {
   public:
    /// \throws std::invalid_argument  check(mesh, options), unless it is empty
    Hull(HullMesh mesh, const HullOptions& options);

    /// Returns an empty string for usable options, else what is wrong: "mass_kg 0 is out of range
    /// [1e-6, 1e10]".
    static std::string check(const HullMesh& mesh, const HullOptions& options);
    /// Returns an empty string for a usable state, else what is wrong: "the hull's velocity_mps is
    /// out of range [-1e4, 1e4]".
    static std::string check(const HullState& state);
    /// Returns an empty string for usable inputs, else what is wrong: forces and torques in
    /// [-1e15, 1e15], wind in [-1e3, 1e3] m/s.
    static std::string check(const HullInputs& inputs);
    /// \throws std::invalid_argument  if step_s is negative or not finite, or a wake has no frame
    static void check_step(const WaterKinematics& water, const HullInputs& inputs, double step_s);

    /// Returns the mesh of construction.
    const HullMesh& mesh() const { return mesh_; }
    /// Returns how the hull lies in still water.
    const HullAfloat& afloat() const { return afloat_; }
    /// Returns the mass without added mass.
    double mass_kg() const { return mass_kg_; }
    /// Returns the density of the water, kg/m^3.
    double water_density_kgpm3() const { return options_.water_density_kgpm3; }
    const HullMatrix& added_mass() const { return added_mass_; }       ///< at rest
    glm::dvec3 centre_of_mass_m() const { return centre_of_mass_m_; }  ///< in the axes of the mesh
    /// Returns the given coefficients; null without.
    const GivenCoefficients* coefficients() const { return options_.coefficients.get(); }
    /// Returns the coefficients' forces of waves less the pressure of undisturbed waves on the hull at rest, each 5
    /// degrees; null without.
    const ForceTable* diffraction() const { return diffraction_.get(); }
    /// Returns the XXH3 of mesh, mass and coefficients. Hulls of equal digests move
    /// bit-identically.
    std::uint64_t digest() const;
    /// Returns how far edges that reach below the waterline at rest extend along an axis between points that sample
    /// the water: at most a tenth of the hull's length, unless the mesh would have more than 4,096 points.
    double longest_edge_m() const { return longest_edge_m_; }
    /// Returns the world position of the mesh's origin, to draw it.
    glm::dvec3 mesh_origin_m(const HullState& state) const;

    /// Returns a state at rest in still water, upright, with the hull's x axis turned from +x
    /// towards +z by the heading.
    /// \throws std::invalid_argument  if the heading is not finite
    HullState at_rest(double x_m, double z_m, double heading_rad = 0) const;
    /// As above, but on the surface of the water, with its velocity there.
    HullState at_rest(const WaterKinematics& water, double x_m, double z_m, double heading_rad = 0) const;

    /// Returns the loads of a state, and stores in it what the next call needs.
    /// \param state   successive calls are step_s apart
    /// \param step_s  at least 0: drag is that of an implicit step of this length, so that an
    ///                explicit integrator remains stable; 0: no time has passed. Given coefficients remember
    ///                the velocity of the state for as long; step() takes the mean velocity instead
    /// \throws std::invalid_argument  check(state) or check(inputs) if it is not empty, or what
    ///                                check_step() throws, or if diffraction is missing in the inputs, or
    ///                                given to a hull without; the state is unchanged then
    HullLoads loads(const WaterKinematics& water, HullState& state, double step_s, const HullInputs& inputs,
                    HullWorkspace& workspace) const;

    /// Solves (M + A) du = step_s F for the velocities after a step, with weight and the inputs'
    /// force, and stores them in the state. An application whose physics engine has no mass matrix
    /// sets the body's velocities to the result.
    void accelerate(HullState& state, const HullLoads& loads, double step_s, const HullInputs& inputs = {}) const;

    /// Advances a state by a step: half of the motion, forces, the other half (Verlet). Without
    /// waves, wind and inputs each step reduces the mechanical energy. More than 0.1 s, after a
    /// hitch of the application, is divided into equal steps, and more than 1 s counts as 1 s.
    /// \returns whether the state has advanced by all of step_s
    /// \throws std::invalid_argument  what loads() throws
    bool step(const WaterKinematics& water, HullState& state, double step_s, const HullInputs& inputs,
              HullWorkspace& workspace) const;

   private:
    friend class FloatingBodies;
    friend class HullSpray;
    friend class HullWake;
    friend class SeaForces;
    double floating_m3() const { return floating_volume_m3_; }
    void append_points(const HullState& state, HullWorkspace& workspace) const;
    /// Fills workspace.vertices from its samples.
    void place_vertices(const WaterKinematics& water, std::size_t first_point, const HullState& state,
                        const HullWake* wake, HullWorkspace& workspace) const;
    HullLoads loads_at(const WaterKinematics& water, std::size_t first_point, HullState& state, double step_s,
                       const HullInputs& inputs, HullWorkspace& workspace) const;
    /// What step() divides a time into.
    struct Steps {
        /// \pre step_s is at least 0
        explicit Steps(double step_s);
        int count;
        double each_s;
        bool are_all;
    };
    /// A hull in a step.
    struct Moving {
        const Hull& hull;
        HullState& state;
        const HullInputs& inputs;
        HullLoads& loads;  ///< receives those of the last part of the step
    };
    /// Advances hulls as step(), without checks and with one query for all.
    static bool advance(const WaterKinematics& water, std::span<const Moving> hulls, double step_s,
                        HullWorkspace& workspace);
    struct Speeds;
    void check_mass() const;
    void check_waves(const HullInputs& inputs) const;
    void find_diffraction();
    void add_given(const WaterKinematics& water, const HullState& state, double step_s, const HullInputs& inputs,
                   double radiates, HullLoads& loads) const;
    void remember(HullState& state, const HullLoads& loads, double step_s, const HullInputs& inputs,
                  const Vector6& mean_velocity) const;
    HullMatrix turning_by(const glm::dvec3& spin, double submersion) const;
    static void drift(HullState& state, double seconds);
    Speeds speeds_after(const HullState& state, const HullLoads& loads, double step_s,
                        const HullInputs& inputs) const;
    void complete_step(HullState& middle, const HullLoads& forces, double step_s, const HullInputs& inputs) const;
    double wet_extent_m(const glm::dvec3& a, const glm::dvec3& b) const;
    void divide_triangles();
    void find_rest();
    void find_displaced_moments();
    void set_added_mass_of_plates();

    HullMesh mesh_;
    HullOptions options_;
    double mass_kg_;
    glm::dvec3 centre_of_mass_m_, inertia_kgm2_;
    std::vector<glm::dvec3> arms_m_;  // vertices from the centre of mass, first those of the mesh
    std::vector<HullMesh::Triangle> triangles_;  // of these
    std::vector<double> weights_;     // of vertices in means over the plan; their sum is 1
    HullMatrix added_mass_{};
    std::shared_ptr<const ForceTable> diffraction_;
    HullAfloat afloat_;
    double footprint_m_ = 0;  // twice the distance of vertices
    double longest_edge_m_ = 0;
    double floating_volume_m3_ = 0;
    glm::dvec3 displaced_m5_{};  // second moments of the water that the hull at rest displaces
    double middle_weight_ = 1;      // of the displaced water in the mean vertical acceleration
    double strip_damping_ = 0;      // kg/s for a square metre of waterplane
    double roll_damping_ = 0;       // kg m^2/s
    double heave_wave_number_ = 0;  // rad/m, of the waves that heave makes
};

}  // namespace pelagic
