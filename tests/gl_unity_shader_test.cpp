// The shader of the package for Unity, compiled from HLSL by glslang and translated to GLSL by
// SPIRV-Cross, against the headset tier of gl/shaders on the same driver.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/program.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/water/detail_image.hpp"
#include "pelagic/gl/water/foam_image.hpp"
#include "pelagic/gl/water/frame_textures.hpp"
#include "pelagic/gl/water/patch_buffers.hpp"
#include "pelagic/gl/water/scene_block.hpp"
#include "pelagic/gl/water/sea_programs.hpp"
#include "pelagic/quadtree/patch_mesh.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/tests/gl_scene.hpp"
#include "pelagic/tests/test_paths.hpp"

namespace pelagic {
namespace {

namespace fs = std::filesystem;

constexpr int unity_width = 480, unity_height = 270, unity_vertices = 32;
constexpr int patches_of_draw = 100;  // fewer than in Unity: plain uniforms are limited

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

struct Stages {
    std::string vertex, fragment;
};

/// Returns both stages of unity/Runtime/Unity/Shaders/Ocean.shader in GLSL ES 3.10, with the stubs
/// of URP's files.
Stages shader_of_unity() {
    std::string name = (fs::temp_directory_path() / "pelagic_hlsl_XXXXXX").string();
    const fs::path folder = mkdtemp(name.data()), packages = folder / "Packages", source = source_folder;
    fs::create_directories(packages / "com.pelagic.ocean");
    fs::create_directories(packages / "com.unity.render-pipelines.universal");
    fs::create_directory_symlink(source / "unity/Runtime", packages / "com.pelagic.ocean/Runtime");
    fs::create_directory_symlink(source / "tests/unity/shaders",
                                 packages / "com.unity.render-pipelines.universal/ShaderLibrary");
    const std::string shader = text_of(source / "unity/Runtime/Unity/Shaders/Ocean.shader");
    const std::size_t start = shader.find("HLSLPROGRAM"), end = shader.find("ENDHLSL");
    std::istringstream lines(shader.substr(start, end - start));
    std::ofstream program(folder / "ocean.hlsl");
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);)
        if (line.find("#pragma") == std::string::npos) program << line << "\n";  // of Unity
    program.close();
    const auto translated = [&](const std::string& stage, const std::string& entry) {
        const std::string command =
            "cd " + folder.string() + " && glslangValidator -D -V -S " + stage + " -e " + entry +
            " -Dhalf=float -Dhalf3=float3 -Dhalf4=float4 -DPELAGIC_PATCHES=" + std::to_string(patches_of_draw) +
            " --auto-map-bindings --auto-map-locations -I. -o out.spv ocean.hlsl >log 2>&1 && "
            "spirv-cross out.spv --es --version 310 --glsl-emit-ubo-as-plain-uniforms --output out.glsl >>log 2>&1";
        EXPECT_EQ(std::system(command.c_str()), 0)
            << text_of(folder / "log") << " (Debian: glslang-tools, spirv-cross)";
        return text_of(folder / "out.glsl");
    };
    const Stages stages{translated("vert", "Vertex"), translated("frag", "Fragment")};
    fs::remove_all(folder);
    return stages;
}

void replace(std::string& text, const std::string& old_text, const std::string& new_text) {
    const std::size_t at = text.rfind(old_text);
    ASSERT_NE(at, std::string::npos) << old_text;
    text.replace(at, old_text.size(), new_text);
}

/// Returns both stages of the headset tier, in full precision as HLSL's. Haze is left out: in Unity
/// it is the scene's fog.
Stages headset_tier() {
    const gl::ProgramFiles files = gl::sea_program_files({.cascades = 4, .shading = gl::Shading::headset})[0];
    Stages stages{gl::shader_source(files.vertex, files.defines), gl::shader_source(files.fragment, files.defines)};
    replace(stages.fragment, "screen_colour(through_haze(radiance, from_eye, distance_m))",
            "screen_colour(radiance)");
    replace(stages.fragment, "uniform sampler2D detail;", "uniform highp sampler2D detail;");
    replace(stages.fragment, "uniform mediump sampler2DArray snapshots;", "uniform highp sampler2DArray snapshots;");
    return stages;
}

