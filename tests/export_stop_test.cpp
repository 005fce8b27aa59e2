// Exports that are stopped by a signal, run into a limit, or are killed while they replace another
// one: no data is lost or left behind.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <string>

#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

const std::string journal_file = ".pelagic-export.jsonl";

/// Waits until the running export has journaled `lines` lines and the journal contains `text`.
bool wait_for_journal(const std::filesystem::path& folder, int lines, const std::string& text) {
    return comes_true([&] {
        if (!std::filesystem::exists(folder / journal_file)) return false;
        const std::string now = read_file(folder / journal_file);
        return now.find(text) != std::string::npos && std::count(now.begin(), now.end(), '\n') >= lines;
    });
}

class StoppedExport : public testing::TestWithParam<int> {};

TEST_P(StoppedExport, EndsCleanlyPrintsHowToResumeAndResumes) {
    const TemporaryFolder folder, logs, fresh;
    // with PNG files for one of the signals
    const Arguments many = {"--frames", "250", "--maps", GetParam() == SIGTERM ? maps_with_png : "displacement"};
    const pid_t process = start_pelagic(small_export(folder.path(), many), logs / "out", logs / "err");
    ASSERT_TRUE(wait_for_journal(folder.path(), 5, "version"));
    ::kill(process, GetParam());
    EXPECT_EQ(wait_for(process), 128 + GetParam());
    const std::string message = read_file(logs / "err");
    EXPECT_TRUE(message.starts_with("pelagic: stopped after ")) << message;
    EXPECT_NE(message.find(" of 250 frames"), std::string::npos) << message;
    EXPECT_NE(message.find("--resume"), std::string::npos) << message;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
    for (const auto& [name, bytes] : files_in(folder.path())) EXPECT_FALSE(name.ends_with(".part")) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "sea.json"));

    EXPECT_EQ(run_pelagic(small_export(folder.path(), joined(many, {"--resume"}))).exit_code, 0);
    EXPECT_EQ(run_pelagic(small_export(fresh.path(), joined(many, {"--no-sync"}))).exit_code, 0);
    EXPECT_TRUE(files_in(folder.path()) == files_in(fresh.path()));
}

TEST(ExportNotes, AreWrittenBeforeTheFrames) {
    const TemporaryFolder folder, logs;
    const pid_t process =
        start_pelagic(small_export(folder.path(), {"--frames", "480", "--fps", "24", "--loop-period", "5"}),
                      logs / "out", logs / "err");
    EXPECT_TRUE(wait_for_journal(folder.path(), 3, "version"));
    const std::string notes = read_file(logs / "err"), summary = read_file(logs / "out");
    ::kill(process, SIGKILL);
    wait_for(process);
    EXPECT_NE(
        notes.find(
            "note: the frames span 20 s, and the sea repeats after its loop of 5 s; a --loop-period of at least 20 "
            "repeats nothing\n"),
        std::string::npos)
        << notes;
    EXPECT_EQ(summary, "");
    for (const std::vector<std::string>& whole :
         {Arguments{"--frames", "120", "--fps", "24"}, {"--loop-frames", "200"}}) {
        const TemporaryFolder other;
        const Outcome outcome =
            run_pelagic(small_export(other.path(), joined({"--loop-period", "5", "--no-sync"}, whole)));
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_EQ(outcome.err.find("the sea repeats"), std::string::npos) << outcome.err;
    }
}

INSTANTIATE_TEST_SUITE_P(Signals, StoppedExport, testing::Values(SIGINT, SIGTERM));

TEST(KilledReplacement, LeavesNoOlderFilesAfterResume) {
    const TemporaryFolder folder, logs, fresh;
    ASSERT_EQ(
        run_pelagic(small_export(folder.path(), {"--frames", "40", "--mips", "--maps", maps_with_png, "--no-sync"}))
            .exit_code,
        0);
    const Arguments second = {"--frames", "250", "--wind-speed", "9", "--maps", "displacement"};
    Arguments replacing = second;
    replacing.push_back("--overwrite");
    const pid_t process = start_pelagic(small_export(folder.path(), replacing), logs / "out", logs / "err");
    ASSERT_TRUE(wait_for_journal(folder.path(), 4, "\"wind_speed_mps\":9"));
    ::kill(process, SIGKILL);
    EXPECT_EQ(wait_for(process), 128 + SIGKILL);

    Arguments again = second;
    again.push_back("--resume");
    EXPECT_EQ(run_pelagic(small_export(folder.path(), again)).exit_code, 0);
    EXPECT_EQ(run_pelagic(small_export(fresh.path(), joined(second, {"--no-sync"}))).exit_code, 0);
    EXPECT_TRUE(files_in(folder.path()) == files_in(fresh.path()));
}

TEST(FileSizeLimit, IsAWriteErrorAndNoSignal) {
    const TemporaryFolder folder;
    const Outcome outcome = run_pelagic(small_export(folder.path(), {}), [] {
        const rlimit min{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &min);
    });
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("can't write "), std::string::npos) << outcome.err;
    for (const auto& [name, bytes] : files_in(folder.path()))
        EXPECT_TRUE(name == journal_file || name == ".sea.lock") << name;
}

}  // namespace
}  // namespace pelagic
