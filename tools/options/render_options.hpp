// What `pelagic render` was asked for, checked.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>

#include "pelagic/tools/events/event_options.hpp"
#include "pelagic/tools/options/scene_options.hpp"

namespace pelagic::tools {

struct RenderOptions {
    SceneOptions scene;
    /// At least one of them is not empty: the image as PNG, its radiance as EXR, the sky as EXR.
    std::filesystem::path file, hdr_file, sky_file;
    double time_s = 0;
    int frames = 1;
    double fps = 24;
    std::optional<EventOptions> events;  ///< none: the water answers nobody
    std::optional<glm::dvec2> rock_m;    ///< x and z of a rock in the sea
    bool wireframe = false, stereo = false, json = false;

    /// FILE.png, or FILE_0000.png and so on where there is more than one frame. \param named  `file` or `hdr_file`
    std::filesystem::path file_of(const std::filesystem::path& named, int frame) const;
};

class RenderFlags {
   public:
    void add_to(CLI::App& app);
    /// Throws InputError, one line that names option, value and range; writes nothing.
    RenderOptions resolve() const;

   private:
    SceneFlags scene_;
    EventFlags events_;
    std::map<std::string, std::optional<std::string>> typed_;  ///< by flag name, where it was given
    bool wireframe_ = false, stereo_ = false, json_ = false;
};

}  // namespace pelagic::tools