class LinkedProgram {
   public:
    LinkedProgram(const gl::Functions& functions, const Stages& stages)
        : name(functions.CreateProgram()), gl_(functions), text_(stages.vertex + stages.fragment) {
        attach(GL_VERTEX_SHADER, stages.vertex);
        attach(GL_FRAGMENT_SHADER, stages.fragment);
        gl_.LinkProgram(name);
        GLint good = GL_FALSE;
        gl_.GetProgramiv(name, GL_LINK_STATUS, &good);
        std::string log(4096, '\0');
        gl_.GetProgramInfoLog(name, 4096, nullptr, log.data());
        EXPECT_TRUE(good) << log.c_str();
        gl_.UseProgram(name);
    }
    ~LinkedProgram() { gl_.DeleteProgram(name); }

    /// Sets a sampler by its GLSL name, or by the part of the name that HLSL gives.
    void set_unit(const std::string& sampler, int unit) const {
        const GLint location = gl_.GetUniformLocation(name, sampler.c_str());
        EXPECT_GE(location, 0) << sampler;
        gl_.Uniform1i(location, unit);
    }
    /// Sets a vector of HLSL, which SPIRV-Cross makes a member of a structure for each stage.
    void set(const std::string& vector, glm::vec4 value) const {
        bool is_found = false;
        for (std::size_t at = text_.find("uniform "); at != std::string::npos; at = text_.find("uniform ", at + 1)) {
            std::istringstream words(text_.substr(at, 200));
            std::string uniform, type, variable;
            words >> uniform >> type >> variable;
            variable = variable.substr(0, variable.find(';'));
            const GLint location = gl_.GetUniformLocation(name, (variable + "." + vector).c_str());
            if (location < 0) continue;
            gl_.Uniform4f(location, value.x, value.y, value.z, value.w);
            is_found = true;
        }
        EXPECT_TRUE(is_found) << vector;
    }
    template <class Vectors>
    void set_all(const std::string& vectors, const Vectors& values, std::size_t count) const {
        for (std::size_t i = 0; i < count; ++i) set(vectors + "[" + std::to_string(i) + "]", values[i]);
    }

    const GLuint name;

   private:
    void attach(GLenum kind, const std::string& text) const {
        const GLuint shader = gl_.CreateShader(kind);
        const char* start = text.c_str();
        gl_.ShaderSource(shader, 1, &start, nullptr);
        gl_.CompileShader(shader);
        GLint good = GL_FALSE;
        gl_.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
        std::string log(4096, '\0');
        gl_.GetShaderInfoLog(shader, 4096, nullptr, log.data());
        EXPECT_TRUE(good) << log.c_str() << text;
        gl_.AttachShader(name, shader);
        gl_.DeleteShader(shader);
    }

    const gl::Functions& gl_;
    std::string text_;
};

