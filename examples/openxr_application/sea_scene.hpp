// The sea around the user of the headset.
#pragma once

#include <array>
#include <optional>

#include "eye_images.hpp"
#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/sim/ocean.hpp"

namespace openxr_application {

class SeaScene {
   public:
    /// Computes the spectrum and the sky, which takes some seconds.
    /// \param multiview  true if both layers of a framebuffer are drawn in one pass
    /// \throws std::invalid_argument  if the sea's options are invalid
    SeaScene(const pelagic::SeaState& sea, const pelagic::QuadtreePreset& quality, const pelagic::gl::Functions& gl,
             bool multiview);

    /// Schedules the frame of a time on other threads.
    /// \param hashed  true if the frame keeps all data that pelagic::hash_of() needs
    void schedule(double time_s, bool hashed);
    /// Waits for the scheduled frame and uploads it. Every scheduled frame must be completed.
    void complete();
    /// Returns the frame completed last.
    const pelagic::Frame& frame() const { return *frame_; }
    /// Draws the frame for both eyes into `images`: one pass with multiview, else two.
    void draw(const std::array<XrView, 2>& eyes, const EyeImages& images);

   private:
    pelagic::Ocean ocean_;
    pelagic::gl::SeaPass pass_;
    const pelagic::Frame* frame_ = nullptr;
};

}  // namespace openxr_application
