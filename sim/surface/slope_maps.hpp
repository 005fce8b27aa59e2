// Stages `slopes+mipmaps` and `slopes tail` of a cascade: they compute the two maps of
// sim/slope_sum.hpp from its surface.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/slope_sum.hpp"
#include "pelagic/sim/surface/mipmaps.hpp"
#include "pelagic/sim/surface/texture_bands.hpp"
#include "pelagic/sim/texture_targets.hpp"

namespace pelagic {

/// Returns the slope that a byte step of the slope maps stands for.
inline float slope_step(const SlopeRanges& ranges) { return ranges.slope / 127.f; }

/// Input and output of the slope stages of a cascade. A view: it owns no memory.
struct SlopeMaps {
    /// Column blocks (wave_blocks.hpp); null for make_tail().
    const float* surface;
    int resolution;
    std::size_t block_stride;             ///< floats between column blocks
    double side_m;                        ///< side of the cascade
    double cosine = 1, sine = 0;          ///< rotation of the cascade's axes, see GradientsJob
    SlopeRanges ranges;                   ///< positive
    std::uint16_t* rgba16f;               ///< 4 N^2; null: not written
    PresentCompression compression = {};  ///< written with rgba16f
    TextureTargets::Chain slopes, moments;
    MipAverages* averages;  ///< with slope_planes planes

    /// Number of jobs of the first stage. Different jobs may run concurrently.
    std::size_t jobs() const;
    void make(const Kernels& kernels, std::size_t job) const;
    /// Replaces make() for the columns of a strip.
    void make_strip(const Kernels& kernels, const TextureStrip& strip) const;
    /// Runs the second stage. \pre make() has run for all jobs
    void make_tail(const Kernels& kernels) const;

   private:
    SlopesJob slopes_job() const;
    float slope_step() const { return pelagic::slope_step(ranges); }
    float variance_factor() const { return slope_step() * slope_step() / ranges.variance; }
};

}  // namespace pelagic
