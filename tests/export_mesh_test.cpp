// `pelagic export --mesh`: its files, invalid options, and independence of the bytes from threads
// and maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/files/digest.hpp"

namespace pelagic {
namespace {

Outcome export_mesh_to(const TemporaryFolder& folder, const Arguments& more) {
    return run_pelagic(joined({"export", "--out", folder.path().string(), "--resolution", "32", "--patch-size", "100",
                               "--no-sync", "--loop-period", "20"},
                              more));
}

const std::vector<std::string> all_meshes = {"--maps", "none",   "--loop-frames",
                                             "3",      "--mesh", "obj,ply,gltf,gltf-animation,mdd"};

TEST(ExportMesh, EachFormatHasFilesAndARecord) {
    const TemporaryFolder folder;
    const Outcome outcome = export_mesh_to(folder, all_meshes);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::vector<std::string> names;
    for (const auto& [name, bytes] : files_in(folder.path())) names.push_back(name);
    EXPECT_EQ(names, (std::vector<std::string>{".sea.lock", "mesh.glb", "mesh.mdd", "mesh_0000.glb", "mesh_0000.obj",
                                               "mesh_0000.ply", "mesh_0001.glb", "mesh_0001.obj", "mesh_0001.ply",
                                               "mesh_0002.glb", "mesh_0002.obj", "mesh_0002.ply", "sea.json",
                                               "sea_files.json"}));
    const auto record = nlohmann::json::parse(read_file(folder / "sea.json"));
    EXPECT_EQ(record["export"]["mesh"]["side_m"], 100);
    EXPECT_EQ(record["export"]["mesh"]["steps"], 32);
    EXPECT_EQ(record["frames"][1]["files"].size(), 3u);
    EXPECT_EQ(record["frames"][1]["files"][0]["name"], "mesh_0001.obj");
    EXPECT_EQ(record["sequence_files"].size(), 2u);
}

TEST(ExportMesh, BytesDoNotDependOnThreadsAndMaps) {
    const TemporaryFolder one, other;
    ASSERT_EQ(export_mesh_to(one, joined(all_meshes, {"--threads", "1"})).exit_code, 0);
    std::vector<std::string> with_maps = joined(all_meshes, {"--threads", "3"});
    with_maps[1] = "displacement";
    ASSERT_EQ(export_mesh_to(other, with_maps).exit_code, 0);
    const auto others = files_in(other.path());
    for (const auto& [name, bytes] : files_in(one.path()))
        EXPECT_TRUE(name == "sea.json" || name == "sea_files.json" || others.at(name) == bytes) << name;
}

TEST(ExportMesh, ResumeReplacesADamagedMesh) {
    const TemporaryFolder folder;
    ASSERT_EQ(export_mesh_to(folder, all_meshes).exit_code, 0);
    const auto whole = files_in(folder.path());
    write_file(folder / "mesh_0001.ply", "ply");
    write_file(folder / "mesh.mdd", "");
    const Outcome outcome = export_mesh_to(folder, joined(all_meshes, {"--resume"}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("3 frames (2 of them kept)"), std::string::npos) << outcome.out;
    EXPECT_TRUE(files_in(folder.path()) == whole);
}

// Frames have a stack of cascades, whose foam is resolved while the ocean computes later frames.
TEST(ExportMesh, VerifyComputesMeshesAgain) {
    const TemporaryFolder folder;
    const Arguments several = {"export", "--out",         folder.path().string(), "--resolution", "32",   "--no-sync",
                               "--maps", "none",          "--loop-frames",        "3",            "--mesh",
                               "ply,mdd", "--wind-speed", "20",                   "--mesh-size",  "20"};
    ASSERT_EQ(run_pelagic(several).exit_code, 0);
    const Arguments verify = {"verify", folder.path().string(), "--sample", "all"};
    const Outcome good = run_pelagic(verify);
    ASSERT_EQ(good.exit_code, 0) << good.err;
    // A record and files that match, of other meshes.
    auto record = nlohmann::ordered_json::parse(read_file(folder / "sea_files.json"));
    const auto replace = [&](auto& file, const std::string& bytes) {
        write_file(folder / file["name"], bytes);
        file["xxh3"] = tools::digest_of(bytes);
    };
    auto& frame = record["frames"][1];
    replace(frame["files"][0], "other");
    replace(record["sequence_files"][0], "foam");
    frame.erase("record_xxh3");
    frame["record_xxh3"] = tools::digest_of(frame.dump());
    write_file(folder / "sea_files.json", record.dump());
    const Outcome outcome = run_pelagic(verify);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("mesh_0001.ply is computed otherwise here"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("mesh.mdd is computed otherwise here"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("2 things are wrong"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find("--overwrite"), std::string::npos) << outcome.out;
}

TEST(ExportMesh, ALaterExportWithoutMeshesRemovesThem) {
    const TemporaryFolder folder;
    ASSERT_EQ(export_mesh_to(folder, all_meshes).exit_code, 0);
    write_file(folder / "mesh.obj", "somebody's own");
    ASSERT_EQ(export_mesh_to(folder, {"--maps", "foam", "--overwrite"}).exit_code, 0);
    std::vector<std::string> names;
    for (const auto& [name, bytes] : files_in(folder.path())) names.push_back(name);
    EXPECT_EQ(names,
              (std::vector<std::string>{".sea.lock", "foam_0000.png", "mesh.obj", "sea.json", "sea_files.json"}));
}

/// The last vertex of an OBJ file: position with colour, texture coordinates, normal.
std::vector<double> last_vertex(const std::string& obj) {
    std::istringstream lines(obj.substr(obj.rfind("\nv ") + 1));
    std::vector<double> numbers;
    for (std::string word; lines >> word && word != "f";)
        if (word[0] != 'v') numbers.push_back(std::stod(word));
    return numbers;
}

TEST(ExportMesh, AxesUnitAndRowsMatchTheMaps) {
    const TemporaryFolder usual, other;
    const std::vector<std::string> one = {"--maps", "none", "--mesh", "obj"};
    ASSERT_EQ(export_mesh_to(usual, one).exit_code, 0);
    ASSERT_EQ(export_mesh_to(other, joined(one, {"--axes", "z-up", "--unit", "cm", "--rows", "bottom"})).exit_code,
              0);
    const std::vector<double> a = last_vertex(read_file(usual / "mesh_0000.obj")),
                              b = last_vertex(read_file(other / "mesh_0000.obj"));
    ASSERT_EQ(a.size(), 11u);  // x y z, three values of foam, u v, the normal
    ASSERT_EQ(b.size(), 11u);
    const std::vector<double> wanted = {100 * a[0], -100 * a[2], 100 * a[1], a[3],   a[4], a[5],
                                        a[6],       1 - a[7],    a[8],       -a[10], a[9]};
    // a float step at 10000 cm
    for (std::size_t n = 0; n < wanted.size(); ++n) EXPECT_NEAR(b[n], wanted[n], 1e-3) << n;
}

TEST(ExportMesh, NamesFollowAPattern) {
    const TemporaryFolder folder;
    const std::string pattern = (folder / "wave.####.exr").string();
    const auto exported = [&](const std::vector<std::string>& more) {
        return run_pelagic(
            joined({"export", "--no-sync", "--resolution", "16", "--patch-size", "50", "--out", pattern}, more));
    };
    ASSERT_EQ(exported({"--start-number", "7", "--maps", "displacement", "--mesh", "obj,mdd"}).exit_code, 0);
    std::vector<std::string> names;
    for (const auto& [name, bytes] : files_in(folder.path())) names.push_back(name);
    EXPECT_EQ(names, (std::vector<std::string>{".sea.lock", "mesh.mdd", "sea.json", "sea_files.json", "wave.0007.exr",
                                               "wave.mesh.0007.obj"}));
    ASSERT_EQ(exported({"--maps", "displacement", "--overwrite"}).exit_code, 0);
    EXPECT_EQ(files_in(folder.path()).size(), 4u) << "meshes of the earlier export are still there";
}

TEST(ExportMesh, ANotePrintsTheCascadesThatTheStepsResolve) {
    const TemporaryFolder folder;
    const std::vector<std::string> stack = {
        "export", "--out", folder.path().string(), "--resolution", "32", "--maps", "none", "--mesh", "obj"};
    const Outcome coarse = run_pelagic(joined(stack, {"--mesh-steps", "8"}));
    EXPECT_NE(coarse.err.find("show the waves of the coarsest 1 of 4 cascades"), std::string::npos) << coarse.err;
    const Outcome fine = run_pelagic(joined(stack, {"--mesh-steps", "8", "--mesh-size", "0.5", "--overwrite"}));
    EXPECT_EQ(fine.exit_code, 0) << fine.err;
    EXPECT_EQ(fine.err.find("show the waves"), std::string::npos) << fine.err;
}

TEST(ExportMesh, InvalidOptionsGiveOneLineAndNoFile) {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--mesh", "fbx"},
         "--mesh is fbx, expected obj, ply, gltf, gltf-animation, mdd or some of them with commas"},
        {{"--mesh", "obj,obj"}, "--mesh is obj,obj, expected"},
        {{"--mesh", ""}, "--mesh is , expected obj"},
        {{"--mesh-size", "5"}, "--mesh-size is 5; it requires --mesh"},
        {{"--mesh-steps", "5"}, "--mesh-steps is 5; it requires --mesh"},
        {{"--mesh", "obj", "--mesh-size", "0"}, "--mesh-size is 0, expected metres in [0.001, 1e6]"},
        {{"--mesh", "obj", "--mesh-steps", "2049"}, "--mesh-steps is 2049, expected a whole number from 1 to 2048"},
        {{"--mesh", "gltf", "--axes", "z-up"}, "--axes is z-up, expected y-up with --mesh gltf"},
        {{"--mesh", "gltf-animation", "--unit", "cm"}, "--unit is cm, expected m with --mesh gltf"},
        {{"--maps", "none"}, "--maps is none, expected --mesh or --events with it, or some maps"},
        {{"--mesh", "gltf-animation", "--frames", "257"}, "of 257 frames needs at most 256"},
        {{"--mesh", "gltf-animation", "--frames", "1-3,5"}, "of frames 1-3,5 needs frames without a gap"},
        {{"--mesh", "gltf-animation", "--frames", "100", "--mesh-steps", "2048"}, "expected at most 512 MiB"},
        {{"--mesh", "mdd", "--frames", "100000", "--mesh-steps", "100"}, "expected at most 1024 MiB"},
    };
    for (const auto& [options, message] : cases) {
        const Outcome outcome = export_mesh_to(folder, options);
        EXPECT_EQ(outcome.exit_code, 2) << message;
        EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    EXPECT_TRUE(files_in(folder.path()).empty());
}

}  // namespace
}  // namespace pelagic
