"""A sea's spectrum, measured in two ways and compared with the requested spectrum: by buoys that
record the height of the water for a whole loop, and by a Fourier transform of one frame.

usage: measured_spectrum.py [OUT.png]
"""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import Tuple

import numpy as np
import pelagic
from numpy.typing import NDArray

Doubles = NDArray[np.float64]

#: Linear waves: with choppiness a buoy would measure sharpened crests, which are harmonics of the
#: peak.
SEA = pelagic.Sea(wind_speed_mps=12, fetch_m=100e3, choppiness=0, spreading="hasselmann", loop_period_s=400)

#: The same sea with a texel every 2 m. Interpolation between texels is linear, which
#: flattens waves of a few texels at arbitrary positions; each of four cascades has such waves.
SEA_OF_BUOYS = replace(SEA, patch_size_m=1000, resolution=512)


def spectrum_of_buoys(sea: pelagic.Sea, step_s: float = 0.4, buoys: int = 300) -> Tuple[Doubles, Doubles]:
    """Returns frequencies in Hz and the spectrum of heights in m^2/Hz, the mean over buoys at
    random positions."""
    places = np.random.default_rng(1).uniform(0, 1000, (buoys, 2))
    moments = round(sea.loop_period_s / step_s)
    heights = np.empty((moments, buoys))
    with pelagic.Ocean(sea) as ocean:
        for i in range(moments):
            heights[i] = ocean.frame_at(i * step_s).query(places, fields=["height"])["height"]
    # The loop ends where it begins, so a transform needs no window function. Negative frequencies
    # are added to positive ones.
    energy = 2 * np.abs(np.fft.rfft(heights, axis=0) / moments) ** 2
    frequencies = np.arange(1, moments // 2) / sea.loop_period_s
    return frequencies, energy[1:-1].mean(axis=1) * sea.loop_period_s


def spectrum_of_frame(sea: pelagic.Sea, time_s: float = 0) -> Tuple[Doubles, Doubles]:
    """Returns bands of wave numbers by their edges, rad/m, and the spectrum of heights in them,
    m^3, summed over all directions. Each cascade has a band of the waves."""
    edges = np.geomspace(0.01, 20, 80)
    energy = np.zeros(len(edges) - 1)
    with pelagic.Ocean(sea) as ocean:
        for cascade in ocean.frame_at(time_s).cascades:
            n = cascade.resolution
            k = 2 * np.pi * np.fft.fftfreq(n, cascade.patch_size_m / n)
            variances = np.abs(np.fft.fft2(cascade.height) / n**2) ** 2
            energy += np.histogram(np.hypot(k, k[:, None]), edges, weights=variances)[0]
    return edges, energy / np.diff(edges)


def main(out: str) -> None:
    import matplotlib  # type: ignore[import]

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt  # type: ignore[import]

    def title(variance: float) -> str:
        return f"Hs {4 * np.sqrt(variance):.2f} m, asked for {SEA.report().significant_wave_height_m:.2f} m"

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    frequencies, measured = spectrum_of_buoys(SEA_OF_BUOYS)
    seen = frequencies < 0.5
    left.plot(frequencies[seen], measured[seen], color="tab:blue", linewidth=1, label="300 buoys, one loop")
    left.plot(frequencies[seen], SEA.energy_by_frequency(frequencies[seen]), color="black", linestyle="--", label="JONSWAP")
    left.set(xlabel="frequency (Hz)", ylabel="m²/Hz", title=title(measured.sum() / SEA.loop_period_s))
    left.legend()

    edges, measured = spectrum_of_frame(SEA)
    wave_numbers = np.sqrt(edges[1:] * edges[:-1])
    right.loglog(wave_numbers, np.where(measured > 0, measured, np.nan), color="tab:blue", marker=".", linewidth=1, label="one frame, all cascades")
    right.loglog(wave_numbers, SEA.energy_by_wave_number(wave_numbers), color="black", linestyle="--", label="JONSWAP")
    right.set(xlabel="wave number (rad/m)", ylabel="m³", title=title((measured * np.diff(edges)).sum()), ylim=(1e-9, 1e3))
    right.legend()
    figure.savefig(out, dpi=90)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "measured_spectrum.png")
