// Failing exports: killed, without disk space, without permission. No partial file remains, and
// --resume completes the export.
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <thread>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/sweep.hpp"
#include "pelagic/tests/test_paths.hpp"

namespace pelagic {
namespace {

Arguments export_of_12_frames(const std::filesystem::path& folder, const Arguments& more = {},
                              const std::string& maps = two_exr_maps) {
    return joined({"export", "--out", folder.string(), "--resolution", "64", "--patch-size", "250", "--frames", "12",
                   "--mips", "--maps", maps},
                  more);
}

Files undisturbed_export(const std::string& maps = two_exr_maps) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_pelagic(export_of_12_frames(folder.path(), {"--no-sync"}, maps)).exit_code, 0);
    return files_in(folder.path());
}

void expect_same_files(const std::filesystem::path& folder, const std::map<std::string, std::string>& expected) {
    const auto files = files_in(folder);
    for (const auto& [name, bytes] : files) {
        ASSERT_TRUE(expected.contains(name)) << name << " should not be there";
        EXPECT_TRUE(bytes == expected.at(name)) << name << " has other bytes";
    }
    EXPECT_EQ(files.size(), expected.size());
}

void expect_no_half_written_file(const std::filesystem::path& folder,
                                 const std::map<std::string, std::string>& whole) {
    for (const auto& [name, bytes] : files_in(folder)) {
        if (name.starts_with('.')) continue;  // temporary files and the journal
        const auto same = whole.find(name);
        ASSERT_NE(same, whole.end()) << name;
        EXPECT_TRUE(bytes == same->second) << name << " is not whole";
    }
}

// The export is killed after a random number of files, at a random time within the next one. Every
// third one has PNG files.
TEST(KilledExport, ResumesToIdenticalFiles) {
    const Files with_png = undisturbed_export(maps_with_png), only_exr = undisturbed_export(two_exr_maps);
    const auto files_there = [](const std::filesystem::path& folder) {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
    };
    std::mt19937 random(20);
    int killed_midway = 0;
    // On a busy machine the export may finish before it is killed; then the test tries again.
    const int enough_kills = of_sweep(6, 60);
    for (int attempt = 0; killed_midway < enough_kills && attempt < 20 * enough_kills; ++attempt) {
        const TemporaryFolder folder, logs;
        const bool has_png = killed_midway % 3 == 0;
        const std::string& maps = has_png ? maps_with_png : two_exr_maps;
        const Files& whole = has_png ? with_png : only_exr;
        const std::size_t enough = std::uniform_int_distribution<std::size_t>(0, whole.size() * 7 / 10)(random);
        const pid_t process = start_pelagic(export_of_12_frames(folder.path(), {}, maps), logs / "out", logs / "err");
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (files_there(folder.path()) < enough && std::chrono::steady_clock::now() < deadline)
            std::this_thread::sleep_for(std::chrono::microseconds(100));
        std::this_thread::sleep_for(std::chrono::microseconds(std::uniform_int_distribution<int>(0, 5000)(random)));
        ::kill(process, SIGKILL);
        killed_midway += wait_for(process) == 128 + SIGKILL;
        expect_no_half_written_file(folder.path(), whole);

        const Outcome resumed = run_pelagic(export_of_12_frames(folder.path(), {"--resume"}, maps));
        ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
        expect_same_files(folder.path(), whole);
    }
    EXPECT_EQ(killed_midway, enough_kills) << "that many attempts should catch it at work";
    RecordProperty("killed_midway", killed_midway);
}