/// A frame of a storm with foam, and everything that both programs read.
class Scene {
   public:
    Scene()
        : ocean_(sea_named("storm", 64), {.slopes = true, .foam = true}),
          textures_(gl_, 64, 4),
          buffers_(gl_, unity_vertices),
          selection_({.size_m = 1024, .vertices = unity_vertices, .lod_scale = 2}),
          target_(gl_, unity_width, unity_height, 1, gl::PixelKind::radiance) {
        const Frame& frame = ocean_.frame_at(12.5);
        textures_.upload(frame);
        gl::SeaFacts facts = gl::facts_of(frame);
        facts.has_foam = true;
        facts.writes_radiance = true;
        const Camera camera{.position_m = {20, 7, -35}, .target_m = {120, -14, 10}};
        const gl::Eye eye = gl::eye_of(camera, {0, 0, unity_width, unity_height});
        selection_.select(
            {.viewer_m = camera.position_m, .views = {&eye.clip_from_world, 1}, .bounds = frame.bounds});
        const gl::Sky& sky = test_sky();
        block_ = gl::scene_block_of({.eyes = {&eye, 1}, .list = &list()}, facts,
                                    gl::water_optics(gl::default_jerlov_type), sky);
        block_.cloud_place = {};  // Unity's light has no map of shadows
        // The C interface has no statistics of foam in pixels wider than its structure.
        block_.foam_filter = {};
        buffers_.upload(list().instances, list().skirt);
        bind(0, GL_TEXTURE_2D_ARRAY, textures_.displacement());
        bind(1, GL_TEXTURE_2D_ARRAY, textures_.slopes());
        bind(2, GL_TEXTURE_2D_ARRAY, textures_.snapshots());
        bind_ripples();
        bind_foam();
        bind_sky(sky);
    }

    const DrawList& list() const { return selection_.list(); }

    template <class Draw>
    std::vector<float> image(const Draw& draw) {
        target_.bind();
        gl_.ClearColor(0, 0, 0, 0);
        gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl_.Enable(GL_DEPTH_TEST);
        gl_.DepthFunc(GL_LEQUAL);
        draw();
        return target_.read_radiance();
    }

