// A soak test with random sequences of calls: frames are scheduled, completed, queried and
// cancelled, seas change, and oceans are created and destroyed, with and without threads. Every
// frame is compared with a plain replay, and memory must not grow.
//
// usage: pelagic_soak [FRAMES]    exit code 1 and a line at the first difference
#include <pelagic/pelagic.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "pelagic/tests/platform/platform.hpp"

namespace {

[[noreturn]] void fail(const char* what, const char* why = "") {
    std::fprintf(stderr, "soak: %s %s\n", what, why);
    std::exit(1);
}

void must(pelagic_status status) {
    if (status != PELAGIC_OK) fail("a call failed:", pelagic_last_error());
}
void must_be_rejected(pelagic_status status) {
    if (status != PELAGIC_WRONG_ORDER) fail("a misuse was not refused");
}

constexpr int seas = 3;

pelagic_sea sea_number(int number, std::int32_t resolution) {
    auto sea = pelagic_sea_make();
    must(pelagic_sea_preset(number == 0 ? "calm" : number == 1 ? "rough" : "storm", &sea));
    sea.resolution = resolution;
    sea.patch_size_m = 250;
    sea.seed = static_cast<std::uint32_t>(number);
    return sea;
}

pelagic_executor* make_executor(std::int32_t kind, std::int32_t threads) {
    auto options = pelagic_executor_options_make();
    options.kind = kind;
    options.threads = threads;
    pelagic_executor* executor = nullptr;
    must(pelagic_executor_create(&options, &executor));
    return executor;
}

pelagic_ocean* make_ocean(int sea, std::int32_t resolution, const pelagic_executor* executor) {
    auto options = pelagic_ocean_options_make();
    options.queries = 1;
    options.executor = executor;
    const pelagic_sea state = sea_number(sea, resolution);
    pelagic_ocean* ocean = nullptr;
    must(pelagic_ocean_create(&state, &options, &ocean));
    return ocean;
}

/// Queries a few buoys. The positions are the same for every ocean, so that results can be
/// compared.
struct Samples {
    std::array<float, 5> height{}, normal_y{};
    bool operator==(const Samples&) const = default;
};

Samples samples_of(const pelagic_ocean* ocean) {
    const double x[5] = {0, 11, -300, 1e6, 77.7}, z[5] = {0, 5, 40, -1e6, 0.01};
    Samples results;
    auto points = pelagic_points_make();
    points.count = 5, points.x = x, points.z = z;
    auto samples = pelagic_samples_make();
    samples.height_m = results.height.data();
    samples.normal_y = results.normal_y.data();
    must(pelagic_ocean_query(ocean, &points, &samples));
    return results;
}

std::uint64_t hash_of(const pelagic_ocean* ocean) {
    std::uint64_t hash = 0;
    must(pelagic_ocean_frame_hash(ocean, 0, PELAGIC_HASH_FRAME, &hash));
    return hash;
}

/// The replay: one ocean for each sea, no threads, one frame after the other.
class Replay {
   public:
    explicit Replay(std::int32_t resolution) {
        pelagic_executor* serial = make_executor(PELAGIC_EXECUTOR_SERIAL, 0);
        for (int sea = 0; sea < seas; ++sea) oceans_[sea] = make_ocean(sea, resolution, serial);
        pelagic_executor_destroy(serial);
    }
    ~Replay() {
        for (pelagic_ocean* ocean : oceans_) pelagic_ocean_destroy(ocean);
    }
    Replay(const Replay&) = delete;
    Replay& operator=(const Replay&) = delete;

    const pelagic_ocean* at(int sea, double time_s) {
        pelagic_frame frame{};
        must(pelagic_ocean_schedule(oceans_[sea], time_s));
        must(pelagic_ocean_complete(oceans_[sea], &frame));
        return oceans_[sea];
    }

    pelagic_ocean* ocean(int sea) { return oceans_[sea]; }

   private:
    std::array<pelagic_ocean*, seas> oceans_{};
};

/// One ocean and its expected state.
class Subject {
   public:
    Subject(std::int32_t resolution, const std::vector<pelagic_executor*>& executors, Replay& replay, unsigned seed)
        : resolution_(resolution), executors_(executors), replay_(replay), random_(seed) {
        build();
    }
    ~Subject() { pelagic_ocean_destroy(ocean_); }
    Subject(const Subject&) = delete;
    Subject& operator=(const Subject&) = delete;

    /// Takes one random action; returns the number of frames that it completed.
    int step() {
        switch (random_() % 16) {
            case 0: return change_sea();
            case 1: return finish_sea();
            case 2: return ask_again();
            case 3: return random_() % 64 == 0 ? rebuild() : 0;
            case 4: return frame_at();
            default: return in_flight_ ? complete() : schedule();
        }
    }

   private:
    void build() {
        sea_ = static_cast<int>(random_() % seas);
        ocean_ = make_ocean(sea_, resolution_, executors_[random_() % executors_.size()]);
        in_flight_ = baking_ = has_frame_ = false;
    }

    double any_time() { return static_cast<double>(random_() % 100000) * 0.01; }

    int schedule() {
        time_s_ = any_time();
        scheduled_sea_ = sea_;
        must(pelagic_ocean_schedule(ocean_, time_s_));
        in_flight_ = true;
        if (random_() % 8 == 0) must_be_rejected(pelagic_ocean_schedule(ocean_, 0));
        return 0;
    }

