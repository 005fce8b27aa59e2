// Selects the frame that the C interface queries, and keeps its memory unchanged while a reader
// uses it.
#include "pelagic/capi/c_ocean.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace pelagic::capi {
namespace {

/// Frames with different bounds, which a query stores with them.
class Shown {
   public:
    Shown() : frame_(ocean_.frame_at(0)) {}
    SurfaceQuery query(float number) {
        frame_.bounds = {number, number, number, number};
        return SurfaceQuery(frame_);
    }

   private:
    Ocean ocean_{{.resolution = 16, .patch_size_m = 250}, {.executor = make_serial_executor(), .queries = true}};
    Frame frame_;
};

void show(QueryFrames& frames, const SurfaceQuery& query) { frames.set_current(query.frame(), query); }

float number_of(const QueryFrames::Reader& reader) { return reader.query()->bounds().height_min_m; }

TEST(CInterfaceQueryFrames, ReaderGetsTheNewestFrameAndKeepsIt) {
    Shown shown;
    QueryFrames frames;
    EXPECT_EQ(QueryFrames::Reader(frames).query(), nullptr);
    show(frames, shown.query(1));
    const QueryFrames::Reader first(frames);
    EXPECT_EQ(number_of(first), 1);
    frames.wait_for_old_readers();
    show(frames, shown.query(2));
    EXPECT_EQ(number_of(first), 1);
    EXPECT_EQ(number_of(QueryFrames::Reader(frames)), 2);
}

TEST(CInterfaceQueryFrames, ReaderGetsAFrameByItsNumberUntilItsMemoryIsNeeded) {
    Shown shown;
    QueryFrames frames;
    const SurfaceQuery first = shown.query(1), second = shown.query(2);
    EXPECT_EQ(frames.set_current(first.frame(), first), 1u);
    EXPECT_EQ(QueryFrames::Reader(frames, 2).frame(), nullptr);
    frames.wait_for_old_readers();
    EXPECT_EQ(frames.set_current(second.frame(), second), 2u);
    EXPECT_EQ(number_of(QueryFrames::Reader(frames, 1)), 1);
    EXPECT_EQ(number_of(QueryFrames::Reader(frames, 2)), 2);
    frames.wait_for_old_readers();
    EXPECT_EQ(QueryFrames::Reader(frames, 1).frame(), nullptr);
    EXPECT_EQ(number_of(QueryFrames::Reader(frames, 2)), 2);
}

// Long enough for a thread that does not wait to finish; a slow machine cannot fail a thread that
// waits.
constexpr std::chrono::milliseconds a_while(100);

TEST(CInterfaceQueryFrames, FrameIsOverwrittenAfterItsLastReader) {
    Shown shown;
    QueryFrames frames;
    show(frames, shown.query(1));
    auto first = std::make_unique<QueryFrames::Reader>(frames);
    auto second = std::make_unique<QueryFrames::Reader>(frames);
    frames.wait_for_old_readers();  // no reader holds the previous frame
    show(frames, shown.query(2));
    const QueryFrames::Reader of_the_newest(frames);

    std::atomic<bool> waits = false, is_free = false;
    std::thread application([&] {
        waits = true;
        frames.wait_for_old_readers();
        is_free = true;
    });
    while (!waits) std::this_thread::yield();
    std::this_thread::sleep_for(a_while);
    EXPECT_FALSE(is_free) << "two readers are there";
    first.reset();
    std::this_thread::sleep_for(a_while);
    EXPECT_FALSE(is_free) << "one is left";
    second.reset();
    application.join();
    EXPECT_TRUE(is_free) << "whoever reads the newest frame holds up nobody";
}

// Readers arrive while the application advances from frame to frame: the frames that they hold
// never change. The application's steps are short, so that every interleaving occurs within a
// second.
TEST(CInterfaceQueryFrames, HeldFrameNeverChanges) {
    Shown shown;
    std::vector<SurfaceQuery> queries;
    for (int n = 0; n < 64; ++n) queries.push_back(shown.query(static_cast<float>(n)));
    QueryFrames frames;
    show(frames, queries[0]);
    std::atomic<bool> is_over = false;
    std::atomic<long> changed = 0, reads = 0;
    std::vector<std::thread> readers;
    for (int thread = 0; thread < 3; ++thread) {
        readers.emplace_back([&] {
            while (!is_over) {
                const QueryFrames::Reader reader(frames);
                const float number = number_of(reader);
                for (int look = 0; look < 3000; ++look) {
                    const FrameBounds bounds = reader.query()->bounds();
                    changed += bounds.height_min_m != number || bounds.horizontal_z_max_m != number;
                    std::atomic_signal_fence(std::memory_order_seq_cst);
                }
                ++reads;
            }
        });
    }
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    for (std::size_t n = 1; std::chrono::steady_clock::now() < end || reads < 1000; ++n) {
        frames.wait_for_old_readers();
        // A frame takes a while to write: a reader that arrived too late for this memory would see
        // it change.
        for (int i = 0; i < 300; ++i) std::atomic_signal_fence(std::memory_order_seq_cst);
        show(frames, queries[n % queries.size()]);
    }
    is_over = true;
    for (std::thread& reader : readers) reader.join();
    EXPECT_EQ(changed, 0) << "of " << reads;
}

}  // namespace
}  // namespace pelagic::capi
