// What the command line says.
#pragma once

#include <filesystem>

#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace openxr_application {

struct Options {
    pelagic::SeaState sea;
    pelagic::QuadtreePreset quality;
    int frames = 0;                ///< that are shown before the program ends by itself; 0: until its user leaves
    std::filesystem::path images;  ///< where the last frame's left.ppm and right.ppm go; empty: nowhere
    std::filesystem::path hashes;  ///< a line for each frame shown goes here at the end; empty: nowhere
};

/// Throws std::invalid_argument: one line that names the option.
Options options_of(int count, char** arguments);

}  // namespace openxr_application
