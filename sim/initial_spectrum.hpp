// Stage `spectrum`: the waves at t = 0, packed so that moving them in time is one rotation (VR Ocean, 3.2.5 to 3.4.3).
//
// With h0(k) = a + ib and conj(h0(-k)) = c + id, equation 22 packs S' = (a + c, b + d, b - d, c - a), and
//   h(k, t) = S'_xy cos(phase) + S'_zw sin(phase) = h0(k) e^{-i phase} + conj(h0(-k)) e^{+i phase}.
// Only kz in [0, N/2) is kept: the other half plane is its mirror, because the sea is real.
#pragma once

#include <complex>
#include <cstddef>

#include "sim/sea_state.hpp"
#include "sim/spectra.hpp"
#include "sim/wave_blocks.hpp"
#include "simd/aligned_buffer.hpp"

namespace pelagic {

/// The packed half plane: row p of block b is modes[b * N + p], p in FFT order (kx = p, or p - N from N/2 on).
struct PackedSpectrum {
    explicit PackedSpectrum(int n) : resolution(n), modes(line_blocks(n) * static_cast<std::size_t>(n)) {}

    int resolution;
    AlignedBuffer<ModeRow> modes;
};

/// h0 of the wave numbers (m, n), metres (VR Ocean, equation 13). Zero at DC (equation 14), and on the Nyquist row
/// and column: the partner -k of such a wave is itself on the grid, so it can't be told which way it runs.
std::complex<double> initial_amplitude(const SeaState& sea, const WaveSpectrum& spectrum, int m, int n);

/// Fills one line, 0 <= line < line_count(). Lines are independent.
void bake_spectrum_line(const SeaState& sea, const WaveSpectrum& spectrum, std::size_t line, PackedSpectrum& out);

}  // namespace pelagic
