// Hulls from mesh files, against closed forms and a file that Assimp wrote.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/test_paths.hpp"
#include "pelagic/tools/meshes/hull_file.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

using nlohmann::json;

const std::filesystem::path stored = in_sources("tests/fuzz/corpus/hull_file");

/// Returns the message of the error, or an empty string.
std::string error_of(const std::filesystem::path& file) {
    try {
        read_hull("--hull", file);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

void expect_near(const glm::dvec3& at, const glm::dvec3& expected, double within) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(at[axis], expected[axis], within) << "xyz"[axis];
}

// Corners at (0, 0, 0), (1, 0, 0), (0, 1, 0) and (0, 0, 1): volume 1/6,
// centre at 1/4. Its OBJ file has vertex colours, normals, and numbers that count backwards.
TEST(HullFile, AnObjTetrahedronHasItsVolumeAndCentre) {
    const HullMesh mesh = read_hull("--hull", stored / "tetrahedron.obj");
    EXPECT_NEAR(mesh.volume_m3(), 1.0 / 6, 1e-15);
    expect_near(mesh.centre_m(), {0.25, 0.25, 0.25}, 1e-15);
}

// A face of many corners is split. A box of 4 x 1 x 2 m.
TEST(HullFile, ObjFacesMayHaveMoreThanThreeCorners) {
    const TemporaryFolder folder;
    write_file(folder / "box.obj",
               "v -2 0 -1\r\nv 2 0 -1\r\nv 2 1 -1\r\nv -2 1 -1\r\nv -2 0 1\r\nv 2 0 1\r\nv 2 1 1\r\nv -2 1 1\r\n"
               "f 1 4 3 2\r\nf 5 6 7 8\r\nf 1 2 6 5\r\nf 4 8 7 3\r\nf 1 5 8 4\r\nf 2 3 7 6\r\n");
    const HullMesh mesh = read_hull("--hull", folder / "box.obj");
    EXPECT_EQ(mesh.triangles().size(), 12u);
    EXPECT_NEAR(mesh.volume_m3(), 8, 1e-14);
    expect_near(mesh.centre_m(), {0, 0.5, 0}, 1e-14);
}

// A backslash at the end of a line continues it. Errors name the first line.
TEST(HullFile, ObjLinesMayBeContinued) {
    const TemporaryFolder folder;
    const std::string vertices = "# C:\\\nv 0 0 \\\n 0\nv 1 0 0\r\nv 0 1 0\nv \\\r\n0 0 1\n";
    write_file(folder / "hull.obj", vertices + "f 1 \\\n3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\\");
    EXPECT_NEAR(read_hull("--hull", folder / "hull.obj").volume_m3(), 1.0 / 6, 1e-15);
    write_file(folder / "hull.obj", vertices + "f 1 \\\n3 \\\n9\n");
    EXPECT_NE(error_of(folder / "hull.obj").find("hull.obj:8: a corner of a face is 9"), std::string::npos)
        << error_of(folder / "hull.obj");
}

// Assimp 5.2 wrote the octahedron |x| + |y| + |z| <= 2: volume 4/3 2^3.
TEST(HullFile, ABinaryGltfFileOfAnotherProgramIsRead) {
    const HullMesh mesh = read_hull("--hull", stored / "octahedron.glb");
    EXPECT_EQ(mesh.triangles().size(), 8u);
    EXPECT_EQ(mesh.vertices().size(), 6u);
    EXPECT_NEAR(mesh.volume_m3(), 32.0 / 3, 1e-14);
    expect_near(mesh.centre_m(), {0, 0, 0}, 1e-15);
}

// The tetrahedron, mirrored and scaled by (1, 1, -2), turned about z by an angle of cosine
// 0.8^2 - 0.6^2 and sine 2 0.8 0.6, and moved by its parent. Bounds are those of doubles near 1.
TEST(HullFile, TransformsOfGltfNodesAreApplied) {
    const HullMesh mesh = read_hull("--hull", stored / "tetrahedron.gltf");
    EXPECT_NEAR(mesh.volume_m3(), 1.0 / 3, 1e-14);
    expect_near(mesh.centre_m(), {0.25 * 0.28 - 0.25 * 0.96, 1 + 0.25 * 0.96 + 0.25 * 0.28, -0.5}, 1e-14);
}

TEST(HullFile, BuffersOfGltfMayBeFilesBesideIt) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "my parts");
    json gltf = json::parse(read_file(stored / "tetrahedron.gltf"));
    std::string bytes(60, '\0');
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::memcpy(bytes.data(), corners, 48);
    const unsigned char indices[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    std::memcpy(bytes.data() + 48, indices, 12);
    write_file(folder / "my parts/a.bin", bytes);
    gltf["buffers"][0]["uri"] = "my%20parts/a.bin";
    write_file(folder / "hull.gltf", gltf.dump());
    EXPECT_NEAR(read_hull("--hull", folder / "hull.gltf").volume_m3(), 1.0 / 3, 1e-14);
    gltf["buffers"][0]["uri"] = "none.bin";
    write_file(folder / "hull.gltf", gltf.dump());
    EXPECT_NE(error_of(folder / "hull.gltf").find("none.bin, which can't be read"), std::string::npos)
        << error_of(folder / "hull.gltf");
}

