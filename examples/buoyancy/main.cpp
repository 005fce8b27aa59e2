// Three boats in a storm with each other's wakes. The next frame is computed while the boats query
// the current one.
//
//   buoyancy [FOLDER [SECONDS]]     writes FOLDER/trace.csv and FOLDER/trace.svg
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "pelagic/examples/buoyancy/box_wake.hpp"
#include "pelagic/examples/buoyancy/floating_box.hpp"
#include "pelagic/examples/buoyancy/trace.hpp"
#include "pelagic/sim/ocean.hpp"

namespace {

using namespace pelagic;
using namespace pelagic::buoyancy;

constexpr double step_s = 1.0 / 60;
// Time before the trace: the boats start at rest in a moving sea; covers the barge's launch_s()
// too.
constexpr double settling_s = 30;

/// Texels of 0.5 m resolve the dinghy; the side suffices for the barge and a border.
const DynamicWavesOptions answering{.resolution = 512, .side_m = 256, .border_m = 48};

struct Boat {
    const char* name;
    BoxOptions box;
};

const Boat boats[] = {
    {"dinghy 4 m", {.length_m = 4, .height_m = 0.9, .beam_m = 1.7, .mass_kg = 1100, .centre_of_mass_m = -0.1}},
    {"yacht 12 m", {.length_m = 12, .height_m = 2.5, .beam_m = 4, .mass_kg = 36'000, .centre_of_mass_m = -0.4}},
    {"barge 80 m", {.length_m = 80, .height_m = 6, .beam_m = 20, .mass_kg = 4'100'000, .centre_of_mass_m = 0}},
};

struct Options {
    std::filesystem::path folder = "out/buoyancy";
    double seconds = 60;
};

/// Empty if they can be understood, else what is wrong.
std::string parse(int argc, char** argv, Options& options) {
    if (argc > 1 && argv[1][0] == '-')
        return "unknown option " + std::string(argv[1]) + ", expected [FOLDER [SECONDS]]";
    if (argc > 3) return "unexpected argument " + std::string(argv[3]) + ", expected [FOLDER [SECONDS]]";
    if (argc > 1) options.folder = argv[1];
    if (options.folder.empty()) return "FOLDER is empty, expected the name of a folder";
    if (argc > 2) {
        char* end = nullptr;
        options.seconds = std::strtod(argv[2], &end);
        if (end == argv[2] || *end != 0 || !(options.seconds >= 1 && options.seconds <= 3600))
            return "SECONDS is " + std::string(argv[2]) + ", expected a number from 1 to 3600";
    }
    return {};
}

SeaState storm() {
    for (const SeaPreset& preset : sea_presets())
        if (preset.name == "storm") return preset.sea;
    return {};
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error && !std::filesystem::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
    if (error) throw std::runtime_error(folder.string() + ": " + error.message());
}

std::vector<BoatTrace> sail(double seconds) {
    Ocean ocean(storm(), {.queries = true, .velocities = true, .dynamic_waves = answering});
    std::vector<FloatingBox> boxes;
    std::vector<BoatTrace> traces;
    for (const Boat& boat : boats) {
        FloatingBox& box = boxes.emplace_back(boat.box);
        // Side by side, with bows downwind.
        box.state().position_m.z = 20 * static_cast<double>(traces.size());
        traces.push_back({boat.name, {}});
    }

    std::vector<BoxWake> wakes;
    for (const FloatingBox& box : boxes) wakes.emplace_back(ocean, box);

    HullWater hull;
    const int settling = static_cast<int>(std::lround(settling_s / step_s));
    const int steps = static_cast<int>(std::lround(seconds / step_s));
    ocean.schedule(-settling * step_s);
    for (int i = -settling; i <= steps; ++i) {
        const Frame& frame = ocean.complete();
        for (std::size_t boat = 0; boat < boxes.size(); ++boat) wakes[boat].press(ocean, boxes[boat], step_s);
        const glm::dvec3 middle = boxes[1].state().position_m;
        ocean.dynamic_waves().set_center(middle.x, middle.z);
        ocean.schedule((i + 1) * step_s);  // computed while the boats query this frame
        step(boxes, SurfaceQuery(frame), step_s, hull, wakes);
        if (i < 0) continue;
        for (std::size_t boat = 0; boat < boxes.size(); ++boat)
            traces[boat].moments.push_back({i * step_s, boxes[boat].heave_m(), attitude_of(boxes[boat].state())});
    }
    return traces;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (const std::string problem = parse(argc, argv, options); !problem.empty()) {
        std::fprintf(stderr, "buoyancy: %s\n", problem.c_str());
        return 2;
    }
    try {
        make_folder(options.folder);  // first, to fail early
        const std::vector<BoatTrace> traces = sail(options.seconds);
        write_csv(options.folder / "trace.csv", traces);
        write_svg(options.folder / "trace.svg", "Three boxes in a storm, significant wave height 8 m", traces);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "buoyancy: %s\n", error.what());
        return 1;
    }
    return 0;
}
