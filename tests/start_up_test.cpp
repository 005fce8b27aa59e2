// Counts the shared libraries that a command loads at start-up. Help must not load image libraries.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/test_paths.hpp"

namespace pelagic {
namespace {

/// Returns the names of the shared libraries that the loader opens while the command runs.
/// LD_DEBUG=files belongs to glibc.
std::set<std::string> loaded_by(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    const TemporaryFolder logs;
    EXPECT_EQ(run_pelagic(arguments,
                          [&] {
                              ::setenv("LD_DEBUG", "files", 1);
                              ::setenv("LD_DEBUG_OUTPUT", (logs / "load").c_str(), 1);
                              if (::chdir(folder.c_str()) != 0) std::_Exit(126);
                          })
                  .exit_code,
              0);
    std::set<std::string> names;
    for (const auto& [file, text] : files_in(logs.path())) {
        std::istringstream lines(text);
        const std::string mark = "calling init: ";
        for (std::string line; std::getline(lines, line);)
            if (const auto at = line.find(mark); at != std::string::npos) names.insert(line.substr(at + mark.size()));
    }
    return names;
}

bool has(const std::set<std::string>& names, const std::string& part) {
    for (const std::string& name : names)
        if (name.find(part) != std::string::npos) return true;
    return false;
}

TEST(StartUp, LoadsImageLibrariesOnlyForImages) {
    const TemporaryFolder folder;
    write_file(folder / "points.csv", "1,2\n");
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"--help"}, {"info"}, {"query", "--points", "points.csv"}, {"quadtree"}, {"export", "--help"}}) {
        const std::set<std::string> names = loaded_by(arguments, folder.path());
        EXPECT_TRUE(has(names, "libstdc++")) << "the loader said nothing";
        EXPECT_FALSE(has(names, "OpenImageIO")) << arguments[0];
        // 16 on Debian 12, with oneTBB, GLFW and the libraries of X; the sanitizers add a few.
        EXPECT_LE(names.size(), 30u) << arguments[0];
    }
    const auto loaded_for = [&](const std::string& maps) {
        return loaded_by({"export", "--out", maps, "--resolution", "16", "--maps", maps}, folder.path());
    };
    const std::set<std::string> exr = loaded_for("displacement"), png = loaded_for("gradient");
    EXPECT_TRUE(has(exr, "OpenEXR"));
    EXPECT_FALSE(has(exr, "OpenImageIO"));
    EXPECT_TRUE(has(png, "OpenImageIO"));
}

// The libraries are found wherever the tool is installed and from any working folder. Without them
// the tool prints an error.
TEST(StartUp, FindsTheImageLibrariesBesideTheTool) {
    const TemporaryFolder folder;
    const std::filesystem::path bin = folder / "bin", tool = bin / "pelagic";
    const std::filesystem::path libraries = (bin / PELAGIC_MODULE_FOLDER).lexically_normal();
    std::filesystem::create_directories(bin);
    std::filesystem::create_directories(libraries);
    std::filesystem::copy_file(tested_binary, tool);
    std::filesystem::create_symlink(tool, folder / "link");
    const auto run = [&] {
        const pid_t process = ::fork();
        if (process == 0) {
            const std::string out = (folder / "out").string();
            if (!std::freopen((folder / "err").c_str(), "w", stderr)) std::_Exit(126);
            ::execl((folder / "link").c_str(), "pelagic", "export", "--out", out.c_str(), "--resolution", "16",
                    nullptr);
            std::_Exit(127);
        }
        return wait_for(process);
    };
    for (const auto& [file, use] : {std::pair("pelagic_exr.so", "writes EXR files"),
                                    std::pair("pelagic_images.so", "writes and reads images")}) {
        EXPECT_EQ(run(), 1);
        EXPECT_NE(read_file(folder / "err").find(file + std::string(", which ") + use), std::string::npos)
            << read_file(folder / "err");
        EXPECT_FALSE(std::filesystem::exists(folder / "out"));
        std::filesystem::copy_file(std::filesystem::path(tested_binary).parent_path() / PELAGIC_MODULE_FOLDER / file,
                                   libraries / file);
    }
    EXPECT_EQ(run(), 0) << read_file(folder / "err");
}

}  // namespace
}  // namespace pelagic
