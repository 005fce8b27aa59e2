// `pelagic quadtree`: its output and files, read by independent code.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

using Triple = std::array<double, 3>;

struct Obj {
    std::vector<Triple> vertices, normals;
    std::vector<std::array<double, 2>> texture;
    std::vector<std::array<std::size_t, 3>> faces;  ///< indices from 0
};

Obj read_obj(const std::string& text) {
    Obj obj;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v" || kind == "vn") {
            Triple& v = (kind == "v" ? obj.vertices : obj.normals).emplace_back();
            words >> v[0] >> v[1] >> v[2];
        } else if (kind == "vt") {
            auto& t = obj.texture.emplace_back();
            words >> t[0] >> t[1];
        } else if (kind == "f") {
            auto& face = obj.faces.emplace_back();
            for (std::size_t& corner : face) {
                std::size_t texture = 0, normal = 0;
                char slash = 0;
                words >> corner >> slash >> texture >> slash >> normal;
                EXPECT_TRUE(texture == corner && normal == corner && corner > 0) << line;
                --corner;
            }
        }
    }
    return obj;
}

/// Merges vertices with bit-identical positions; a vertex on which two patches differ stays two.
struct Welded {
    explicit Welded(const Obj& obj) {
        for (const Triple& place : obj.vertices)
            number_of.push_back(numbers.try_emplace(place, numbers.size()).first->second);
    }
    std::map<Triple, std::size_t> numbers;
    std::vector<std::size_t> number_of;
};

TEST(QuadtreeCommand, WholeMeshIsOneSurfaceWithAFlatBorder) {
    TemporaryFolder folder;
    const Outcome run =
        run_pelagic({"quadtree", "--size", "1000", "--quality", "low", "--all", "--camera", "123,4,-56", "--obj",
                     (folder / "sea.obj").string(), "--json", (folder / "sea.json").string(), "--resolution", "64"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Obj obj = read_obj(read_file(folder / "sea.obj"));
    const auto statistics = nlohmann::json::parse(read_file(folder / "sea.json"));
    EXPECT_EQ(obj.faces.size(), statistics.at("triangles").get<std::size_t>());
    const Welded welded(obj);
    EXPECT_GT(obj.vertices.size(), welded.numbers.size()) << "each patch has vertices of its own";

    std::map<std::pair<std::size_t, std::size_t>, int> edges;
    std::map<std::size_t, Triple> place_of;
    double area = 0;
    for (const auto& f : obj.faces) {
        const Triple &a = obj.vertices.at(f[0]), &b = obj.vertices.at(f[1]), &c = obj.vertices.at(f[2]);
        area += ((b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2])) / 2;
        for (std::size_t e = 0; e < 3; ++e) {
            const std::size_t from = welded.number_of.at(f[e]), to = welded.number_of.at(f[(e + 1) % 3]);
            ++edges[{from, to}];
            place_of[from] = obj.vertices[f[e]];
        }
    }
    EXPECT_NEAR(area, 1e6, 1e-3);  // sums of a hundred thousand products of doubles
    int border = 0;
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        if (edges.contains({edge.second, edge.first})) continue;
        ++border;
        EXPECT_EQ(place_of.at(edge.first)[1], 0);
    }
    EXPECT_GT(border, 0);
    // For a disc, faces - edges + vertices = 1. An inner edge is in the map twice.
    const auto all_edges = static_cast<long>((edges.size() + static_cast<std::size_t>(border)) / 2);
    EXPECT_EQ(static_cast<long>(welded.numbers.size()) - all_edges + static_cast<long>(obj.faces.size()), 1);
}

// Texture coordinates give the reference position, the reference position gives the displaced
// position, and that gives the normal.
TEST(QuadtreeCommand, VerticesHaveTextureCoordinatesAndNormals) {
    TemporaryFolder folder;
    const Outcome run =
        run_pelagic({"quadtree", "--size", "1000", "--quality", "low", "--all", "--camera", "0,4,0", "--obj",
                     (folder / "sea.obj").string(), "--resolution", "64", "--patch-size", "250"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Obj obj = read_obj(read_file(folder / "sea.obj"));
    ASSERT_EQ(obj.texture.size(), obj.vertices.size());
    ASSERT_EQ(obj.normals.size(), obj.vertices.size());

    const SeaState sea{.resolution = 64, .patch_size_m = 250};
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true});
    const Frame& frame = ocean.frame_at(0);
    const SurfaceQuery water(frame);
    int in_place = 0;
    for (std::size_t v = 0; v < obj.vertices.size(); ++v) {
        const Triple &place = obj.vertices[v], &normal = obj.normals[v];
        EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1, 2e-4);
        const double x = (obj.texture[v][0] - 0.5 / 64) * sea.patch_size_m;
        const double z = (1 - obj.texture[v][1] - 0.5 / 64) * sea.patch_size_m;
        // Six decimals of 250 m. Other vertices are morphing between two levels, or fading out
        // towards the border.
        const Displacement moved = displacement_of(frame, x, z);
        const double off = std::hypot(x + moved.dx - place[0], moved.height - place[1], z + moved.dz - place[2]);
        const bool is_fading = std::max(std::abs(x), std::abs(z)) > 5.0 / 16 * 1000 - sea.patch_size_m / 64;
        if (off > 1e-3 || is_fading) continue;
        ++in_place;
        float nx[1], ny[1], nz[1];
        water.sample({{&place[0], 1}, {&place[2], 1}}, {.normal_x = nx, .normal_y = ny, .normal_z = nz});
        const double cosine = normal[0] * static_cast<double>(nx[0]) + normal[1] * static_cast<double>(ny[0]) +
                              normal[2] * static_cast<double>(nz[0]);
        // Both use the same differences; the error is that of four decimals and of the query's
        // millimetre.
        EXPECT_GT(cosine / std::hypot(normal[0], normal[1], normal[2]), std::cos(0.05 * std::numbers::pi / 180))
            << x << " " << z;
    }
    EXPECT_GT(in_place, 1000);
}

