// A small sea with everything that is needed to draw it without a window.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/sim/ocean.hpp"

namespace pelagic {

/// Returns the named preset, with the given resolution if there is one.
SeaState sea_named(std::string_view preset, int resolution = 0);

/// Returns the sky that all tests of a process share; it is baked once.
const gl::Sky& test_sky();

/// Returns the rows of an image, from the top.
struct ImageRows {
    int first = 0, count = 0;
};

class GlScene {
   public:
    static constexpr double eye_distance_m = 0.063;
    struct Options {
        std::string_view preset = "moderate";
        std::string_view quality = "high";
        int resolution = 0;       ///< 0: the preset's resolution
        int cascades = 0;         ///< 0: the default number
        double patch_size_m = 0;  ///< side of the only cascade; 0: sides chosen from the sea
        int width = 320, height = 180, samples = 4;
        double size_m = 4096;
        gl::PixelKind writes = gl::PixelKind::screen;
        gl::Shading shading = gl::Shading::high;
        double depth_m = 0;         ///< 0: the preset's depth
        double wind_speed_mps = 0;  ///< 0: the preset's wind speed
        bool foam = false;          ///< foam accumulates, and images show it
        bool lens_may_dip = false;  ///< frames can be queried, for the water plane at the lens
    };
    explicit GlScene(const Options& options);

    /// Draws into the scene's target, which is first cleared with `clear`.
    gl::DrawStatistics draw(const Camera& camera, double time_s, bool draws_sky = true, bool stereo = false,
                            glm::vec3 clear = {0, 0, 0}) {
        return draw(camera, ocean.frame_at(time_s), draws_sky, stereo, clear);
    }
    gl::DrawStatistics draw(const Camera& camera, const Frame& frame, bool draws_sky = true, bool stereo = false,
                            glm::vec3 clear = {0, 0, 0});
    std::vector<std::uint8_t> image(const Camera& camera, double time_s) {
        return image(camera, ocean.frame_at(time_s));
    }
    std::vector<std::uint8_t> image(const Camera& camera, const Frame& frame) {
        draw(camera, frame);
        return target->read();
    }
    /// Draws a square of sea from 2 km straight above through parallel rays, under a uniform sky
    /// and sun. Returns the green radiance, in rows. For a scene that writes radiance.
    std::vector<float> light_from_above(const Frame& frame, int pixels, double side_m);
    /// \param only  if not empty, only these rows of the image are drawn, which saves time
    void resize(int width, int height, ImageRows only = {});
    const gl::Functions& gl() const { return context.functions(); }

    gl::HeadlessContext context{{.debug = true}};
    Ocean ocean;
    Selection selection;
    std::optional<gl::RenderTarget> target;
    std::optional<gl::SeaPass> pass;
    gl::SeaRenderer* renderer = nullptr;                    ///< of the pass
    std::optional<gl::ApplicationScene> application_scene;  ///< used in all draws, as spray
    gl::SprayInput spray;

   private:
    int samples_;
    gl::PixelKind writes_;
    gl::Viewport whole_;  ///< the image's region of the target
};

/// Converts an sRGB byte to light in [0, 1].
float linear_of(std::uint8_t srgb);

/// Returns a sky of one colour and no other light: a pixel that the sky does not reach is black.
gl::Sky even_sky(float radiance);

/// Returns a uniform sky without a sun: the radiance of a surface is its reflectance.
gl::Sky white_sky();

/// Returns a random number in (0, 1).
inline double uniform(std::minstd_rand& random) { return static_cast<double>(random()) / 2147483647.0; }

}  // namespace pelagic
