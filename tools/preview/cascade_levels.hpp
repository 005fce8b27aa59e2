// A cascade's displacement, slopes and foam at any place and any fineness, for images: levels like a texture's, read trilinearly.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "pelagic/sim/cascade.hpp"

namespace pelagic::tools {

struct CascadeSample {
    glm::vec3 displacement{0};  ///< Dx, height, Dz, metres
    float foam = 0;             ///< 0 none to 1 covered
    SurfaceSlopes slopes;       ///< without cov_xz
};

class CascadeLevels {
   public:
    /// Copies what it needs but for the slopes: the cascade's views stay valid until the last at(). \pre it has slopes and foam
    void take(const Cascade& cascade);

    /// The mean around a reference point. \param footprint_m  the width of what is asked about
    CascadeSample at(double x_m, double z_m, float footprint_m) const;

   private:
    using Level = std::vector<glm::vec4>;  ///< Dx, height, Dz, foam

    void add_level(CascadeSample& sum, float u, float v, int level, float weight) const;

    Cascade cascade_;
    std::vector<Level> levels_;
};

}  // namespace pelagic::tools
