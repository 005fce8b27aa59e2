// Options of the command line.
#pragma once

#include <filesystem>

#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace openxr_application {

struct Options {
    pelagic::SeaState sea;
    pelagic::QuadtreePreset quality;
    int frames = 0;                ///< number of displayed frames; 0: until the user exits
    std::filesystem::path images;  ///< folder of the last left.ppm and right.ppm; may be empty
    std::filesystem::path hashes;  ///< file with a line per displayed frame; may be empty
};

/// \throws std::invalid_argument  on one line with the option
Options options_of(int count, char** arguments);

}  // namespace openxr_application
