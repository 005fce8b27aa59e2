// What `pelagic render` was asked for, checked.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "gl/sky_baker.hpp"
#include "gl/views.hpp"
#include "quadtree/quadtree_options.hpp"
#include "tools/camera_options.hpp"
#include "tools/export_options.hpp"

namespace pelagic::tools {

struct RenderOptions {
    ResolvedSea sea;
    ComputeOptions compute;
    std::filesystem::path file;
    int width = 1280, height = 720;
    double time_s = 0;
    int frames = 1;
    double fps = 24;
    gl::Camera camera;
    gl::SkyOptions sky;
    std::string quality;
    QuadtreeOptions quadtree;
    bool wireframe = false, stereo = false, json = false;

    /// FILE.png, or FILE_0000.png and so on where there is more than one frame.
    std::filesystem::path file_of(int frame) const;
};

class RenderFlags {
   public:
    void add_to(CLI::App& app);
    /// Throws InputError, one line that names option, value and range; writes nothing.
    RenderOptions resolve() const;

   private:
    SeaOptions sea_;
    ComputeFlags compute_;
    CameraFlags camera_;
    std::map<std::string, std::optional<std::string>> typed_;  ///< by flag name, where it was given
    bool wireframe_ = false, stereo_ = false, json_ = false;
};

}  // namespace pelagic::tools
