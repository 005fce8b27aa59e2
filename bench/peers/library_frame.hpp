// A frame computed with an FFT library, as an expert would write it: real fields as real transforms
// or two in one complex transform, everything else vectorised with Pelagic's own kernels. One
// thread. Outputs are textures; planes are intermediate results.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/bench/peers/fftw_kernels.hpp"
#include "pelagic/bench/peers/peer_frame.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/surface/mipmaps.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic::peers {

/// Arrangement of the three real fields in transforms.
enum class FieldArrangement {
    packed,   ///< Dx + i Dz in one complex transform, the height in a real transform
    separate  ///< three real transforms
};

class LibraryFrame {
   public:
    virtual ~LibraryFrame() = default;
    LibraryFrame(const LibraryFrame&) = delete;
    LibraryFrame& operator=(const LibraryFrame&) = delete;

    /// Computes the frame at `time_s`, which must be finite. The result is valid until the next
    /// call. Never allocates, unless the library does.
    const PeerFrame& frame_at(double time_s);

   protected:
    /// Allocates and bakes. \pre check(sea) is empty, runs_here(isa), N >= 2 lanes of isa
    LibraryFrame(const SeaState& sea, Isa isa, FieldArrangement arrangement);

    /// Transforms the spectra to planes or, if packed, the horizontal pair to `horizontal_`.
    virtual void transform() = 0;
    /// Sets all spectra to 0, for libraries that write to the arrays when they plan.
    void clear_spectra();
    float* plane(std::size_t component) { return planes_.data() + component * texels_; }

    FieldArrangement arrangement_;
    std::size_t size_, texels_;
    AlignedBuffer<float> height_spectrum_;                   ///< N rows of N/2 + 1 complex numbers
    AlignedBuffer<float> horizontal_spectrum_, horizontal_;  ///< packed: N x N complex numbers
    AlignedBuffer<float> dx_spectrum_, dz_spectrum_;         ///< separate: like the height's

   private:
    void bake_spectrum();
    void evolve(std::uint32_t fraction);
    void gradients();

    AlignedBuffer<float> planes_;  ///< dx, height, dz
    SeaState sea_;
    const Kernels& kernels_;
    const FftwKernels& own_kernels_;
    AlignedBuffer<float> waves_;
    AlignedBuffer<std::uint32_t> harmonics_;
    MipAverages mip_averages_;
    AlignedBuffer<std::uint16_t> halves_;
    AlignedBuffer<std::uint32_t> bytes_;
    FrameBounds bounds_{};
    PeerFrame frame_;
};

}  // namespace pelagic::peers