// Vertices 256 to 259 of records of 20 bytes, the tetrahedron, whose floats begin at the fifth byte.
// Other vertices, the first index and all other bytes are not used.
TEST(HullFile, GltfIndicesOfTwoBytesStridesAndOffsetsAreRead) {
    constexpr std::size_t first = 256, stride = 20, records = (first + 4) * stride, view = 8;
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::uint16_t indices[] = {0xffff, 256, 258, 257, 256, 257, 259, 257, 258, 259, 256, 259, 258};
    std::string bytes(view + records + sizeof indices, '\x7f');
    for (std::size_t i = 0; i < 4; ++i) std::memcpy(&bytes[view + (first + i) * stride + 4], corners[i], 12);
    std::memcpy(&bytes[view + records], indices, sizeof indices);
    const TemporaryFolder folder;
    write_file(folder / "a.bin", bytes);
    json gltf = json::parse(read_file(stored / "tetrahedron.gltf"));
    gltf["buffers"][0] = {{"uri", "a.bin"}, {"byteLength", bytes.size()}};
    gltf["bufferViews"] = {{{"buffer", 0}, {"byteOffset", view}, {"byteLength", records}, {"byteStride", stride}},
                           {{"buffer", 0}, {"byteOffset", view + records}, {"byteLength", sizeof indices}}};
    gltf["accessors"][0].update({{"byteOffset", 4}, {"count", first + 4}});
    gltf["accessors"][1].update({{"byteOffset", 2}, {"componentType", 5123}});
    write_file(folder / "hull.gltf", gltf.dump());
    const HullMesh mesh = read_hull("--hull", folder / "hull.gltf");
    EXPECT_EQ(mesh.vertices().size(), 4u);
    EXPECT_NEAR(mesh.volume_m3(), 1.0 / 3, 1e-14);
}

// -0 equals 0, so the bits of a hull's results must not depend on it.
TEST(HullFile, NoVertexHasANegativeZero) {
    const TemporaryFolder folder;
    write_file(folder / "hull.obj",
               "v -0 -0 -0\nv 1 -0 -0\nv -0 1 -0\nv -0 -0 1\nv 0 0 0\nf 1 3 2\nf 5 2 4\nf 2 3 4\nf 1 4 3\n");
    const HullMesh mesh = read_hull("--hull", folder / "hull.obj");
    EXPECT_EQ(mesh.vertices().size(), 4u);
    for (const glm::dvec3& vertex : mesh.vertices())
        for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(std::signbit(vertex[axis])) << "xyz"[axis];
}

