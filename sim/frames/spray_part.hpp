// Spray as a part of a frame: droplets of crests, which ticks launch, and of emitters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/sim/buffers/double_buffer.hpp"
#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/cascades/weather.hpp"
#include "pelagic/sim/frames/kept_ticks.hpp"
#include "pelagic/sim/shore/shore_source.hpp"
#include "pelagic/sim/spray/crest_spray.hpp"

namespace pelagic {

class SprayPart final : public FramePart {
   public:
    /// \param shore  null without one; it outlives this object and precedes it among the parts
    /// \throws std::invalid_argument  check(options), unless it is empty
    SprayPart(const SprayOptions& options, FrameSlots& slots, const Weather& weather, const ShoreSource* shore);

    /// Functions of Ocean. They take effect when the next frame begins.
    void set_center(double x_m, double z_m);
    void emit(std::span<const SprayEmitter> emitters);
    /// \pre no frame is in flight, for both
    std::vector<std::uint8_t> save_state() const;
    void restore_state(std::span<const std::uint8_t> saved);

    void add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) override;
    void swap_buffers() override { slots_.swap(); }
    void begin(const PassMoment& at) override;
    void end(Frame& frame) override;
    void drop() override;
    const TicksDue* ticks() const override { return &ticks_.due(); }
    void forget() override { ticks_.forget(); }
    void before_change(const SeaChange& next) override { ticks_.before_change(next); }
    /// The centre stays in its place.
    void set_water_frame(const WaterFrame& water) override {
        next_.x_m += next_.water.origin_x_m - water.origin_x_m;
        next_.z_m += next_.water.origin_z_m - water.origin_z_m;
        next_.water = water;
    }
    std::size_t bytes() const override;

   private:
    void begin_tick(const PassMoment& at);
    void write_frame();
    SprayWind wind_at(double time_s) const { return SprayWind::of(weather_.sea_at(weather_.moment_at(time_s))); }

    /// What the application sets for a frame and its ticks.
    struct Settings {
        double x_m = 0, z_m = 0;  ///< centre, in the world
        WaterFrame water;
    };
    struct Slot {
        AlignedBuffer<SprayDroplet> droplets;
        std::size_t count = 0;
    };
    FrameSlots& frames_;
    const Weather& weather_;
    const ShoreSource* shore_;
    KeptTicks ticks_;
    CrestSpray crests_;
    DropletRing emitted_;
    DropletRing waiting_;  ///< droplets of emitters that the next frame adds
    Settings next_, now_;  ///< of the next frame, and of the frame that was begun last
    SprayTime time_;
    bool is_idle_ = false;  ///< the tick is another part's
    DoubleBuffer<Slot> slots_;
};

}  // namespace pelagic
