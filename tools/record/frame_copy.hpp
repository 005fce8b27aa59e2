// A copy of a frame that does not refer to the ocean's memory.
#pragma once

#include <memory>
#include <vector>

#include "pelagic/sim/frame.hpp"

namespace pelagic::tools {

/// Copies every view of a frame, so that files can be encoded while the ocean computes. Textures
/// for drawing, which no file holds, are left out: displacement_rgba16f, slopes_rgba8 and
/// moments_rgba8 are empty.
class FrameCopy {
   public:
    explicit FrameCopy(const Frame& frame);
    FrameCopy(const FrameCopy&) = delete;

    const Frame& frame() const { return frame_; }

   private:
    Frame frame_;
    std::vector<Cascade> cascades_;
    std::vector<std::shared_ptr<const void>> memory_;  ///< of the views
};

}  // namespace pelagic::tools
