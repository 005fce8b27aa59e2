// The reflection of the sea's shader, unmodified, on a table of inputs: reflected and transmitted
// light sum to all the light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/program.hpp"
#include "pelagic/gl/render_target.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;
constexpr int mirror_columns = 64, mirror_rows = 32;

/// Angles of the eye from the zenith and roughnesses, by a pixel's column and row: to half a degree
/// above the surface, alpha to 0.6.
double eye_from_zenith(int column) { return 89.5 * pi / 180 * (column + 0.5) / mirror_columns; }
double roughness(int row) { return 0.02 + 0.58 * (row + 0.5) / mirror_rows; }

class GlMirror : public testing::Test {
   protected:
    /// Returns the RGBA of each pixel; `body` sets `result` from `theta`, `alpha` and `pixel`.
    std::vector<float> computed(const std::string& body) {
        const gl::Functions& gl = context_.functions();
        const std::string vertex =
            "#version 300 es\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 "
            ": "
            "-1.0, 0.0, 1.0); }\n";
        const std::string fragment =
            "#version 300 es\n#define CASCADES 1\n#define SHADING 2\n#define SURFACE 0\nprecision highp "
            "float;\nprecision highp int;\nconst float pi = "
            "3.14159265;\n" +
            std::string(gl::shader_text("scene.glsl")) + std::string(gl::shader_text("mirror.glsl")) +
            "out vec4 result;\nvoid main() {\n"
            "    vec2 pixel = gl_FragCoord.xy;\n"
            "    float theta = radians(89.5) * pixel.x / 64.0, alpha = 0.02 + 0.58 * pixel.y / 32.0;\n"
            "    vec3 up = vec3(0.0, 1.0, 0.0), eye_at = vec3(sin(theta), cos(theta), 0.0);\n" +
            body + "}\n";
        const GLuint program = gl.CreateProgram();
        for (const auto& [kind, text] :
             {std::pair(GL_VERTEX_SHADER, &vertex), std::pair(GL_FRAGMENT_SHADER, &fragment)}) {
            const GLuint shader = gl.CreateShader(static_cast<GLenum>(kind));
            const char* start = text->c_str();
            gl.ShaderSource(shader, 1, &start, nullptr);
            gl.CompileShader(shader);
            GLint good = GL_FALSE;
            gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
            EXPECT_TRUE(good) << *text;
            gl.AttachShader(program, shader);
            gl.DeleteShader(shader);
        }
        gl.LinkProgram(program);
        gl::RenderTarget target(gl, mirror_columns, mirror_rows, 0, gl::PixelKind::radiance);
        target.bind();
        const gl::VertexArray empty(gl);
        gl.BindVertexArray(empty.name());
        gl.UseProgram(program);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<float> upper_row_first = target.read_radiance(), values;
        for (int row = mirror_rows - 1; row >= 0; --row)
            values.insert(values.end(), upper_row_first.begin() + 4 * mirror_columns * row,
                          upper_row_first.begin() + 4 * mirror_columns * (row + 1));
        gl.DeleteProgram(program);
        return values;
    }

    gl::HeadlessContext context_{{.debug = true}};
};

// The sum of the glint over suns in all directions and facet slopes, plus the light of the water,
// gains no light. It lacks the light that two waves reflect, which is traced for the sky only. With
// that light little is missing: facets of the glint and Fresnel's mean differ at grazing angles,
// increasingly with roughness.
TEST_F(GlMirror, WhiteFurnaceGainsNoLightAndLosesLittle) {
    const std::vector<float> values = computed(R"(
    float sum = 0.0;
    for (int i = 0; i < 96; ++i)
        for (int j = 0; j < 48; ++j) {
            vec2 slopes = alpha * vec2((float(i) + 0.5) / 12.0 - 4.0, (float(j) + 0.5) / 12.0);
            vec3 facet = normalize(vec3(slopes.x, 1.0, slopes.y));
            float cosine = dot(facet, eye_at);
            if (cosine <= 0.0) continue;
            // Maps slopes to directions of facets, and these to directions of light, on both sides
            // of the plane through the eye.
            float angle = 2.0 * alpha * alpha / 144.0 * facet.y * facet.y * facet.y * 4.0 * cosine;
            sum += angle * mirrored_fraction(up, eye_at, reflect(-eye_at, facet), alpha * alpha, alpha);
        }
    MeanMirror mirror = mean_mirror(up, eye_at, alpha * alpha, alpha);
    float fresnel = mean_fresnel(cos(theta), alpha * sqrt(0.5));
    float twice = fresnel * (mirror.sky_share - mirror.lit), passed = 1.0 - fresnel * mirror.sky_share;
    result = vec4(64.0 * (sum + passed - 1.0), twice, passed, 1.0);  // halves have steps of 1e-3 around 1
)");
    double min = 2, max = 0, min_rough = 2, max_with_twice = 0;
    for (int row = 0; row < mirror_rows; ++row)
        for (int column = 0; column < mirror_columns; ++column) {
            const float* pixel = &values[4 * static_cast<std::size_t>(row * mirror_columns + column)];
            const double once = 1 + pixel[0] / 64, all = once + pixel[1];
            max = std::max(max, once);
            max_with_twice = std::max(max_with_twice, all);
            (roughness(row) <= 0.3 ? min : min_rough) = std::min(roughness(row) <= 0.3 ? min : min_rough, all);
        }
    std::printf("white furnace: at most %.4f for the sun; for the sky %.4f to %.4f, at least %.4f where alpha is over "
                "0.3\n",
                max, min, max_with_twice, min_rough);
    EXPECT_GE(min, 0.97);
    EXPECT_LE(max, 1.001);
    EXPECT_LE(max_with_twice, 1.01);  // error of the fitted lit fraction
    EXPECT_GE(min_rough, 0.85);
}

