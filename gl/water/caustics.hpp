// Caustics: sunlight on a level plane below the waves, relative to the sunlight that flat water
// transmits to that plane.
//
//   CausticsBaker baker(executor);
//   baker.schedule(frame, {.depth_m = 6, .sun = sky.sun_direction});
//   ... in the next frame: renderer.set_caustics(baker.complete());
//
// Each grid cell of the surface refracts its sunlight to the plane. Irradiance there grows by the
// factor by which the cell's area shrinks.
//
// Only one cascade is refracted: the cascade whose waves focus nearest the depth of the plane.
// Waves of curvature c focus light n / ((n - 1) c) below their crests (the paraxial focus of a lens
// of radius 1/c). Longer waves have not focused at that depth and have little effect. Rays of
// shorter waves have already crossed and mixed, so shorter waves blur the image according to the
// variance of their slopes. A cascade is periodic: light that leaves it on one side enters on the
// other, and the mean is 1.
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
    double depth_m = 6;  ///< depth of the plane below the still-water level; [0.001, 1000]
    /// Unit vector towards the sun. Elevations below 6 degrees are raised to 6 degrees.
    glm::vec3 sun{0, 1, 0};
};

/// Returns an empty string if the options are valid, else a message about the first invalid field.
std::string check(const CausticsOptions& options);

/// Baked caustics. Identical frames and options give identical texels for any number of threads.
struct Caustics {
    static constexpr int side = 256;  ///< texels along each axis
    static constexpr int levels = 9;

    CausticsOptions options;
    /// Sunlight that enters through all cells, relative to a level cascade. It differs from 1 only
    /// where folds of the surface hide cells. The texels are divided by it.
    double light = 1;
    /// Grid of the cascade that was refracted. The centre of texel (i, j) lies at
    /// (i + 1/2, j + 1/2) side_m / side along its axes.
    CascadeGrid grid;
    /// Relative irradiance as half floats, level after level; each level is the box mean of the
    /// previous one. Texels are indexed by the point where the sun's ray would enter flat water. To
    /// sample a point on the floor, project it up to the surface along the sun's ray in flat water.
    std::vector<std::uint16_t> halves;
};

/// Returns the depth, in metres, at which the cascade's waves concentrate light most:
/// n / ((n - 1) 1.5 c), where c is the root mean square of the sum of both curvatures.
double focus_of(const Cascade& cascade);

/// Returns the depth at which to focus caustics, in metres. For an even floor it is the sea's
/// depth; for a height field it is the median of its depths between 0.5 and 12 m. It is 8 m for
/// deeper floors, where only shafts of light show.
double caustics_depth_m(const SeaFloor& floor, double sea_depth_m);

class CausticsBaker {
   public:
    /// Creates a baker whose jobs run on an executor.
    explicit CausticsBaker(std::shared_ptr<Executor> executor);
    ~CausticsBaker();  ///< Waits for jobs in flight.
    CausticsBaker(const CausticsBaker&) = delete;
    CausticsBaker& operator=(const CausticsBaker&) = delete;

    /// Starts baking. The frame's views must stay valid until complete().
    /// \pre no bake is in progress
    /// \throws std::invalid_argument  with the text of check(options), and without planes
    ///     (OceanOptions::planes)
    void schedule(const Frame& frame, const CausticsOptions& options);
    /// Returns whether complete() would not wait.
    bool is_done() const;
    /// Waits for the bake and runs jobs meanwhile. The result is valid until the next complete().
    const Caustics& complete();

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