    std::vector<float> image_of_headset_tier() {
        const LinkedProgram program(gl_, headset_tier());
        gl::Buffer uniforms(gl_);
        gl_.BindBuffer(GL_UNIFORM_BUFFER, uniforms.name());
        gl_.BufferData(GL_UNIFORM_BUFFER, sizeof block_, &block_, GL_STATIC_DRAW);
        gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms.name());
        gl_.UniformBlockBinding(program.name, gl_.GetUniformBlockIndex(program.name, "Scene"), 0);
        const std::array samplers = {"displacement", "slopes", "snapshots", "detail", "foam_structure", "sky"};
        for (int unit = 0; unit < 6; ++unit) program.set_unit(samplers[static_cast<std::size_t>(unit)], unit);
        program.set_unit("cloud_shadows", 3);  // any: their weight is 0
        return image([&] { buffers_.draw_patches(list().batches, false); });
    }

    std::vector<float> image_of_unity() {
        const LinkedProgram program(gl_, shader_of_unity());
        const std::array samplers = {"_PelagicDisplacement", "_PelagicSlopes", "_PelagicSnapshots",
                                     "_PelagicRipples",      "_PelagicLace",   "stub_sky"};
        for (int unit = 0; unit < 6; ++unit) {
            const std::string name = samplers[static_cast<std::size_t>(unit)];
            program.set_unit("SPIRV_Cross_Combined" + name + "sampler" + (name[0] == '_' ? "" : "_") + name, unit);
        }
        bind(4, GL_TEXTURE_2D, lace_.name());
        set_uniforms(program);
        return image([&] { draw_patches(program); });
    }

   private:
    void bind(int unit, GLenum kind, GLuint texture) const {
        gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        gl_.BindTexture(kind, texture);
    }

    void bind_ripples() {
        const gl::DetailImage image = gl::make_detail_image();
        bind(3, GL_TEXTURE_2D, detail_.name());
        gl_.TexStorage2D(GL_TEXTURE_2D, gl::DetailImage::levels, GL_RGBA8, gl::DetailImage::side,
                         gl::DetailImage::side);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        for (int level = 0; level < gl::DetailImage::levels; ++level)
            gl_.TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, gl::DetailImage::side >> level,
                              gl::DetailImage::side >> level, GL_RGBA, GL_UNSIGNED_BYTE, image.level(level));
    }

    /// Creates the array of the headset tier, and a texture of its lace alone for Unity's.
    void bind_foam() {
        const std::shared_ptr<Executor> executor = make_serial_executor();
        const gl::FoamImage image = gl::make_foam_image(*executor);
        constexpr int side = gl::FoamImage::side, levels = gl::FoamImage::levels, layers = gl::FoamImage::layers;
        bind(4, GL_TEXTURE_2D, lace_.name());
        gl_.TexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA8, side, side);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        for (int level = 0; level < levels; ++level)
            gl_.TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, side >> level, side >> level, GL_RGBA, GL_UNSIGNED_BYTE,
                              image.texel(level, gl::FoamImage::lace, 0, 0));
        bind(4, GL_TEXTURE_2D_ARRAY, foam_.name());
        gl_.TexStorage3D(GL_TEXTURE_2D_ARRAY, levels, GL_RGBA8, side, side, layers);
        gl_.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        for (int level = 0; level < levels; ++level)
            gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, 0, side >> level, side >> level, layers, GL_RGBA,
                              GL_UNSIGNED_BYTE, image.level(level));
    }

    void bind_sky(const gl::Sky& sky) {
        bind(5, GL_TEXTURE_CUBE_MAP, sky_.name());
        gl_.TexStorage2D(GL_TEXTURE_CUBE_MAP, sky.levels, GL_RGBA16F, sky.face_size, sky.face_size);
        gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        for (int level = 0; level < sky.levels; ++level)
            for (int face = 0; face < 6; ++face)
                gl_.TexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), level, 0, 0,
                                  sky.face_size >> level, sky.face_size >> level, GL_RGBA, GL_HALF_FLOAT,
                                  sky.face(level, face).data());
    }

    /// Sets what OceanSurface.cs sets, for a viewer at the origin of the scene.
    void set_uniforms(const LinkedProgram& program) const {
        program.set_all("_PelagicCascadePlace", block_.cascade_place, 4);
        program.set_all("_PelagicCascadeScale", block_.cascade_scale, 4);
        program.set_all("_PelagicCascadeSlope", block_.cascade_slope, 4);
        program.set_all("_PelagicFoamCascade", block_.foam_cascade, 3);
        program.set_all("_PelagicFoamAge", block_.foam_age, 2);
        program.set("_PelagicFoamKind", block_.foam_kind);
        program.set("_PelagicFoamFront", block_.foam_front);
        program.set("_PelagicViewer", {0, 0, 0, -block_.viewer.z});
        program.set("_PelagicGrid", block_.grid);
        program.set("_PelagicFade", block_.fade);
        program.set("_PelagicMesh", {block_.mesh.x, block_.mesh.y, 0, block_.skirt.w});
        program.set("_PelagicSun", block_.sun);
        program.set("_PelagicSunIrradiance", block_.sun_irradiance);
        program.set("_PelagicSkyIrradiance", block_.sky_irradiance);
        program.set("_PelagicAbsorption", block_.water_absorption);
        program.set("_PelagicBackscattering", block_.water_backscattering);
        program.set("_PelagicCrestRay", block_.crest_ray);
        program.set("_PelagicCrestSun", block_.crest_sun);
        program.set("_PelagicCrestSky", block_.crest_sky);
        program.set("_PelagicWaves", block_.waves);
        program.set("_PelagicRippleTurn", block_.detail_turn[0]);
        program.set("_PelagicDetailPlace",
                    {block_.detail_shift.x, block_.detail_shift.y, block_.foam_shift.z, block_.foam_shift.w});
        program.set("stub_sky_levels", {block_.sky_irradiance.w, 0, 0, 0});
        // The scene's z axis is -z of the sea.
        program.set("stub_camera", {block_.eye[0].x, block_.eye[0].y, -block_.eye[0].z, 0});
        for (int row = 0; row < 4; ++row) {
            const glm::mat4& m = block_.clip_from_viewer[0];
            program.set("stub_clip_from_world[" + std::to_string(row) + "]",
                        {m[0][row], m[1][row], -m[2][row], m[3][row]});
        }
    }

    void draw_patches(const LinkedProgram& program) const {
        const PatchMesh mesh(unity_vertices);
        std::vector<glm::vec3> positions;
        for (const PatchMesh::Vertex& vertex : mesh.positions) positions.emplace_back(vertex.i, 0, vertex.j);
        gl::VertexArray array(gl_);
        gl::Buffer corners(gl_), indices(gl_);
        gl_.BindVertexArray(array.name());
        gl_.BindBuffer(GL_ARRAY_BUFFER, corners.name());
        gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(positions.size() * sizeof(glm::vec3)),
                       positions.data(), GL_STATIC_DRAW);
        gl_.EnableVertexAttribArray(0);
        gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
        gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
        gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(2 * mesh.indices.size()), mesh.indices.data(),
                       GL_STATIC_DRAW);
        for (const DrawBatch& batch : list().batches) {
            ASSERT_LE(batch.count, unsigned{patches_of_draw});
            for (std::uint32_t i = 0; i < batch.count; ++i) {
                const PatchInstance& patch = list().instances[batch.first + i];
                const auto weight = [](std::uint16_t of) { return static_cast<float>(of) / full_weight; };
                program.set(
                    "_PelagicPatches[" + std::to_string(2 * i) + "]",
                    {patch.corner_x, patch.corner_z, 2 * patch.level + patch.diagonals, weight(patch.inner_weight)});
                program.set("_PelagicPatches[" + std::to_string(2 * i + 1) + "]",
                            {weight(patch.edge_weights[east]), weight(patch.edge_weights[north]),
                             weight(patch.edge_weights[west]), weight(patch.edge_weights[south])});
            }
            const PatchMesh::Range& range = mesh.ranges[batch.stitches];
            gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_SHORT,
                                      reinterpret_cast<const void*>(std::uintptr_t{2} * range.first),
                                      static_cast<GLsizei>(batch.count));
        }
    }

    gl::HeadlessContext context_;
    const gl::Functions& gl_ = context_.functions();
    Ocean ocean_;
    gl::FrameTextures textures_;
    gl::PatchBuffers buffers_;
    Selection selection_;
    gl::RenderTarget target_;
    gl::SceneBlock block_;
    gl::Texture detail_{gl_}, foam_{gl_}, lace_{gl_}, sky_{gl_};
};

