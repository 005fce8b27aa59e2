// Bakes the sky into a cube map with jobs. Level 0 holds atmosphere and clouds. The further levels
// hold reflections of increasing roughness. The shaders add the sun's disc behind the sea and its
// glint on the sea.
//
//   SkyBaker baker(executor, 256);
//   baker.schedule({.sun_elevation_rad = 0.5f});
//   if (baker.is_done()) sky_texture.upload(baker.complete());  // some frames later
#pragma once

#include <memory>

#include "pelagic/gl/sky/sky.hpp"
#include "pelagic/jobs/executor.hpp"

namespace pelagic::gl {

class SkyBaker {
   public:
    /// \param face_size  texels along a side of level 0: a power of two, [16, 2048]
    /// \throws std::invalid_argument if face_size is invalid
    SkyBaker(std::shared_ptr<Executor> executor, int face_size);
    ~SkyBaker();  ///< waits for jobs in flight
    SkyBaker(const SkyBaker&) = delete;
    SkyBaker& operator=(const SkyBaker&) = delete;

    /// Starts baking. \pre no sky is being baked
    /// \throws std::invalid_argument with the text of check(options) if an option is invalid
    void schedule(const SkyOptions& options);
    /// Returns true if complete() does not have to wait.
    bool is_done() const;
    /// Waits for the scheduled sky; the calling thread executes jobs meanwhile. The result is valid
    /// until the second schedule() after this call.
    const Sky& complete();

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
