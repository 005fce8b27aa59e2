// The grid of dynamic waves as a texture: RGBA16F with height, slopes along x and z, and foam, which repeats as the grid's own
// storage does. Its mips are the driver's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/pixel_ring.hpp"
#include "pelagic/sim/dynamic_waves_view.hpp"

namespace pelagic::gl {

/// Why the textures can't take the grid, "Frame::dynamic_waves.height_m.size() is 3, needs resolution^2, 65536"; empty if they can, or if there is none.
std::string check(const DynamicWavesView& water, int largest_side);

/// Four halves a texel, two a word with the first below: height, slopes by central differences around the torus, foam as a part of 1. What
/// is beyond halves is their largest.
void pack(const DynamicWavesView& water, std::span<std::uint32_t> words);

class DynamicWaveTextures {
   public:
    explicit DynamicWaveTextures(const Functions& gl);
    DynamicWaveTextures(const DynamicWaveTextures&) = delete;
    DynamicWaveTextures& operator=(const DynamicWaveTextures&) = delete;

    /// Empty, or why upload() would not take it.
    std::string invalid_value_of(const DynamicWavesView& water) const { return check(water, largest_side_); }
    /// Starts its way into the next of two textures, as FrameTextures does; the views may go stale afterwards. Grids of one size take
    /// the same textures again. Nothing happens without a window. \pre invalid_value_of() is empty
    void upload(const DynamicWavesView& water);

    /// GL_TEXTURE_2D of the last grid.
    GLuint texels() const { return sets_[set_].name(); }
    std::size_t uploaded_bytes() const { return uploaded_bytes_; }  ///< of the last upload()
    double last_driver_ms() const { return driver_ms_; }            ///< of the last upload(): calls that move texels

   private:
    void make_textures(int resolution);

    const Functions& gl_;
    int largest_side_ = 0, resolution_ = 0;
    std::array<Texture, 2> sets_;  ///< one is written while the other may still be drawn from
    std::optional<PixelRing> pixels_;
    std::size_t set_ = 0, uploaded_bytes_ = 0;
    double driver_ms_ = 0;
};

}  // namespace pelagic::gl
