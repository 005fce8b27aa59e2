// Three boats in a storm, which make waves and float on those of each other. The next frame is
// computed while the boats use the current one.
//
//   boat [SECONDS] > motion.csv
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/examples/boat/boat_mesh.hpp"
#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/sim/ocean.hpp"

namespace {

using namespace pelagic;
using examples::boat_mesh;

constexpr double tick_s = 1.0 / 60;

struct Boat {
    const char* name;
    Hull hull;
};

SeaState storm() {
    for (const SeaPreset& preset : sea_presets())
        if (preset.name == "storm") return preset.sea;
    return {};
}

/// Returns SECONDS, or 0 if it is not a number from 1 to 3600.
double seconds_of(int argc, char** argv) {
    if (argc < 2) return 60;
    char* end = nullptr;
    const double seconds = std::strtod(argv[1], &end);
    return argc == 2 && end != argv[1] && *end == 0 && seconds >= 1 && seconds <= 3600 ? seconds : 0;
}

void print(double time_s, const Boat& boat, const HullState& state) {
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    const double pitch_rad = std::asin(axes[0].y), roll_rad = std::atan2(-axes[2].y, axes[1].y);
    std::printf("%.3f,%s,%.3f,%.2f,%.2f\n", time_s, boat.name, state.position_m.y - boat.hull.afloat().height_m,
                pitch_rad * 180 / std::numbers::pi, roll_rad * 180 / std::numbers::pi);
}

void sail(double seconds) {
    const Boat boats[] = {
        {"dinghy", Hull(boat_mesh(4, 1.7, 0.8), {.mass_kg = 350, .skeg_m2 = 0.16, .skeg_x_m = -1.6})},
        {"yacht", Hull(boat_mesh(12, 4, 2.5), {.mass_kg = 14'000,
                                               .centre_of_mass_m = glm::dvec3(-1, 1, 0),
                                               .skeg_m2 = 1.44,
                                               .skeg_x_m = -4.8})},
        {"ship", Hull(boat_mesh(60, 14, 9), {.mass_kg = 1'200'000,
                                             .centre_of_mass_m = glm::dvec3(-5, 4, 0),
                                             .skeg_m2 = 36,
                                             .skeg_x_m = -24})},
    };
    // 12 texels along the dinghy, and room for the ship.
    Ocean ocean(storm(), {.queries = true,
                          .depth = true,
                          .dynamic_waves = DynamicWavesOptions{.resolution = 512, .side_m = 160, .border_m = 20}});
    FloatingBodies bodies(make_default_executor(), &ocean.dynamic_waves());
    std::vector<std::uint32_t> numbers;
    for (const Boat& boat : boats)
        numbers.push_back(bodies.add(boat.hull, boat.hull.at_rest(0, 20.0 * static_cast<double>(numbers.size()))));
    const int ticks = static_cast<int>(std::lround(seconds / tick_s));
    std::puts("time_s,boat,heave_m,pitch_deg,roll_deg");
    ocean.schedule(0);
    for (int i = 0; i < ticks; ++i) {
        const Frame& frame = ocean.complete();
        bodies.press(frame, tick_s);
        const glm::dvec3 yacht_m = bodies.state(numbers[1]).position_m;
        ocean.dynamic_waves().set_center(yacht_m.x, yacht_m.z);
        ocean.schedule((i + 1) * tick_s);
        bodies.step(frame, tick_s);
        for (std::size_t j = 0; j < numbers.size(); ++j)
            print((i + 1) * tick_s, boats[j], bodies.state(numbers[j]));
    }
}

}  // namespace

int main(int argc, char** argv) {
    const double seconds = seconds_of(argc, argv);
    if (seconds == 0) {
        std::fprintf(stderr, "boat: SECONDS is %s, expected a number from 1 to 3600\n", argv[1]);
        return 2;
    }
    try {
        sail(seconds);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "boat: %s\n", error.what());
        return 1;
    }
    return 0;
}
