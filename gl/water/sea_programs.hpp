// Programs that draw the sea, and the shader files of each.
#pragma once

#include <array>
#include <compare>
#include <string>

#include "pelagic/gl/program.hpp"
#include "pelagic/gl/water/exclusions.hpp"
#include "pelagic/gl/water/shading.hpp"
#include "pelagic/gl/water/small_water.hpp"

namespace pelagic::gl {

/// Texture units of the programs.
enum Unit : GLint {
    displacement_unit,
    slopes_unit,
    moments_unit,
    detail_unit,
    sky_unit,
    floor_unit,
    caustics_unit,
    foam_unit,
    snapshots_unit,
    flow_unit,
    scene_radiance_unit,
    scene_depth_unit,
    shore_weights_unit,
    shore_water_unit,
    shore_reach_unit,
    dynamic_waves_unit,
    cloud_shadows_unit,
    unit_count
};
/// Returns the unit of the exclusion maps. OpenGL ES 3.0 guarantees 16 units to a fragment shader,
/// so the maps share that of a texture that the surface's programs do not sample. Only vertex shaders
/// and the skirt sample the clouds' shadows.
constexpr Unit exclusions_unit(Surface surface) { return surface == Surface::open ? flow_unit : shore_weights_unit; }

struct ProgramFiles {
    const char* vertex;
    const char* fragment;
    std::string defines;  ///< preprocessor lines
};

/// Features that a set of programs is compiled for.
struct SeaVariant {
    std::size_t cascades = 1;
    Shading shading = Shading::high;
    Surface surface = Surface::open;
    bool multiview = false;
    /// The floor is visible, or a lens is near the water. These programs cost more time per pixel.
    bool below = false;
    bool mirrors_scene = false;  ///< reflections include the application's scene
    bool dynamic_waves = false;  ///< the frame has a dynamic-wave grid
    /// An open sea has a shore: cascades are attenuated there, and shore waves are added.
    bool shore = false;
    bool surface_data = false;  ///< DrawMode::surface_data

    auto operator<=>(const SeaVariant&) const = default;
};

/// Returns the files of the patch, skirt, background, wireframe and floor programs, in this order.
std::array<ProgramFiles, 5> sea_program_files(const SeaVariant& variant);
/// Returns the files of the program for patches that reach the interior of a hull.
/// \param exclusions  number of hulls that the program can leave out
ProgramFiles exclusion_program_files(const SeaVariant& variant, std::size_t exclusions);

struct SeaProgram {
    SeaProgram() = default;
    SeaProgram(const Functions& gl, const ProgramFiles& files);
    /// Makes the program current.
    /// \param eye  0 or 1; ignored with multiview, where gl_ViewID_OVR selects the eye
    void use(const Functions& gl, int eye) const;

    Program program;
    GLint eye_index = -1, brightness = -1;
};

struct SeaPrograms {
    /// Compiles the programs and leaves one of them current.
    /// \throws GlError  if the driver rejects a shader
    SeaPrograms(const Functions& gl, const SeaVariant& variant);
    /// Returns the program for patches that reach the interior of a hull: one for a single
    /// exclusion, one for up to max_exclusions. Compiles it at the first use and leaves a program
    /// current.
    /// \throws GlError  if the driver rejects a shader
    SeaProgram& patches_with(const Functions& gl, std::size_t exclusions);

    SeaProgram patches, skirt, background, wireframe;
    SeaProgram floor;  ///< compiled only with SeaVariant::below

   private:
    SeaVariant variant_;
    SeaProgram patches_with_one_, patches_with_many_;
};

}  // namespace pelagic::gl
