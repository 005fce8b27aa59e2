// `pelagic export --trace`: a trace file that viewers can open, with every job and file of the
// export, and unchanged images.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

using nlohmann::json;

/// \param maps two of them, so that a frame has several files; "gradient" is a PNG
Arguments export_with_mips(const std::filesystem::path& folder, const Arguments& more,
                           const std::string& maps = two_exr_maps) {
    return small_export(folder, joined({"--mips", "--maps", maps}, more));
}

/// The events of a trace; checks that each has the fields that viewers need.
std::vector<json> checked_events(const std::filesystem::path& file) {
    const json trace = json::parse(read_file(file));
    const std::vector<json> events = trace.at("traceEvents");
    std::set<int> named_threads;
    for (const json& event : events)
        if (event.at("name") == "thread_name") named_threads.insert(event.at("tid").get<int>());
    for (const json& event : events) {
        EXPECT_TRUE(event.at("name").is_string());
        EXPECT_TRUE(event.at("pid").is_number_integer());
        EXPECT_TRUE(named_threads.contains(event.at("tid").get<int>())) << event;
        const std::string phase = event.at("ph");
        if (phase == "M") {
            EXPECT_TRUE(event.at("args").at("name").is_string());
            continue;
        }
        EXPECT_TRUE(phase == "X" || phase == "b" || phase == "e") << event;
        EXPECT_TRUE(event.at("cat").is_string());
        EXPECT_GE(event.at("ts").get<double>(), 0);
        if (phase == "X") {
            EXPECT_GE(event.at("dur").get<double>(), 0);
        } else {
            EXPECT_TRUE(event.at("id").is_number_integer());
        }
    }
    return events;
}

TEST(ExportTrace, HoldsEveryJobOfEveryFrameAndEveryFile) {
    constexpr int frames = 3;
    Ocean ocean({.resolution = 32, .patch_size_m = 250}, {.executor = make_serial_executor()});
    std::map<std::string, int> jobs_expected;
    for (const Stage& stage : ocean.graph().stages())
        jobs_expected[stage.name] += frames * static_cast<int>(block_count(stage));

    for (const std::string threads : {"1", "3"}) {
        const TemporaryFolder folder;
        const Outcome outcome = run_pelagic(export_with_mips(
            folder / "sea",
            {"--frames", std::to_string(frames), "--threads", threads, "--trace", (folder / "trace.json").string()},
            maps_with_png));
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        std::map<std::string, int> jobs, files;
        std::map<int, int> started, ended;
        for (const json& event : checked_events(folder / "trace.json")) {
            if (event["ph"] == "b") ++started[event["id"]];
            if (event["ph"] == "e") ++ended[event["id"]];
            if (event["ph"] != "X") continue;
            if (event["cat"] == "file") ++files[event["name"]];
            if (event["cat"] == "job" && event["args"].contains("frame")) ++jobs[event["name"]];
        }
        EXPECT_EQ(jobs, jobs_expected);
        EXPECT_EQ(started.size(), frames + 1u) << "each frame and the sea";
        EXPECT_EQ(started, ended);
        EXPECT_EQ(files["files"], frames);
        EXPECT_EQ(files["encode displacement"], frames);
        EXPECT_EQ(files["encode gradient"], frames * mip_levels(32));
        EXPECT_EQ(files["write"], frames * (1 + mip_levels(32)));
    }
}

