// Films, encoded by the program ffmpeg, which must be in PATH.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pelagic/tools/files/descriptor.hpp"

namespace pelagic::tools {

/// Returns true if the program ffmpeg is in PATH.
bool can_make_films();

/// A film that the program encodes while images are added. Memory holds the encoded film only.
class Film {
   public:
    /// \param width, height  size of the images; even, as the video format requires
    /// \throws FileError     if memory or a socket cannot be allocated
    Film(int width, int height, double frames_per_second);
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// Appends an image. \param rgba  8 bits per channel, the upper row first; alpha is ignored
    void add(std::span<const std::uint8_t> rgba);

    struct Encoded {
        std::vector<unsigned char> mp4;  ///< H.264; empty after a failure
        std::string reason;              ///< one line with the cause of the failure
    };
    /// Returns the film of all images. Call it once. The bytes depend on the version of ffmpeg.
    Encoded finish();

   private:
    /// Waits for the end of the program. Returns 0 if it succeeded.
    int wait();

    Descriptor film_, errors_, frames_;
    pid_t process_ = 0;
    int failure_ = 0;  ///< errno if the program could not be started, -1 if it has ended early
};

}  // namespace pelagic::tools
