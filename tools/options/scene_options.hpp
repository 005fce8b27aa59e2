// What `pelagic render` and `pelagic view` share: the sea, who looks at it, the sky, the level of detail.
#pragma once

#include <CLI/App.hpp>
#include <map>
#include <optional>
#include <string>

#include "pelagic/gl/exposure.hpp"
#include "pelagic/gl/sky/sky_baker.hpp"
#include "pelagic/gl/views.hpp"
#include "pelagic/gl/water/sea_floor.hpp"
#include "pelagic/gl/water/shading.hpp"
#include "pelagic/gl/water/small_water.hpp"
#include "pelagic/gl/water/water_optics.hpp"
#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/tools/options/camera_options.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/options/floor_options.hpp"
#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {

struct SceneOptions {
    ResolvedSea sea;
    ComputeOptions compute;
    int width = 1280, height = 720;
    Camera camera;
    std::string light;  ///< by which the sky was chosen; empty: by the wind
    gl::SkyOptions sky;
    gl::WaterOptics water;
    std::optional<gl::Shading> shading;  ///< none: high, or as a window's frame time allows
    gl::CameraSettings settings;
    gl::SeaFloor floor;
    std::optional<ShoreOptions> shore;  ///< the floor's heights, where waves feel them
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
    /// The floor's options as they were typed, for a command line that draws the same.
    std::string typed_floor() const { return floor_.typed(); }

   private:
    void read_camera_settings(gl::CameraSettings& settings) const;

    SeaOptions sea_;
    ComputeFlags compute_;
    CameraFlags camera_;
    FloorFlags floor_;
    std::map<std::string, std::optional<std::string>> typed_;  ///< by flag name, where it was given
};

}  // namespace pelagic::tools
