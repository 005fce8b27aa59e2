// Options that `pelagic render` and `pelagic view` share: sea, camera, sky and level of detail.
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

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
#include "pelagic/tools/options/water_frame_options.hpp"

namespace pelagic::tools {

enum class SprayUse {
    automatic,  ///< on, except with Shading::headset
    on,
    off
};

struct SceneOptions {
    ResolvedSea sea;
    ComputeOptions compute;
    int width = 1280, height = 720;
    Camera camera;
    std::string light;  ///< name of the light preset; empty: the sky depends on the wind
    gl::SkyOptions sky;
    gl::WaterOptics water;
    std::optional<gl::Shading> shading;  ///< unset: high, or adapted to a window's frame time
    gl::CameraSettings settings;
    float crest_glow = 1;  ///< gl::DrawInput::crest_glow
    gl::SeaFloor floor;
    std::optional<ShoreOptions> shore;  ///< the floor's heights with --shore
    WaterFrame water_frame;
    gl::Surface surface = gl::Surface::open;
    SprayUse spray = SprayUse::automatic;
    std::optional<gl::FlowMap> flow;
    std::string quality;
    QuadtreeOptions quadtree;

    /// Returns whether spray is drawn with a shading.
    bool has_spray(gl::Shading with) const {
        if (surface != gl::Surface::open) return false;
        return spray == SprayUse::on || (spray == SprayUse::automatic && with != gl::Shading::headset);
    }
};

}  // namespace pelagic::tools

namespace pelagic {

template <>
struct EnumNames<tools::SprayUse> {
    static constexpr std::array<std::string_view, 3> all = {"auto", "on", "off"};
};

}  // namespace pelagic

namespace pelagic::tools {

class SceneFlags {
   public:
    /// \param preset  see SeaOptions::add_to()
    void add_to(CLI::App& app, SeaOptions::PresetName preset = SeaOptions::PresetName::option);
    /// Checks the options.
    /// \throws InputError  on one line with option, value and range
    /// \param motion  of the camera
    SceneOptions resolve(const CameraMotion& motion = {}) const;
    bool has_target() const { return camera_.has_target(); }  ///< true if --target was given
    /// Returns a heading and a line for each preset of --light.
    static std::string description_of_lights();
    /// Returns the floor's options as given on the command line, to print an equivalent command.
    std::string typed_floor() const { return floor_.typed(); }
    /// Returns the options of sea level and current in the same form.
    std::string typed_water_frame() const { return water_frame_.typed(); }

   private:
    void read_camera_settings(gl::CameraSettings& settings) const;

    SeaOptions sea_;
    ComputeFlags compute_;
    CameraFlags camera_;
    FloorFlags floor_;
    WaterFrameFlags water_frame_;
    std::map<std::string, std::optional<std::string>> typed_;  ///< command-line values by flag
};

}  // namespace pelagic::tools
