// VR Ocean's frame, implemented from the paper, sections 3.4 to 3.9, in plain scalar C++.
//
// The stages of its table 1, one item at a time on the calling thread: all N^2 waves evolve in a
// centred spectrum; three full complex transforms, rows then columns, radix 2, with twiddles
// computed in every butterfly (section 3.6.3); sign correction; gradients by central differences; a
// chain of mipmaps. Only errata that give a wrong sea are corrected (docs/errata.md): the
// transform's sign, the full normal, the sign in equation 49, mipmaps from floats, and rounded
// frequencies. Amplitudes, frequencies and time are Pelagic's, so both compute the same sea.
//
// The paper's sine and cosine are one intrinsic that its compiler inlines at reduced precision;
// here it is a polynomial. There are no SIMD intrinsics; the optimiser may vectorise the loops.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/bench/peers/peer_frame.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic::peers {

namespace paper {

struct Complex {
    float re, im;
};

/// The paper's four-component displacement: Dx and Dz as complex numbers.
struct Horizontal {
    Complex x, z;
};

/// S' of equation 22: two complex factors, of the cosine and of the sine.
struct PackedWave {
    Complex of_cosine, of_sine;
};

/// A texel of the mip chain before packing: the scaled normal and the clamped Jacobian.
struct GradientTexel {
    float n_x, n_y, n_z, jacobian;
};

/// Both spectra, later both surfaces, N * N each.
struct Fields {
    std::vector<Complex> height;
    std::vector<Horizontal> horizontal;
};

struct Outputs {
    std::vector<float> dx, height, dz;
    std::vector<std::uint16_t> rgba16f;
    std::vector<std::uint32_t> rgba8;
};

}  // namespace paper

class PaperFrame {
   public:
    /// Bakes the spectrum and allocates all memory. \pre check(sea) is empty
    explicit PaperFrame(const SeaState& sea);

    /// Computes the frame at `time_s`, which must be finite. The result is valid until the next
    /// call. Never allocates.
    const PeerFrame& frame_at(double time_s);

   private:
    void bake_spectrum();
    void evolve(std::uint32_t index);
    void horizontal_pass(std::uint32_t row);
    void vertical_pass(std::uint32_t column);
    void finalize(std::uint32_t index);
    void gradient(std::uint32_t index);
    void halve(int level, std::uint32_t index);

    SeaState sea_;
    std::uint32_t resolution_;
    int log_resolution_;
    float choppiness_;
    float half_texels_per_metre_;
    float normal_length_;
    float smoothness_;
    std::uint32_t turns_ = 0;  ///< LoopFraction of the current frame

    std::vector<paper::PackedWave> initial_amplitudes_;
    std::vector<std::uint32_t> harmonics_;
    std::vector<float> orbit_ratios_;  ///< not in the paper, which is for deep water only
    paper::Fields a_, b_;              ///< figure 4: evolve writes A, rows A to B, columns B to A
    std::vector<paper::GradientTexel> chain_;
    paper::Outputs outputs_;
    PeerFrame frame_;  ///< views of outputs_
};

}  // namespace pelagic::peers
