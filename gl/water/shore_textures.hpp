// Textures of a frame's shore: the weight of each cascade, the waves that the floor transforms, and
// the height that they reach.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/pixel_ring.hpp"
#include "pelagic/sim/shore_surface.hpp"

namespace pelagic::gl {

class ShoreTextures {
   public:
    explicit ShoreTextures(const Functions& gl) : gl_(gl) {}
    ShoreTextures(const ShoreTextures&) = delete;
    ShoreTextures& operator=(const ShoreTextures&) = delete;

    /// Copies the shore and starts the transfer to the next set of textures, like
    /// FrameTextures::upload(). Cascade weights are uploaded only if they differ from those of the
    /// last upload. A rectangle of another size reallocates the textures. Without a shore the call
    /// has no effect, and the textures keep their contents. Restores GL state.
    /// \throws GlError  if the driver does not map a buffer
    void upload(const ShoreSurface& shore);

    /// Cascade weights, RGBA8; channel t holds cascade t.
    GLuint weights() const { return weights_.name(); }
    /// RGBA16F: height, its slopes along x and z by central differences, foam. The driver generates
    /// its mips if has_mips().
    GLuint water() const { return sets_[set_].water.name(); }
    GLuint reach() const { return sets_[set_].reach.name(); }  ///< R16F
    bool has_mips() const { return gl_.renders_to_half_floats; }

    /// Time that the last upload() spent in GL calls that copy texels.
    double last_driver_ms() const { return driver_ms_; }
    std::size_t uploaded_bytes() const { return uploaded_bytes_; }

   private:
    struct Set {
        Texture water, reach;
    };
    void make_textures(int columns, int rows);

    const Functions& gl_;
    int columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> weights_rgba8_;  ///< content of weights_
    Texture weights_;
    std::array<Set, 2> sets_;
    std::optional<PixelRing> pixels_;  ///< weights, water and reach of the next frame
    std::size_t set_ = 0, uploaded_bytes_ = 0;
    double driver_ms_ = 0;
};

}  // namespace pelagic::gl