TEST(Resume, ReplacesDamagedAndMissingFilesAndKeepsTheRest) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_pelagic(export_of_12_frames(folder.path(), {}, maps_with_png)).exit_code, 0);
    const auto whole = files_in(folder.path());
    std::filesystem::resize_file(folder / "displacement_0003.exr", 100);
    std::string edited = whole.at("gradient_0005_mip2.png");
    edited[edited.size() / 2] ^= 1;
    write_file(folder / "gradient_0005_mip2.png", edited);
    std::filesystem::remove(folder / "gradient_0007.png");
    const auto untouched = std::filesystem::last_write_time(folder / "displacement_0001.exr");

    const Outcome outcome = run_pelagic(export_of_12_frames(folder.path(), {"--resume"}, maps_with_png));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("9 of them kept"), std::string::npos) << outcome.out;
    expect_same_files(folder.path(), whole);
    EXPECT_EQ(std::filesystem::last_write_time(folder / "displacement_0001.exr"), untouched);
}

TEST(Resume, AnotherSeaIsRejectedWithoutAChange) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_pelagic(export_of_12_frames(folder.path())).exit_code, 0);
    const auto before = files_in(folder.path());
    const Outcome outcome = run_pelagic(export_of_12_frames(folder.path(), {"--resume", "--wind-speed", "9"}));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("--wind-speed was 12"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("is 9"), std::string::npos) << outcome.err;
    expect_same_files(folder.path(), before);
}

// An export of 12 frames replaces one of 40 frames and is interrupted by a full disk.
TEST(Resume, CompletesAnInterruptedReplacement) {
    const auto whole = undisturbed_export();
    const TemporaryFolder folder;
    ASSERT_EQ(
        run_pelagic(small_export(folder.path(), {"--frames", "40", "--maps", two_exr_maps, "--no-sync"})).exit_code,
        0);
    const Outcome failed = run_pelagic(export_of_12_frames(folder.path(), {"--overwrite"}), [] {
        const rlimit min{20000, 20000};
        ::setrlimit(RLIMIT_FSIZE, &min);
        ::signal(SIGXFSZ, SIG_IGN);
    });
    ASSERT_EQ(failed.exit_code, 1) << failed.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "sea.json")) << "the export is not complete";
    ASSERT_EQ(run_pelagic(export_of_12_frames(folder.path(), {"--resume"})).exit_code, 0);
    expect_same_files(folder.path(), whole);
}

TEST(Resume, ADamagedRecordIsRejectedInOneLine) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_pelagic(export_of_12_frames(folder.path(), {}, maps_with_png)).exit_code, 0);
    write_file(folder / "sea_files.json", "{ torn");
    const Outcome outcome = run_pelagic(export_of_12_frames(folder.path(), {"--resume"}, maps_with_png));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST(Resume, AnEmptyFolderGetsAWholeExport) {
    const TemporaryFolder folder;
    EXPECT_EQ(run_pelagic(export_of_12_frames(folder.path(), {"--resume"})).exit_code, 0);
    expect_same_files(folder.path(), undisturbed_export());
}

void expect_write_error(const Outcome& outcome, const std::filesystem::path& folder, const std::string& reason) {
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("can't write " + folder.string()), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
}

// A full tmpfs where mounting is permitted (as root); in all cases, a limit on file sizes.
TEST(FullDisk, GivesOneLineAndNoPartialFile) {
    const TemporaryFolder disk;
    if (::mount("tmpfs", disk.path().c_str(), "tmpfs", 0, "size=200k") == 0) {
        const Outcome outcome = run_pelagic(export_of_12_frames(disk / "sea", {}, maps_with_png));
        expect_write_error(outcome, disk / "sea", "No space left on device");
        expect_no_half_written_file(disk / "sea", undisturbed_export(maps_with_png));
        for (const auto& [name, bytes] : files_in(disk / "sea")) EXPECT_FALSE(name.ends_with(".part")) << name;
        EXPECT_FALSE(std::filesystem::exists(disk / "sea" / "sea.json"));
        EXPECT_EQ(::umount(disk.path().c_str()), 0);
    }
    const Files whole = undisturbed_export();
    const TemporaryFolder folder;
    const Outcome outcome = run_pelagic(export_of_12_frames(folder.path()), [] {
        const rlimit min{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &min);
        ::signal(SIGXFSZ, SIG_IGN);
    });
    expect_write_error(outcome, folder.path(), "File too large");
    expect_no_half_written_file(folder.path(), whole);
    for (const auto& [name, bytes] : files_in(folder.path())) EXPECT_FALSE(name.ends_with(".part")) << name;

    // With enough space, --resume completes the export.
    EXPECT_EQ(run_pelagic(export_of_12_frames(folder.path(), {"--resume"})).exit_code, 0);
    expect_same_files(folder.path(), whole);
}

