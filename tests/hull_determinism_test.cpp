// Trajectories and spray of hulls are bit-identical on every instruction set, executor and
// compiler, and after a rollback.
#include <gtest/gtest.h>

#include <bit>
#include <cfenv>
#include <cstdint>
#include <memory>
#include <vector>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/floating/hull_spray.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/emulated.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/hull_states.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

constexpr double hull_step_s = 1.0 / 64;  // times are exact in every rounding mode

/// Adds hulls on a grid, above the water, at rest and in it, each with another force.
void add_fleet(FloatingBodies& bodies, const Hull& hull, int count) {
    for (int i = 0; i < count; ++i) {
        HullState state = hull.at_rest(i % 5 * 30.0, i / 5 * 30.0, 0.3 * i);
        state.position_m.y += i % 3;
        state.angular_velocity_radps = {0.3, -0.2, 0.1 * (i % 4)};
        bodies.set_inputs(bodies.add(hull, state),
                          {.force = {.force_n = {100.0 * i, 0, 50}}, .wind_mps = {10, 0, 3}});
    }
}

std::uint64_t trajectory_hash(Isa isa, std::shared_ptr<Executor> executor) {
    Ocean ocean(rough_sea, {.executor = executor, .isa = isa, .queries = true, .depth = true});
    const Hull hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 3500});
    FloatingBodies bodies(executor);
    add_fleet(bodies, hull, 16);
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
    for (int i = 0; i < (is_sanitized ? 10 : 60); ++i) {
        bodies.step(ocean.frame_at((i + 0.5) * hull_step_s), hull_step_s);
        for (std::uint32_t number = 1; number <= bodies.size(); ++number) {
            const HullState& state = bodies.state(number);
            for (int axis = 0; axis < 3; ++axis)
                for (const double value :
                     {state.position_m[axis], state.velocity_mps[axis], state.angular_velocity_radps[axis],
                      state.orientation[axis], bodies.loads(number).total().force_n[axis]})
                    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;
        }
    }
    return hash;
}

TEST(HullDeterminism, TrajectoriesAreBitIdenticalOnEachInstructionSetAndThreadCount) {
    const std::uint64_t expected = trajectory_hash(isas_here().front(), make_serial_executor());
    for (const Isa isa : isas_here())
        for (const ExecutorKind& kind : executor_kinds())
            EXPECT_EQ(trajectory_hash(isa, kind.make(kind.threads)), expected) << name_of(isa) << kind.name;
    if (!is_sanitized) {
        EXPECT_EQ(expected, 14699591400000694664u)
            << "the same from every compiler; a change of physics changes it, too";
    }
}

TEST(HullDeterminism, AHullOfASetMovesAsOneAlone) {
    Ocean ocean(rough_sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
    const Hull hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 3500});
    FloatingBodies bodies(make_serial_executor());
    add_fleet(bodies, hull, 3);
    HullState alone = bodies.state(2);
    HullWorkspace workspace;
    for (int i = 0; i < 50; ++i) {
        const Frame& frame = ocean.frame_at((i + 0.5) * hull_step_s);
        bodies.step(frame, hull_step_s);
        hull.step(WaterQuery(frame), alone, hull_step_s, bodies.inputs(2), workspace);
    }
    EXPECT_TRUE(equal(alone, bodies.state(2)));
}

