// Where a window of texels lies that follows somebody. Texel i of the world's lattice stands at i texel_m and is kept in column
// i mod N of a torus, so a window that moves keeps what it still covers where it is.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pelagic {

class LocalWindow {
   public:
    LocalWindow(int resolution, double texel_m) : resolution_(resolution), texel_m_(texel_m) {}

    /// The window's lowest texel along an axis if its middle is as near to `middle_m` as whole texels allow.
    std::int64_t first_around(double middle_m) const {
        return static_cast<std::int64_t>(std::floor(middle_m / texel_m_ + 0.5)) - resolution_ / 2;
    }
    std::size_t in_torus(std::int64_t texel) const {
        return static_cast<std::size_t>(texel & (static_cast<std::int64_t>(resolution_) - 1));
    }

    int resolution() const { return resolution_; }
    double texel_m() const { return texel_m_; }

   private:
    int resolution_;  ///< a power of two
    double texel_m_;
};

}  // namespace pelagic
