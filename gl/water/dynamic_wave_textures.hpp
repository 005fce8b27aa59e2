// Dynamic-wave grid as an RGBA16F texture: height, slopes along x and z, and foam. The texture is
// periodic, like the grid's toroidal storage. The driver generates its mips.
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

/// Returns an empty string if the grid can be uploaded or is absent, else the reason, for example
/// "Frame::dynamic_waves.height_m.size() is 3, expected resolution^2, 65536".
/// \param largest_side  GL_MAX_TEXTURE_SIZE of the driver
std::string check(const DynamicWavesView& water, int largest_side);

/// Packs the grid as four half floats per texel: height, two slopes, and foam in [0, 1]. Slopes are
/// central differences with periodic boundaries. Each word holds two halves, the first in its low
/// bits. Values beyond the range of half floats are clamped to it.
/// \param words  2 resolution^2 elements
void pack(const DynamicWavesView& water, std::span<std::uint32_t> words);

class DynamicWaveTextures {
   public:
    explicit DynamicWaveTextures(const Functions& gl);
    DynamicWaveTextures(const DynamicWaveTextures&) = delete;
    DynamicWaveTextures& operator=(const DynamicWaveTextures&) = delete;

    /// Returns an empty string if upload() accepts the grid, else the reason.
    std::string invalid_value_of(const DynamicWavesView& water) const { return check(water, largest_side_); }
    /// Starts the copy of the grid into the next of two textures. The views may become invalid
    /// afterwards. Textures are reused for grids of equal size. Without a grid the call has no
    /// effect.
    /// \pre invalid_value_of(water) is empty
    void upload(const DynamicWavesView& water);

    /// GL_TEXTURE_2D of the last grid.
    GLuint texels() const { return sets_[set_].name(); }
    std::size_t uploaded_bytes() const { return uploaded_bytes_; }  ///< bytes of the last upload()
    /// Time that the last upload() spent in GL calls that copy texels.
    double last_driver_ms() const { return driver_ms_; }

   private:
    void make_textures(int resolution);

    const Functions& gl_;
    int largest_side_ = 0, resolution_ = 0;
    std::array<Texture, 2> sets_;  ///< one is written while the GPU may still read the other
    std::optional<PixelRing> pixels_;
    std::size_t set_ = 0, uploaded_bytes_ = 0;
    double driver_ms_ = 0;
};

}  // namespace pelagic::gl