    int complete() {
        std::int32_t is_ready = 0;
        if (random_() % 2) must(pelagic_ocean_poll(ocean_, &is_ready));
        pelagic_frame frame{};
        must(pelagic_ocean_complete(ocean_, &frame));
        in_flight_ = false;
        has_frame_ = true;
        const pelagic_ocean* expected = replay_.at(scheduled_sea_, time_s_);
        if (frame.time_s != time_s_ || hash_of(ocean_) != hash_of(expected)) fail("a frame has wrong bits");
        expected_ = samples_of(expected);
        if (samples_of(ocean_) != expected_) fail("a query has wrong bits");
        if (random_() % 8 == 0) must_be_rejected(pelagic_ocean_complete(ocean_, &frame));
        return 1;
    }

    int ask_again() {
        if (has_frame_ && samples_of(ocean_) != expected_) fail("a query of an older frame has wrong bits");
        return 0;
    }

    int frame_at() {
        if (in_flight_) return 0;
        const double time_s = any_time();
        const std::size_t texels = static_cast<std::size_t>(resolution_) * static_cast<std::size_t>(resolution_);
        halves_.resize(4 * texels);
        auto buffers = pelagic_frame_buffers_make();
        buffers.rgba16f_count = halves_.size();
        buffers.displacement_rgba16f = halves_.data();
        must(pelagic_ocean_frame_at(ocean_, time_s, &buffers, nullptr));
        expected_halves_.resize(halves_.size());
        buffers.displacement_rgba16f = expected_halves_.data();
        must(pelagic_ocean_frame_at(replay_.ocean(sea_), time_s, &buffers, nullptr));
        if (halves_ != expected_halves_) fail("frame_at has wrong bits");
        ask_again();
        return 1;
    }

    int change_sea() {
        const int wanted = static_cast<int>(random_() % seas);
        const pelagic_sea sea = sea_number(wanted, resolution_);
        if (baking_) {
            must_be_rejected(pelagic_ocean_schedule_sea(ocean_, &sea));
        } else {
            must(pelagic_ocean_schedule_sea(ocean_, &sea));
            baked_sea_ = wanted;
            baking_ = true;
        }
        return 0;
    }

    int finish_sea() {
        if (!baking_ || in_flight_) {
            must_be_rejected(pelagic_ocean_complete_sea(ocean_));
        } else {
            must(pelagic_ocean_complete_sea(ocean_));
            sea_ = baked_sea_;
            baking_ = false;
        }
        return 0;
    }

    /// Destroys the ocean in any state.
    int rebuild() {
        pelagic_ocean_destroy(ocean_);
        build();
        return 0;
    }

    std::int32_t resolution_;
    const std::vector<pelagic_executor*>& executors_;
    Replay& replay_;
    std::mt19937 random_;
    pelagic_ocean* ocean_ = nullptr;
    int sea_ = 0, scheduled_sea_ = 0, baked_sea_ = 0;
    bool in_flight_ = false, baking_ = false, has_frame_ = false;
    double time_s_ = 0;
    Samples expected_;
    std::vector<std::uint16_t> halves_, expected_halves_;
};

/// Creates oceans, completes `frames` frames with them, and destroys them in any state.
void live(long frames, unsigned life, const std::vector<pelagic_executor*>& executors, Replay& small_replay,
          Replay& large_replay, long& done, long& on_threads) {
    Subject small[4] = {{16, executors, small_replay, 10 * life},
                        {16, executors, small_replay, 10 * life + 1},
                        {16, executors, small_replay, 10 * life + 2},
                        {16, executors, small_replay, 10 * life + 3}};
    Subject large(128, executors, large_replay, 10 * life + 4);
    const long end = done + frames;
    for (long step = 0; done < end; ++step) {
        done += small[step % 4].step();
        if (step % 100 == 0) on_threads += large.step();
    }
}

}  // namespace

int main(int argc, char** argv) {
    const long frames = argc > 1 ? std::atol(argv[1]) : 10000;
    const auto start = std::chrono::steady_clock::now();
    std::vector<pelagic_executor*> executors = {make_executor(PELAGIC_EXECUTOR_SERIAL, 0),
                                                make_executor(PELAGIC_EXECUTOR_THREADS, 2),
                                                make_executor(PELAGIC_EXECUTOR_THREADS, 3)};
    constexpr int lives = 10;
    long done = 0, on_threads = 0;
    std::size_t bytes_early = 0, bytes_late = 0;
    {
        // N = 16 is computed by complete() alone; N = 128 uses the threads.
        Replay small_replay(16), large_replay(128);
        for (unsigned life = 0; life < lives; ++life) {
            live(frames / lives, life, executors, small_replay, large_replay, done, on_threads);
            bytes_late = pelagic::bytes_handed_out();
            if (life == 0) bytes_early = bytes_late;
        }
    }
    for (pelagic_executor* executor : executors) pelagic_executor_destroy(executor);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf(
        "%ld frames of N = 16 and %ld of N = 128, each equal to its replay, in %.1f s; bytes held %zu, later %zu\n",
        done, on_threads, seconds, bytes_early, bytes_late);
    // The memory after the oceans of a life are destroyed. glibc counts the blocks that each thread
    // caches, 230 KB at most, as allocated. A leak of one small block a frame would be megabytes.
    if (bytes_late > bytes_early + 256 * 1024) fail("memory grew");
}
