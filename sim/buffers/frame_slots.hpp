// The buffers of frames: two slots, so that one frame is computed while the application still draws the one before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/sim/buffers/contraction_map.hpp"
#include "pelagic/sim/buffers/fold_map.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/texture_targets.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// What frames hold beside the sea.
struct FrameExtras {
    bool folds = false;
    bool velocities = false;
    bool gradients = true;  ///< each cascade's own normals
    bool slopes = false;    ///< and those that add to other cascades'
    bool foam = false;      ///< that lasts
    Allocator memory = {};  ///< for everything whose size grows with N^2
};

/// The buffers of one cascade of one frame, and the views of them.
struct CascadeBuffers {
    /// \param lanes  Kernels::lanes of the instruction set that computes them
    /// \param cascades  of the frame
    CascadeBuffers(std::size_t cascades, int resolution, std::size_t lanes, const FrameExtras& extras);
    std::size_t bytes() const;

    AlignedBuffer<float> surface;               ///< lines at first, see kernels/wave_blocks.hpp
    AlignedBuffer<float> velocity;              ///< the same for the derivative in time, if wanted
    std::optional<FoldMap> folds;               ///< of one cascade, if wanted
    std::optional<ContractionMap> contraction;  ///< of several
    AlignedBuffer<std::uint16_t> rgba16f;
    AlignedBuffer<std::uint32_t> rgba8;            ///< gradients, if wanted
    AlignedBuffer<std::uint32_t> slopes, moments;  ///< if wanted
    AlignedBuffer<std::uint8_t> foam;              ///< the chain, if wanted
};

/// The foam of a cascade at the last tick, and how much of it has faded since.
struct RememberedFoam {
    const std::uint8_t* bytes = nullptr;  ///< N^2, null where nothing is remembered
    int fade = 0;
};

/// Stages write to the slot that is the back one, and look for it when they run.
class FrameSlots {
   public:
    /// \param cascades  how many there are, of resolution^2 texels each
    FrameSlots(std::size_t cascades, int resolution, std::size_t lanes, const FrameExtras& extras);
    FrameSlots(const FrameSlots&) = delete;  // frames point into it
    FrameSlots& operator=(const FrameSlots&) = delete;

    std::size_t cascade_count() const { return slots_[0].cascades.size(); }
    int resolution() const { return slots_[0].cascades.front().resolution(); }

    CascadeBuffers& buffers(std::size_t cascade) { return slots_[back_].buffers[cascade]; }
    Cascade& cascade(std::size_t cascade) { return slots_[back_].cascades[cascade]; }
    /// Where the cascade's textures go: all that it has, into its buffers or into memory of the application's.
    const TextureTargets& textures(std::size_t cascade) const { return slots_[back_].textures[cascade]; }
    Frame& frame() { return slots_[back_].frame; }
    /// What the cascade's frame finds of foam.
    RememberedFoam& remembered_foam(std::size_t cascade) { return slots_[back_].remembered_foam[cascade]; }

    /// Makes the other slot the back one: for the next frame, and to give up the last one, so that the one before it is not
    /// written over yet.
    void turn() { back_ = 1 - back_; }

    /// What the slot's frame writes elsewhere, by cascade; it has no views of that. None: everything is its own.
    void write_textures_to(std::span<const TextureTargets> cascades);
    /// What becomes of the textures when all stages are done.
    void finish_textures();

    std::size_t bytes() const;

   private:
    struct Slot {
        std::vector<CascadeBuffers> buffers;
        std::vector<TextureTargets> own_textures;  ///< in the buffers
        std::vector<TextureTargets> elsewhere;     ///< what the application has asked for
        std::vector<TextureTargets> textures;      ///< where the frame's are written
        std::vector<Cascade> cascades;
        std::vector<RememberedFoam> remembered_foam;
        Frame frame;
    };
    std::size_t last_level() const { return static_cast<std::size_t>(mip_levels(resolution()) - 1); }

    std::array<Slot, 2> slots_;
    std::size_t back_ = 0;
};

}  // namespace pelagic
