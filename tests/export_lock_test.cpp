// Two exports to one folder, and the order of file-system synchronisation. Failing file systems are
// simulated by a seccomp filter, which makes system calls of the program fail with an errno.
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <string>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/test_paths.hpp"

namespace pelagic {
namespace {

/// An export of many frames that is stopped by a signal while it runs, so that it holds the
/// folder's lock until the test ends it.
class ExportAtWork {
   public:
    explicit ExportAtWork(const std::filesystem::path& folder, const Arguments& more = {}) {
        process_ =
            start_pelagic(small_export(folder, joined({"--frames", "100000"}, more)), logs_ / "out", logs_ / "err");
        EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(folder / "displacement_0002.exr"); }));
        ::kill(process_, SIGSTOP);
        // Threads stop one by one, and some finish a file before they stop.
        int status = 0;
        EXPECT_EQ(::waitpid(process_, &status, WUNTRACED), process_);
        EXPECT_TRUE(WIFSTOPPED(status));
    }
    ~ExportAtWork() { die(); }

    void die() {
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        EXPECT_EQ(wait_for(process_), 128 + SIGKILL);
        process_ = -1;
    }

   private:
    TemporaryFolder logs_;
    pid_t process_;
};

/// Makes a system call fail with an errno, in this process and in the programs that it executes.
void make_fail(int call, int reason) {
    sock_filter filter[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(reason)),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const sock_fprog program{static_cast<unsigned short>(std::size(filter)), filter};
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
        std::_Exit(126);
}

TEST(FolderLock, RejectsASecondExportWithoutAChange) {
    const TemporaryFolder folder;
    ExportAtWork first(folder.path());
    const auto before = files_in(folder.path());
    for (const Arguments& more : {Arguments{}, {"--resume"}, {"--frames", "2", "--wind-speed", "9"}})
        expect_one_line(run_pelagic(small_export(folder.path(), more)), 2, "another export is at work there");
    EXPECT_TRUE(files_in(folder.path()) == before);
}

TEST(FolderLock, IsReleasedWhenItsOwnerIsKilled) {
    const TemporaryFolder folder;
    const Arguments with_png = {"--maps", maps_with_png};
    ExportAtWork first(folder.path(), with_png);
    ASSERT_EQ(run_pelagic(small_export(folder.path(), with_png)).exit_code, 2);
    first.die();
    const Outcome second = run_pelagic(small_export(folder.path(), with_png));
    EXPECT_EQ(second.exit_code, 0) << second.err;
}

TEST(FolderLock, IsNotTakenWithNoLock) {
    const TemporaryFolder folder;
    ExportAtWork first(folder.path(), {"--no-lock"});
    EXPECT_FALSE(std::filesystem::exists(folder / ".sea.lock"));
    EXPECT_EQ(run_pelagic(small_export(folder.path())).exit_code, 0);
}

TEST(FolderLock, AFileSystemWithoutLocksIsRejectedExceptWithNoLock) {
    const auto without_locks = [] { make_fail(SYS_flock, ENOLCK); };
    const TemporaryFolder folder;
    expect_one_line(run_pelagic(small_export(folder.path()), without_locks), 2, "--no-lock");
    EXPECT_EQ(files_in(folder.path()).size(), 1u) << "the lock's file, and nothing else";
    EXPECT_EQ(run_pelagic(small_export(folder.path(), {"--no-lock"}), without_locks).exit_code, 0);
}

// The lock file belongs to another user and is read-only, in a folder that both users can write to.
TEST(FolderLock, MayBelongToAnotherUser) {
    const TemporaryFolder folder;
    write_file(folder / ".sea.lock", "");
    std::filesystem::permissions(folder / ".sea.lock", std::filesystem::perms(0444));
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0777));
    if (::getuid() == 0) {
        ASSERT_EQ(::chown((folder / ".sea.lock").c_str(), 65534, 65534), 0);
    }
    const Outcome outcome = run_pelagic(small_export(folder.path()), obey_permissions);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

