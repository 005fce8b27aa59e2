// The frame loop of a game without rendering: completes a frame, schedules the next, queries
// heights, and reads the cascades.
#include <cstdio>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"

int main() {
    pelagic::Ocean ocean({.wind_speed_mps = 9}, {.queries = true});
    const std::vector<double> buoys_x = {10, 20, 30}, buoys_z = {5, 5, 5};
    std::vector<float> heights(buoys_x.size());

    ocean.schedule(0);
    for (int n = 1; n <= 5; ++n) {
        const pelagic::Frame& frame = ocean.complete();  // scheduled one frame ago
        ocean.schedule(n / 90.0);                        // computed while this frame is drawn
        const pelagic::SurfaceQuery water(frame);
        water.sample({.x = buoys_x, .z = buoys_z}, {.height_m = heights});
        std::printf("%.4f s: hash %016llx, buoys at %.3f %.3f %.3f m, cascades of", frame.time_s,
                    static_cast<unsigned long long>(hash_of(frame)), heights[0], heights[1], heights[2]);
        // A renderer uploads each cascade's textures here: displacement_rgba16f, slopes_rgba8 and
        // moments_rgba8.
        for (const pelagic::Cascade& cascade : frame.cascades) std::printf(" %g", cascade.grid.side_m);
        std::printf(" m\n");
    }
}
