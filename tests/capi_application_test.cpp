// An application's own memory, error log and job system, including faulty ones.
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "pelagic/tests/capi_sea.hpp"
#include "pelagic/tests/platform/platform.hpp"

namespace pelagic {
namespace {

// ---- Memory -----------------------------------------------------------------------

struct CallerHeap {
    std::size_t held = 0, max = SIZE_MAX, largest_alignment = 0;
    std::size_t shift = 0;  ///< offset of returned memory from its alignment, in bytes
    int calls = 0;

    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        auto* const heap = static_cast<CallerHeap*>(user);
        ++heap->calls;
        if (bytes == 0 || heap->held + bytes > heap->max) return nullptr;
        heap->held += bytes;
        heap->largest_alignment = std::max(heap->largest_alignment, alignment);
        auto* const memory = static_cast<char*>(allocate_aligned(bytes + alignment, alignment));
        std::memset(memory, 0xAB, bytes);  // memory is not zeroed
        return memory + heap->shift;
    }
    static void release(void* user, void* memory, std::size_t bytes, std::size_t) {
        auto* const heap = static_cast<CallerHeap*>(user);
        heap->held -= bytes;
        free_aligned(static_cast<char*>(memory) - heap->shift);
    }
    static void* allocate_by_throwing(void*, std::size_t, std::size_t) { throw std::runtime_error("no heap"); }
};

pelagic_ocean_options with_heap(CallerHeap& heap) {
    auto options = pelagic_ocean_options_make();
    options.queries = options.velocities = 1;
    options.allocate = CallerHeap::allocate;
    options.release = CallerHeap::release;
    options.memory_user = &heap;
    return options;
}

void expect_all_from_the_application(const pelagic_sea& sea) {
    CallerHeap heap;
    const pelagic_ocean_options options = with_heap(heap);
    pelagic_ocean* made = nullptr;
    ASSERT_EQ(pelagic_ocean_create(&sea, &options, &made), PELAGIC_OK) << pelagic_last_error();
    COcean ocean(made);
    pelagic_ocean_info info{};
    ASSERT_EQ(pelagic_ocean_describe(made, &info), PELAGIC_OK);
    EXPECT_LT(info.memory_bytes - heap.held, 100'000u) << "tables and handles";
    EXPECT_LE(heap.held, info.memory_bytes);

    const std::size_t before = heap.held;
    const int calls_before = heap.calls;
    pelagic_frame frame{};
    for (int n = 0; n < 3; ++n) {
        ASSERT_EQ(pelagic_ocean_schedule(made, n), PELAGIC_OK);
        ASSERT_EQ(pelagic_ocean_complete(made, &frame), PELAGIC_OK);
    }
    EXPECT_EQ(heap.calls, calls_before) << "a frame allocates nothing";
    ASSERT_EQ(pelagic_ocean_schedule_sea(made, &sea), PELAGIC_OK);
    EXPECT_GT(heap.held, before);
    ASSERT_EQ(pelagic_ocean_complete_sea(made), PELAGIC_OK);
    EXPECT_EQ(heap.held, before);
    ocean.reset();
    EXPECT_EQ(heap.held, 0u);
}

TEST(CInterfaceMemory, GridSizedMemoryComesFromTheApplication) {
    expect_all_from_the_application(small_sea(256));
    expect_all_from_the_application(stack_sea(3, 128));
}

TEST(CInterfaceMemory, FailedAllocationsReturnAStatusWithoutALeak) {
    const pelagic_sea sea = small_sea(64);
    CallerHeap heap;
    std::size_t wanted = 0;
    {
        const pelagic_ocean_options options = with_heap(heap);
        pelagic_ocean* made = nullptr;
        ASSERT_EQ(pelagic_ocean_create(&sea, &options, &made), PELAGIC_OK);
        wanted = heap.held;
        // If a new sea cannot be allocated, the ocean keeps its current sea.
        heap.max = heap.held;
        EXPECT_EQ(pelagic_ocean_schedule_sea(made, &sea), PELAGIC_OUT_OF_MEMORY);
        EXPECT_EQ(pelagic_ocean_schedule(made, 0), PELAGIC_OK);
        pelagic_ocean_destroy(made);
    }
    // The first bake holds a second spectrum, so the peak is slightly more than `wanted`.
    for (std::size_t max = 0; max <= wanted; max += wanted / 20) {
        heap.max = max;
        const pelagic_ocean_options options = with_heap(heap);
        pelagic_ocean* made = nullptr;
        EXPECT_EQ(pelagic_ocean_create(&sea, &options, &made), PELAGIC_OUT_OF_MEMORY) << max;
        EXPECT_EQ(made, nullptr);
        EXPECT_EQ(heap.held, 0u);
    }

    heap = {};
    heap.shift = 32;
    pelagic_ocean_options options = with_heap(heap);
    pelagic_ocean* made = nullptr;
    EXPECT_EQ(pelagic_ocean_create(&sea, &options, &made), PELAGIC_INVALID_ARGUMENT);
    EXPECT_NE(std::string(pelagic_last_error()).find("not aligned"), std::string::npos);
    EXPECT_EQ(heap.held, 0u);
    options.allocate = CallerHeap::allocate_by_throwing;
    EXPECT_EQ(pelagic_ocean_create(&sea, &options, &made), PELAGIC_OUT_OF_MEMORY);
    options.release = nullptr;
    EXPECT_EQ(pelagic_ocean_create(&sea, &options, &made), PELAGIC_INVALID_ARGUMENT);
    EXPECT_STREQ(pelagic_last_error(), "allocate or release is NULL, expected both or neither");
}

// ---- Errors -----------------------------------------------------------------------

struct ErrorLog {
    std::vector<std::pair<pelagic_status, std::string>> lines;
    ErrorLog() { pelagic_set_error_callback(add, this); }
    ~ErrorLog() { pelagic_set_error_callback(nullptr, nullptr); }
    static void add(void* user, pelagic_status status, const char* message) {
        EXPECT_EQ(message, pelagic_last_error());
        static_cast<ErrorLog*>(user)->lines.emplace_back(status, message);
    }
};

TEST(CInterfaceErrors, TheCallbackIsCalledForEachFailure) {
    const pelagic_sea sea = small_sea();
    {
        const ErrorLog log;
        EXPECT_EQ(pelagic_sea_check(&sea), PELAGIC_OK);
        EXPECT_TRUE(log.lines.empty());
        EXPECT_EQ(pelagic_sea_check(nullptr), PELAGIC_INVALID_ARGUMENT);
        std::thread([&] { EXPECT_EQ(pelagic_ocean_complete(nullptr, nullptr), PELAGIC_INVALID_ARGUMENT); }).join();
        ASSERT_EQ(log.lines.size(), 2u) << "also of those on other threads";
        EXPECT_EQ(log.lines[0].first, PELAGIC_INVALID_ARGUMENT);
        EXPECT_EQ(log.lines[0].second, "sea is NULL, expected a pointer");
        EXPECT_EQ(log.lines[1].second, "ocean is NULL, expected a pointer");
    }
    // Exceptions of the callback do not propagate.
    pelagic_set_error_callback([](void*, pelagic_status, const char*) { throw 1; }, nullptr);
    EXPECT_EQ(pelagic_sea_check(nullptr), PELAGIC_INVALID_ARGUMENT);
    pelagic_set_error_callback(nullptr, nullptr);
    EXPECT_EQ(pelagic_sea_check(nullptr), PELAGIC_INVALID_ARGUMENT);
}

TEST(CInterfaceErrors, MessagesAreOneShortLineWithoutControlCharacters) {
    const pelagic_sea sea = small_sea();
    const auto message_for = [&](const std::string& isa) -> std::string {
        auto options = pelagic_ocean_options_make();
        options.isa = isa.c_str();
        pelagic_ocean* ocean = nullptr;
        EXPECT_EQ(pelagic_ocean_create(&sea, &options, &ocean), PELAGIC_INVALID_ARGUMENT);
        return pelagic_last_error();
    };
    constexpr const char* accepted = ", expected sse4.2, avx2, avx512 or neon";
    EXPECT_EQ(message_for("a\n\nb\r\x7f"), std::string("isa is a\\n\\nb\\x0d\\x7f") + accepted);
    EXPECT_EQ(message_for("caf\u00e9 \u6d77"), std::string("isa is caf\u00e9 \u6d77") + accepted);
    EXPECT_EQ(message_for("next\u0085line"), std::string("isa is next\\xc2\\x85line") + accepted)
        << "a control character too";
    EXPECT_EQ(message_for("\xff\xc3"), std::string("isa is \\xff\\xc3") + accepted) << "no UTF-8";
    for (std::size_t length = 0; length < 400; ++length)
        ASSERT_LT(message_for("x" + std::string(length, '\xc3') + std::string(length, 'y')).size(), 300u);
}

// ---- Jobs -------------------------------------------------------------------------

/// A job system that works correctly unless a fault is selected.
struct FaultyApplication {
    enum class Loop { correct, throws, throws_half_way, skips_jobs, returns_early, calls_twice, calls_out_of_range };
    enum class Submit { correct, throws, throws_after_all, twice, never, late };
    Loop loop = Loop::correct;
    Submit submitting = Submit::correct;
    std::vector<std::thread> threads;
    std::vector<std::pair<void (*)(void*), void*>> late;

    static void parallel_for(void* user, std::size_t count, void (*job)(void*, std::size_t), void* work) {
        auto* const application = static_cast<FaultyApplication*>(user);
        if (application->loop == Loop::throws) throw std::runtime_error("no workers");
        if (application->loop == Loop::returns_early) {
            // The jobs run after the loop has returned.
            application->threads.emplace_back([=] {
                for (std::size_t i = 0; i < count; ++i) job(work, i);
            });
            return;
        }
        const std::size_t called_count = application->loop == Loop::correct ||
                                                 application->loop == Loop::calls_twice ||
                                                 application->loop == Loop::calls_out_of_range
                                             ? count
                                             : count / 2;
        for (std::size_t i = 0; i < called_count; ++i) {
            job(work, i);
            if (application->loop == Loop::calls_twice) job(work, i);
        }
        if (application->loop == Loop::calls_out_of_range) job(work, count), job(work, SIZE_MAX);
        if (application->loop == Loop::throws_half_way) throw 1;
    }

    static void submit(void* user, void (*task)(void*), void* work) {
        auto* const application = static_cast<FaultyApplication*>(user);
        switch (application->submitting) {
            case Submit::throws: throw std::runtime_error("queue is full");
            case Submit::never: return;
            case Submit::late: application->late.emplace_back(task, work); return;
            case Submit::twice: application->threads.emplace_back(task, work); [[fallthrough]];
            default: application->threads.emplace_back(task, work);
        }
        if (application->submitting == Submit::throws_after_all) throw 1;
    }

    void join() {
        for (std::thread& thread : threads) thread.join();
        threads.clear();
    }

    COcean ocean(bool with_submit, std::int32_t resolution = 128) {
        auto options = pelagic_executor_options_make();
        options.kind = PELAGIC_EXECUTOR_APPLICATION;
        options.threads = 2;
        options.parallel_for = parallel_for;
        options.submit = with_submit ? submit : nullptr;
        options.user = this;
        pelagic_executor* executor = nullptr;
        EXPECT_EQ(pelagic_executor_create(&options, &executor), PELAGIC_OK) << pelagic_last_error();
        COcean ocean = ocean_of(small_sea(resolution), executor);
        pelagic_executor_destroy(executor);  // the ocean keeps a reference
        pelagic_ocean_info info{};
        EXPECT_EQ(pelagic_ocean_describe(ocean.get(), &info), PELAGIC_OK);
        EXPECT_STREQ(info.executor, "application");
        EXPECT_EQ(info.threads, 2);
        return ocean;
    }
};

pelagic_status make_frame(pelagic_ocean* ocean, double time_s) {
    pelagic_frame frame{};
    const pelagic_status status = pelagic_ocean_schedule(ocean, time_s);
    return status == PELAGIC_OK ? pelagic_ocean_complete(ocean, &frame) : status;
}

/// Checks that frames are bit-identical to a serial ocean's before and after a frame in which the
/// application misbehaves, and that the faulty frame returns `expected`.
void expect_recovery(FaultyApplication& application, bool with_submit, const std::function<void()>& misbehave,
                     pelagic_status expected, const std::string& message) {
    const COcean reference = ocean_of(small_sea(128), executor_of(PELAGIC_EXECUTOR_SERIAL).get());
    const COcean ocean = application.ocean(with_submit);
    const auto expect_right_frames = [&](double time_s) {
        ASSERT_EQ(make_frame(ocean.get(), time_s), PELAGIC_OK) << pelagic_last_error();
        ASSERT_EQ(make_frame(reference.get(), time_s), PELAGIC_OK);
        EXPECT_EQ(hash_of(ocean.get()), hash_of(reference.get())) << time_s;
    };
    expect_right_frames(1);
    for (int round = 0; round < 3; ++round) {
        misbehave();
        EXPECT_EQ(make_frame(ocean.get(), 2), expected) << pelagic_last_error();
        if (expected != PELAGIC_OK) {
            EXPECT_EQ(std::string(pelagic_last_error()), message);
            EXPECT_EQ(hash_of(ocean.get()), hash_of(reference.get())) << "the frame before is still there";
        }
        // The fault also affects a change of the sea.
        const pelagic_sea sea = small_sea(128);
        EXPECT_EQ(pelagic_ocean_schedule_sea(ocean.get(), &sea), PELAGIC_OK);
        EXPECT_EQ(pelagic_ocean_complete_sea(ocean.get()), expected) << pelagic_last_error();
        application.join();
        application.loop = FaultyApplication::Loop::correct;
        application.submitting = FaultyApplication::Submit::correct;
        expect_right_frames(3 + round);
    }
    application.join();
}

TEST(CInterfaceApplicationJobs, AThrowingLoopLosesItsFrameAndReturnsAStatus) {
    for (const bool with_submit : {false, true}) {
        FaultyApplication application;
        expect_recovery(
            application, with_submit, [&] { application.loop = FaultyApplication::Loop::throws; },
            PELAGIC_APPLICATION_ERROR, "parallel_for threw an exception: no workers");
        expect_recovery(
            application, with_submit, [&] { application.loop = FaultyApplication::Loop::throws_half_way; },
            PELAGIC_APPLICATION_ERROR, "parallel_for threw an exception");
    }
}

TEST(CInterfaceApplicationJobs, AnIncompleteLoopLosesItsFrameAndReturnsAStatus) {
    for (const bool with_submit : {false, true}) {
        FaultyApplication application;
        const char* const message = "parallel_for returned before all of its jobs were done";
        expect_recovery(
            application, with_submit, [&] { application.loop = FaultyApplication::Loop::skips_jobs; },
            PELAGIC_APPLICATION_ERROR, message);
    }
}

// The other thread may or may not finish before the loop returns; later frames are correct in both
// cases.
TEST(CInterfaceApplicationJobs, JobsThatOutliveTheirLoopAreHarmless) {
    FaultyApplication application;
    const COcean ocean = application.ocean(false);
    for (int n = 0; n < 200; ++n) {
        application.loop = FaultyApplication::Loop::returns_early;
        const pelagic_status status = make_frame(ocean.get(), n);
        EXPECT_TRUE(status == PELAGIC_OK || status == PELAGIC_APPLICATION_ERROR) << pelagic_last_error();
        if (n % 4 == 3) application.join();
    }
    application.loop = FaultyApplication::Loop::correct;
    ASSERT_EQ(make_frame(ocean.get(), 12.34), PELAGIC_OK) << pelagic_last_error();
    application.join();
    const COcean reference = ocean_of(small_sea(128), executor_of(PELAGIC_EXECUTOR_SERIAL).get());
    ASSERT_EQ(make_frame(reference.get(), 12.34), PELAGIC_OK);
    EXPECT_EQ(hash_of(ocean.get()), hash_of(reference.get()));
}

TEST(CInterfaceApplicationJobs, RepeatedAndOutOfRangeJobsAreIgnored) {
    FaultyApplication application;
    expect_recovery(
        application, true, [&] { application.loop = FaultyApplication::Loop::calls_twice; }, PELAGIC_OK, "");
    expect_recovery(
        application, true, [&] { application.loop = FaultyApplication::Loop::calls_out_of_range; }, PELAGIC_OK, "");
}

TEST(CInterfaceApplicationJobs, AThrowingSubmitReturnsAStatus) {
    FaultyApplication application;
    expect_recovery(
        application, true, [&] { application.submitting = FaultyApplication::Submit::throws; },
        PELAGIC_APPLICATION_ERROR, "submit threw an exception: queue is full");
    expect_recovery(
        application, true, [&] { application.submitting = FaultyApplication::Submit::throws_after_all; },
        PELAGIC_APPLICATION_ERROR, "submit threw an exception");
}

TEST(CInterfaceApplicationJobs, TasksCalledTwiceOrNeverAreHarmless) {
    FaultyApplication application;
    expect_recovery(
        application, true, [&] { application.submitting = FaultyApplication::Submit::twice; }, PELAGIC_OK, "");
    expect_recovery(
        application, true, [&] { application.submitting = FaultyApplication::Submit::never; }, PELAGIC_OK, "");
}

TEST(CInterfaceApplicationJobs, TasksCalledTwiceAfterTheirOceanIsDestroyedAreHarmless) {
    FaultyApplication application;
    application.submitting = FaultyApplication::Submit::late;
    COcean ocean = application.ocean(true);
    for (int n = 0; n < 3; ++n) ASSERT_EQ(make_frame(ocean.get(), n), PELAGIC_OK);
    const COcean next = application.ocean(true);  // may reuse the memory of the first ocean
    ocean.reset();
    ASSERT_EQ(pelagic_ocean_schedule(next.get(), 5), PELAGIC_OK);
    for (int round = 0; round < 2; ++round)
        for (const auto& [task, work] : application.late) task(work);
    pelagic_frame frame{};
    EXPECT_EQ(pelagic_ocean_complete(next.get(), &frame), PELAGIC_OK);
}

TEST(CInterfaceApplicationJobs, AThrowingLoopPreventsCreationOfAnOcean) {
    FaultyApplication application;
    application.loop = FaultyApplication::Loop::throws;
    auto options = pelagic_executor_options_make();
    options.kind = PELAGIC_EXECUTOR_APPLICATION;
    options.parallel_for = FaultyApplication::parallel_for;
    options.user = &application;
    pelagic_executor* executor = nullptr;
    ASSERT_EQ(pelagic_executor_create(&options, &executor), PELAGIC_OK);
    const COceanExecutor held(executor);
    auto ocean_options = pelagic_ocean_options_make();
    ocean_options.executor = executor;
    const pelagic_sea sea = small_sea(128);
    auto* ocean = reinterpret_cast<pelagic_ocean*>(1);
    EXPECT_EQ(pelagic_ocean_create(&sea, &ocean_options, &ocean), PELAGIC_APPLICATION_ERROR);
    EXPECT_EQ(ocean, nullptr);
}

}  // namespace
}  // namespace pelagic
