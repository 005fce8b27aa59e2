// The programs that draw the sea, and the shader files that each is made of.
#pragma once

#include <array>
#include <string>

#include "pelagic/gl/program.hpp"
#include "pelagic/gl/water/shading.hpp"
#include "pelagic/gl/water/small_water.hpp"

namespace pelagic::gl {

/// Texture units, as the programs read them.
enum Unit : GLint {
    displacement_unit,
    slopes_unit,
    moments_unit,
    detail_unit,
    sky_unit,
    floor_unit,
    caustics_unit,
    foam_unit,
    foam_maps_unit,
    flow_unit,
    scene_radiance_unit,
    scene_depth_unit,
    shore_parts_unit,
    shore_water_unit,
    shore_reach_unit,
    dynamic_waves_unit,
    unit_count
};

struct ProgramFiles {
    const char* vertex;
    const char* fragment;
    std::string defines;  ///< lines
};

/// What a set of programs is made for.
struct SeaVariant {
    std::size_t cascades = 1;
    Shading shading = Shading::high;
    Surface surface = Surface::open;
    bool multiview = false;
    bool below = false;          ///< the floor shows, or a lens is near the water: the others spare its cost
    bool mirrors_scene = false;  ///< what an application drew, too
    bool dynamic_waves = false;  ///< the frame has a dynamic-wave grid
    bool shore = false;          ///< of an open sea: cascades are held back there, and its waves add to them
};

/// For patches, skirt, background, wireframe and floor, in this order.
std::array<ProgramFiles, 5> sea_program_files(const SeaVariant& variant);

struct SeaProgram {
    SeaProgram() = default;
    SeaProgram(const Functions& gl, const ProgramFiles& files);
    /// \param eye  0 or 1; with multiview the driver knows
    void use(const Functions& gl, int eye) const;

    Program program;
    GLint eye_index = -1, brightness = -1;
};

struct SeaPrograms {
    /// Throws GlError if the driver refuses a shader. Leaves one of them in use.
    SeaPrograms(const Functions& gl, const SeaVariant& variant);

    SeaProgram patches, skirt, background, wireframe;
    SeaProgram floor;  ///< with SeaVariant::below
};

}  // namespace pelagic::gl
