// Preview images of a sea, rendered on the CPU without OpenGL in less than a second.
//
// A grid of reference points, about one per pixel, is displaced by the sum of the cascades and
// rasterised with a depth buffer. A smooth sky and a sun light a rough water surface (GGX, Walter
// et al. 2007; Schlick 1994) and white foam. The roughness is the variance of slopes that a pixel
// does not resolve (LEAN mapping, Olano and Baker 2010).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::tools {

class ShadedSea {
   public:
    /// The camera is above the origin, higher for longer and higher waves, and looks into the wind.
    /// \param width, height  size of the image, at least 2
    ShadedSea(const SeaState& sea, int width, int height, std::shared_ptr<Executor> executor);
    ~ShadedSea();

    int width() const;
    int height() const;

    /// Renders a frame. Returns RGBA8 pixels in sRGB, the upper row first, valid until the next
    /// call. The pixels are bit-identical for every thread count and instruction set. \pre the
    /// frame has slopes and foam
    const std::vector<std::uint8_t>& draw(const Frame& frame);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::tools
