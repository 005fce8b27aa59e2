// The sky as a cube map, baked by jobs: atmosphere and clouds in level 0, and in the levels behind it what mirrors of
// growing roughness show. The sun's disc is not in it: the shaders add it, behind the sea and as its glint.
//
//   SkyBaker baker(executor, 256);
//   baker.schedule({.sun_elevation_rad = 0.5f});
//   ... some frames later, when baker.is_done(): sky_texture.upload(baker.complete());
#pragma once

#include <memory>

#include "pelagic/gl/sky/sky.hpp"
#include "pelagic/jobs/executor.hpp"

namespace pelagic::gl {

class SkyBaker {
   public:
    /// \param face_size  a power of two, 16 to 2048; else std::invalid_argument
    SkyBaker(std::shared_ptr<Executor> executor, int face_size);
    ~SkyBaker();  ///< waits for work in flight
    SkyBaker(const SkyBaker&) = delete;
    SkyBaker& operator=(const SkyBaker&) = delete;

    /// Starts to bake; throws std::invalid_argument(check(options)). \pre no sky is being baked
    void schedule(const SkyOptions& options);
    bool is_done() const;
    /// Waits, helping. The sky stays as it is until the second schedule() from now.
    const Sky& complete();

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
