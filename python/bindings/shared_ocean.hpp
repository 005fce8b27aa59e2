// An ocean for languages in which objects may outlive others: frames detect that their memory is
// reused, arrays prevent it from being overwritten, and threads take turns. It does not depend on
// Python.
//
// An ocean has the memory of two frames, so frame n is overwritten by frame n + 2. Before that,
// schedule() waits for readers of frame n, and throws if views of it exist.
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

/// The frame's memory belongs to a later frame.
struct StaleFrame : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Views of the required memory exist.
struct MemoryInUse : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A call in the wrong order, such as a second schedule() without complete().
struct WrongOrder : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A frame and its number.
struct NumberedFrame {
    Frame frame;
    std::uint64_t number;
};

/// Methods may be called from any thread; they wait for one another where an ocean may be used by
/// one thread only. After close() they throw std::invalid_argument.
class SharedOcean {
   public:
    SharedOcean(const Forecast& forecast, const OceanOptions& options);

    void schedule(double time_s);
    bool is_ready();
    NumberedFrame complete();
    NumberedFrame frame_at(double time_s);
    /// Calls use(i, frame) with the frame of each time, in order, while the next frame is computed.
    /// Earlier frames become stale.
    void frames_at(std::span<const double> times_s, const std::function<void(std::size_t, const Frame&)>& use);
    void schedule_sea(const SeaChange& change);
    void set_water_frame(const WaterFrame& water);

    bool has_dynamic_waves() const { return has_dynamic_waves_; }
    bool has_spray() const { return has_spray_; }
    /// Calls with(ocean) while no other method runs.
    void use(const std::function<void(Ocean&)>& with);
    /// As above; throws WrongOrder if a frame is in flight.
    void use_between_frames(const std::function<void(Ocean&)>& with);
    /// Calls change() while no other method runs, also if the ocean is closed.
    void alter_input(const std::function<void()>& change);

    /// Waits for readers and frees the memory. Memory with views is freed with its last view.
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

    /// Returns true if frame `number` is neither overwritten nor closed.
    bool is_alive(std::uint64_t number);

    /// While a Reader exists, the frame is not overwritten. Throws StaleFrame if it was
    /// overwritten.
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
    /// Like a Reader without a time limit: the ocean does not wait for it, but throws MemoryInUse.
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

    /// Runs one batch of queries on the ocean's threads. \pre a Reader exists meanwhile
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

    std::mutex turn_;  ///< held while the ocean works; locked before state_
    std::mutex state_;
    std::condition_variable readers_left_;
    std::shared_ptr<Executor> executor_;
    std::unique_ptr<Ocean> ocean_;
    double repeat_length_m_;
    bool has_velocities_, has_foam_, has_dynamic_waves_, has_spray_;
    std::array<Use, 2> uses_;
    std::array<double, 2> times_s_{};
    std::uint64_t scheduled_ = 0;  ///< number of frames so far
    bool in_flight_ = false;
    bool is_closed_ = false;
    std::vector<std::unique_ptr<SurfaceQueryJobs>> idle_jobs_;
};

}  // namespace pelagic::python
