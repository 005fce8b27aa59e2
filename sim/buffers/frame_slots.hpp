// The buffers of frames. Two slots exist, so that one frame is computed while the application
// renders the previous one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/sim/buffers/contraction_map.hpp"
#include "pelagic/sim/buffers/double_buffer.hpp"
#include "pelagic/sim/buffers/fold_map.hpp"
#include "pelagic/sim/buffers/water_planes.hpp"
#include "pelagic/sim/buffers/working_surfaces.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/texture_targets.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// The buffers of a cascade of a frame.
struct CascadeBuffers {
    /// \param is_one    whether the frame has one cascade, along the world's axes
    /// \param has_foam  whether the cascade may have foam
    /// \param lanes  Kernels::lanes of the instruction set that computes the frame
    CascadeBuffers(bool is_one, bool has_foam, int resolution, std::size_t lanes, const FrameContents& contents,
                   const Allocator& memory);
    std::size_t bytes() const;

    /// Lines, later the surface (kernels/wave_blocks.hpp), if FrameContents::planes.
    AlignedBuffer<float> surface;
    /// Time derivative of `surface`, if FrameContents::has_drawn_velocities().
    AlignedBuffer<float> velocity;
    std::unique_ptr<WaterPlanes> water;         ///< if FrameContents::has_water_levels()
    std::optional<FoldMap> folds;               ///< if FrameContents::queries, of one cascade
    std::optional<ContractionMap> contraction;  ///< if FrameContents::queries, else
    AlignedBuffer<std::uint16_t> rgba16f;
    AlignedBuffer<std::uint32_t> rgba8;            ///< if FrameContents::gradients
    AlignedBuffer<std::uint32_t> slopes, moments;  ///< if FrameContents::slopes
    AlignedBuffer<std::uint8_t> compression;       ///< N^2, if the cascade may have foam
};

/// Two slots of frame buffers. Stages write to the back slot, which they look up when they run.
class FrameSlots {
   public:
    /// \param cascades  number of cascades, of resolution^2 texels each
    /// \param memory  for all buffers whose size grows with N^2
    FrameSlots(std::size_t cascades, int resolution, std::size_t lanes, const FrameContents& contents,
               const Allocator& memory = {}, bool is_rotated = false);
    FrameSlots(const FrameSlots&) = delete;  // frames hold pointers into the slots
    FrameSlots& operator=(const FrameSlots&) = delete;

    std::size_t cascade_count() const { return slots_.back().cascades.size(); }
    int resolution() const { return slots_.back().cascades.front().resolution(); }

    const FrameContents& contents() const { return contents_; }
    const Allocator& memory() const { return memory_; }

    CascadeBuffers& buffers(std::size_t cascade) { return slots_.back().buffers[cascade]; }
    /// Returns where a cascade's lines and surface are computed: its planes, or a working buffer,
    /// which the cascade takes. Thread-safe.
    float* surface(std::size_t cascade) { return working_ ? working_->of(cascade) : buffers(cascade).surface.data(); }
    /// Marks the surface as read, so that other cascades may use its working buffer.
    void release_surface(std::size_t cascade) {
        if (working_) working_->release(cascade);
    }
    Cascade& cascade(std::size_t cascade) { return slots_.back().cascades[cascade]; }
    std::span<Cascade> cascades() { return slots_.back().cascades; }
    /// Returns the cascade of the frame before, which the application may use.
    const Cascade& front_cascade(std::size_t cascade) const { return slots_.front().cascades[cascade]; }
    /// Returns the targets of all textures of the cascade: its own buffers or the application's
    /// memory.
    const TextureTargets& textures(std::size_t cascade) const { return slots_.back().textures[cascade]; }
    Frame& frame() { return slots_.back().frame; }

    void swap() { slots_.swap(); }

    /// Sets the application's texture targets of the back slot's frame. The frame has no views of
    /// textures in the application's memory.
    /// \param cascades  targets by cascade; empty: all textures are written to the slot's own
    /// buffers
    void write_textures_to(std::span<const TextureTargets> cascades);
    /// Copies the last mip levels to the application's targets and sets Cascade::slope_variance.
    /// \pre all stages are done
    void finish_textures();

    std::size_t bytes() const;

   private:
    struct Slot {
        std::vector<CascadeBuffers> buffers;
        std::vector<TextureTargets> own_textures;  ///< the slot's own buffers
        std::vector<TextureTargets> elsewhere;     ///< the application's targets
        std::vector<TextureTargets> textures;      ///< the targets that stages write to
        std::vector<Cascade> cascades;
        Frame frame;
    };
    std::size_t last_level() const { return static_cast<std::size_t>(mip_levels(resolution()) - 1); }

    FrameContents contents_;
    Allocator memory_;
    DoubleBuffer<Slot> slots_;
    std::optional<WorkingSurfaces> working_;  ///< without planes
};

}  // namespace pelagic
