// Edge cases of the command line: values and names that could break the one-line error message, and
// output that cannot be written.
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

struct Edge {
    /// OUT is replaced by the path of a folder that does not exist
    std::vector<std::string> arguments;
    std::string expected;
    std::string config = {};  ///< passed as --config if not empty
};

TEST(CommandLineEdges, ErrorsAreOneLineAndExitCode2) {
    const Edge edges[] = {
        {{"info", "--wind-speed", "3\n4"}, "--wind-speed 3\\n4 is out of range (0, 60]"},
        {{"info", "--wind-speed", "\x1b[2J"}, "--wind-speed \\x1b[2J is out of range (0, 60]"},
        {{"info", "--seed="}, "--seed requires a value"},
        {{"info", "--wind-speed", "--seed", "3"}, "--wind-speed requires a value"},
        {{"info", "--wind-speed", "+-3"}, "--wind-speed +-3 is out of range (0, 60]"},
        {{"info", "export", "--out", "OUT"}, "unknown option --out"},
        {{"export", "--out", "OUT", "info"}, "info"},
        {{"info"}, ":1: wind_speed is \"9\", expected a number without quotes: (0, 60]", "wind_speed = \"9\"\n"},
        {{"info"}, ":2: sea is a table", "seed = 1\n[sea]\nwind_speed = 9\n"},
        // found by fuzzing: toml++ fails an assertion
        {{"info"}, ": malformed table, expected lines such as", "[ *\n"},
        {{"info"}, "unknown key a\\nb", "\"a\\nb\" = 1\n"},
        {{"info"}, "preset is a\\x00b, expected pond", "preset = \"a\\u0000b\"\n"},
        {{"info", "--wind-speed",
          "\xc2\x9b"
          "2J"},
         "--wind-speed \\xc2\\x9b2J is out of range (0, 60]"},
        {{"info", "--wind-speed", std::string(5000, '9')}, "is out of range (0, 60]"},
        {{"info", "--config", "/" + std::string(5000, 'x')}, "expected a TOML file"},
        {{std::string(5000, 'x')}, "query, render, view, quadtree or bench"},
    };
    for (const Edge& edge : edges) {
        const TemporaryFolder folder;
        std::vector<std::string> arguments = edge.arguments;
        std::replace(arguments.begin(), arguments.end(), std::string("OUT"), (folder / "out").string());
        if (!edge.config.empty()) {
            write_file(folder / "sea.toml", edge.config);
            arguments.insert(arguments.end(), {"--config", (folder / "sea.toml").string()});
        }
        const Outcome outcome = run_pelagic(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << edge.expected;
        EXPECT_EQ(outcome.out, "") << edge.expected;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_LT(outcome.err.size(), 300u) << outcome.err;
        EXPECT_NE(outcome.err.find(edge.expected), std::string::npos) << outcome.err << "lacks " << edge.expected;
        EXPECT_FALSE(std::filesystem::exists(folder / "out")) << edge.expected;
    }
}

TEST(CommandLineEdges, VersionWorksForEachCommand) {
    for (const char* command : {"bench", "export", "info", "query"})
        EXPECT_EQ(run_pelagic({command, "--version"}).out, run_pelagic({"--version"}).out);
}

TEST(StandardOutput, AFullDeviceIsAnError) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"info", "--json"}, {"--help"}}) {
        const Outcome outcome = run_pelagic(arguments, [] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); });
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_EQ(outcome.err, "pelagic: can't write standard output: No space left on device\n");
    }
}

TEST(TiffHalves, AreWrittenUnconverted) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_pelagic({"export", "--out", folder.path().string(), "--resolution", "32", "--patch-size", "250",
                           "--format", "tif", "--half"})
                  .exit_code,
              0);
    const auto file = OIIO::ImageInput::open((folder / "displacement_0000.tif").string());
    ASSERT_TRUE(file);
    ASSERT_EQ(file->spec().format, OIIO::TypeDesc::HALF);
    std::vector<std::uint16_t> pixels(32 * 32 * 3);
    ASSERT_TRUE(file->read_image(0, 0, 0, -1, OIIO::TypeDesc::HALF, pixels.data()));
    Ocean ocean({.resolution = 32, .patch_size_m = 250}, {.executor = make_serial_executor()});
    const Frame& frame = ocean.frame_at(0);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        ASSERT_EQ(pixels[i], frame.cascades[0].displacement_rgba16f[i / 3 * 4 + i % 3]) << i;
}

}  // namespace
}  // namespace pelagic
