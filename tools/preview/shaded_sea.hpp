// An image of the sea for who wants to know what an export holds: drawn on the CPU, without GL, in a fraction of a second.
//
// A grid of reference points, about one for each pixel of the image, is moved by the sum of the cascades and drawn with a depth
// buffer. Light: what a smooth sky and a sun leave on a rough water surface (GGX, Walter et al. 2007; Schlick 1994), whose
// roughness is the variance of the slopes that a pixel does not show (LEAN mapping, Olano and Baker 2010), and white foam.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::tools {

class ShadedSea {
   public:
    /// The camera stands over the origin, higher over longer and higher waves, and looks towards where the wind comes from.
    /// \param width, height  of the image, at least 2
    ShadedSea(const SeaState& sea, int width, int height, std::shared_ptr<Executor> executor);
    ~ShadedSea();

    int width() const;
    int height() const;

    /// RGBA8 for a screen (sRGB), the upper row first; the same bits for any thread count and instruction set. Valid until the
    /// next call. \pre the frame has slopes and foam
    const std::vector<std::uint8_t>& draw(const Frame& frame);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::tools
