// Tests of the GLSL source of the analytic waves: GLSL's reference compiler accepts it, and a
// driver computes the same water.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/analytic/analytic_glsl.hpp"
#include "pelagic/analytic/analytic_surface.hpp"
#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/render_target.hpp"

namespace pelagic {
namespace {

constexpr int analytic_pixels = 48;  // Pixels a side; each pixel evaluates one position.
constexpr const char* every_place =
    "#version 300 es\nvoid main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, "
    "1.0); }\n";

/// Returns a shader that writes `result`, an expression of `water`, for a square of positions of
/// side 3 m.
std::string shader_of(const std::string& water, const std::string& result, float time_s) {
    return "#version 300 es\nprecision highp float;\n" + water +
           "out vec4 result;\nvoid main() {\n    AnalyticWater water = analytic_water(gl_FragCoord.xy * 3.0 - "
           "72.0, " +
           std::to_string(time_s) + ");\n    result = " + result + ";\n}\n";
}

/// Returns the values that the driver computes, from the lowest row up.
std::vector<float> drawn(const std::string& fragment) {
    const gl::HeadlessContext context{{.debug = true}};
    const gl::Functions& gl = context.functions();
    const GLuint program = gl.CreateProgram();
    for (const auto& [kind, text] :
         {std::pair<GLenum, std::string>(GL_VERTEX_SHADER, every_place), {GL_FRAGMENT_SHADER, fragment}}) {
        const GLuint shader = gl.CreateShader(kind);
        const char* start = text.c_str();
        gl.ShaderSource(shader, 1, &start, nullptr);
        gl.CompileShader(shader);
        char log[2000] = "";
        gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
        EXPECT_STREQ(log, "");
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader);
    }
    gl.LinkProgram(program);
    gl::RenderTarget target(gl, analytic_pixels, analytic_pixels, 1, gl::PixelKind::radiance);
    target.bind();
    gl.UseProgram(program);
    gl.Viewport(0, 0, analytic_pixels, analytic_pixels);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    const std::vector<float> upper_first = target.read_radiance();
    gl.DeleteProgram(program);
    std::vector<float> pixels;
    for (std::size_t row = analytic_pixels; row-- > 0;)
        pixels.insert(pixels.end(), upper_first.begin() + static_cast<std::ptrdiff_t>(row * analytic_pixels * 4),
                      upper_first.begin() + static_cast<std::ptrdiff_t>((row + 1) * analytic_pixels * 4));
    return pixels;
}

const AnalyticSea& intense() { return analytic_preset_named("analytic-intense")->sea; }

TEST(AnalyticGlsl, CompilesInVertexAndFragmentShaders) {
    std::string folder = (std::filesystem::temp_directory_path() / "pelagic_analytic_XXXXXX").string();
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
    // whole numbers must be written as floats, too
    AnalyticSea flat{.waves = {{}}, .choppiness = 0};
    for (const AnalyticSea& sea : {intense(), flat}) {
        const std::string vertex = folder + "/water.vert", fragment = folder + "/water.frag";
        std::ofstream(vertex)
            << "#version 300 es\nprecision highp float;\n"
            << analytic_glsl(sea)
            << "in vec2 rest;\nvoid main() { gl_Position = vec4(analytic_water(rest, 1.0).displacement, 1.0); }\n";
        std::ofstream(fragment) << shader_of(analytic_glsl(sea), "vec4(water.normal, water.jacobian)", 1);
        const int status =
            std::system(("glslangValidator -l " + vertex + " " + fragment + " > " + folder + "/said 2>&1").c_str());
        std::stringstream said;
        said << std::ifstream(folder + "/said").rdbuf();
        EXPECT_EQ(status, 0) << said.str() << " (Debian: glslang-tools)";
    }
    std::filesystem::remove_all(folder);
}

// The target holds half floats, whose relative precision is 2.4e-4.
TEST(AnalyticGlsl, MatchesTheSurfaceOnTheCpu) {
    const GlslOrigin origin{.time_s = 86400, .x_m = 1e5, .z_m = -2e5};
    const float time_s = 12.5f;
    std::vector<double> x, z;
    for (int j = 0; j < analytic_pixels; ++j)
        for (int i = 0; i < analytic_pixels; ++i) {
            x.push_back(origin.x_m + (i + 0.5) * 3 - 72);
            z.push_back(origin.z_m + (j + 0.5) * 3 - 72);
        }
    std::vector<std::vector<float>> said(7, std::vector<float>(x.size()));
    AnalyticSurface(intense()).sample_undisplaced(origin.time_s + time_s, {x, z},
                                                  {said[1], said[0], said[2], said[3], said[4], said[5], said[6]});
    double amplitude_m = 0;
    for (const AnalyticWave& wave : intense().waves) amplitude_m += wave.amplitude_m;

    const std::string water = analytic_glsl(intense(), origin);
    const std::vector<float> moved = drawn(shader_of(water, "vec4(water.displacement, 1.0)", time_s));
    const std::vector<float> normals = drawn(shader_of(water, "vec4(water.normal, water.jacobian)", time_s));
    for (std::size_t place = 0; place < x.size(); ++place)
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const float displacement = channel < 3 ? said[channel][place] : 1;
            ASSERT_NEAR(moved[4 * place + channel], displacement, 1e-3 * amplitude_m);
            ASSERT_NEAR(normals[4 * place + channel], said[3 + channel][place], 1e-3);
        }
}

}  // namespace
}  // namespace pelagic