TEST(ReadOnlyFolder, GivesOneLineAndNoFile) {
    const TemporaryFolder parent;
    const std::filesystem::path folder = parent / "sea";
    std::filesystem::create_directory(folder);
    std::filesystem::permissions(folder, std::filesystem::perms(0555));
    expect_write_error(run_pelagic(export_of_12_frames(folder), obey_permissions), folder, "Permission denied");
    EXPECT_TRUE(files_in(folder).empty());
    expect_write_error(run_pelagic(export_of_12_frames(folder / "new"), obey_permissions), folder / "new",
                       "Permission denied");
    EXPECT_TRUE(files_in(folder).empty());
}

/// Returns what the command shows on a terminal. One that takes minutes (`is_long`) is killed once it
/// estimates the time that is left. \param is_silent  discard standard output
std::string shown_on_a_terminal(Arguments arguments, bool is_long, bool is_silent = false) {
    arguments.insert(arguments.begin(), "pelagic");
    std::vector<char*> words;
    for (std::string& word : arguments) words.push_back(word.data());
    words.push_back(nullptr);
    int terminal = -1;
    const pid_t process = ::forkpty(&terminal, nullptr, nullptr, nullptr);
    EXPECT_GE(process, 0);
    if (process == 0) {
        if (!is_silent || std::freopen("/dev/null", "w", stdout)) ::execv(tested_binary, words.data());
        std::_Exit(127);
    }
    std::string shown;
    char buffer[4096];
    for (ssize_t got; (!is_long || shown.find(" s left") == std::string::npos) &&
                      (got = ::read(terminal, buffer, sizeof buffer)) > 0;)
        shown.append(buffer, static_cast<std::size_t>(got));
    if (is_long) ::kill(process, SIGKILL);
    const int exit_code = wait_for(process);
    EXPECT_TRUE(is_long || exit_code == 0) << exit_code;
    ::close(terminal);
    EXPECT_NE(shown.find(" s left"), std::string::npos) << shown;
    return shown;
}

TEST(Progress, ShowsFramesAndRemainingTimeOnATerminal) {
    const TemporaryFolder folder;
    const std::string shown = shown_on_a_terminal(
        {"export", "--out", folder.path().string(), "--frames", "40", "--resolution", "128", "--patch-size", "250"},
        false);
    EXPECT_NE(shown.find("of 40, "), std::string::npos) << shown;
}

TEST(Progress, ShowsTheTimeOfALongQueryOnATerminal) {
    const TemporaryFolder folder;
    const std::string points = (folder / "points.csv").string(), events = (folder / "events.csv").string();
    write_file(points, "1,2\n");
    write_file(events, "time,x,z,radius,height\n0,0,0,2,0.5\n");
    const std::string shown =
        shown_on_a_terminal({"query", "--points", points, "--events", events, "--events-resolution", "1024", "--time",
                             "80000", "--resolution", "16"},
                            true);
    EXPECT_NE(shown.find(" of 80000 s, "), std::string::npos) << shown;
}

// Many blocks of points at one time.
TEST(Progress, ShowsTheFractionOfManyPointsOnATerminal) {
    const TemporaryFolder folder;
    const std::string points = (folder / "points.csv").string();
    std::string text;
    for (int i = 0; i < 30'000'000; ++i) text += "1,2\n";
    write_file(points, text);
    const std::string shown = shown_on_a_terminal({"query", "--points", points, "--foam", "--json"}, true, true);
    EXPECT_NE(shown.find("point "), std::string::npos) << shown;
    EXPECT_NE(shown.find(" %, "), std::string::npos) << shown;
}

}  // namespace
}  // namespace pelagic