TEST(HullFile, LinksAndPipesDoNotLeadBuffersOfGltfElsewhere) {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const fs::path here = folder / "here";
    fs::create_directory(here);
    json gltf = json::parse(read_file(stored / "tetrahedron.gltf"));
    const std::string bytes(60, '\0');
    write_file(folder / "outside.bin", bytes);
    write_file(here / "own.bin", bytes);
    fs::create_symlink("own.bin", here / "own_link.bin");
    fs::create_symlink(folder / "outside.bin", here / "link.bin");
    fs::create_directory_symlink("..", here / "up");
    ASSERT_EQ(::mkfifo((here / "pipe.bin").c_str(), 0666), 0);
    const auto error_of_uri = [&](const std::string& uri) {
        gltf["buffers"][0]["uri"] = uri;
        write_file(here / "hull.gltf", gltf.dump());
        return error_of(here / "hull.gltf");
    };
    for (const char* uri : {"link.bin", "up/outside.bin"})
        EXPECT_NE(error_of_uri(uri).find(std::string(uri) + ", expected a file in the folder of"), std::string::npos)
            << error_of_uri(uri);
    for (const char* uri : {"pipe.bin", "up"})
        EXPECT_NE(error_of_uri(uri).find("expected a"), std::string::npos) << error_of_uri(uri);
    EXPECT_EQ(error_of_uri("own_link.bin").find("buffers[0]"), std::string::npos) << "the hull is flat, and read";
}

