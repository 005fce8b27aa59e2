// Preview films, encoded by the program ffmpeg, which must be in PATH.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pelagic/tools/files/descriptor.hpp"

namespace pelagic::tools {

/// Returns true if the program ffmpeg is in PATH.
bool can_make_films();

/// A sequence of images of equal size, stored uncompressed until encode().
class Film {
   public:
    /// \param width, height  size of the images; even, as the video format requires
    /// \throws FileError     if memory cannot be allocated
    Film(int width, int height, double frames_per_second);

    /// Appends an image. \param rgba  8 bits per channel, the upper row first; alpha is ignored
    void add(std::span<const std::uint8_t> rgba);

    struct Encoded {
        std::vector<unsigned char> mp4;  ///< H.264; empty after a failure
        std::string reason;              ///< one line with the cause of the failure
    };
    /// Encodes the images. The bytes depend on the version of ffmpeg.
    Encoded encode() const;

   private:
    int width_, height_;
    double frames_per_second_;
    Descriptor frames_;
};

}  // namespace pelagic::tools
