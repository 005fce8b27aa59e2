// Frame ranges of exports, and the names of their files.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/frame_times.hpp"
#include "pelagic/tools/maps/name_pattern.hpp"

namespace pelagic::tools {
namespace {

using Ranges = std::vector<FrameRange>;

/// Exports to `place` in a temporary folder and returns the names of all files there.
std::vector<std::string> exported_to(const std::string& place, const Arguments& more) {
    const TemporaryFolder folder;
    const Outcome outcome = run_pelagic(
        joined({"export", "--resolution", "32", "--wind-speed", "9", "--out", (folder / place).string()}, more));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::vector<std::string> names;
    for (const auto& [name, bytes] : files_in((folder / place).parent_path()))
        if (name != ".sea.lock" && name != "sea.json" && name != "sea_files.json") names.push_back(name);
    return names;
}

TEST(FrameRanges, AreParsedAndFormatted) {
    EXPECT_EQ(parse_frame_ranges("10-20,40"), (Ranges{{10, 20}, {40, 40}}));
    EXPECT_EQ(parse_frame_ranges("7-7"), (Ranges{{7, 7}}));
    EXPECT_EQ(text_of({{10, 20}, {40, 40}}), "10-20,40");
    for (const std::string wrong :
         {"", "-", "1-", "-1", "3-2", "1-5,5", "5,1", "1,,2", "1-2-3", "a", "1 - 2", "1000000"})
        EXPECT_FALSE(parse_frame_ranges(wrong)) << wrong;
}

TEST(FrameTimes, GiveNumberAndTimeOfEachFrame) {
    FrameTimes shot{.start_s = 5, .start_number = 1001, .ranges = {{1001, 1003}, {1049, 1049}}, .fps = 24};
    EXPECT_EQ(shot.count(), 4u);
    EXPECT_EQ(shot.number(0), 1001);
    EXPECT_EQ(shot.number(3), 1049);
    EXPECT_TRUE(shot.contains(1002));
    EXPECT_FALSE(shot.contains(1004));
    EXPECT_EQ(shot.time_of(1001), 5);
    EXPECT_EQ(shot.time_of(1049), 7);  // 48 frames of 1/24 s later
    EXPECT_FALSE(shot.is_one_run());
}

// A frame depends on its time only: alone, in a range, or with a start in seconds.
TEST(FrameNumbers, DetermineTheTimeOfAFrame) {
    const TemporaryFolder folder;
    const auto hashes = [&](const std::string& name, const Arguments& more) {
        const Outcome outcome = run_pelagic(joined(
            {"export", "--resolution", "16", "--maps", "displacement", "--out", (folder / name).string()}, more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        std::map<int, std::string> found;
        const auto sea = nlohmann::json::parse(files_in(folder / name).at("sea.json"));
        for (const auto& frame : sea["frames"]) found[frame["frame"]] = frame["hash"];
        return found;
    };
    const auto all = hashes("all", {"--fps", "8", "--frames", "6"});
    ASSERT_EQ(all.size(), 6u);
    EXPECT_EQ(hashes("some", {"--fps", "8", "--frames", "2-3,5"}),
              (std::map<int, std::string>{{2, all.at(2)}, {3, all.at(3)}, {5, all.at(5)}}));
    EXPECT_EQ(hashes("shot", {"--fps", "8", "--start-number", "1001", "--frames", "1003-1003"}),
              (std::map<int, std::string>{{1003, all.at(2)}}));
    EXPECT_EQ(hashes("late", {"--fps", "8", "--start", "0.5", "--frames", "1"}),
              (std::map<int, std::string>{{0, all.at(4)}}));
    const auto loop = hashes("loop", {"--fps", "8", "--frames", "loop", "--loop-period", "2"});
    EXPECT_EQ(loop.size(), 16u);
    EXPECT_EQ(loop, hashes("loop-frames", {"--loop-frames", "16", "--loop-period", "2"}));
}

TEST(NamePattern, AcceptsPatternsOfOtherPrograms) {
    const auto name = [](const std::string& text, int frame, const std::string& mark = "") {
        const auto pattern = NamePattern::parse(text);
        return pattern ? pattern->name(mark, frame, pattern->extension()) : "none";
    };
    EXPECT_EQ(name("wave.####.exr", 7), "wave.0007.exr");
    EXPECT_EQ(name("wave.%04d.exr", 7), "wave.0007.exr");
    EXPECT_EQ(name("wave_%d.tif", 7), "wave_7.tif");
    EXPECT_EQ(name("#####.exr", 123456), "123456.exr");
    EXPECT_EQ(name("wave.####.exr", 7, "foam_c1"), "wave.foam_c1.0007.exr");
    EXPECT_EQ(name("wave_####.exr", 7, "foam"), "wave_foam_0007.exr");
    EXPECT_EQ(name("wave####.exr", 7, "foam"), "wave.foam.0007.exr");
    EXPECT_EQ(name("####.exr", 7, "foam"), "foam.0007.exr");
    for (const std::string wrong : {"wave.exr", "wave.##.##.exr", "wave.####", "wave.####.", "wave.#### .exr",
                                    "####wave.exr", "%s.exr", "%n.exr", "%04x.exr", "%%.exr", "%1000000000d.exr",
                                    ".####.exr", "-####.exr", "wave.####.a/b", "w\n.####.exr", "##########.exr"})
        EXPECT_FALSE(NamePattern::parse(wrong)) << wrong;
}

// Names in a record are valid only if this export can have written them.
TEST(NamePattern, MatchesItsOwnNamesOnly) {
    const auto pattern = NamePattern::parse("wave.####.exr");
    for (const std::string own :
         {"wave.0007.exr", "wave.123456.tif", "wave.foam_c1.0007.png", "wave.gradient_c3_mip11.0000.png"})
        EXPECT_TRUE(is_image_name(own, pattern)) << own;
    for (const std::string other :
         {"wave.007.exr", "wave.00007.exr", "wave.0007.txt", "wave..0007.exr", "wave.mine.0007.exr",
          "wave.foam_c4.0007.png", "wave.foam.0007.png.part", "wav.0007.exr", "wave.displacement_mip1.0007.exr",
          "wave.foam_c1_mip12.0007.png", "wave..exr", "wave.foam-.0007.png"}) {
        EXPECT_FALSE(is_image_name(other, pattern)) << other;
    }
    EXPECT_FALSE(is_image_name("wave.0007.exr", {}));
}

TEST(ExportedNames, FollowThePattern) {
    EXPECT_EQ(exported_to("wave.####.exr", {"--maps", "displacement", "--patch-size", "200", "--frames", "2"}),
              (std::vector<std::string>{"wave.0000.exr", "wave.0001.exr"}));
    EXPECT_EQ(exported_to("wave_%03d.tif", {"--cascades", "2", "--start-number", "1001"}),
              (std::vector<std::string>{"wave_displacement_1001.tif", "wave_displacement_c1_1001.tif",
                                        "wave_gradient_1001.tif", "wave_gradient_c1_1001.tif"}));
}

// As without a pattern: other files are unchanged, and complete frames are kept.
TEST(ExportedNames, SummariesEscapeWhatATerminalWouldInterpret) {
    const TemporaryFolder folder;
    const std::string red = (folder / "\x1b[31mred").string();
    const Outcome exported = run_pelagic(small_export(red, {"--loop-period", "1"}));
    ASSERT_EQ(exported.exit_code, 0) << exported.err;
    const Outcome verified = run_pelagic({"verify", red});
    ASSERT_EQ(verified.exit_code, 0) << verified.err;
    for (const std::string& text : {exported.out + exported.err, verified.out + verified.err}) {
        EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
        EXPECT_NE(text.find("\\x1b[31mred: "), std::string::npos) << text;
    }
}

TEST(ExportedNames, WithAPatternCanBeResumedAndReplaced) {
    const TemporaryFolder folder;
    const auto export_with = [&](const Arguments& more) {
        const Outcome outcome = run_pelagic(joined(
            {"export", "--resolution", "16", "--patch-size", "200", "--out", (folder / "wave.####.exr").string()},
            more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.out;
    };
    export_with({"--frames", "3"});
    const auto whole = files_in(folder.path());
    write_file(folder / "wave.gradient.0001.png", "torn");
    write_file(folder / "wave.mine.0001.exr", "mine");
    EXPECT_NE(export_with({"--frames", "3", "--resume"}).find("(2 of them kept)"), std::string::npos);
    auto mended = files_in(folder.path());
    EXPECT_EQ(mended["wave.mine.0001.exr"], "mine");
    mended.erase("wave.mine.0001.exr");
    EXPECT_TRUE(mended == whole);
    export_with({"--frames", "1", "--overwrite"});
    EXPECT_EQ(files_in(folder.path()).count("wave.gradient.0002.png"), 0u);
    EXPECT_EQ(files_in(folder.path()).at("wave.mine.0001.exr"), "mine");
    EXPECT_EQ(run_pelagic({"info", "--measure", folder.path().string()}).exit_code, 0);
}

}  // namespace
}  // namespace pelagic::tools
