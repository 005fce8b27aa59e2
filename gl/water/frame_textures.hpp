// Textures of a frame: arrays with one layer per cascade. Displacement is RGBA16F, the two slope
// maps are RGBA8. The snapshots that foam is made of are RGBA8, with one layer for each image of
// each of the cascades that make foam; only images that changed are uploaded. Slopes and snapshots
// use the mips that the frame provides. Texels pass through a ring of pixel buffers
// (pixel_ring.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/pixel_ring.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/texture_targets.hpp"

namespace pelagic::gl {

class FrameTextures {
   public:
    /// The fourth cascade makes no foam (CascadePlan::foam_weight()).
    static constexpr std::size_t max_foam_cascades = 3;

    /// Allocates immutable storage for frames with `cascades` cascades of resolution^2 texels.
    FrameTextures(const Functions& gl, int resolution, std::size_t cascades);
    FrameTextures(const FrameTextures&) = delete;
    FrameTextures& operator=(const FrameTextures&) = delete;

    /// Copies the frame into the next pixel buffer and starts the copy into the next set of
    /// textures. The frame's views may become invalid afterwards. Call it at the start of an
    /// application's frame with the result of Ocean::complete(). Waits only if the GPU is three
    /// frames behind. Restores GL state.
    ///
    /// The driver generates the mips of the displacement (box filter). The mips of slopes and
    /// snapshots come from the frame.
    /// \throws std::invalid_argument  for a frame without slopes, of another resolution or with
    ///     another number of cascades; nothing has changed then
    /// \throws GlError  if the driver does not map a buffer
    void upload(const Frame& frame);

    /// Returns targets in the next pixel buffer for Ocean::schedule(). The CPU does not copy a
    /// frame that was written there: upload() only starts the transfer to the textures. The targets
    /// are valid on any thread until upload(). Waits only if the GPU is three frames behind.
    /// Snapshots have no targets: upload() copies them from the frame.
    /// \throws GlError  if the driver does not map a buffer
    std::span<const TextureTargets> map();

    /// Each is a GL_TEXTURE_2D_ARRAY; layer i holds cascade i.
    GLuint displacement() const { return sets_[set_].displacement.name(); }
    /// Returns the texture array of slopes, RGBA8.
    GLuint slopes() const { return sets_[set_].slopes.name(); }
    /// Returns the texture array of moments, RGBA8.
    GLuint moments() const { return sets_[set_].moments.name(); }
    /// Returns the texture array of snapshots, RGBA8: layer i foam_cascades() + j is image i of
    /// cascade j.
    GLuint snapshots() const { return sets_[set_].snapshots.name(); }
    /// Returns the number of coarsest cascades that have layers of snapshots.
    std::size_t foam_cascades() const { return std::min(cascades_, max_foam_cascades); }
    /// Returns whether the last frame has foam. If not, snapshots() holds no data of that frame.
    bool has_foam() const { return has_foam_; }
    /// Returns the texels along a side of a cascade.
    int resolution() const { return resolution_; }
    /// Returns the number of cascades.
    std::size_t cascades() const { return cascades_; }
    /// Returns whether the driver generates mips of the displacement for vertex shaders to sample.
    bool has_displacement_mips() const { return gl_.renders_to_half_floats; }
    /// Time that the last upload() spent in GL calls that copy texels.
    double last_driver_ms() const { return driver_ms_; }
    /// Bytes of the last upload(): cascades (8 N^2 + 2 * 4 (4 N^2 - 1) / 3), and foam_cascades()
    /// 4 (4 N^2 - 1) / 3 more for each image of snapshots that changed, about 87 KB for each
    /// cascade of N = 128 five times a second.
    std::size_t uploaded_bytes() const { return uploaded_bytes_; }

   private:
    GLsizei layers() const { return static_cast<GLsizei>(cascades_); }
    std::size_t displacement_bytes() const;  ///< displacement of all cascades
    std::size_t chain_bytes() const;         ///< mip chains of one RGBA8 map of all cascades
    std::size_t image_bytes() const { return chain_bytes() / cascades_ * foam_cascades(); }
    std::size_t foam_offset() const { return displacement_bytes() + 2 * chain_bytes(); }
    void fill(std::byte* to, const Frame& frame) const;
    template <class Chain>
    std::byte* fill_chains(std::byte* to, std::span<const Cascade> cascades, Chain chain) const;
    void upload_chain(GLuint texture, std::size_t first_layer, std::size_t layers, std::uintptr_t address) const;

    using Versions = std::array<std::array<std::uint64_t, SnapshotFoam::images>, max_foam_cascades>;
    // One set is written while the GPU may still read the other.
    struct Set {
        Texture displacement, slopes, moments, snapshots;
        Versions versions{};  ///< of the snapshots
    };
    bool has_changed(const Set& set, const Frame& frame, std::size_t image) const;

    const Functions& gl_;
    int resolution_;
    std::size_t cascades_;
    std::array<Set, 2> sets_;
    /// Displacement, slopes, moments and changed snapshots of the next frame.
    PixelRing pixels_;
    std::vector<TextureTargets> targets_;
    std::size_t set_ = 0;
    bool has_foam_ = false;  ///< the last uploaded frame has foam
    std::size_t uploaded_bytes_ = 0;
    double driver_ms_ = 0;
};

}  // namespace pelagic::gl