TEST(HullFile, AnInvalidGltfFileIsRejectedInOneLine) {
    const TemporaryFolder folder;
    const json good = json::parse(read_file(stored / "tetrahedron.gltf"));
    json deep = 1;
    for (int level = 0; level < 40; ++level) deep = json::array({deep});
    const std::vector<std::pair<std::string, std::function<void(json&)>>> cases = {
        {"asset.version is \"1.0\", expected 2.0", [](json& j) { j["asset"]["version"] = "1.0"; }},
        {"extensionsRequired is [\"KHR_draco_mesh_compression\"]",
         [](json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }},
        {"scenes[1] does not exist", [](json& j) { j["scene"] = 1; }},
        {"nodes[0] has two parents", [](json& j) { j["nodes"][1]["children"] = {0}; }},
        {"nodes[7] does not exist", [](json& j) { j["nodes"][1]["children"] = {7}; }},
        {"nodes[1].scale is no list of 3 numbers",
         [](json& j) {
             j["nodes"][1]["scale"] = {1, "2", 3};
         }},
        {"nodes[1].rotation is zero",
         [](json& j) {
             j["nodes"][1]["rotation"] = {0, 0, 0, 0};
         }},
        {"nodes[1].mesh is -1, expected a whole number", [](json& j) { j["nodes"][1]["mesh"] = -1; }},
        {"the scene has no triangles", [](json& j) { j["nodes"][1].erase("mesh"); }},
        {"meshes[0].primitives[0].mode is 5", [](json& j) { j["meshes"][0]["primitives"][0]["mode"] = 5; }},
        {"accessors[1] is empty or reaches past the end", [](json& j) { j["accessors"][1]["count"] = 15; }},
        {"accessors[0] is empty or reaches past the end", [](json& j) { j["accessors"][0]["count"] = 4294967295u; }},
        {"has 11 corners, expected triangles", [](json& j) { j["accessors"][1]["count"] = 11; }},
        {"has index 3, expected less than 3", [](json& j) { j["accessors"][0]["count"] = 3; }},
        {"accessors[0].componentType is 5123", [](json& j) { j["accessors"][0]["componentType"] = 5123; }},
        {"accessors[0].type is not VEC3", [](json& j) { j["accessors"][0]["type"] = "VEC2"; }},
        {"accessors[0] is sparse", [](json& j) { j["accessors"][0]["sparse"] = json::object(); }},
        {"byteStride 4 is out of range [12, 252]", [](json& j) { j["bufferViews"][0]["byteStride"] = 4; }},
        {"bufferViews[1] reaches past the end", [](json& j) { j["bufferViews"][1]["byteOffset"] = 4294967295u; }},
        {"buffers[0] has 60 bytes, expected 61", [](json& j) { j["buffers"][0]["byteLength"] = 61; }},
        {"expected a file in the folder of", [](json& j) { j["buffers"][0]["uri"] = "../a.bin"; }},
        {"expected a file in the folder of", [](json& j) { j["buffers"][0]["uri"] = "%2Fdev/zero"; }},
        {"expected a file in the folder of", [](json& j) { j["buffers"][0]["uri"] = "http://a/b.bin"; }},
        {"but not in base64", [](json& j) { j["buffers"][0]["uri"] = "data:;base64,*"; }},
        {"JSON has more than 32 levels", [&](json& j) { j["extras"] = deep; }},
        {"JSON has more than 200000 values", [](json& j) { j["extras"] = std::vector<int>(200'000, 1); }},
        {"the hull has 2 triangles", [](json& j) { j["accessors"][1]["count"] = 6; }},
        {"vertex 0: y",
         [](json& j) {
             j["nodes"][0]["translation"] = {0, 1e300, 0};
         }},
    };
    for (const auto& [reason, change] : cases) {
        json gltf = good;
        change(gltf);
        write_file(folder / "hull.gltf", gltf.dump());
        const std::string error = error_of(folder / "hull.gltf");
        EXPECT_NE(error.find(reason), std::string::npos) << "expected " << reason << ": " << error;
        EXPECT_TRUE(error.starts_with((folder / "hull.gltf").string())) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
}

// Every prefix of a binary file, and every file with one changed byte of its headers, is read or
// rejected, and reads no byte outside (with sanitizers).
TEST(HullFile, ADamagedBinaryFileIsReadOrRejected) {
    const std::string good = read_file(stored / "octahedron.glb");
    const auto is_read = [](const std::string& bytes) {
        try {
            parse_gltf_hull("hull.glb", bytes);
        } catch (const InputError&) {
            return false;
        }
        return true;
    };
    ASSERT_TRUE(is_read(good));
    for (std::size_t size = 4; size < good.size(); ++size) EXPECT_FALSE(is_read(good.substr(0, size))) << size;
    for (std::size_t at = 4; at < 32; ++at) {
        std::string bad = good;
        bad[at] = static_cast<char>(~bad[at]);
        EXPECT_FALSE(is_read(bad)) << at;
    }
}

TEST(HullFile, AnInvalidObjFileIsRejectedInOneLine) {
    const TemporaryFolder folder;
    std::string large = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 4097; ++i) large += "f 1 2 3\n";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"has no faces, expected an OBJ or glTF 2.0 file", ""},
        {"has no faces", "\x89PNG\r\n"},
        {":2: y of a vertex is nan, expected a number of metres", "# a\nv 0 nan 0"},
        {":1: z of a vertex is , expected", "v 0 0"},
        {":2: a corner of a face is 2, expected the number of one of the 1 vertices above", "v 0 0 0\nf 1 1 2"},
        {":2: a corner of a face is 0", "v 0 0 0\nf 1 1 0"},
        {":2: a corner of a face is -2", "v 0 0 0\nf 1 1 -2"},
        {":2: a corner of a face is x", "v 0 0 0\nf 1 1 x"},
        {":2: the number of a face's corners is 2, expected 3 or more", "v 0 0 0\nf 1 1"},
        {":4100: the hull has more than 4096 triangles", large},
        // The faces 1 4 5 and 3 5 4 are missing. OBJ counts vertices from 1.
        {"the hull is open at the edge between vertices 1 and 5, expected a closed mesh",
         "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nf 1 2 3 4\nf 1 5 2\nf 2 5 3"},
        {"hull.obj: vertex 2: y 1001 is out of range [-1000, 1000] m",
         "v 0 0 0\nv 1 1001 0\nv 0 0 1\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3"},
    };
    for (const auto& [reason, text] : cases) {
        write_file(folder / "hull.obj", text);
        const std::string error = error_of(folder / "hull.obj");
        EXPECT_NE(error.find(reason), std::string::npos) << "expected " << reason << ": " << error;
        EXPECT_TRUE(error.starts_with((folder / "hull.obj").string())) << error;
    }
    EXPECT_NE(error_of(folder / "none.obj").find("can't be read"), std::string::npos);
}

}  // namespace
}  // namespace pelagic::tools
