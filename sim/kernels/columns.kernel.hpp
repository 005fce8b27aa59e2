#pragma once

#include <cstddef>

#include "sim/kernels/fft.kernel.hpp"
#include "sim/kernels/kernels.hpp"
#include "sim/wave_blocks.hpp"

namespace pelagic::kernels {

/// Spreads the half plane kz in [0, N/2) of W columns over the whole spectrum: `wave(n)` and `mirror(n)` give the
/// values at kz = n and -n; the Nyquist wave is none.
template <class Arch, class Wave, class Mirror>
inline void load_column(float* data, const FftTables& fft, Wave wave, Mirror mirror) {
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    const std::size_t size = static_cast<std::size_t>(fft.size);
    const xsimd::batch<float, Arch> zero(0.f);
    wave(std::size_t{0}).store(data + fft.positions[0] * element);
    Complex<Arch>{zero, zero}.store(data + fft.positions[size / 2] * element);
    for (std::size_t n = 1; n < size / 2; ++n) {
        wave(n).store(data + fft.positions[n] * element);
        mirror(n).store(data + fft.positions[size - n] * element);
    }
}

/// Real parts to one component of a surface block, imaginary parts to another; either may be null.
template <class Arch>
inline void store_column(const float* data, std::size_t size, float* real_to, float* imaginary_to) {
    for (std::size_t z = 0; z < size; ++z) {
        const auto value = Complex<Arch>::load(data + z * 2 * xsimd::batch<float, Arch>::size);
        value.re.store_aligned(real_to + z * surface_row_floats);
        if (imaginary_to) value.im.store_aligned(imaginary_to + z * surface_row_floats);
    }
}

/// The sideways pair of one column block: P above, conj(Q) below.
template <class Arch>
inline void sideways_columns(const float* lines, const FftTables& fft, float* surface, float* data) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t lane = 0; lane < lane_block; lane += V::size) {
        const auto part = [&](std::size_t n, std::size_t component) {
            return V::load_aligned(lines + n * wave_row_floats + component * lane_block + lane);
        };
        load_column<Arch>(
            data, fft,
            [&](std::size_t n) {
                return Complex<Arch>{part(n, p_re), part(n, p_im)};
            },
            [&](std::size_t n) {
                return Complex<Arch>{part(n, q_re), V(0.f) - part(n, q_im)};
            });
        inverse_fft<Arch>(data, fft);
        store_column<Arch>(data, static_cast<std::size_t>(fft.size), surface + surface_dx * lane_block + lane,
                           surface + surface_dz * lane_block + lane);
    }
}

/// The heights of two column blocks as a + i b. Both are real, so conj(a) + i conj(b) is the mirror; at kz = 0 their
/// imaginary parts are rounding errors and are dropped.
template <class Arch>
inline void height_columns(const ColumnsJob& job, float* data) {
    using V = xsimd::batch<float, Arch>;
    const FftTables& fft = *job.fft;
    for (std::size_t lane = 0; lane < lane_block; lane += V::size) {
        const auto part = [&](int block, std::size_t n, std::size_t component) {
            if (!job.lines[block]) return V(0.f);
            return V::load_aligned(job.lines[block] + n * wave_row_floats + component * lane_block + lane);
        };
        load_column<Arch>(
            data, fft,
            [&](std::size_t n) {
                const V a_re = part(0, n, height_re), b_re = part(1, n, height_re);
                if (n == 0) return Complex<Arch>{a_re, b_re};
                return Complex<Arch>{a_re - part(1, n, height_im), part(0, n, height_im) + b_re};
            },
            [&](std::size_t n) {
                return Complex<Arch>{part(0, n, height_re) + part(1, n, height_im),
                                     part(1, n, height_re) - part(0, n, height_im)};
            });
        inverse_fft<Arch>(data, fft);
        float* second = job.surface[1] ? job.surface[1] + surface_height * lane_block + lane : nullptr;
        store_column<Arch>(data, static_cast<std::size_t>(fft.size),
                           job.surface[0] + surface_height * lane_block + lane, second);
    }
}

template <class Arch>
void columns(const ColumnsJob& job) {
    FftWorkspace<Arch> workspace;
    for (int block = 0; block < 2; ++block)
        if (job.lines[block]) sideways_columns<Arch>(job.lines[block], *job.fft, job.surface[block], workspace.data);
    height_columns<Arch>(job, workspace.data);
}

}  // namespace pelagic::kernels
