// Foam of a frame's cascades at reference positions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// Weights of the cascades at a position of a shore.
using FoamWeights = std::array<float, max_cascades>;

/// Samples foam with bilinear interpolation. The code is scalar, so results are bit-identical on
/// every machine. A view of a frame; const functions may run on any thread.
class FoamSampler {
   public:
    explicit FoamSampler(const Frame& frame);

    /// Returns whether the frame's cascades have foam.
    bool has_foam() const { return has_foam_; }
    /// Returns the foam of water with the reference position (x_m, z_m), [0, 1].
    /// \param weights  factors of the cascades' compression; null: all 1
    /// \pre has_foam(), and the position is finite
    float at(double x_m, double z_m, const FoamWeights* weights = nullptr) const;

   private:
    /// Four texels around a position, and their weights.
    struct Texels {
        std::array<std::size_t, 4> index;
        std::array<float, 4> weight;
    };
    static Texels texels_at(const Cascade& cascade, double columns, double rows);

    std::span<const Cascade> cascades_;
    const SnapshotFoam& foam_;
    bool has_foam_;
    /// Slots of snapshots that have an effect, the newest first.
    std::array<std::uint8_t, SnapshotFoam::slots> slots_{};
    std::size_t slot_count_ = 0;
};

}  // namespace pelagic
