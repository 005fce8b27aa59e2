// Dynamic waves as a part of an ocean's frames: their runs are in flight beside those of the frame.
#pragma once

#include <cstddef>
#include <utility>

#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/dynamic_waves.hpp"

namespace pelagic {

class DynamicWavesPart final : public FramePart {
   public:
    /// Throws as the constructor of DynamicWaves.
    /// \param runs_ahead  Executor::runs_ahead() of the resources' executor
    DynamicWavesPart(const DynamicWavesOptions& options, DynamicWaves::Resources resources, bool runs_ahead)
        : waves_(options, std::move(resources)), runs_ahead_(runs_ahead) {
        waves_.has_ocean_ = true;
    }

    DynamicWaves& waves() { return waves_; }

    void swap_buffers() override { waves_.swap_buffers(); }
    /// Applies the commands, and starts the ticks of a frame except those that end() computes.
    void begin(const PassMoment& at) override {
        if (at.pass == Pass::frame) waves_.begin_frame(at.time_s);
    }
    bool is_done() const override { return !runs_ahead_ || waves_.is_done(); }
    void end(Frame& frame) override {
        waves_.complete_frame();
        frame.dynamic_waves = waves_.view();
        frame.bounds += frame.dynamic_waves.bounds;
    }
    /// Waits for the ticks of a frame in flight, which are not undone.
    void drop() override { waves_.drop_frame(); }
    void set_water_frame(const WaterFrame& water) override {
        waves_.set_current(water.current_x_mps, water.current_z_mps);
        waves_.set_origin(water.origin_x_m, water.origin_z_m);
    }
    std::size_t bytes() const override { return sizeof *this + waves_.memory_bytes(); }

   private:
    DynamicWaves waves_;
    bool runs_ahead_;
};

}  // namespace pelagic
