// A short film for people, by the program ffmpeg, which is looked for when it is needed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pelagic/tools/files/descriptor.hpp"

namespace pelagic::tools {

/// The program ffmpeg is in PATH.
bool can_make_films();

/// Images of one size, kept without compression until the end.
class Film {
   public:
    /// Throws FileError if the system has no memory for it. \param width, height  even, as video wants them
    Film(int width, int height, double frames_per_second);

    /// \param rgba  8 bits a channel, the upper row first; alpha is left out
    void add(std::span<const std::uint8_t> rgba);

    struct Encoded {
        std::vector<unsigned char> mp4;  ///< H.264, empty if there is none
        std::string reason;              ///< why, in a line
    };
    /// Not the same bytes with another ffmpeg.
    Encoded encode() const;

   private:
    int width_, height_;
    double frames_per_second_;
    Descriptor frames_;
};

}  // namespace pelagic::tools
