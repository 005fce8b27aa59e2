// Snapshots of the compression of cascades, at foam ticks (snapshot_foam.hpp).
//
// A snapshot is a pure function of its time, so a frame after a jump in time computes 16 of them
// and has the same bytes as a frame that was reached step by step. Snapshots are stored in the
// frame of the drifting foam: texel y of the snapshot of time t_k holds the compression at y + v
// t_k. All snapshots of a frame at time t are then sampled at one point, x - v t. The drift in a
// loop is a whole number of texels, so that foam repeats with the loop. Fractions of texels are
// interpolated from eight texels along each axis, which changes no wave of three texels or more by
// over 1.2 % per axis. A cubic would keep 73 % of the variance of the shortest waves, too little
// for the whitecap cover of light winds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/foam/drift.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

class FoamSnapshots {
   public:
    FoamSnapshots(FrameSlots& slots, const Kernels& kernels);
    FoamSnapshots(const FoamSnapshots&) = delete;  // stages point into it
    FoamSnapshots& operator=(const FoamSnapshots&) = delete;

    /// Adds the stages of one tick. Returns the stages after which the tick's displacement may be
    /// overwritten, by cascade.
    /// \param surfaces_done  the stages that compute the tick's displacement, by cascade
    std::vector<StageId> add_tick_stages(JobGraph& graph, std::span<const StageId> surfaces_done);

    /// Sets the weight and the drift in a loop of the cascade's foam, for ticks and frames from now
    /// on. A cascade of weight 0 has no snapshots.
    void set_sea(std::size_t cascade, double weight, const DriftTexels& drift_per_loop) {
        cascades_[cascade].is_there = weight > 0;
        cascades_[cascade].drift = drift_per_loop;
    }
    /// Makes the next run of the stages do nothing, or lifts that.
    void set_idle(bool is_idle) { is_idle_ = is_idle; }
    /// Prepares the cascade's snapshot of tick `number` for the next run of the stages. Images that
    /// the application's frame shows are not overwritten. \pre no run is in flight
    /// \param from  the grid and the factors of compression at the tick
    void begin_tick(std::size_t cascade, const Cascade& from, const TickClock& clock, std::int64_t number);
    /// Gives the frame in the back slot the snapshots, as of the last tick before its time.
    void set_views(const TickClock& clock, const TickTime& time);

    std::size_t bytes() const;

   private:
    /// Two buffers for each image: the current one, and one that no valid frame shows.
    struct Image {
        std::array<AlignedBuffer<std::uint32_t>, 2> chains;
        std::size_t current = 0;
        std::uint64_t version = 0;
    };
    struct CascadeSnapshots {
        bool is_there = false;
        CascadeGrid grid;
        DriftTexels drift{};
        PresentCompression bytes;                                   ///< of slopes of one unit
        std::size_t slot = 0;                                       ///< of the tick
        const std::uint32_t* before = nullptr;                      ///< the image before the tick
        std::size_t shift_x = 0, shift_z = 0;                       ///< whole texels of the drift
        std::array<float, SnapshotJob::taps> weights_x, weights_z;  ///< of the fractions of texels
        AlignedBuffer<float> compression;                           ///< N^2
        std::array<Image, SnapshotFoam::images> images;

        Image& image() { return images[slot / 4]; }
    };
    void compress_rows(std::size_t cascade, std::size_t job);
    void store_rows(std::size_t cascade, std::size_t job);
    void make_levels(std::size_t cascade);

    FrameSlots& slots_;
    const Kernels& kernels_;
    std::vector<CascadeSnapshots> cascades_;
    bool is_idle_ = false;
};

/// Returns the factors that convert a cascade's slopes to bytes of compression.
/// \param slope_unit  unit of the slopes
PresentCompression bytes_of_compression(const Cascade& cascade, float slope_unit = 1);

}  // namespace pelagic
