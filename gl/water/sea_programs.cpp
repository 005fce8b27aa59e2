#include "pelagic/gl/water/sea_programs.hpp"

#include "pelagic/gl/gl_state_guard.hpp"

namespace pelagic::gl {

static_assert(unit_count == texture_units, "an application gets back what it had in each of them");

/// By Unit.
constexpr const char* samplers[unit_count] = {
    "displacement",  "slopes",        "moments",        "detail",
    "sky",           "floor_heights", "caustics",       "foam_structure",
    "snapshots",     "flow",          "scene_radiance", "scene_depth",
    "shore_weights", "shore_water",   "shore_reach",    "dynamic_waves_texels",
    "cloud_shadows"};

std::array<ProgramFiles, 5> sea_program_files(const SeaVariant& variant) {
    const auto number = [](auto value) { return std::to_string(static_cast<int>(value)); };
    std::string defines = "#define CASCADES " + number(variant.cascades) + "\n#define SHADING " +
                          number(variant.shading) + "\n#define SURFACE " + number(variant.surface) +
                          "\n#define BELOW " + number(variant.below) + "\n";
    if (variant.mirrors_scene) defines += "#define MIRRORS_SCENE\n";
    if (variant.shore) defines += "#define SHORE\n";
    if (variant.multiview) defines += "#define MULTIVIEW\n";
    if (variant.surface_data) defines += "#define SURFACE_DATA\n";
    // Dynamic waves do not reach beyond the patches.
    const std::string of_patches = defines + (variant.dynamic_waves ? "#define DYNAMIC_WAVES\n" : "");
    return {{{"sea.vert.glsl", "sea.frag.glsl", of_patches},
             {"skirt.vert.glsl", "sea.frag.glsl", defines + "#define SKIRT\n"},
             {"sky.vert.glsl", "sky.frag.glsl", defines},
             {"sea.vert.glsl", "wireframe.frag.glsl", of_patches},
             {"floor.vert.glsl", "floor.frag.glsl", defines + "#define FLOOR\n"}}};
}

ProgramFiles exclusion_program_files(const SeaVariant& variant, std::size_t exclusions) {
    ProgramFiles files = sea_program_files(variant)[0];
    files.defines += "#define EXCLUSIONS " + std::to_string(exclusions) + "\n";
    return files;
}

SeaProgram::SeaProgram(const Functions& gl, const ProgramFiles& files)
    : program(gl, files.vertex, files.fragment, files.defines) {
    gl.UseProgram(program.name());
    gl.UniformBlockBinding(program.name(), gl.GetUniformBlockIndex(program.name(), "Scene"), 0);
    for (GLint unit = 0; unit < unit_count; ++unit) gl.Uniform1i(program.uniform(samplers[unit]), unit);
    eye_index = program.uniform("eye_index");
    brightness = program.uniform("brightness");
}

void SeaProgram::use(const Functions& gl, int eye) const {
    gl.UseProgram(program.name());
    if (eye_index >= 0) gl.Uniform1i(eye_index, eye);
}

SeaPrograms::SeaPrograms(const Functions& gl, const SeaVariant& variant) : variant_(variant) {
    const std::array<ProgramFiles, 5> files = sea_program_files(variant);
    SeaProgram* const programs[] = {&patches, &skirt, &background, &wireframe, &floor};
    for (std::size_t i = 0; i < files.size(); ++i)
        if (programs[i] != &floor || variant.below) *programs[i] = SeaProgram(gl, files[i]);
}

SeaProgram& SeaPrograms::patches_with(const Functions& gl, std::size_t exclusions) {
    SeaProgram& chosen = exclusions == 1 ? patches_with_one_ : patches_with_many_;
    if (chosen.program.name() != 0) return chosen;
    chosen = SeaProgram(gl, exclusion_program_files(variant_, exclusions == 1 ? 1 : max_exclusions));
    gl.Uniform1i(chosen.program.uniform("exclusion_maps"), exclusions_unit(variant_.surface));
    return chosen;
}

}  // namespace pelagic::gl
