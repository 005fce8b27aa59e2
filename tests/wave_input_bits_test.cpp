// Wave inputs of applications are bit-identical on every instruction set, executor and compiler.
#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <utility>
#include <vector>

#include "pelagic/sim/gerstner_input.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/ripple_input.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/golden.hpp"

namespace pelagic {
namespace {

struct NamedSea {
    const char* name;
    SeaState sea;
};

/// Jobs of several rows, of one row and of all rows; a stack with rotated grids, and a pond.
std::vector<NamedSea> seas() {
    return {{"stack", {.cascades = 3, .resolution = 64, .wind_speed_mps = 12, .loop_period_s = 30}},
            {"smallest", {.resolution = 16, .patch_size_m = 40, .wind_speed_mps = 6, .loop_period_s = 30}},
            {"one-cascade", {.resolution = 128, .patch_size_m = 150, .wind_speed_mps = 12, .loop_period_s = 30}},
            {"pond", {.waves = WaveModel::pond, .resolution = 64, .loop_period_s = 30}}};
}

/// Returns waves for each of the cascades.
AnalyticSea waves() {
    AnalyticSea sea{.waves = {}, .choppiness = 0.9};
    double wavelength_m = 180;
    for (int i = 0; i < 20; ++i, wavelength_m *= 0.77)
        sea.waves.push_back({.amplitude_m = 0.003 * wavelength_m,
                             .wavelength_m = wavelength_m,
                             .direction_rad = 0.61 * (i % 7) - 1.9,
                             .phase_rad = 0.43 * (i % 11) - 2});
    return sea;
}

/// Returns FNV-1a of the velocities, which hash_of() does not include.
std::uint64_t velocity_hash_of(const Frame& frame) {
    std::uint64_t hash = 14695981039346656037u;
    for (const Cascade& cascade : frame.cascades)
        for (const PlaneView& plane : {cascade.velocity_x, cascade.velocity_y, cascade.velocity_z})
            for (int j = 0; j < plane.resolution; ++j)
                for (int i = 0; i < plane.resolution; ++i)
                    hash = (hash ^ std::bit_cast<std::uint32_t>(plane.at(i, j))) * 1099511628211u;
    return hash;
}

/// Returns hashes of two consecutive frames with foam; the second frame has other inputs.
std::vector<std::uint64_t> frames_of(const SeaState& sea, Isa isa, std::shared_ptr<Executor> executor) {
    const auto batch = std::make_shared<GerstnerInput>(waves());
    const auto rings = std::make_shared<RippleInput>(
        Ripple{.x_m = 7.3, .z_m = -2.9, .wavelength_m = 9, .amplitude_m = 0.5, .reach_m = 40});
    Ocean ocean(sea, {.executor = std::move(executor),
                      .isa = isa,
                      .velocities = Velocities::drawn,
                      .slopes = true,
                      .foam = true,
                      .inputs = {batch, rings}});
    std::vector<std::uint64_t> hashes;
    const auto note = [&](const Frame& frame) {
        hashes.insert(hashes.end(), {hash_of(frame), foam_hash_of(frame), velocity_hash_of(frame)});
    };
    note(ocean.frame_at(4.321));
    rings->set({.x_m = -3, .z_m = 1e6, .wavelength_m = 13, .amplitude_m = 0.25, .phase_rad = 1});
    note(ocean.frame_at(4.444));
    return hashes;
}

TEST(WaveInputBits, AreTheGoldenOnesOnEveryInstructionSetAndExecutor) {
    for (const Computing& on : computings()) {
        SCOPED_TRACE(on.name);
        GoldenRows rows("input");
        for (const auto& [name, sea] : seas()) {
            rows.begin(name);
            for (const std::uint64_t hash : frames_of(sea, on.isa, on.executor())) rows.add(hash);
        }
        rows.expect();
    }
}

}  // namespace
}  // namespace pelagic
