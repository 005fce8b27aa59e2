// A frame of sea as textures: arrays with a layer for each cascade, displacement as RGBA16F, the two maps of slopes as RGBA8 and
// foam as R8 with our own mips, through a ring of pixel buffers (pixel_ring.hpp).
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
    /// Immutable storage for frames of so many cascades of resolution^2 texels.
    FrameTextures(const Functions& gl, int resolution, std::size_t cascades);
    FrameTextures(const FrameTextures&) = delete;
    FrameTextures& operator=(const FrameTextures&) = delete;

    /// Copies the frame into the next pixel buffer and starts its way into the next set of textures; the frame's
    /// views may go stale afterwards. Call it at the start of an application's frame, with the frame that complete() gave.
    /// Waits only if the GPU is three frames behind. GL state ends as it was.
    /// Mips of the displacement are the driver's (box filter), those of the slopes and of foam are the frame's.
    /// Throws std::invalid_argument, before it touches anything, for a frame without slopes, of another
    /// resolution or with another number of cascades.
    void upload(const Frame& frame);

    /// Targets in the next pixel buffer, for Ocean::schedule(): a frame written there is copied by nobody, and upload() only
    /// starts it on its way. They are valid, on any thread, until then. Waits as upload() does. Throws GlError. Foam has no
    /// targets: upload() copies it from the frame.
    std::span<const TextureTargets> map();

    /// GL_TEXTURE_2D_ARRAY each; layer i is cascade i.
    GLuint displacement() const { return sets_[set_].displacement.name(); }
    GLuint slopes() const { return sets_[set_].slopes.name(); }
    GLuint moments() const { return sets_[set_].moments.name(); }
    GLuint foam() const { return sets_[set_].foam.name(); }
    bool has_foam() const { return has_foam_; }  ///< the last frame had some; else foam() holds nothing
    int resolution() const { return resolution_; }
    std::size_t cascades() const { return cascades_; }
    /// The driver made the displacement's mips, and vertices may take them.
    bool has_displacement_mips() const { return gl_.renders_to_half_floats; }
    double last_driver_ms() const { return driver_ms_; }  ///< of the last upload(): the calls that move texels
    /// Of the last upload(): cascades (8 N^2 + 2 * 4 (4 N^2 - 1) / 3), and (4 N^2 - 1) / 3 for foam: 328 KB for a cascade of N = 128.
    std::size_t uploaded_bytes() const { return foam_offset() + (has_foam_ ? foam_bytes() : 0); }

   private:
    GLsizei layers() const { return static_cast<GLsizei>(cascades_); }
    std::size_t displacement_bytes() const;  ///< of all cascades
    std::size_t chain_bytes() const;         ///< the same, of one map of words
    std::size_t foam_bytes() const { return chain_bytes() / sizeof(std::uint32_t); }
    std::size_t foam_offset() const { return displacement_bytes() + 2 * chain_bytes(); }
    void fill(std::byte* to, const Frame& frame) const;
    template <class Texel>
    void fill_chains(std::byte* to, const Frame& frame, std::span<const Texel> Cascade::*map) const;
    void upload_chain(GLuint texture, GLenum format, std::size_t texel_bytes, std::uintptr_t address) const;

    // Textures are written while the other set may still be drawn from.
    struct Set {
        Texture displacement, slopes, moments, foam;
    };

    const Functions& gl_;
    int resolution_;
    std::size_t cascades_;
    std::array<Set, 2> sets_;
    PixelRing pixels_;  ///< displacement, slopes, moments and foam of the next frame, each of all cascades
    std::vector<TextureTargets> targets_;
    std::size_t set_ = 0;
    bool has_foam_ = false;  ///< of the last upload()
    double driver_ms_ = 0;
};

}  // namespace pelagic::gl
