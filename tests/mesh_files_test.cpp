// Meshes of the sea: positions of their vertices, and contents of their files, byte by byte.
// tests/night/mesh_test.sh reads the files with third-party programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tools/meshes/gltf_file.hpp"
#include "pelagic/tools/meshes/mesh.hpp"
#include "pelagic/tools/meshes/sea_mesh.hpp"

namespace pelagic::tools {
namespace {

using nlohmann::json;

const SeaState one_cascade{
    .resolution = 32, .patch_size_m = 100, .wind_speed_mps = 12, .choppiness = 0.5, .loop_period_s = 20};

Ocean ocean_of(const SeaState& sea) {
    return Ocean(sea, {.executor = make_serial_executor(), .queries = true, .foam = true});
}

/// Compares each vertex's displaced position with a query of that position.
void expect_the_sea(const Frame& frame, const Mesh& mesh) {
    const SurfaceQuery water(frame, 1e-4);
    const std::size_t count = mesh.positions.size();
    std::vector<double> x, z;
    for (const glm::dvec3& p : mesh.positions) x.push_back(p.x), z.push_back(p.z);
    std::vector<float> height(count), nx(count), ny(count), nz(count), foam(count);
    water.sample({x, z}, {.height_m = height, .normal_x = nx, .normal_y = ny, .normal_z = nz, .foam = foam});
    ASSERT_EQ(mesh.normals.size(), count);
    ASSERT_EQ(mesh.foam.size(), count);
    EXPECT_GT(*std::max_element(foam.begin(), foam.end()), 0) << "tells nothing about foam";
    for (std::size_t v = 0; v < count; ++v) {
        // Queries converge to 1/64 of the tolerance, and slopes are below 1.
        EXPECT_NEAR(mesh.positions[v].y, static_cast<double>(height[v]), 1e-5);
        EXPECT_NEAR(static_cast<double>(mesh.foam[v]), static_cast<double>(foam[v]), 1e-3);
        // Both use differences over two texels of the finest cascade; float cosines near 1 have
        // steps of 0.02 degrees. A query of a stack takes the other cascades' differences over two
        // of their texels, which smooths them: measured 1.3 degrees at most.
        const float cosine = glm::dot(mesh.normals[v], glm::vec3(nx[v], ny[v], nz[v]));
        EXPECT_GT(cosine, std::cos((frame.cascades.size() == 1 ? 0.05f : 2.f) * std::numbers::pi_v<float> / 180));
    }
}

TEST(SeaMesh, GridOfACascadeMatchesTheSea) {
    Ocean ocean = ocean_of(one_cascade);
    const Frame& frame = ocean.frame_at(3);
    const Mesh mesh = mesh_of(frame, {100, 32});
    expect_the_sea(frame, mesh);
    EXPECT_EQ(mesh.positions.size(), 33u * 33);
    EXPECT_EQ(mesh.face_count(), 32u * 32);
}

TEST(SeaMesh, FineSquareOfAStackMatchesTheSea) {
    Ocean ocean = ocean_of({.cascades = 2, .resolution = 32, .wind_speed_mps = 14, .choppiness = 0.5});
    const Frame& frame = ocean.frame_at(3);
    expect_the_sea(frame, mesh_of(frame, {32 * frame.cascades[1].texel_m(), 32, 2}));
}

TEST(SeaMesh, WavesShorterThanTwoStepsAreOmitted) {
    const std::vector<CascadePlan> plans = plan_cascades({.cascades = 3, .resolution = 32});
    for (std::size_t cascade = 1; cascade < 3; ++cascade) {
        const double longest_step_m =
            1.5 * plans[cascade].grid.side_m / 32;  // two of them for a wave of three texels
        EXPECT_EQ(cascades_shown_by(longest_step_m * 0.999, plans), cascade + 1);
        EXPECT_EQ(cascades_shown_by(longest_step_m * 1.001, plans), cascade);
    }
    EXPECT_EQ(cascades_shown_by(1e6, plans), 1u);
}

TEST(SeaMesh, OneCascadeIsPeriodic) {
    Ocean ocean = ocean_of(one_cascade);
    const Mesh mesh = mesh_of(ocean.frame_at(5), {100, 32});
    for (std::size_t k = 0; k <= 32; ++k) {
        const auto expect_shifted = [&](std::size_t from, std::size_t to, const glm::dvec3& by) {
            const glm::dvec3 off = mesh.positions[to] - mesh.positions[from] - by;
            EXPECT_LT(glm::length(off), 1e-12);  // of doubles near 100
            EXPECT_EQ(mesh.foam[to], mesh.foam[from]);
        };
        expect_shifted(k * 33, k * 33 + 32, {100, 0, 0});
        expect_shifted(k, 32 * 33 + k, {0, 0, 100});
    }
}

TEST(SeaMesh, FacesPointUp) {
    Ocean ocean = ocean_of(one_cascade);
    const Mesh mesh = mesh_of(ocean.frame_at(5), {100, 32});
    double area = 0;
    for (std::size_t at = 0; at < mesh.faces.size(); at += 4)
        for (std::size_t corner = 0; corner < 4; ++corner) {
            const glm::dvec3 &a = mesh.positions.at(mesh.faces[at + corner]),
                             &b = mesh.positions.at(mesh.faces[at + (corner + 1) % 4]);
            area += (a.z * b.x - a.x * b.z) / 2;
        }
    EXPECT_NEAR(area, 100 * 100, 1e-8);  // periodic edges enclose the undisplaced area
}

/// A square whose corners are in an order that cannot hide an error.
Mesh small_mesh(bool has_foam) {
    Mesh mesh{.positions = {{0, 0.1, -0.5}, {1, 0, 0}, {0, 2, 1}, {1, 0, 1.25}},
              .normals = {{0, 1, 0}, {0.6f, 0.8f, 0}, {0, 1, 0}, {0, 0.8f, -0.6f}},
              .texture_coordinates = {{0.125f, 0.875f}, {1.125f, 0.875f}, {0.125f, -0.125f}, {1.125f, -0.125f}},
              .foam = {},
              .faces = {0, 2, 3, 1},
              .corners = 4};
    if (has_foam) mesh.foam = {0, 0.25f, 0.5f, 1};
    return mesh;
}

TEST(MeshFiles, ObjIsText) {
    EXPECT_EQ(mesh_as_obj(small_mesh(false), ObjDigits::of_floats),
              "# Pelagic: a sea, faces counter-clockwise from above\ns 1\n"
              "v 0 0.1 -0.5\nvt 0.125000 0.875000\nvn 0.0000 1.0000 0.0000\n"
              "v 1 0 0\nvt 1.125000 0.875000\nvn 0.6000 0.8000 0.0000\n"
              "v 0 2 1\nvt 0.125000 -0.125000\nvn 0.0000 1.0000 0.0000\n"
              "v 1 0 1.25\nvt 1.125000 -0.125000\nvn 0.0000 0.8000 -0.6000\n"
              "f 1/1/1 3/3/3 4/4/4 2/2/2\n");
    EXPECT_NE(mesh_as_obj(small_mesh(true), ObjDigits::of_floats).find("\nv 1 0 0 0.2500 0.2500 0.2500\n"),
              std::string::npos);
    Mesh third = small_mesh(false);
    third.positions[0].y = 1.0 / 3;
    EXPECT_NE(mesh_as_obj(third, ObjDigits::of_floats).find("\nv 0 0.33333334 -0.5\n"), std::string::npos);
    EXPECT_NE(mesh_as_obj(third, ObjDigits::all).find("\nv 0 0.3333333333333333 -0.5\n"), std::string::npos);
}

std::string as_text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

template <class Number>
Number value_at(const std::string& bytes, std::size_t at) {
    Number number;
    std::memcpy(&number, bytes.substr(at).data(), sizeof number);
    return number;
}

TEST(MeshFiles, PlyIsBinaryAfterItsHeader) {
    const std::string file = as_text(mesh_as_ply(small_mesh(true)));
    const std::string header =
        "ply\nformat binary_little_endian 1.0\n"
        "comment Pelagic: a sea, faces counter-clockwise from above\nelement vertex 4\n"
        "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float "
        "nz\n"
        "property float s\nproperty float t\nproperty float foam\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    ASSERT_EQ(file.substr(0, header.size()), header);
    constexpr std::size_t vertex = 9 * 4 + 3;
    ASSERT_EQ(file.size(), header.size() + 4 * vertex + 1 + 4 * 4);
    const std::size_t second = header.size() + vertex;
    const std::vector<float> numbers = {1, 0, 0, 0.6f, 0.8f, 0, 1.125f, 0.875f, 0.25f};
    for (std::size_t k = 0; k < numbers.size(); ++k) EXPECT_EQ(value_at<float>(file, second + 4 * k), numbers[k]);
    EXPECT_EQ(file.substr(second + 36, 3), "\x40\x40\x40");  // a quarter of 255, rounded
    EXPECT_EQ(file[header.size() + 4 * vertex], 4);
    EXPECT_EQ(value_at<std::uint32_t>(file, file.size() - 12), 2u);
    EXPECT_EQ(as_text(mesh_as_ply(small_mesh(false))).find("foam"), std::string::npos);
}

TEST(MeshFiles, MddIsBigEndian) {
    Mesh mesh = small_mesh(false);
    mesh.positions.resize(1);
    mesh.positions[0] = {1, -2, 0.5};
    Bytes file;
    append_mdd_header(file, std::vector<float>{0, 0.25f}, 1);
    append_mdd_frame(file, mesh);
    using namespace std::string_literals;
    EXPECT_EQ(as_text(file),
              "\0\0\0\x02\0\0\0\x01\0\0\0\0\x3e\x80\0\0"s
              "\x3f\x80\0\0\xc0\0\0\0\x3f\0\0\0"s);
}

/// The parsed parts of a glTF file.
struct Glb {
    explicit Glb(const Bytes& bytes) {
        const std::string file = as_text(bytes);
        EXPECT_EQ(file.substr(0, 4), "glTF");
        EXPECT_EQ(value_at<std::uint32_t>(file, 4), 2u);
        EXPECT_EQ(value_at<std::uint32_t>(file, 8), file.size());
        const std::uint32_t text = value_at<std::uint32_t>(file, 12);
        EXPECT_EQ(file.substr(16, 4), "JSON");
        description = json::parse(file.substr(20, text));
        EXPECT_EQ(file.substr(24 + text, 4), std::string("BIN\0", 4));
        buffer = file.substr(28 + text);
        EXPECT_EQ(value_at<std::uint32_t>(file, 20 + text), buffer.size());
    }
    template <class Number>
    std::vector<Number> numbers(std::size_t accessor) const {
        const json& view =
            description["bufferViews"][description["accessors"][accessor]["bufferView"].get<std::size_t>()];
        std::vector<Number> all(view["byteLength"].get<std::size_t>() / sizeof(Number));
        std::memcpy(all.data(), buffer.data() + view["byteOffset"].get<std::size_t>(), all.size() * sizeof(Number));
        return all;
    }
    const json& primitive() const { return description["meshes"][0]["primitives"][0]; }

