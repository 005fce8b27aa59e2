// Trajectories of hulls are bit-identical on every instruction set, executor and compiler, and
// after a rollback.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

#include "pelagic/floating/floating_hulls.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

constexpr double step_s = 1.0 / 60;

/// Hulls on a grid, above the water, at rest and in it, each with another force.
std::vector<FloatingHull> fleet(const Hull& hull, int count) {
    std::vector<FloatingHull> hulls;
    for (int i = 0; i < count; ++i) {
        FloatingHull floating{.hull = &hull, .state = hull.at_rest(i % 5 * 30.0, i / 5 * 30.0, 0.3 * i)};
        floating.state.position_m.y += i % 3;
        floating.state.angular_velocity_radps = {0.3, -0.2, 0.1 * (i % 4)};
        floating.inputs = {.force = {.force_n = {100.0 * i, 0, 50}}, .wind_mps = {10, 0, 3}};
        hulls.push_back(floating);
    }
    return hulls;
}

const SeaState rough{.resolution = 64, .patch_size_m = 400, .wind_speed_mps = 17, .fetch_m = 400e3, .choppiness = 1};

std::uint64_t trajectory_hash(Isa isa, std::shared_ptr<Executor> executor) {
    Ocean ocean(rough, {.executor = executor, .isa = isa, .queries = true, .velocities = true});
    const Hull hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 3500});
    FloatingHulls jobs(executor);
    std::vector<FloatingHull> hulls = fleet(hull, 16);
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
    for (int i = 0; i < (is_sanitized ? 10 : 60); ++i) {
        jobs.step(SurfaceQuery(ocean.frame_at((i + 0.5) * step_s)), hulls, step_s);
        for (const FloatingHull& floating : hulls)
            for (int axis = 0; axis < 3; ++axis)
                for (const double value : {floating.state.position_m[axis], floating.state.velocity_mps[axis],
                                           floating.state.angular_velocity_radps[axis],
                                           floating.state.orientation[axis], floating.loads.total().force_n[axis]})
                    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;
    }
    return hash;
}

TEST(HullDeterminism, TrajectoriesAreBitIdenticalOnEachInstructionSetAndThreadCount) {
    const std::uint64_t expected = trajectory_hash(isas_here().front(), make_serial_executor());
    for (const Isa isa : isas_here())
        for (const ExecutorKind& kind : executor_kinds())
            EXPECT_EQ(trajectory_hash(isa, kind.make(kind.threads)), expected) << name_of(isa) << kind.name;
    if (!is_sanitized) {
        EXPECT_EQ(expected, 4668277731250335747u)
            << "the same from every compiler; a change of physics changes it, too";
    }
}

bool equal(const HullState& a, const HullState& b) {
    return a.position_m == b.position_m && a.orientation == b.orientation && a.velocity_mps == b.velocity_mps &&
           a.angular_velocity_radps == b.angular_velocity_radps && a.water_velocity_y_mps == b.water_velocity_y_mps &&
           a.submersion == b.submersion;
}

TEST(HullDeterminism, ARollbackOf30TicksReplaysBitEqual) {
    Ocean ocean(rough, {.executor = make_serial_executor(), .queries = true, .velocities = true});
    const Hull hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 3500});
    FloatingHulls jobs(make_serial_executor());
    std::vector<FloatingHull> hulls = fleet(hull, 3), saved;
    const auto advance = [&](int from, int to) {
        for (int i = from; i < to; ++i) jobs.step(SurfaceQuery(ocean.frame_at((i + 0.5) * step_s)), hulls, step_s);
    };
    advance(0, 20);
    saved = hulls;
    advance(20, 50);
    const std::vector<FloatingHull> once = hulls;
    hulls = saved;
    advance(20, 50);
    for (std::size_t i = 0; i < hulls.size(); ++i) EXPECT_TRUE(equal(hulls[i].state, once[i].state)) << i;
    // one hull without the batch
    HullState alone = fleet(hull, 3)[1].state;
    HullWorkspace workspace;
    for (int i = 0; i < 50; ++i)
        hull.step(SurfaceQuery(ocean.frame_at((i + 0.5) * step_s)), alone, step_s, hulls[1].inputs, workspace);
    EXPECT_TRUE(equal(alone, hulls[1].state));
}

}  // namespace
}  // namespace pelagic
