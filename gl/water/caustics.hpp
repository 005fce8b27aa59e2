// Caustics: sunlight on a level plane below the waves, as a part of what flat water would let through there.
//
//   CausticsBaker baker(executor);
//   baker.schedule(frame, {.depth_m = 6, .sun = sky.sun_direction});
//   ... in the next frame: renderer.set_caustics(baker.complete());
//
// A grid cell of the surface carries its sunlight to where its refracted corners meet the plane; what its area there has
// shrunk to, light has grown by. That is done for the one cascade whose waves focus nearest that depth: waves of curvature c gather
// light n / ((n - 1) c) below their crests (the paraxial focus of a lens whose radius is 1/c), so longer ones are still a
// plain swell there, and shorter ones have mixed their rays long before: they blur it, by the scatter of their slopes.
// A cascade repeats, so all light that leaves it on one side comes back on the other: the mean is 1.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "pelagic/gl/water/sea_floor.hpp"
#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::gl {

struct CausticsOptions {
    double depth_m = 6;      ///< of the plane below rest; [0.001, 1000]
    glm::vec3 sun{0, 1, 0};  ///< towards it, a unit vector; lower than 6 degrees it counts as that high
};

/// Empty if usable, else the first bad field.
std::string check(const CausticsOptions& options);

/// The same for the same frame and options, whoever baked it with however many threads.
struct Caustics {
    static constexpr int side = 256;  ///< texels
    static constexpr int levels = 9;

    CausticsOptions options;
    /// What all cells take in, over what a level cascade does: 1 but for what folds of the surface hide. The texels are divided by it.
    double light = 1;
    CascadeGrid
        grid;  ///< of the cascade that made it: texel (i, j)'s middle is (i + 1/2, j + 1/2) side_m / side along its axes
    /// Half floats, level after level, each the box mean of the one before. A texel is where light came through the surface had
    /// it been flat: a place on the floor is looked up as seen along the sun's ray in flat water.
    std::vector<std::uint16_t> halves;
};

/// The depth in which the cascade's waves gather most light: n / ((n - 1) 1.5 c), c being the root of the mean square of the sum
/// of both curvatures.
double focus_of(const Cascade& cascade);

/// Whether anybody could see them: an eye in the water or soon there, or a floor within sight.
/// \param above_water_m  the eye's height above the surface below it
bool shows_caustics(const SeaFloor& floor, double sea_depth_m, double above_water_m);

/// Where to focus them: at an even floor, or at the middle of what a field has within 12 m; deeper than that, for shafts of light,
/// 8 m.
double caustics_depth_m(const SeaFloor& floor, double sea_depth_m);

class CausticsBaker {
   public:
    explicit CausticsBaker(std::shared_ptr<Executor> executor);
    ~CausticsBaker();  ///< waits for work in flight
    CausticsBaker(const CausticsBaker&) = delete;
    CausticsBaker& operator=(const CausticsBaker&) = delete;

    /// Starts; the frame's views must stay valid until complete(). Throws std::invalid_argument(check(options)).
    /// \pre none is being baked
    void schedule(const Frame& frame, const CausticsOptions& options);
    bool is_done() const;
    /// Waits, helping. Valid until the next complete().
    const Caustics& complete();

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