// Frames with foam are scheduled with or without a tick, and 15 ticks precede that of the first
// one. All of them are numbered.
TEST(ExportTrace, NumbersFramesOfFoamAndNamesTicks) {
    const TemporaryFolder folder;
    const Outcome outcome = run_pelagic(
        export_with_mips(folder / "sea", {"--frames", "6", "--trace", (folder / "trace.json").string()}, "foam"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::map<std::string, std::set<int>> flights;
    std::map<std::string, std::set<int>> frames_of_job;
    std::map<std::string, int> files;
    for (const json& event : checked_events(folder / "trace.json")) {
        const std::string name = event["name"];
        if (event["ph"] == "b") flights[name].insert(event["args"].at(name).get<int>());
        if (event["ph"] == "X" && event["cat"] == "job" && event["args"].contains("frame"))
            frames_of_job[name].insert(event["args"]["frame"].get<int>());
        if (event["ph"] == "X" && event["cat"] == "file") ++files[name];
    }
    EXPECT_EQ(flights["frame"], (std::set<int>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(flights["tick"].size(), 15u);
    EXPECT_EQ(frames_of_job["evolve+rows"], flights["frame"]);
    // At 24 frames per second, tick 1 precedes frame 5.
    EXPECT_EQ(frames_of_job["tick snapshot"], (std::set<int>{0, 5}));
    EXPECT_EQ(files["encode foam"], 6 * mip_levels(32));
}

/// Returns how many frames an export computed.
std::size_t frames_computed(const std::filesystem::path& trace) {
    const std::vector<json> events = checked_events(trace);
    return static_cast<std::size_t>(std::count_if(events.begin(), events.end(), [](const json& event) {
        return event["ph"] == "b" && event["name"] == "frame";
    }));
}

TEST(ExportTrace, MeshesAndFlipbooksOfAllFramesComputeEachFrameOnce) {
    const TemporaryFolder folder;
    const Arguments arguments = small_export(
        folder / "sea", {"--maps", "displacement", "--frames", "4", "--flipbook", "2x2", "--mesh",
                         "obj,gltf-animation,mdd", "--mesh-steps", "8", "--trace", (folder / "trace.json").string()});
    ASSERT_EQ(run_pelagic(arguments).exit_code, 0);
    EXPECT_EQ(frames_computed(folder / "trace.json"), 4u);
    const std::string animation = read_file(folder / "sea" / "mesh.glb");

    // A frame is missing: the files of all frames need the others, too, but none of them twice.
    std::filesystem::remove(folder / "sea" / "mesh_0002.obj");
    std::filesystem::remove(folder / "sea" / "mesh.glb");
    ASSERT_EQ(run_pelagic(joined(arguments, {"--resume"})).exit_code, 0);
    EXPECT_EQ(frames_computed(folder / "trace.json"), 4u);
    EXPECT_EQ(read_file(folder / "sea" / "mesh.glb"), animation);
    EXPECT_TRUE(std::filesystem::exists(folder / "sea" / "mesh_0002.obj"));
}

TEST(ExportTrace, AddsOneFileAndChangesNoOther) {
    const TemporaryFolder plain, traced;
    ASSERT_EQ(run_pelagic(export_with_mips(plain.path(), {"--frames", "2"})).exit_code, 0);
    ASSERT_EQ(
        run_pelagic(export_with_mips(traced.path(), {"--frames", "2", "--trace", (traced / "trace.json").string()}))
            .exit_code,
        0);
    auto files = files_in(traced.path());
    EXPECT_EQ(files.erase("trace.json"), 1u);
    EXPECT_TRUE(files == files_in(plain.path()));
}

TEST(ExportTrace, AResumedExportTracesOnlyTheRemainingWork) {
    const TemporaryFolder folder;
    const auto more = [&](const std::string& name) {
        return std::vector<std::string>{"--frames", "3", "--resume", "--trace", (folder / name).string()};
    };
    ASSERT_EQ(run_pelagic(export_with_mips(folder / "sea", {"--frames", "3"})).exit_code, 0);
    std::filesystem::remove(folder / "sea" / "compression_0001.exr");
    ASSERT_EQ(run_pelagic(export_with_mips(folder / "sea", more("one.json"))).exit_code, 0);
    ASSERT_EQ(run_pelagic(export_with_mips(folder / "sea", more("none.json"))).exit_code, 0);
    std::set<int> made;
    for (const json& event : checked_events(folder / "one.json"))
        if (event["name"] == "files") made.insert(event["args"]["frame"].get<int>());
    EXPECT_EQ(made, std::set<int>{1});
    for (const json& event : checked_events(folder / "none.json")) EXPECT_EQ(event["ph"], "M");
}

TEST(ExportTrace, IsWrittenWhenTheExportIsStopped) {
    const TemporaryFolder folder, logs;
    const pid_t process = start_pelagic(
        export_with_mips(folder / "sea", {"--frames", "4000", "--trace", (folder / "trace.json").string()}),
        logs / "out", logs / "err");
    EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(folder / "sea" / "compression_0002.exr"); }));
    ::kill(process, SIGTERM);
    EXPECT_EQ(wait_for(process), 128 + SIGTERM) << read_file(logs / "err");
    const std::vector<json> events = checked_events(folder / "trace.json");
    EXPECT_GT(std::count_if(events.begin(), events.end(), [](const json& event) { return event["name"] == "files"; }),
              1);
}

// The error is reported before the first frame, not after a long export.
TEST(ExportTrace, AnUnwritablePathIsAnErrorBeforeAnyChange) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_pelagic(export_with_mips(folder / "sea", {"--frames", "2"})).exit_code, 0);
    write_file(folder / "file", "mine");
    const auto before = files_in(folder / "sea");
    for (const auto& [place, reason] :
         {std::pair<std::string, std::string>{"missing", "No such file or directory"}, {"file", "Not a directory"}}) {
        const std::string trace = (folder / place / "trace.json").string();
        const Outcome outcome = run_pelagic(export_with_mips(folder / "sea", {"--overwrite", "--trace", trace}));
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_EQ(outcome.err, "pelagic: can't write " + trace + ": " + reason + "\n");
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(files_in(folder / "sea") == before);
    }
    EXPECT_EQ(read_file(folder / "file"), "mine");
}

}  // namespace
}  // namespace pelagic