    json description;
    std::string buffer;
};

TEST(MeshFiles, GlbHasTrianglesAndCountsVFromTheTop) {
    const Glb glb(GlbFile(small_mesh(true)).finish(1, false));
    const json& attributes = glb.primitive()["attributes"];
    EXPECT_EQ(glb.numbers<std::uint32_t>(glb.primitive()["indices"]), (std::vector<std::uint32_t>{0, 2, 3, 0, 3, 1}));
    EXPECT_EQ(glb.numbers<float>(attributes["POSITION"])[11], 1.25f);
    EXPECT_EQ(glb.numbers<float>(attributes["TEXCOORD_0"]),
              (std::vector<float>{0.125f, 0.125f, 1.125f, 0.125f, 0.125f, 1.125f, 1.125f, 1.125f}));
    EXPECT_EQ(glb.numbers<float>(attributes["_FOAM"]), (std::vector<float>{0, 0.25f, 0.5f, 1}));
    EXPECT_EQ(glb.numbers<std::uint8_t>(attributes["COLOR_0"])[4], 64);
    EXPECT_FALSE(glb.description.contains("animations"));
    EXPECT_FALSE(Glb(GlbFile(small_mesh(false)).finish(1, false)).primitive()["attributes"].contains("COLOR_0"));
}

/// The frames of a loop as a viewer shows them: weights interpolated between the keys around a
/// time, and targets weighted by them.
TEST(MeshFiles, AnimatedGlbShowsEachFrameAtItsTimeAndLoops) {
    Ocean ocean = ocean_of(one_cascade);
    constexpr std::size_t frames = 5;
    constexpr double fps = frames / 20.0;
    std::vector<Mesh> meshes;
    for (std::size_t k = 0; k < frames; ++k)
        meshes.push_back(mesh_of(ocean.frame_at(static_cast<double>(k) / fps), {100, 32}));
    GlbFile file(meshes[0]);
    for (std::size_t k = 1; k < frames; ++k) file.add(meshes[k]);
    const Glb glb(file.finish(fps, true));
    EXPECT_EQ(glb.buffer.size(), GlbFile::buffer_bytes(33 * 33, 2 * 32 * 32, frames));

    const json& animation = glb.description["animations"][0];
    EXPECT_EQ(animation["channels"][0]["target"]["path"], "weights");
    const auto times_s = glb.numbers<float>(animation["samplers"][0]["input"]);
    const auto weights = glb.numbers<float>(animation["samplers"][0]["output"]);
    ASSERT_EQ(times_s.size(), frames + 1);
    ASSERT_EQ(weights.size(), (frames + 1) * (frames - 1));
    for (const auto& [name, width] : {std::pair{"POSITION", 3}, {"NORMAL", 3}}) {
        const auto base = glb.numbers<float>(glb.primitive()["attributes"][name]);
        for (std::size_t k = 0; k <= frames; ++k) {
            EXPECT_FLOAT_EQ(times_s[k], static_cast<float>(static_cast<double>(k) / fps));
            std::vector<float> shown = base;
            for (std::size_t target = 0; target + 1 < frames; ++target) {
                const auto moved = glb.numbers<float>(glb.primitive()["targets"][target][name]);
                for (std::size_t n = 0; n < shown.size(); ++n)
                    shown[n] += weights[k * (frames - 1) + target] * moved[n];
            }
            const Mesh& mesh = meshes[k % frames];
            for (std::size_t n = 0; n < shown.size(); ++n) {
                const auto vertex = n / static_cast<std::size_t>(width), axis = n % static_cast<std::size_t>(width);
                const float wanted = name == std::string("NORMAL")
                                         ? mesh.normals[vertex][static_cast<int>(axis)]
                                         : static_cast<float>(mesh.positions[vertex][static_cast<int>(axis)]);
                ASSERT_NEAR(shown[n], wanted, 1e-5) << name << k;  // a step of floats around 100
            }
        }
    }
}

}  // namespace
}  // namespace pelagic::tools
