// A set of floating hulls in the water of an ocean: they are found by number, make wakes and have
// one saved state.
//
//   const Hull hull(HullMesh(vertices, triangles), {.mass_kg = 900});
//   FloatingBodies bodies(make_default_executor(), &ocean.dynamic_waves());
//   const std::uint32_t boat = bodies.add(hull, hull.at_rest(10, -4));
//   const Frame& frame = ocean.complete();
//   bodies.press(frame, tick_s);
//   ocean.schedule(next_s);                                              // a tick later
//   bodies.step(frame, tick_s);
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/hull_wake.hpp"
#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// One thread at a time uses an object. With waves, add(), remove(), clear() and press() enqueue
/// commands, so that thread also uses the waves and their ocean.
class FloatingBodies {
   public:
    /// Largest number of bodies whose hulls have given coefficients (given_coefficients.hpp).
    static constexpr std::ptrdiff_t max_given = 8;

    /// Creates an empty set.
    /// \param executor  computes the steps
    /// \param waves  receives the wakes of all bodies and outlives the calls; null: no wakes. The
    ///               destructor does not use it, so the pressures of bodies remain: see clear().
    /// \throws std::invalid_argument  if the executor is null
    explicit FloatingBodies(std::shared_ptr<Executor> executor, DynamicWaves* waves = nullptr);
    ~FloatingBodies();
    FloatingBodies(const FloatingBodies&) = delete;  // the jobs point into it
    FloatingBodies& operator=(const FloatingBodies&) = delete;

    /// Adds a body without inputs and returns its number, which is never reused. The set keeps a
    /// copy of the hull, one for hulls of equal digests, also after the body is removed, for
    /// restore_state().
    /// \throws std::invalid_argument  Hull::check(state), what DynamicWaves::add_footprint() throws,
    ///                                and for a ninth body with given coefficients; nothing is changed then
    std::uint32_t add(const Hull& hull, const HullState& state);
    /// Removes a body, and its pressure from the next tick on. Does nothing if there is none of
    /// that number.
    void remove(std::uint32_t number);
    /// Removes all bodies and their pressures.
    void clear();
    /// Returns the number of bodies.
    std::size_t size() const { return bodies_.size(); }

    /// Returns a body's hull: the copy, valid as long as the set.
    /// \throws std::invalid_argument  here and below, if there is no body of that number: "number is
    ///                                7, expected that of a body"; nothing is changed then
    const Hull& hull(std::uint32_t number) const;
    const HullState& state(std::uint32_t number) const;    ///< after the last step
    const HullInputs& inputs(std::uint32_t number) const;  ///< of the next step, with the wake
    const HullLoads& loads(std::uint32_t number) const;    ///< of the last step
    /// \throws std::invalid_argument  Hull::check(state)
    void set_state(std::uint32_t number, const HullState& state);
    /// Sets force and wind of the steps from now on. The inputs' wake and diffraction are ignored.
    /// \throws std::invalid_argument  Hull::check(inputs)
    void set_inputs(std::uint32_t number, const HullInputs& inputs);

    /// Moves all bodies and their wakes, after a shift of the world's origin (Ocean::set_origin()) by
    /// (-x_m, -z_m). Call it when the first frame with the new origin is complete, before that frame's
    /// press() and step().
    /// \throws std::invalid_argument  if a body would be out of range; nothing is changed then
    void shift(double x_m, double z_m);

    /// Moves the pressures of wakes to the bodies, as HullWake::press(). Does nothing without
    /// waves.
    /// \param tick_s  time since the last call
    /// \throws std::invalid_argument  what HullWake::press() throws
    void press(const Frame& frame, double tick_s);
    /// Advances all bodies as Hull::step() does, bit-identically for any number of threads, and
    /// returns its result. The calling thread takes part. Allocates nothing in Pelagic's code once
    /// each job has had a hull of as many vertices, and after the first step in a sea with wave forces.
    /// \param frame  with queries and depth
    /// \throws std::invalid_argument  what Hull::step() throws, for a body that is out of range
    ///                                after its number: "body 3: "; what SeaForces::on() throws;
    ///                                nothing is changed then
    bool step(const Frame& frame, double step_s);
    /// As above, in any water. Bodies with wakes need that of a frame.
    bool step(const WaterKinematics& water, double step_s);

    /// Returns all that later steps depend on, wakes included: 1,300 bytes a body, 800 more with
    /// given coefficients, and 16 a cell of its wake. Call it as DynamicWaves::save_state(): after
    /// complete(), before the first command of the tick.
    std::vector<std::uint8_t> save_state() const;
    /// Restores a saved state, on any machine of equal byte order. Each saved hull must be one
    /// that was added to this set. Restore the dynamic waves first.
    /// \throws std::invalid_argument  if a hull is unknown, the waves have another texel, or the
    ///                                bytes are damaged; nothing is changed then
    void restore_state(std::span<const std::uint8_t> saved);

   private:
    /// Hulls of equal digests.
    struct Kind {
        /// \param waves  null: no wakes
        Kind(const Hull& of, std::uint64_t its_digest, DynamicWaves* waves);
        Hull hull;
        std::uint64_t digest;
        std::optional<HullWake> wake;  ///< copied for each body; none without waves
    };
    struct Motion {
        HullState state;
        HullInputs inputs = {};
        HullLoads loads = {};
    };
    struct Body : Motion {
        std::uint32_t number;
        const Kind* kind;
        std::unique_ptr<HullWake> wake;
    };
    struct Reader;
    struct Jobs;

    std::size_t index_of(std::uint32_t number) const;
    const Body& body_of(std::uint32_t number) const { return bodies_[index_of(number)]; }
    template <class Use>
    static void for_each_number(Motion& motion, Use use);
    template <class Use>
    static void for_each_number(HullWake& wake, Use use);
    template <class Use>
    static void for_each_of_radiation(Motion& motion, Use use);
    static void require_few(std::span<const Body> bodies);
    Body read_body(Reader& from, std::uint32_t last_number) const;

    DynamicWaves* waves_;
    std::deque<Kind> kinds_;    // bodies point to them
    std::vector<Body> bodies_;  // in ascending order of numbers
    std::uint32_t next_number_ = 1;
    std::unique_ptr<Jobs> jobs_;
};

}  // namespace pelagic