class UnsyncedDisk : public testing::TestWithParam<int> {};

TEST_P(UnsyncedDisk, IsAWriteErrorExceptWithNoSync) {
    const auto without_sync = [] { make_fail(GetParam(), EIO); };
    const TemporaryFolder folder;
    expect_one_line(run_pelagic(small_export(folder.path()), without_sync), 1, "Input/output error");
    for (const auto& [name, bytes] : files_in(folder.path())) {
        EXPECT_FALSE(name.ends_with(".part")) << name;
        EXPECT_TRUE(name.starts_with('.')) << name << " counts as written";
    }
    EXPECT_EQ(run_pelagic(small_export(folder.path(), {"--no-sync"}), without_sync).exit_code, 0);
}

INSTANTIATE_TEST_SUITE_P(Calls, UnsyncedDisk, testing::Values(SYS_fsync, SYS_fdatasync),
                         [](const auto& call) { return call.param == SYS_fsync ? "Folders" : "Files"; });

// The order of system calls, as strace records it.
TEST(SyncedExport, SyncsAFrameBeforeItIsJournaled) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "sea");
    const std::string trace = (folder / "trace").string();
    std::string command =
        "ASAN_OPTIONS=detect_leaks=0 strace -f -y -e trace=fsync,fdatasync,rename,renameat,renameat2,write -o '" +
        trace + "' " + tested_binary;
    for (const std::string& argument :
         small_export(folder / "sea", {"--frames", "2", "--threads", "1", "--maps", maps_with_png}))
        command += " '" + argument + "'";
    if (std::system("strace -o /dev/null true 2>/dev/null") != 0) GTEST_SKIP() << "strace has no permission to trace";
    ASSERT_EQ(std::system((command + " >/dev/null").c_str()), 0);

    std::vector<std::string> calls;
    std::istringstream lines(read_file(trace));
    for (std::string line; std::getline(lines, line);) calls.push_back(line);
    const std::string in_folder = std::filesystem::canonical(folder / "sea").string();
    /// Returns the index of the first call from `from` on whose line contains all words, or the
    /// number of calls.
    const auto find = [&](std::size_t from, const std::vector<std::string>& words) {
        for (; from < calls.size(); ++from)
            if (std::all_of(words.begin(), words.end(),
                            [&](const std::string& word) { return calls[from].find(word) != std::string::npos; }))
                break;
        return from;
    };
    std::size_t last_frame = 0;
    for (const std::string frame : {"0000", "0001"}) {
        std::size_t renamed = 0;
        for (const std::string& name : {"displacement_" + frame + ".exr", "gradient_" + frame + ".png"}) {
            const std::size_t synced = find(0, {"fdatasync(", "/." + name + ".part>"});
            const std::size_t placed = find(0, {"renameat(", "\"" + name + "\""});
            EXPECT_LT(synced, placed) << name;
            ASSERT_LT(placed, calls.size()) << name;
            renamed = std::max(renamed, placed);
        }
        const std::size_t folder_synced = find(renamed, {"fsync(", in_folder + ">"});
        const std::size_t counted = find(renamed, {"write(", "/.pelagic-export.jsonl>"});
        EXPECT_LT(folder_synced, counted) << frame;
        EXPECT_LT(find(counted, {"fdatasync(", "/.pelagic-export.jsonl>"}), calls.size()) << frame;
        last_frame = counted;
    }
    const std::size_t record = find(0, {"renameat(", "\"sea_files.json\""}),
                      sea_json = find(0, {"renameat(", "\"sea.json\""});
    EXPECT_LT(last_frame, record);
    EXPECT_LT(find(0, {"fdatasync(", "/.sea_files.json.part>"}), record);
    EXPECT_LT(record, sea_json);
    EXPECT_LT(find(0, {"fdatasync(", "/.sea.json.part>"}), sea_json);
    EXPECT_LT(find(sea_json, {"fsync(", in_folder + ">"}), calls.size());
}

}  // namespace
}  // namespace pelagic
