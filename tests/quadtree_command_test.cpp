// `pelagic quadtree`: what it prints and writes, read by somebody else.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

struct Obj {
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::array<int, 3>> faces;  ///< from 0
};

Obj read_obj(const std::string& text) {
    Obj obj;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            auto& v = obj.vertices.emplace_back();
            words >> v[0] >> v[1] >> v[2];
        } else if (kind == "f") {
            auto& f = obj.faces.emplace_back();
            words >> f[0] >> f[1] >> f[2];
            for (int& index : f) --index;
        }
    }
    return obj;
}

TEST(QuadtreeCommand, TheWholeMeshIsOneClosedSheetWithAFlatBorder) {
    TemporaryFolder folder;
    const Outcome run =
        run_pelagic({"quadtree", "--size", "1000", "--quality", "low", "--all", "--camera", "123,4,-56", "--obj",
                     (folder / "sea.obj").string(), "--json", (folder / "sea.json").string(), "--resolution", "64"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Obj obj = read_obj(read_file(folder / "sea.obj"));
    const auto json = nlohmann::json::parse(read_file(folder / "sea.json"));
    EXPECT_EQ(obj.faces.size(), json.at("triangles").get<std::size_t>());

    std::map<std::pair<int, int>, int> edges;
    double area = 0;
    for (const auto& f : obj.faces) {
        const auto &a = obj.vertices.at(static_cast<std::size_t>(f[0])),
                   &b = obj.vertices.at(static_cast<std::size_t>(f[1])),
                   &c = obj.vertices.at(static_cast<std::size_t>(f[2]));
        area += ((b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2])) / 2;
        for (int e = 0; e < 3; ++e)
            ++edges[{f[static_cast<std::size_t>(e)], f[static_cast<std::size_t>((e + 1) % 3)]}];
    }
    EXPECT_NEAR(area, 1e6, 1);  // four decimals a vertex
    int border = 0;
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        if (edges.contains({edge.second, edge.first})) continue;
        ++border;
        EXPECT_EQ(obj.vertices.at(static_cast<std::size_t>(edge.first))[1], 0);
    }
    EXPECT_GT(border, 0);
    // A sheet: one face more than edges less vertices. An edge inside stands in the map twice.
    const auto all_edges = static_cast<long>((edges.size() + static_cast<std::size_t>(border)) / 2);
    EXPECT_EQ(static_cast<long>(obj.vertices.size()) - all_edges + static_cast<long>(obj.faces.size()), 1);
}

TEST(QuadtreeCommand, FiguresAgreeWithEachOther) {
    TemporaryFolder folder;
    const std::string json_file = (folder / "q.json").string();
    const Outcome run = run_pelagic({"quadtree", "--size", "4096", "--camera", "10,5,10", "--target", "500,0,100",
                                     "--fov", "70", "--stereo", "0.064", "--json", json_file, "--resolution", "32"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(read_file(json_file));
    int patches = 0, instances = 0;
    for (const auto& level : json.at("patches_by_level")) patches += level.at("patches").get<int>();
    for (const auto& batch : json.at("batches")) instances += batch.at("instances").get<int>();
    EXPECT_EQ(patches, json.at("instances"));
    EXPECT_EQ(instances, json.at("instances"));
    EXPECT_EQ(json.at("views"), 2);
    EXPECT_LE(json.at("batches").size(), 16u);
    EXPECT_GT(json.at("microseconds").get<double>(), 0);
    EXPECT_NE(run.out.find("triangles"), std::string::npos);
}

TEST(QuadtreeCommand, ThePlanShowsEveryPatchAndTheFrustum) {
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

TEST(QuadtreeCommand, AFailedWriteIsOneLineAndNothingHalfWritten) {
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
