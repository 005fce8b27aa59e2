// With too little stack, memory or threads the program works, or prints one line about the missing
// resource and exits with 1. No signal and no C++ terminate ends it.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

std::function<void()> with_at_most(int resource, std::size_t bytes) {
    return [=] {
        rlimit limit{};
        getrlimit(static_cast<__rlimit_resource>(resource), &limit);
        limit.rlim_cur = std::min<rlim_t>(bytes, limit.rlim_max);
        setrlimit(static_cast<__rlimit_resource>(resource), &limit);
    };
}

constexpr std::size_t kib = 1024, mib = 1024 * kib;

class ScarceResources : public testing::Test {
   protected:
    void SetUp() override {
        if (is_sanitized) GTEST_SKIP() << "a sanitizer's own needs are larger";
    }
};

// A job of N = 2048 needs 0.4 to 0.8 MiB of stack.
TEST_F(ScarceResources, ASmallStackSufficesForEveryFrame) {
    for (const std::string resolution : {"256", "2048"}) {
        for (const std::string threads : {"1", "2"}) {
            // The small frame tests the stack of a single thread.
            if (resolution == "2048" && threads == "1") continue;
            std::vector<std::string> hashes;
            for (const std::size_t stack : {64 * kib, 8 * mib}) {
                const TemporaryFolder folder;
                const Outcome outcome =
                    run_pelagic({"export", "--out", folder.path(), "--frames", "1", "--maps", "displacement",
                                 "--half", "--patch-size", "250", "--resolution", resolution, "--threads", threads},
                                with_at_most(RLIMIT_STACK, stack));
                ASSERT_EQ(outcome.exit_code, 0) << stack << ": " << outcome.err;
                hashes.push_back(read_file(folder / "displacement_0000.exr"));
            }
            EXPECT_EQ(hashes[0], hashes[1]);
        }
    }
}

// From too little memory to load the program's libraries to enough.
TEST_F(ScarceResources, TooLittleMemoryIsReportedInOneLine) {
    const TemporaryFolder folder;
    write_file(folder / "points.csv", "x,z\n1,2\n");
    std::size_t refused = 0, worked = 0;
    const std::size_t step = of_sweep(192, 64) * mib;
    for (std::size_t room = 64 * mib; room <= 1024 * mib; room += step) {
        const Outcome outcome = run_pelagic({"query", "-q", "--patch-size", "250", "--resolution", "1024",
                                             "--threads", "8", "--points", folder / "points.csv"},
                                            with_at_most(RLIMIT_AS, room));
        // 127: the loader could not map a library.
        ASSERT_TRUE(outcome.exit_code <= 2 || outcome.exit_code == 127)
            << room / mib << " MiB: " << outcome.exit_code << " " << outcome.err;
        if (outcome.exit_code == 1) {
            ++refused;
            EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
            EXPECT_EQ(outcome.err.find("pelagic: "), 0u) << outcome.err;
        } else if (outcome.exit_code != 127) {
            ++worked;
        }
    }
    EXPECT_GT(refused, 0u);
    EXPECT_GT(worked, 0u);
}

// The image library's dependencies start threads when they are loaded, and crash or hang if the
// system cannot start one. Their stacks are as large as the limit, and no stack of this size fits.
TEST_F(ScarceResources, TooFewThreadsForTheImageLibraryAreReportedAndNothingIsWritten) {
    constexpr std::size_t too_large = 64 * 1024 * mib;
    rlimit limit{};
    getrlimit(RLIMIT_STACK, &limit);
    if (limit.rlim_max < too_large) GTEST_SKIP() << "stacks are limited to " << limit.rlim_max << " bytes";
    const TemporaryFolder folder;
    const Outcome outcome = run_pelagic({"export", "--out", folder / "out", "--resolution", "16"}, [] {
        with_at_most(RLIMIT_STACK, too_large)();
        with_at_most(RLIMIT_AS, 3 * 1024 * mib)();
    });
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(outcome.err.find("pelagic: can't load "), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find("5 threads are requested, but the system provides 1: "), std::string::npos)
        << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

void expect_one_line_with_too_little_memory(const std::string& maps, std::size_t min, std::size_t step) {
    std::size_t refused = 0, worked = 0;
    for (std::size_t room = min; room <= 1024 * mib; room += room < 512 * mib ? step : 256 * mib) {
        const TemporaryFolder folder;
        const Outcome outcome =
            run_pelagic({"export", "--out", folder / "out", "--resolution", "16", "--threads", "1", "--maps", maps},
                        with_at_most(RLIMIT_AS, room));
        if (outcome.exit_code == 127) continue;  // the loader could not map a library of the tool
        if (outcome.exit_code == 0) {
            ++worked;
            continue;
        }
        ++refused;
        EXPECT_EQ(outcome.exit_code, 1) << room / mib << " MiB: " << outcome.err;
        EXPECT_EQ(outcome.err.find("pelagic: "), 0u) << room / mib << " MiB: " << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    EXPECT_GT(refused, 0u) << maps;
    EXPECT_GT(worked, 0u) << maps;
}

// Between too little memory and enough, the dependencies crash in several ways.
TEST_F(ScarceResources, TooLittleMemoryForTheImageLibrariesIsReportedInOneLine) {
    expect_one_line_with_too_little_memory("displacement,gradient", 320 * mib, of_sweep(64, 16) * mib);
    expect_one_line_with_too_little_memory("displacement", 24 * mib, of_sweep(32, 4) * mib);
}

}  // namespace
}  // namespace pelagic
