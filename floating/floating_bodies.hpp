// A set of floating hulls in the water of an ocean: they are found by number, make wakes and have
// one saved state.
//
//   FloatingBodies bodies(make_default_executor(), &ocean.dynamic_waves());
//   const std::uint32_t boat = bodies.add(hull, hull->at_rest(10, -4));  // hull: std::shared_ptr
//   const Frame& frame = ocean.complete();
//   bodies.press(frame, tick_s);
//   ocean.schedule(next_s);                                              // a tick later
//   bodies.step(SurfaceQuery(frame), tick_s);
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/floating/floating_hulls.hpp"
#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/hull_wake.hpp"
#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

/// One thread at a time uses an object. With waves, add(), remove(), clear() and press() enqueue
/// commands, so that thread also uses the waves and their ocean.
class FloatingBodies {
   public:
    /// Creates an empty set.
    /// \param waves  receives the wakes of all bodies and outlives the calls; null: no wakes. The
    ///               destructor does not use it, so the pressures of bodies remain: see clear().
    explicit FloatingBodies(std::shared_ptr<Executor> executor, DynamicWaves* waves = nullptr);
    ~FloatingBodies();
    FloatingBodies(const FloatingBodies&) = delete;  // the jobs point into it
    FloatingBodies& operator=(const FloatingBodies&) = delete;

    /// Adds a body without inputs and returns its number, which is never reused. The set keeps
    /// the hull, also after the body is removed, for restore_state().
    /// \throws std::invalid_argument  for a null hull, Hull::check(state), and what
    ///                                DynamicWaves::add_footprint() throws; nothing is changed then
    std::uint32_t add(std::shared_ptr<const Hull> hull, const HullState& state);
    /// Removes a body, and its pressure from the next tick on. Does nothing if there is none of
    /// that number.
    void remove(std::uint32_t number);
    /// Removes all bodies and their pressures.
    void clear();
    /// Returns the number of bodies.
    std::size_t size() const { return bodies_.size(); }

    /// Returns a body's hull.
    /// \throws std::invalid_argument  here and below, if there is no body of that number: "number is
    ///                                7, expected that of a body"; nothing is changed then
    const Hull& hull(std::uint32_t number) const;
    const HullState& state(std::uint32_t number) const;    ///< after the last step
    const HullInputs& inputs(std::uint32_t number) const;  ///< of the next step
    const HullLoads& loads(std::uint32_t number) const;    ///< of the last step
    /// \throws std::invalid_argument  Hull::check(state)
    void set_state(std::uint32_t number, const HullState& state);
    /// Sets force and wind of the steps from now on. The inputs' wake is ignored.
    /// \throws std::invalid_argument  Hull::check(inputs)
    void set_inputs(std::uint32_t number, const HullInputs& inputs);

    /// Moves the pressures of wakes to the bodies, as HullWake::press(). Does nothing without
    /// waves.
    /// \param tick_s  time since the last call
    /// \throws std::invalid_argument  what HullWake::press() throws
    void press(const Frame& frame, double tick_s);
    /// Advances all bodies by a step, as FloatingHulls::step().
    /// \throws std::invalid_argument  what FloatingHulls::step() throws, with the number of the
    ///                                body: "body 3: "; nothing is changed then
    bool step(const SurfaceQuery& water, double step_s);

    /// Returns all that later steps depend on, wakes included: 1,300 bytes a body, and 16 a
    /// cell of its wake. Call it as DynamicWaves::save_state(): after complete(), before the first
    /// command of the tick.
    std::vector<std::uint8_t> save_state() const;
    /// Restores a saved state, on any machine of equal byte order. Each saved hull must be one
    /// that was added to this set. Restore the dynamic waves first.
    /// \throws std::invalid_argument  if a hull is unknown, the waves have another texel, or the
    ///                                bytes are damaged; nothing is changed then
    void restore_state(std::span<const std::uint8_t> saved);

   private:
    /// Hulls of equal digests.
    struct Kind {
        std::shared_ptr<const Hull> hull;
        std::uint64_t digest;
        std::optional<HullWake> wake;  ///< copied for each body; none without waves
    };
    struct Body {
        std::uint32_t number;
        const Kind* kind;
        std::unique_ptr<HullWake> wake;
    };
    struct Reader;

    const Kind& kind_of(std::shared_ptr<const Hull> hull);
    std::size_t index_of(std::uint32_t number) const;
    template <class Use>
    static void for_each_number(HullWake& wake, Use use);
    Body read_body(Reader& from, std::uint32_t last_number, FloatingHull& floating) const;

    DynamicWaves* waves_;
    FloatingHulls jobs_;
    std::deque<Kind> kinds_;           // bodies point to them
    std::vector<Body> bodies_;         // in ascending order of numbers
    std::vector<FloatingHull> hulls_;  // of bodies_
    std::uint32_t next_number_ = 1;
};

}  // namespace pelagic