TEST_F(GlMirror, IsReciprocal) {
    const std::vector<float> values = computed(R"(
    float along = 1.5 * fract(pixel.y * 0.618), around = 6.28 * fract(pixel.x * 0.618 + 0.3 * pixel.y);
    vec3 sun_at = vec3(sin(along) * cos(around), cos(along), sin(along) * sin(around));
    // Only for a mirror that reflects light to the eye at all.
    float there = mirrored_fraction(up, eye_at, sun_at, 0.3, sqrt(0.3)) / sun_at.y;
    float back = mirrored_fraction(up, sun_at, eye_at, 0.3, sqrt(0.3)) / eye_at.y;
    result = vec4(there / back, there, back, 1.0);
)");
    int seen = 0;
    for (std::size_t i = 0; i < values.size(); i += 4) {
        if (values[i + 1] < 1e-3f) continue;
        ++seen;
        EXPECT_NEAR(values[i], 1, 2e-3);  // halves have steps of 1e-3
    }
    EXPECT_GT(seen, mirror_columns * mirror_rows / 2);
}

// A calm sea, an eye 2 to 30 degrees above it, normals that lean up to 20 degrees to and fro: under
// a uniform sky the reflected light changes by less than half a stop in 0.6 degrees. A larger
// change would draw an edge across each wave.
TEST_F(GlMirror, ReflectedLightChangesSmoothlyWithTheNormal) {
    const std::vector<float> values = computed(R"(
    float lean = radians(-20.0 + 40.0 * pixel.x / 64.0), eye_height = radians(2.0 + 28.0 * pixel.y / 32.0);
    vec3 normal = vec3(sin(lean), cos(lean), 0.0), to_eye = vec3(cos(eye_height), sin(eye_height), 0.0);
    float sky_share = mean_mirror(normal, to_eye, 0.001, 0.12).sky_share;
    result = vec4(sky_share, dot(normal, to_eye), 0.0, 1.0);
)");
    int compared = 0;
    float max_stops = 0;
    for (int row = 0; row < mirror_rows; ++row)
        for (int column = 1; column < mirror_columns; ++column) {
            const float* here = &values[4 * static_cast<std::size_t>(row * mirror_columns + column)];
            const float* before = here - 4;
            if (here[1] < 0.02f || before[1] < 0.02f) continue;  // not seen
            ++compared;
            max_stops = std::max(max_stops, std::abs(std::log2(here[0] / before[0])));
        }
    std::printf("largest change: %.2f stops in 0.6 degrees\n", static_cast<double>(max_stops));
    EXPECT_LT(max_stops, 0.5f);
    EXPECT_GT(compared, mirror_columns * mirror_rows / 2);
}

/// Computes Fresnel's reflectance from the amplitudes of both polarisations.
double fresnel(double cosine) {
    const double refracted = std::sqrt(1 - (1 - cosine * cosine) / (1.333 * 1.333));
    const double s = (cosine - 1.333 * refracted) / (cosine + 1.333 * refracted);
    const double p = (1.333 * cosine - refracted) / (1.333 * cosine + refracted);
    return 0.5 * (s * s + p * p);
}

/// Integrates over the slopes of facets, each weighted with its area as the eye sees it.
double mean_fresnel(double theta, double s) {
    constexpr int steps = 60;
    double sum = 0, weights = 0;
    for (int i = 0; i < 2 * steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double x = 5 * s * ((i + 0.5) / steps - 1), z = 5 * s * (j + 0.5) / steps;
            const double area = std::cos(theta) + std::sin(theta) * x;
            if (area <= 0) continue;
            const double weight = area * std::exp(-(x * x + z * z) / (2 * s * s));
            sum += weight * fresnel(std::min(1.0, area / std::sqrt(1 + x * x + z * z)));
            weights += weight;
        }
    return sum / weights;
}

TEST_F(GlMirror, UsesFresnelsMeanOverTheVisibleFacets) {
    const std::vector<float> values = computed("    result = vec4(mean_fresnel(cos(theta), alpha * sqrt(0.5)));\n");
    for (int row = 0; roughness(row) * std::sqrt(0.5) <= 0.2; row += 3)
        for (int column = 0; column < mirror_columns; column += 3) {
            const double expected = mean_fresnel(eye_from_zenith(column), roughness(row) * std::sqrt(0.5));
            // The shader's formula omits the third and higher moments.
            EXPECT_NEAR(values[4 * static_cast<std::size_t>(row * mirror_columns + column)], expected,
                        0.04 * expected)
                << "alpha " << roughness(row) << ", " << eye_from_zenith(column) * 180 / pi << " degrees";
        }
}

}  // namespace
}  // namespace pelagic
