// A frame that is not computed by an ocean: its cascade has values that a test sets.
#pragma once

#include "pelagic/sim/frame.hpp"

namespace pelagic {

struct OneCascadeFrame {
    OneCascadeFrame() { frame.cascades = {&cascade, 1}; }
    OneCascadeFrame(const OneCascadeFrame&) = delete;
    OneCascadeFrame& operator=(const OneCascadeFrame&) = delete;

    void set_bounds(const FrameBounds& bounds) { frame.bounds = cascade.bounds = bounds; }

    Cascade cascade;
    Frame frame;
};

}  // namespace pelagic
