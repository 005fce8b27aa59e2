// Many oceans, many repetitions, many threads.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <random>
#include <thread>

#include "pelagic/tests/capi_sea.hpp"
#include "pelagic/tests/platform/platform.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

TEST(CInterfaceLoad, AHundredOceansShareOneExecutor) {
    const COceanExecutor executor = executor_of(PELAGIC_EXECUTOR_THREADS, 3);
    std::vector<COcean> oceans;
    for (std::uint32_t i = 0; i < 100; ++i) {
        pelagic_sea sea = small_sea(i % 2 ? 128 : 16);
        sea.seed = i / 25;
        oceans.push_back(ocean_of(sea, executor.get()));
    }
    for (int round = 0; round < 2; ++round) {
        for (const COcean& ocean : oceans) ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), round), PELAGIC_OK);
        pelagic_frame frame{};
        for (const COcean& ocean : oceans) ASSERT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
    }
    for (std::uint32_t i = 0; i < 100; i += 7) {
        pelagic_sea sea = small_sea(i % 2 ? 128 : 16);
        sea.seed = i / 25;
        EXPECT_EQ(hash_of(oceans[i].get()), hash_at(ocean_of(sea, executor_of(PELAGIC_EXECUTOR_SERIAL).get()), 1))
            << i;
    }
}

// Uses glibc's count of allocated bytes; a sanitizer has its own allocator and leak check.
TEST(CInterfaceLoad, TenThousandOceansDoNotLeak) {
    const COceanExecutor serial = executor_of(PELAGIC_EXECUTOR_SERIAL);
    const COceanExecutor threads = executor_of(PELAGIC_EXECUTOR_THREADS, 2);
    const pelagic_sea sea = small_sea();
    const auto make_some = [&](int count) {
        for (int i = 0; i < count; ++i) {
            const COcean ocean = ocean_of(sea, i % 2 ? serial.get() : threads.get());
            // destroyed while in flight
            ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), i), PELAGIC_OK);
        }
        for (int i = 0; i < count / 100; ++i) executor_of(PELAGIC_EXECUTOR_THREADS, 3);
    };
    make_some(500);
    // glibc counts blocks in a thread's cache as allocated, which gives some kilobytes more or less. A
    // leak is in each of three rounds. The bound is less than a byte per ocean.
    std::size_t least = SIZE_MAX;
    for (int round = 0; round < 3 && least > 8192; ++round) {
        const std::size_t before = bytes_handed_out();
        make_some(is_sanitized ? 1000 : 10000);
        const std::size_t after = bytes_handed_out();
        least = std::min(least, after > before ? after - before : 0);
    }
    EXPECT_LE(least, 8192u);
}

// Each query reads one complete frame, and concurrent queries do not change the frames.
TEST(CInterfaceLoad, EightThreadsQueryWhileFramesAreComputed) {
    constexpr int frames = 40, times = 4;
    const pelagic_sea sea = small_sea(128);
    std::vector<double> x, z;
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
        x.push_back(static_cast<double>(random()) / 0x1p22);
        z.push_back(static_cast<double>(random()) / 0x1p22);
    }
    const auto sample_heights = [&](const pelagic_ocean* ocean) {
        std::vector<float> heights(x.size());
        auto points = pelagic_points_make();
        auto samples = pelagic_samples_make();
        points.count = x.size(), points.x = x.data(), points.z = z.data();
        samples.height_m = heights.data();
        EXPECT_EQ(pelagic_ocean_query(ocean, &points, &samples), PELAGIC_OK) << pelagic_last_error();
        return heights;
    };
    pelagic_frame frame{};
    std::vector<std::vector<float>> expected;
    std::vector<std::uint64_t> hashes;
    const COcean alone = ocean_of(sea, executor_of(PELAGIC_EXECUTOR_SERIAL).get());
    for (int n = 0; n < times; ++n) {
        ASSERT_EQ(pelagic_ocean_schedule(alone.get(), n), PELAGIC_OK);
        ASSERT_EQ(pelagic_ocean_complete(alone.get(), &frame), PELAGIC_OK);
        expected.push_back(sample_heights(alone.get()));
        hashes.push_back(hash_of(alone.get()));
    }

    const COcean ocean = ocean_of(sea, executor_of(PELAGIC_EXECUTOR_THREADS, 3).get());
    ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 0), PELAGIC_OK);
    ASSERT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
    std::atomic<bool> stop = false;
    std::atomic<int> ready = 0, torn = 0;
    std::vector<std::thread> readers;
    for (int i = 0; i < 8; ++i) {
        readers.emplace_back([&] {
            while (!stop) {
                const std::vector<float> heights = sample_heights(ocean.get());
                ++ready;
                if (std::find(expected.begin(), expected.end(), heights) == expected.end()) ++torn;
            }
        });
    }
    for (int n = 1; n <= frames; ++n) {
        EXPECT_EQ(pelagic_ocean_schedule(ocean.get(), n % times), PELAGIC_OK);
        EXPECT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
        EXPECT_EQ(hash_of(ocean.get()), hashes[static_cast<std::size_t>(n % times)]);
    }
    while (ready < 8) std::this_thread::yield();
    stop = true;
    for (std::thread& reader : readers) reader.join();
    EXPECT_EQ(torn, 0);
}

}  // namespace
}  // namespace pelagic
