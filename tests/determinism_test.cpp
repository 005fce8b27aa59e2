// One sea, bit for bit: whatever the instruction set, the executor, the threads, the order and the age.
#include <algorithm>
#include <cfenv>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "sim/ocean.hpp"
#include "tests/each_isa.hpp"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace pelagic {
namespace {

struct Host {
    std::string name;
    std::shared_ptr<Executor> executor;
};

std::vector<Host> hosts() {
    std::vector<Host> all = {{"serial", make_serial_executor()}};
    for (const int threads : {1, 2, 3, 8}) {
        all.push_back({"thread_" + std::to_string(threads), make_thread_executor(threads)});
#if defined(PELAGIC_HAS_TBB)
        all.push_back({"tbb_" + std::to_string(threads), make_tbb_executor(threads)});
#endif
    }
    return all;
}

std::uint64_t hash_at(const SeaState& sea, double time_s, Isa isa = choose_isa(),
                      std::shared_ptr<Executor> executor = make_serial_executor()) {
    Ocean ocean(sea, {.executor = std::move(executor), .isa = isa});
    return hash_of(ocean.frame_at(time_s));
}

TEST(Determinism, EveryInstructionSetExecutorAndThreadCountGivesTheSameBits) {
    for (const int n : {16, 64, 128, 256}) {
        for (const double choppiness : {0.0, 1.0}) {
            const SeaState sea{.resolution = n, .wind_direction_rad = 1, .choppiness = choppiness};
            const std::uint64_t expected = hash_at(sea, 12.34, isas_here().front());
            for (const Isa isa : isas_here())
                for (const Host& host : hosts())
                    EXPECT_EQ(hash_at(sea, 12.34, isa, host.executor), expected)
                        << n << " " << name_of(isa) << " " << host.name;
        }
    }
}

TEST(Determinism, LargeSeasToo) {
    for (const int n : {512, 1024, 2048}) {
        const SeaState sea{.resolution = n};
        const std::uint64_t expected = hash_at(sea, 3.5, isas_here().front());
        for (const Isa isa : isas_here())
            EXPECT_EQ(hash_at(sea, 3.5, isa, make_thread_executor(3)), expected) << n << " " << name_of(isa);
    }
}

TEST(Determinism, WholeLoopsGiveTheBitsOfTimeZero) {
    for (const double period : {200.0, 8.0, 0.1, 7.3, 86400.0}) {
        Ocean ocean({.resolution = 32, .loop_period_s = period}, {.executor = make_serial_executor()});
        const std::uint64_t start = hash_of(ocean.frame_at(0));
        for (const double periods : {1.0, 2.0, 1000.0, -1.0})
            EXPECT_EQ(hash_of(ocean.frame_at(periods * period)), start) << periods << " periods of " << period;
        EXPECT_NE(hash_of(ocean.frame_at(period * 0.37)), start) << "the sea stands still";
    }
}

TEST(Determinism, TenHoursLaterFrameZeroHasTheSameBits) {
    Ocean ocean({.resolution = 64}, {.executor = make_serial_executor()});
    const std::uint64_t start = hash_of(ocean.frame_at(0)), later = hash_of(ocean.frame_at(1.25));
    // Ten hours at 1 Hz, drawn; the loop is 200 s, so 36000 s is a whole number of them.
    for (int second = 0; second < 36000; second += 97) ocean.frame_at(second);
    EXPECT_EQ(hash_of(ocean.frame_at(36000)), start);
    EXPECT_EQ(hash_of(ocean.frame_at(36001.25)), later);
}

TEST(Determinism, AnyOrderOfFramesGivesTheSameBits) {
    std::vector<double> times;
    for (int i = 0; i < 24; ++i) times.push_back(i * 8.3 - 40);
    const SeaState sea{.resolution = 128};  // smaller frames are computed without jobs
    std::map<double, std::uint64_t> expected;
    for (const double time : times) expected[time] = hash_at(sea, time);

    std::mt19937 random(9);
    Ocean ocean(sea, {.executor = make_default_executor(3)});
    for (int round = 0; round < 4; ++round) {
        std::shuffle(times.begin(), times.end(), random);
        for (const double time : times) EXPECT_EQ(hash_of(ocean.frame_at(time)), expected[time]) << time;
    }
}

TEST(Determinism, AFrameStaysWhileTheNextOneIsComputed) {
    const SeaState sea{.resolution = 128};
    Ocean ocean(sea, {.executor = make_thread_executor(2)});
    ocean.schedule(0);
    std::uint64_t expected = hash_at(sea, 0);
    for (int i = 1; i < 20; ++i) {
        const Frame& frame = ocean.complete();
        ocean.schedule(i * 0.4);
        EXPECT_EQ(hash_of(frame), expected);
        EXPECT_EQ(frame.time_s, (i - 1) * 0.4);
        expected = hash_at(sea, i * 0.4);
    }
    ocean.complete();
}

TEST(Determinism, AWindChangeWaitsForTheHostAndThenIsWholeInOneFrame) {
    const SeaState before{.resolution = 128},
        after{.resolution = 128, .wind_speed_mps = 20, .choppiness = 0.3, .seed = 4};
    for (const Host& host : hosts()) {
        Ocean ocean(before, {.executor = host.executor});
        ocean.schedule_sea(after);
        EXPECT_EQ(hash_of(ocean.frame_at(2)), hash_at(before, 2)) << host.name;
        ocean.complete_sea();
        EXPECT_TRUE(ocean.sea_is_ready());
        EXPECT_EQ(hash_of(ocean.frame_at(2)), hash_at(after, 2)) << host.name;
    }
}

TEST(Determinism, OceansMayBeDestroyedInFlight) {
    for (const Host& host : hosts()) {
        for (int i = 0; i < 10; ++i) {
            Ocean ocean({.resolution = 128}, {.executor = host.executor});
            ocean.schedule_sea({.resolution = 128, .seed = 2});
            ocean.schedule(1);
        }
    }
}

// Engines switch threads to flush-to-zero or another rounding mode; the sea must not notice, and must put it back.
TEST(Determinism, TheHostsFloatingPointEnvironmentDoesNotReachTheSea) {
    const SeaState sea{.spectrum = SpectrumModel::phillips, .resolution = 64, .wind_speed_mps = 2};
    const std::uint64_t expected = hash_at(sea, 5);
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        const std::uint64_t hash = hash_at(sea, 5);
        EXPECT_EQ(std::fegetround(), mode);
        std::fesetround(FE_TONEAREST);
        EXPECT_EQ(hash, expected);
    }
#if defined(__x86_64__)
    const unsigned found = _mm_getcsr();
    _mm_setcsr(found | 0x8040);  // flush to zero, denormals are zero
    const std::uint64_t hash = hash_at(sea, 5);
    EXPECT_EQ(_mm_getcsr() & 0x8040, 0x8040u);
    _mm_setcsr(found);
    EXPECT_EQ(hash, expected);
#endif
}

// A change of these is a change of everybody's sea: the commit must say why.
TEST(Determinism, GoldenHashesNeverChange) {
    std::map<std::string, SeaState> seas = {{"default", {}}};
    for (const SpectrumModel model : spectrum_models())
        seas[std::string(name_of(model)) + "-64"] = {.spectrum = model, .resolution = 64};
    for (const SeaPreset& preset : sea_presets()) seas["preset-" + std::string(preset.name)] = preset.sea;

    std::map<std::string, std::string> golden;
    std::ifstream file(PELAGIC_GOLDEN_HASHES);
    for (std::string name, hash; file >> name >> hash;) golden[name] = hash;
    std::size_t compared = 0;
    for (const auto& [name, sea] : seas) {
        for (const char* time : {"0", "12.34"}) {
            std::ostringstream hash;
            hash << std::hex << hash_at(sea, std::stod(time));
            const std::string key = name + "@" + time;
            EXPECT_EQ(golden[key], hash.str()) << "the line would be: " << key << " " << hash.str();
            ++compared;
        }
    }
    EXPECT_EQ(golden.size(), compared) << "lines that no test reads";
}

}  // namespace
}  // namespace pelagic
