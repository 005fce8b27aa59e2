// The programs that draw the sea, and the shader files that each is made of.
#pragma once

#include <array>
#include <string>

#include "pelagic/gl/program.hpp"
#include "pelagic/gl/shading.hpp"
#include "pelagic/gl/small_water.hpp"

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
    flow_unit
};

struct ProgramFiles {
    const char* vertex;
    const char* fragment;
    std::string defines;  ///< lines
};

/// For patches, skirt, background, wireframe and floor, in this order, of a sea with so many tiles.
std::array<ProgramFiles, 5> sea_program_files(bool multiview, std::size_t tiles, Shading shading,
                                              Surface surface = Surface::open);

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
    SeaPrograms(const Functions& gl, bool multiview, std::size_t tiles, Shading shading, Surface surface);

    SeaProgram patches, skirt, background, wireframe, floor;
};

}  // namespace pelagic::gl
