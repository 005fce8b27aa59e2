// The options of `pelagic render`.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/tools/aov/aov.hpp"
#include "pelagic/tools/events/event_options.hpp"
#include "pelagic/tools/hulls/hull_options.hpp"
#include "pelagic/tools/options/scene_options.hpp"

namespace pelagic::tools {

struct RenderOptions {
    SceneOptions scene;
    /// Output files: the image as PNG or a film as MP4, the radiance as EXR, the sky as EXR. At
    /// least one is not empty.
    std::filesystem::path file, hdr_file, sky_file;
    std::filesystem::path spray_file;  ///< droplets as PLY; may be empty
    CameraMotion motion;
    bool has_target = true;  ///< false: the target moves up and down with the camera of --eye-height
    std::vector<Aov> aovs;   ///< layers of `hdr_file`
    double time_s = 0;
    int frames = 1;
    double fps = 24;
    std::optional<EventOptions> events;  ///< unset: no dynamic waves
    std::optional<glm::dvec2> rock_m;    ///< x and z of a rock in the sea
    std::optional<HullLaunch> hull;      ///< a floating hull; `events` has the grid of its wake
    bool wireframe = false, stereo = false, json = false;
    bool resume = false;  ///< keep images that exist

    /// Returns true if images show spray.
    bool has_spray() const { return !wireframe && scene.has_spray(scene.shading.value_or(gl::Shading::high)); }
    /// Returns true if `file` is one film of all frames.
    bool is_film() const { return file.extension() == ".mp4"; }
    /// Returns the path of a frame's file: FILE.png, or FILE_0000.png and so on if there are
    /// several frames; for FILE.####.png always FILE.0000.png and so on.
    /// \param named  `file`, `hdr_file` or `spray_file`
    std::filesystem::path file_of(const std::filesystem::path& named, int frame) const;
};

class RenderFlags {
   public:
    void add_to(CLI::App& app);
    /// Checks the options. Writes no files.
    /// \throws InputError  on one line with option, value and range
    RenderOptions resolve() const;

   private:
    CameraMotion resolve_motion() const;
    void resolve_aovs(RenderOptions& options) const;
    void resolve_times(RenderOptions& options) const;

    SceneFlags scene_;
    HullFlags hull_;
    EventFlags events_;
    std::map<std::string, std::optional<std::string>> typed_;  ///< command-line values by flag
    bool wireframe_ = false, stereo_ = false, json_ = false, resume_ = false;
};

}  // namespace pelagic::tools
