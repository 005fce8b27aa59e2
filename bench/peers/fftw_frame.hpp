// The frame computed with FFTW, as an expert would write it: PATIENT plans, real fields as real
// transforms or two in one complex transform, everything else vectorised with Pelagic's own
// kernels. One thread.
//
// FFTW selects its code itself, regardless of the instruction set here; Debian's build supports
// SSE2 and AVX.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "pelagic/bench/peers/fftw_kernels.hpp"
#include "pelagic/bench/peers/peer_frame.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/surface/mipmaps.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic::peers {

/// Arrangement of the three real fields in FFTW transforms.
enum class FftwArrangement {
    packed,   ///< Dx + i Dz in one complex transform, the height in a real transform
    separate  ///< three real transforms
};

/// Source of FFTW's plans.
enum class FftwPlanning {
    measured,  ///< measured in this process: seconds to minutes
    read       ///< by read_fftw_plans(), for programs that count instructions and run slowly
};

/// Writes all plans that this process has measured, for another process. Throws std::runtime_error.
void write_fftw_plans(const std::string& file);
void read_fftw_plans(const std::string& file);

class FftwFrame {
   public:
    /// Plans and bakes. Throws std::runtime_error if plans that were read do not include this plan.
    /// \pre check(sea) is empty, runs_here(isa), N >= 2 lanes of isa
    FftwFrame(const SeaState& sea, Isa isa, FftwArrangement arrangement,
              FftwPlanning planning = FftwPlanning::measured);
    ~FftwFrame();

    /// Computes the frame at `time_s`, which must be finite. The result is valid until the next
    /// call. Never allocates.
    const PeerFrame& frame_at(double time_s);

    /// Sets the foam of breaking waves.
    void set_foam(const FoamSource& source) { foam_ = source; }

   private:
    struct Plans;

    void bake_spectrum();
    void evolve(std::uint32_t fraction);
    void gradients();
    float* plane(std::size_t component) { return planes_.data() + component * texels_; }

    SeaState sea_;
    FoamSource foam_{.offset = 255, .scale = 510};
    FftwArrangement arrangement_;
    const Kernels& kernels_;
    const FftwKernels& own_kernels_;
    std::size_t size_, texels_;
    AlignedBuffer<float> waves_;
    AlignedBuffer<std::uint32_t> harmonics_;
    AlignedBuffer<float> height_spectrum_;
    AlignedBuffer<float> horizontal_spectrum_, horizontal_;  ///< of the packed arrangement
    AlignedBuffer<float> dx_spectrum_, dz_spectrum_;         ///< of the separate arrangement
    AlignedBuffer<float> planes_;                            ///< dx, height, dz
    MipAverages mip_averages_;
    std::unique_ptr<Plans> plans_;
    AlignedBuffer<std::uint16_t> halves_;
    AlignedBuffer<std::uint32_t> bytes_;
    PlaneBounds bounds_{};
    PeerFrame frame_;
};

}  // namespace pelagic::peers
