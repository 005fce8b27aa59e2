// The layers of `render --aov`: values of the surface in each pixel, for compositing.
//
//   depth     depth.Z        metres along the camera's axis; 1e10 where there is no surface
//   normal    N.X N.Y N.Z    unit normal of the waves, upwards, in world axes
//   foam      foam.Y         fraction covered by foam
//   velocity  velocity.X Y Z velocity of the drawn water, m/s, in world axes
//   position  P.X P.Y P.Z    metres in the world
//
// Each value is that of the middle of its pixel; samples are not averaged. Where there is no surface
// all values but the depth are 0. Layers and channels are named as Nuke's reader splits them, N and P
// as in RenderMan and Arnold; 1e10 is the depth of Blender's background.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/gl/views.hpp"
#include "pelagic/message/enum_names.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"

namespace pelagic::tools {

enum class Aov { depth, normal, foam, velocity, position };

}  // namespace pelagic::tools

namespace pelagic {

template <>
struct EnumNames<tools::Aov> {
    static constexpr std::array<std::string_view, 5> all = {"depth", "normal", "foam", "velocity", "position"};
};

}  // namespace pelagic

namespace pelagic::tools {

/// Parses the value of --aov, "depth,normal".
/// \throws InputError  for a name that is unknown or given twice
std::vector<Aov> parse_aovs(const std::string& option, const std::string& text);

/// Returns the EXR names of all channels, in the order of aov_pixels().
std::vector<std::string> channel_names(std::span<const Aov> aovs);

/// Returns the values of all channels for each pixel, top row first.
/// \param data  pixels of gl::DrawMode::surface_data, RGBA, top row first; 0 where nothing is drawn
/// \param eye   whose viewport is the whole image
/// \param frame  the drawn frame, with OceanOptions::queries and, for Aov::velocity, ::velocities
std::vector<float> aov_pixels(std::span<const Aov> aovs, std::span<const float> data, const gl::Eye& eye,
                              const Frame& frame, SurfaceQueryJobs& jobs);

}  // namespace pelagic::tools
