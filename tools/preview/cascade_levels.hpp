// Mip levels of a cascade's displacement and slopes, sampled trilinearly, for preview images.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/sim/cascade.hpp"

namespace pelagic::tools {

struct CascadeSample {
    glm::vec3 displacement{0};  ///< Dx, height, Dz, metres
    SurfaceSlopes slopes;       ///< without cov_xz
};

class CascadeLevels {
   public:
    /// Stores a cascade. Slopes are not copied, so the cascade's views must stay valid until the
    /// last at().
    /// \pre the cascade has slopes
    void take(const Cascade& cascade);

    /// Returns the mean around a reference position. \param footprint_m  width of the averaged area
    CascadeSample at(double x_m, double z_m, float footprint_m) const;

   private:
    using Level = std::vector<glm::vec3>;  ///< Dx, height, Dz

    void add_level(CascadeSample& sum, float u, float v, int level, float weight) const;

    Cascade cascade_;
    std::vector<Level> levels_;
};

}  // namespace pelagic::tools
