// A frame that no ocean made: one tile, which a test fills in.
#pragma once

#include "pelagic/sim/frame.hpp"

namespace pelagic {

struct OneTileFrame {
    OneTileFrame() { frame.tiles = {&tile, 1}; }
    OneTileFrame(const OneTileFrame&) = delete;
    OneTileFrame& operator=(const OneTileFrame&) = delete;

    void set_bounds(const FrameBounds& bounds) { frame.bounds = tile.bounds = bounds; }

    Tile tile;
    Frame frame;
};

}  // namespace pelagic