// A job of a set steps several hulls. Small ones feel waves of cascades that large ones leave out.
TEST(HullDeterminism, AHullOfASetIsIndependentOfTheSizesOfOthers) {
    SeaState sea = rough_sea;
    sea.cascades = 4;
    sea.resolution = 64;
    sea.patch_size_m = 0;
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
    const Hull boat(boat_mesh(30, 8, 5), {.mass_kg = 400'000}), buoy(box_mesh({0.5, 0.5, 0.5}), {.mass_kg = 60});
    FloatingBodies bodies(make_serial_executor());
    for (int i = 0; i < 130; ++i) {
        const Hull& hull = i % 2 ? buoy : boat;
        bodies.add(hull, hull.at_rest(40.0 * i, 3.0 * i));
    }
    HullState alone[] = {bodies.state(1), bodies.state(2)};
    HullWorkspace workspace;
    for (int i = 0; i < 5; ++i) {
        const Frame& frame = ocean.frame_at((i + 0.5) * hull_step_s);
        bodies.step(frame, hull_step_s);
        boat.step(WaterQuery(frame), alone[0], hull_step_s, {}, workspace);
        buoy.step(WaterQuery(frame), alone[1], hull_step_s, {}, workspace);
    }
    EXPECT_TRUE(equal(alone[0], bodies.state(1)));
    EXPECT_TRUE(equal(alone[1], bodies.state(2)));
}

/// A boat under way in waves, with all that it does to the water.
struct Voyage {
    Ocean ocean;
    Hull hull;
    FloatingBodies bodies;
    HullSpray thrown;
    HullWorkspace workspace;
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a of the emitters
    std::size_t droplets = 0;

    explicit Voyage(Isa isa, const std::shared_ptr<Executor>& executor,
                    const HullMesh& mesh = boat_mesh(6, 2.2, 1.2), const SeaState& sea = rough_sea)
        : ocean(sea, {.executor = executor,
                      .isa = isa,
                      .queries = true,
                      .depth = true,
                      .dynamic_waves = DynamicWavesOptions{.resolution = 128, .side_m = 64, .border_m = 12}}),
          hull(mesh, {.mass_kg = 2000}),
          bodies(executor, &ocean.dynamic_waves()),
          thrown(hull) {
        HullState state = hull.at_rest(3, -2, 0.4);
        state.velocity_mps = {8, 0, 3};
        bodies.set_inputs(bodies.add(hull, state), {.force = {.force_n = {9000, 0, 3000}}});
    }

    void advance(int from, int to) {
        for (int tick = from; tick < to; ++tick) {
            ocean.schedule(tick * hull_step_s);
            const Frame& frame = ocean.complete();
            bodies.press(frame, hull_step_s);
            bodies.step(frame, hull_step_s);
            thrown.update(WaterQuery(frame), bodies.state(1), bodies.loads(1), hull_step_s, workspace,
                          bodies.inputs(1).wake);
            for (const Disturbance& foam : thrown.foam()) ocean.dynamic_waves().add_impulse(foam);
            droplets += thrown.emitters().size();
            for (const SprayEmitter& emitter : thrown.emitters())
                for (const double value :
                     {emitter.time_s, emitter.x_m, emitter.y_m, emitter.z_m, emitter.velocity_x_mps,
                      emitter.velocity_y_mps, emitter.velocity_z_mps, emitter.drop_mm, thrown.masses_kg()[0]})
                    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;
        }
    }
};

TEST(HullDeterminism, SprayIsBitIdenticalOnEachInstructionSetAndThreadCount) {
    const auto hash = [](Isa isa, const std::shared_ptr<Executor>& executor) {
        Voyage voyage(isa, executor);
        voyage.advance(0, 60);
        EXPECT_GT(voyage.droplets, 20u);
        return voyage.hash ^ hash_of(voyage.ocean.dynamic_waves().view());
    };
    const std::uint64_t expected = hash(isas_here().front(), make_serial_executor());
    // Two kinds, because a voyage takes 17 s under qemu.
    const std::vector<ExecutorKind> kinds = executor_kinds();
    for (const Isa isa : isas_here())
        for (const ExecutorKind* kind : {&kinds.front(), &kinds.back()})
            EXPECT_EQ(hash(isa, kind->make(kind->threads)), expected) << name_of(isa) << kind->name;
    EXPECT_EQ(expected, 9683223793150544429u) << "the same from every compiler; a change of physics changes it, too";
}

#if !defined(__wasm__)  // WebAssembly has one rounding mode
// Mesh, hull, wake, spray, frames and steps, all in the caller's rounding mode.
TEST(HullDeterminism, HullsDoNotDependOnTheCallersRoundingMode) {
    const HullMesh mesh = boat_mesh(6, 2.2, 1.2);  // in the default mode
    const auto hash = [&](const std::shared_ptr<Executor>& executor) {
        Voyage voyage(choose_isa(), executor, HullMesh(mesh.vertices(), mesh.triangles()));
        voyage.advance(0, 30);
        const HullState state = voyage.bodies.state(1);
        std::uint64_t sum = voyage.hash ^ hash_of(voyage.ocean.dynamic_waves().view());
        for (int axis = 0; axis < 3; ++axis) sum = sum * 31 + std::bit_cast<std::uint64_t>(state.position_m[axis]);
        HullState apart = state;
        HullWorkspace workspace;
        const WaterQuery water(voyage.ocean.frame_at(1));
        const HullLoads loads = voyage.hull.loads(water, apart, hull_step_s, {}, workspace);
        voyage.hull.accelerate(apart, loads, hull_step_s);
        voyage.hull.step(water, apart, hull_step_s, {}, workspace);
        for (const double hitch_s : {0.25, 0.7}) voyage.bodies.step(water.frame(), hitch_s);
        const glm::dvec3 origin_m = voyage.hull.mesh_origin_m(apart),
                         rest_m = voyage.hull.at_rest(water, 1, 2, 3).position_m;
        for (int axis = 0; axis < 3; ++axis)
            for (const double value :
                 {apart.position_m[axis], apart.velocity_mps[axis], origin_m[axis], rest_m[axis],
                  voyage.bodies.state(1).position_m[axis]})
                sum = sum * 31 + std::bit_cast<std::uint64_t>(value);
        return sum;
    };
    const std::uint64_t expected = hash(make_serial_executor());
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
        for (const bool has_threads : {false, true}) {
            if (is_emulated && has_threads) continue;  // a voyage takes 9 s under qemu
            std::fesetround(mode);
            const std::uint64_t found = hash(has_threads ? make_thread_executor(2) : make_serial_executor());
            EXPECT_EQ(std::fegetround(), mode);
            std::fesetround(FE_TONEAREST);
            EXPECT_EQ(found, expected) << mode << has_threads;
        }
}
#endif

// In crossing systems that lean.
TEST(HullDeterminism, SprayAndFoamReplay30TicksBitEqual) {
    SeaState crossing = rough_sea;
    crossing.systems = {{.height_m = 1.5, .peak_period_s = 8, .direction_rad = 2},
                        {.wind_speed_mps = 9, .direction_rad = -1}};
    crossing.lean = 0.5;
    Voyage voyage(choose_isa(), make_thread_executor(2), boat_mesh(6, 2.2, 1.2), crossing);
    voyage.advance(0, 40);
    voyage.ocean.schedule(40 * hull_step_s);
    voyage.ocean.complete();
    const std::vector<std::uint8_t> waves = voyage.ocean.dynamic_waves().save_state();
    const std::vector<std::uint8_t> bodies = voyage.bodies.save_state();
    const HullSpray thrown = voyage.thrown;
    const auto replay = [&] {
        voyage.hash = 0;
        voyage.advance(40, 71);
        return std::pair(voyage.hash, hash_of(voyage.ocean.dynamic_waves().view()));
    };
    const auto once = replay();
    EXPECT_NE(once.first, 0u) << "it throws water";
    voyage.ocean.dynamic_waves().restore_state(waves);
    voyage.bodies.restore_state(bodies);
    voyage.thrown = thrown;
    EXPECT_EQ(replay(), once);
}

}  // namespace
}  // namespace pelagic
