#include "pelagic/tools/benchmark/headset_table.hpp"

#include <cstdio>
#include <string>

#include "pelagic/tools/benchmark/machine.hpp"

namespace pelagic::tools {
namespace {

/// Refresh rates of standalone headsets' displays.
constexpr int display_hz[] = {72, 90, 120};

/// Returns the percentage of a display's frame.
double percent_of_frame(double ms, int hz) { return 100 * ms * hz / 1000; }

void print_row(const FrameTiming& frame) {
    std::printf("%-6s%8d%9.3f%9.3f to %-7.3f|", frame.sea().c_str(), frame.threads, frame.ms.median, frame.ms.low,
                frame.ms.high);
    for (const int hz : display_hz) std::printf("%7.2f %%", percent_of_frame(frame.ms.median, hz));
    std::printf(" |%7.2f%9.3f\n", static_cast<double>(frame.memory_bytes) / 1e6,
                static_cast<double>(frame.upload_bytes) / 1e6);
}

}  // namespace

std::vector<SeaState> headset_seas() {
    return {{.resolution = 128, .patch_size_m = 250},
            {.resolution = 256, .patch_size_m = 250},
            {.cascades = 3, .resolution = 64},
            {.cascades = 3, .resolution = 128},
            {.cascades = 4, .resolution = 128}};
}

void print_headset_timings(const Timings& timings) {
    std::printf("%s, %s, %s, pelagic " PELAGIC_VERSION "\n\n", cpu_name().c_str(), compiler_name().c_str(),
                std::string(name_of(timings.frames.front().isa)).c_str());
    std::printf("%-6s%8s%9s%20s|", "", "", "ms", "ms,");
    for (const int hz : display_hz) std::printf("%6d Hz", hz);
    std::printf(" |%7s%9s\n", "memory", "uploaded");
    std::printf("%-6s%8s%9s%20s|", "sea", "threads", "median", "quartiles");
    for (const int hz : display_hz) std::printf("%6.1f ms", 1000.0 / hz);
    std::printf(" |%7s%9s\n", "MB", "MB");
    for (const FrameTiming& frame : timings.frames) print_row(frame);
    std::printf(
        "\nsea: cascades x N; Hz: percentage of a display's frame; uploaded: textures of each frame, all levels\n");
    std::printf("docs/integrations/vr.md lists modelled times of a headset's cores.\n");
}

}  // namespace pelagic::tools
