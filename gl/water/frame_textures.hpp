// Textures of a frame: arrays with one layer per cascade. Displacement is RGBA16F, the two slope
// maps are RGBA8 and foam is R8. Slopes and foam use the mips that the frame provides. Texels pass
// through a ring of pixel buffers (pixel_ring.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/pixel_ring.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/texture_targets.hpp"

namespace pelagic::gl {

class FrameTextures {
   public:
    /// Allocates immutable storage for frames with `cascades` cascades of resolution^2 texels.
    FrameTextures(const Functions& gl, int resolution, std::size_t cascades);
    FrameTextures(const FrameTextures&) = delete;
    FrameTextures& operator=(const FrameTextures&) = delete;

    /// Copies the frame into the next pixel buffer and starts the copy into the next set of
    /// textures. The frame's views may become invalid afterwards. Call it at the start of an
    /// application's frame with the result of Ocean::complete(). Waits only if the GPU is three
    /// frames behind. Restores GL state.
    ///
    /// The driver generates the mips of the displacement (box filter). The mips of slopes and foam
    /// come from the frame.
    /// \throws std::invalid_argument  for a frame without slopes, of another resolution or with
    ///     another number of cascades; nothing has changed then
    void upload(const Frame& frame);

    /// Returns targets in the next pixel buffer for Ocean::schedule(). The CPU does not copy a
    /// frame that was written there: upload() only starts the transfer to the textures. The targets
    /// are valid on any thread until upload(). Waits only if the GPU is three frames behind. Foam
    /// has no targets: upload() copies it from the frame.
    /// \throws GlError
    std::span<const TextureTargets> map();

    /// Each is a GL_TEXTURE_2D_ARRAY; layer i holds cascade i.
    GLuint displacement() const { return sets_[set_].displacement.name(); }
    /// Returns the texture array of slopes, RGBA8.
    GLuint slopes() const { return sets_[set_].slopes.name(); }
    /// Returns the texture array of moments, RGBA8.
    GLuint moments() const { return sets_[set_].moments.name(); }
    /// Returns the texture array of foam, R8.
    GLuint foam() const { return sets_[set_].foam.name(); }
    /// Returns whether the last frame has foam. If not, foam() holds no data of that frame.
    bool has_foam() const { return has_foam_; }
    /// Returns the texels along a side of a cascade.
    int resolution() const { return resolution_; }
    /// Returns the number of cascades.
    std::size_t cascades() const { return cascades_; }
    /// Returns whether the driver generates mips of the displacement for vertex shaders to sample.
    bool has_displacement_mips() const { return gl_.renders_to_half_floats; }
    /// Time that the last upload() spent in GL calls that copy texels.
    double last_driver_ms() const { return driver_ms_; }
    /// Bytes of the last upload(): cascades (8 N^2 + 2 * 4 (4 N^2 - 1) / 3), and for foam
    /// cascades (4 N^2 - 1) / 3 more. That is 328 KB for one cascade of N = 128 with foam.
    std::size_t uploaded_bytes() const { return foam_offset() + (has_foam_ ? foam_bytes() : 0); }

   private:
    GLsizei layers() const { return static_cast<GLsizei>(cascades_); }
    std::size_t displacement_bytes() const;  ///< displacement of all cascades
    std::size_t chain_bytes() const;         ///< mip chains of one RGBA8 map of all cascades
    std::size_t foam_bytes() const { return chain_bytes() / sizeof(std::uint32_t); }
    std::size_t foam_offset() const { return displacement_bytes() + 2 * chain_bytes(); }
    void fill(std::byte* to, const Frame& frame) const;
    template <class Texel>
    void fill_chains(std::byte* to, const Frame& frame, std::span<const Texel> Cascade::*map) const;
    void upload_chain(GLuint texture, GLenum format, std::size_t texel_bytes, std::uintptr_t address) const;

    // One set is written while the GPU may still read the other.
    struct Set {
        Texture displacement, slopes, moments, foam;
    };

    const Functions& gl_;
    int resolution_;
    std::size_t cascades_;
    std::array<Set, 2> sets_;
    /// Displacement, slopes, moments and foam of the next frame, each of all cascades.
    PixelRing pixels_;
    std::vector<TextureTargets> targets_;
    std::size_t set_ = 0;
    bool has_foam_ = false;  ///< the last uploaded frame has foam
    double driver_ms_ = 0;
};

}  // namespace pelagic::gl
