// A frame's shore as textures: what each cascade counts with, the waves that feel the floor, and how high they reach.
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

    /// Copies the shore and starts its way into the next set of textures, as FrameTextures::upload() does with a frame. Parts go
    /// again only where they differ from those of the last upload; a rectangle of another size makes new textures. No shore costs
    /// nothing, and those of the last one stay. GL state ends as it was. Throws GlError.
    void upload(const ShoreSurface& shore);

    GLuint parts() const { return parts_.name(); }  ///< RGBA8, cascade t in channel t
    /// RGBA16F: height, its slopes along x and z by central differences, foam; with the driver's mips, where it makes any.
    GLuint water() const { return sets_[set_].water.name(); }
    GLuint reach() const { return sets_[set_].reach.name(); }  ///< R16F
    bool has_mips() const { return gl_.renders_to_half_floats; }

    double last_driver_ms() const { return driver_ms_; }  ///< as FrameTextures have it
    std::size_t uploaded_bytes() const { return uploaded_bytes_; }

   private:
    struct Set {
        Texture water, reach;
    };
    void make_textures(int columns, int rows);

    const Functions& gl_;
    int columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> parts_rgba8_;  ///< that the texture holds
    Texture parts_;
    std::array<Set, 2> sets_;
    std::optional<PixelRing> pixels_;  ///< parts, water and reach of the next frame
    std::size_t set_ = 0, uploaded_bytes_ = 0;
    double driver_ms_ = 0;
};

}  // namespace pelagic::gl