// Both programs compute the same values in another order. Rounding changes derivatives of positions
// by a thousandth, and glints and edges of foam amplify that: single pixels differ, means do not.
TEST(UnityShader, DrawsTheSeaOfTheHeadsetTier) {
    Scene scene;
    const std::vector<float> expected = scene.image_of_headset_tier(), found = scene.image_of_unity();
    std::vector<double> errors;
    int different_coverage = 0;
    glm::dvec3 expected_sum(0), found_sum(0);
    for (std::size_t pixel = 0; pixel < expected.size(); pixel += 4) {
        if (expected[pixel + 3] != found[pixel + 3]) ++different_coverage;
        if (expected[pixel + 3] == 0 || found[pixel + 3] == 0) continue;
        const glm::dvec3 a(expected[pixel], expected[pixel + 1], expected[pixel + 2]);
        const glm::dvec3 b(found[pixel], found[pixel + 1], found[pixel + 2]);
        expected_sum += a;
        found_sum += b;
        errors.push_back(glm::length(a - b) / glm::length(a));
    }
    ASSERT_GT(errors.size(), std::size_t{unity_width * unity_height / 3});
    EXPECT_LE(different_coverage, unity_width * unity_height / 10000) << "edges of triangles may round otherwise";
    std::sort(errors.begin(), errors.end());
    const auto quantile = [&](double fraction) {
        return errors[static_cast<std::size_t>(fraction * static_cast<double>(errors.size() - 1))];
    };
    // A radiance in half floats is rounded by up to 0.0005.
    EXPECT_LT(quantile(0.5), 0.002);
    EXPECT_LT(quantile(0.99), 0.02);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found_sum[c] / expected_sum[c], 1, 0.0005) << "channel " << c;
}

}  // namespace
}  // namespace pelagic
