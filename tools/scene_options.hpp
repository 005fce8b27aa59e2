// What `pelagic render` and `pelagic view` share: the sea, who looks at it, the sky, the level of detail.
#pragma once

#include <CLI/App.hpp>
#include <map>
#include <optional>
#include <string>

#include "pelagic/gl/sky_baker.hpp"
#include "pelagic/gl/small_water.hpp"
#include "pelagic/gl/views.hpp"
#include "pelagic/gl/water_optics.hpp"
#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/tools/camera_options.hpp"
#include "pelagic/tools/export_options.hpp"

namespace pelagic::tools {

struct SceneOptions {
    ResolvedSea sea;
    ComputeOptions compute;
    int width = 1280, height = 720;
    Camera camera;
    gl::SkyOptions sky;
    gl::WaterOptics water;
    gl::Surface surface = gl::Surface::open;
    std::optional<gl::FlowMap> flow;
    std::string quality;
    QuadtreeOptions quadtree;
};

class SceneFlags {
   public:
    void add_to(CLI::App& app);
    /// Throws InputError, one line that names option, value and range.
    SceneOptions resolve() const;

   private:
    SeaOptions sea_;
    ComputeFlags compute_;
    CameraFlags camera_;
    std::map<std::string, std::optional<std::string>> typed_;  ///< by flag name, where it was given
};

}  // namespace pelagic::tools
