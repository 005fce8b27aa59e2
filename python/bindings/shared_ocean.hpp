// An ocean for a language in which anything may live longer than it should: frames know when their memory is gone, arrays keep it
// from being written over, and threads take turns. Knows nothing of Python.
//
// An ocean has the memory of two frames, so the frame scheduled as number n is written over by number n + 2. Before that
// schedule() waits for whoever reads frame n, and refuses while somebody has views of it.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"

namespace pelagic::python {

/// The frame's memory holds a later one.
struct StaleFrame : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The memory that a frame needs is on view.
struct MemoryInUse : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Not now, such as a second schedule() without complete().
struct WrongOrder : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A frame and which one it is.
struct NumberedFrame {
    Frame frame;
    std::uint64_t number;
};

/// Methods may be called from any threads, and wait for one another where an ocean is for one thread at a time. After close() they
/// throw std::invalid_argument.
class SharedOcean {
   public:
    SharedOcean(const Forecast& forecast, const OceanOptions& options);

    void schedule(double time_s);
    bool is_ready();
    NumberedFrame complete();
    NumberedFrame frame_at(double time_s);
    /// Calls use(i, frame) with the frame of each time, in order, while the next one is computed. Frames made before are over then.
    void frames_at(std::span<const double> times_s, const std::function<void(std::size_t, const Frame&)>& use);
    void schedule_sea(const SeaChange& change);

    bool has_dynamic_waves() const { return has_dynamic_waves_; }
    /// Calls use(waves). \pre has_dynamic_waves()
    void use_dynamic_waves(const std::function<void(DynamicWaves&)>& use);
    /// The same where no frame may be in flight.
    void use_dynamic_waves_between_frames(const std::function<void(DynamicWaves&)>& use);
    /// Calls change() while no other method runs, of a closed ocean too.
    void alter_input(const std::function<void()>& change);

    /// Waits for readers, and gives the memory back; what is on view goes when its last view does.
    void close();
    bool is_closed();
    void need_open();

    struct Facts {
        SeaState sea;
        int resolution, threads;
        std::size_t cascade_count, memory_bytes;
        Isa isa;
        double repeat_length_m;
        bool has_velocities, has_foam;
    };
    Facts facts();

    /// Frame `number` is neither written over nor closed.
    bool is_alive(std::uint64_t number);

    /// While one lives, the frame is not written over. Throws StaleFrame if it is gone already.
    class Reader {
       public:
        Reader(std::shared_ptr<SharedOcean> ocean, std::uint64_t number);
        ~Reader();
        Reader(const Reader&) = delete;
        Reader& operator=(const Reader&) = delete;

       private:
        std::shared_ptr<SharedOcean> ocean_;
        std::uint64_t number_;
    };
    /// The same for as long as anybody likes: the ocean doesn't wait for it, but refuses.
    class View {
       public:
        View(std::shared_ptr<SharedOcean> ocean, std::uint64_t number);
        ~View();
        View(const View&) = delete;
        View& operator=(const View&) = delete;

       private:
        std::shared_ptr<SharedOcean> ocean_;
        std::uint64_t number_;
    };

    /// For one batch of queries on the ocean's threads. \pre a Reader lives meanwhile
    void sample(const SurfaceQuery& query, const SurfacePoints& points, const SurfaceSamples& samples);

   private:
    struct Use {
        int readers = 0, views = 0;
    };

    Use& use_of(std::uint64_t number) { return uses_[number % uses_.size()]; }
    void need_open_now() const;
    Ocean& opened() const;
    void need_alive(std::uint64_t number) const;
    void begin(double time_s);
    NumberedFrame end();

    std::mutex turn_;  ///< held while the ocean works, and taken before the next
    std::mutex state_;
    std::condition_variable readers_left_;
    std::shared_ptr<Executor> executor_;
    std::unique_ptr<Ocean> ocean_;
    double repeat_length_m_;
    bool has_velocities_, has_foam_, has_dynamic_waves_;
    std::array<Use, 2> uses_;
    std::array<double, 2> times_s_{};
    std::uint64_t scheduled_ = 0;  ///< frames up to now
    bool in_flight_ = false;
    bool is_closed_ = false;
    std::vector<std::unique_ptr<SurfaceQueryJobs>> idle_jobs_;
};

}  // namespace pelagic::python
