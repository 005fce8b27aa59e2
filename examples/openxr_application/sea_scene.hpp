// The sea around the headset's wearer.
#pragma once

#include <array>
#include <optional>

#include "eye_images.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/ocean.hpp"

namespace openxr_application {

class SeaScene {
   public:
    /// Bakes spectrum and sky: some seconds. Throws std::invalid_argument for a sea that can't be.
    /// \param multiview  it is drawn into both layers of a framebuffer at once
    SeaScene(const pelagic::SeaState& sea, const pelagic::QuadtreePreset& quality, const pelagic::gl::Functions& gl,
             bool multiview);

    /// Starts the sea of that time on other threads. \param hashed  the frame keeps all that pelagic::hash_of() takes
    void schedule(double time_s, bool hashed);
    /// Waits for it and hands it to the GPU. What is scheduled has to be completed.
    void complete();
    /// The frame completed last.
    const pelagic::Frame& frame() const { return *frame_; }
    /// Draws it for both eyes into `images`: one selection, then a pass, or two.
    void draw(const std::array<XrView, 2>& eyes, const EyeImages& images);

   private:
    pelagic::Ocean ocean_;
    pelagic::Selection selection_;
    pelagic::gl::SeaRenderer renderer_;
    const pelagic::Frame* frame_ = nullptr;
};

}  // namespace openxr_application
