// Dynamic waves beside the frames of an ocean: which ticks a frame needs, the runs that make them, and two slots for what frames
// show of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/dynamic_waves/grid.hpp"
#include "pelagic/sim/dynamic_waves_view.hpp"
#include "pelagic/simd/allocator.hpp"

namespace pelagic {

class DynamicWaveFrames {
   public:
    using Prepare = std::function<std::unique_ptr<GraphRun>(const JobGraph&)>;

    /// A jump in time is no more ticks than that many seconds have.
    static constexpr double max_seconds_a_frame = 0.5;

    DynamicWaveFrames(const DynamicWavesOptions& options, Isa isa, const Allocator& memory, const Prepare& prepare);
    DynamicWaveFrames(const DynamicWaveFrames&) = delete;  // stages point into it
    DynamicWaveFrames& operator=(const DynamicWaveFrames&) = delete;

    // Commands take effect at the next begin_frame(), in their order.
    //
    // Disturbances wait for the next tick. Of a frame whose time is not after the time of the frame before, they are provisional: they
    // give way to those of the next such frame that has any, so an application that is paused adds nothing up, and to those of later frames
    // where there is no room for both. Throws std::invalid_argument where more than DynamicWaveSources::most would wait.
    void disturb(const Disturbance& disturbance);
    std::uint32_t add_source(const Disturbance& source);
    void set_source(std::uint32_t number, const Disturbance& source);
    void remove_source(std::uint32_t number);
    void follow(double x_m, double z_m);
    void set_rain(const Rain& rain);

    /// Makes room for the next frame, before anything of it can fail; drop_frame() gives it back.
    void turn() { back_ = 1 - back_; }
    /// Begins the frame of `time_s`: its ticks, of which all but one are left to complete(), and what it shows. The first frame, and one
    /// of a time before the last one's, has no ticks. \pre turn() for this frame
    void begin_frame(double time_s);
    void complete();
    bool is_done() const;
    /// Of the frame completed last. Valid until the second begin_frame() from now.
    DynamicWavesView surface() const;
    /// Gives up what begin_frame() began, so that the frame before stays; its ticks are not undone.
    void drop_frame();

    std::vector<std::uint8_t> saved() const;
    void restore(std::span<const std::uint8_t> saved);
    std::size_t bytes() const;

   private:
    struct Slot {
        AlignedBuffer<float> height, vertical_velocity;
        AlignedBuffer<std::uint8_t> foam;
        std::int64_t first_x = 0, first_z = 0;
        std::vector<float> lowest, highest;
    };
    void begin_run(GraphRun& run);
    void complete_run();
    void apply_commands(bool time_goes_on);
    void show_rows(std::size_t item);

    DynamicWaveGrid grid_;
    /// What an application said since the last begin_frame().
    struct Command {
        enum class Kind { disturb, add, set, remove, follow, rain } kind;
        std::uint32_t number = 0;
        Disturbance disturbance = {};  ///< of a follow, its place
        Rain rain = {};
    };
    void enqueue(const Command& command);

    std::vector<Command> commands_;
    std::size_t new_disturbances_ = 0;  ///< among them
    std::vector<std::uint32_t>
        numbers_;  ///< of the sources that there are after all that was said, in ascending order
    std::array<Slot, 2> slots_;
    std::size_t back_ = 0;
    bool has_clock_ = false;
    double last_time_s_ = 0;      ///< of the last frame
    std::int64_t last_tick_ = 0;  ///< by the frames' time
    std::int64_t ticks_due_ = 0;
    float part_ = 0;
    bool frame_in_flight_ = false;
    JobGraph tick_graph_, show_graph_, tick_and_show_graph_;
    GraphRun* run_in_flight_ = nullptr;
    std::unique_ptr<GraphRun> tick_run_, show_run_, tick_and_show_run_;
};

}  // namespace pelagic
