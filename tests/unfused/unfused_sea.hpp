// The stages of a frame one after the other, each over the whole sea, one float at a time: without
// SIMD registers, blocks, fusing and threads. The operations are those of the kernels in equal
// order, so results must be bit-identical.
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/kernels/fft_plan.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic::unfused {

struct Complex {
    float re = 0, im = 0;
};

class UnfusedSea {
   public:
    /// Bakes the spectrum. \pre check(sea) is empty
    explicit UnfusedSea(const SeaState& sea);

    /// Computes a frame, which is valid until the next call.
    const Frame& frame_at(double time_s);

   private:
    struct Wave {
        float cos_re, cos_im, sin_re, sin_im;  ///< S'
        float direction_x, direction_z, lean_tangent;
        std::uint32_t harmonic;
    };
    /// Row n holds kz = n, by kx at first and by x later: N/2 rows of N.
    struct Field {
        std::vector<Complex> h, p, r;
    };
    /// Values that mipmaps average.
    struct Average {
        float n_x, n_y, n_z, jacobian;
    };

    void spectrum();
    void evolve(std::uint32_t fraction);
    void rows();
    void columns();
    void finalize();
    void gradients();
    void mipmaps();

    std::size_t at(std::size_t x, std::size_t row) const { return row * n_ + x; }

    SeaState sea_;
    std::size_t n_;
    FftPlan plan_;
    std::vector<Wave> waves_;
    float level_m_ = 0;  ///< Cascade::level_m
    Field fields_;
    std::vector<float> dx_, height_, dz_;
    std::vector<std::uint16_t> halves_;
    std::vector<std::uint32_t> texels_;
    std::vector<Average> averages_;  ///< averages of the finest level not computed yet
    Cascade cascade_;
    Frame frame_;
};

/// Sine and cosine of phase / 2^32 turns, as the stage `evolve` computes them.
struct Rotation {
    float sine, cosine;
};
Rotation rotation_of_turns(std::uint32_t phase);

}  // namespace pelagic::unfused
