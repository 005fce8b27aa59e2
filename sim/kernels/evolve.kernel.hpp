#pragma once

#include <cstddef>

#include "sim/kernels/kernels.hpp"
#include "sim/wave_blocks.hpp"
#include "simd/turns.kernel.hpp"

namespace pelagic::kernels {

template <class Arch>
void evolve(const EvolveJob& job) {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    const U fraction(job.fraction);
    const V zero(0.f);

    for (std::size_t p = 0; p < job.count; ++p) {
        const ModeRow& mode = job.modes[p];
        float* out = job.waves + p * wave_row_floats;
        for (std::size_t lane = 0; lane < lane_block; lane += V::size) {
            const auto [sine, cosine] = rotation_of_turns<Arch>(U::load_aligned(mode.harmonic + lane) * fraction);
            const V h_re = V::load_aligned(mode.cos_re + lane) * cosine + V::load_aligned(mode.sin_re + lane) * sine;
            const V h_im = V::load_aligned(mode.cos_im + lane) * cosine + V::load_aligned(mode.sin_im + lane) * sine;

            // i h = (-h_im, h_re); Dx = dir_x i h, Dz = dir_z i h, and P and Q are Dx +- i Dz. The minus is a
            // subtraction from 0: xsimd's unary one is that on AVX-512 only, so zeros would differ in sign.
            const V dir_x = V::load_aligned(mode.dir_x + lane);
            const V dir_z = V::load_aligned(mode.dir_z + lane);
            const V x_im = dir_x * h_im;
            const V x_re = dir_x * h_re;
            const V z_im = dir_z * h_im;
            const V z_re = dir_z * h_re;

            float* row = out + lane;
            h_re.store_aligned(row + height_re * lane_block);
            h_im.store_aligned(row + height_im * lane_block);
            (zero - (x_im + z_re)).store_aligned(row + p_re * lane_block);
            (x_re - z_im).store_aligned(row + p_im * lane_block);
            (z_re - x_im).store_aligned(row + q_re * lane_block);
            (x_re + z_im).store_aligned(row + q_im * lane_block);
        }
    }
}

}  // namespace pelagic::kernels