// tests/mesh_files_test.cpp checks the files' contents.
TEST(QuadtreeCommand, PlyAndGltfHoldTheSameMesh) {
    TemporaryFolder folder;
    const Outcome run = run_pelagic({"quadtree", "--size", "1000", "--quality", "low", "--resolution", "32", "--foam",
                                     "--obj", (folder / "q.obj").string(), "--ply", (folder / "q.ply").string(),
                                     "--gltf", (folder / "q.glb").string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Obj obj = read_obj(read_file(folder / "q.obj"));
    const std::string ply = read_file(folder / "q.ply"), glb = read_file(folder / "q.glb");
    EXPECT_NE(ply.find("element vertex " + std::to_string(obj.vertices.size()) + "\n"), std::string::npos);
    EXPECT_NE(ply.find("element face " + std::to_string(obj.faces.size()) + "\n"), std::string::npos);
    EXPECT_NE(ply.find("property float foam\n"), std::string::npos);
    const auto gltf = nlohmann::json::parse(glb.substr(20, glb.find("BIN") - 24));
    EXPECT_EQ(gltf.at("accessors").at(0).at("count"), obj.vertices.size());
    EXPECT_EQ(gltf["accessors"][gltf["meshes"][0]["primitives"][0]["indices"].get<std::size_t>()]["count"],
              3 * obj.faces.size());
}

TEST(QuadtreeCommand, StatisticsAreConsistent) {
    TemporaryFolder folder;
    const std::string json_file = (folder / "q.json").string();
    const Outcome run = run_pelagic({"quadtree", "--size", "4096", "--camera", "10,5,10", "--target", "500,0,100",
                                     "--fov", "70", "--stereo", "0.064", "--json", json_file, "--resolution", "32"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto statistics = nlohmann::json::parse(read_file(json_file));
    int patches = 0, instances = 0;
    for (const auto& level : statistics.at("patches_by_level")) patches += level.at("patches").get<int>();
    for (const auto& batch : statistics.at("batches")) instances += batch.at("instances").get<int>();
    EXPECT_EQ(patches, statistics.at("instances"));
    EXPECT_EQ(instances, statistics.at("instances"));
    EXPECT_EQ(statistics.at("views"), 2);
    EXPECT_LE(statistics.at("batches").size(), 16u);
    EXPECT_GT(statistics.at("microseconds").get<double>(), 0);
    EXPECT_NE(run.out.find("triangles"), std::string::npos);
}

TEST(QuadtreeCommand, PlanShowsEveryPatchAndTheFrustum) {
    TemporaryFolder folder;
    const std::string svg_file = (folder / "q.svg").string(), json_file = (folder / "q.json").string();
    ASSERT_EQ(run_pelagic({"quadtree", "--all", "--json", json_file, "--resolution", "32"}).exit_code, 0);
    const int all = nlohmann::json::parse(read_file(json_file)).at("instances").get<int>();
    ASSERT_EQ(run_pelagic({"quadtree", "--svg", svg_file, "--json", json_file, "--resolution", "32"}).exit_code, 0);
    const int drawn = nlohmann::json::parse(read_file(json_file)).at("instances").get<int>();
    const std::string svg = read_file(svg_file);
    const auto count = [&](const std::string& what) {
        int n = 0;
        for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++n;
        return n;
    };
    EXPECT_EQ(count("fill-opacity=\"1\""), drawn);
    EXPECT_EQ(count("fill-opacity=\"0.18\""), all - drawn);
    EXPECT_GT(all, drawn);
    EXPECT_EQ(count("<polygon"), 1);
    EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
}

TEST(QuadtreeCommand, FailedWriteGivesOneLineAndNoPartialFile) {
    TemporaryFolder folder;
    const Outcome run =
        run_pelagic({"quadtree", "--obj", (folder / "no/such/folder.obj").string(), "--resolution", "32"});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("can't write"), std::string::npos);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
    EXPECT_TRUE(files_in(folder.path()).empty());
}

}  // namespace
}  // namespace pelagic
