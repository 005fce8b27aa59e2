"""The example measures the spectrum of its sea."""

import sys

import numpy as np
import pytest
from conftest import SOURCE

sys.path.insert(0, str(SOURCE / "python/examples"))
import measured_spectrum as example  # noqa: E402


def test_buoys_measure_the_drawn_waves():
    frequencies, measured = example.spectrum_of_buoys(example.SEA_OF_BUOYS)
    height_m = 4 * np.sqrt(measured.sum() / example.SEA.loop_period_s)
    assert height_m == pytest.approx(example.SEA_OF_BUOYS.report().realised_significant_wave_height_m, rel=0.03)
    asked = example.SEA.energy_by_frequency(frequencies)
    for low, high in ((0.1, 0.12), (0.12, 0.15), (0.15, 0.2), (0.2, 0.3)):
        band = (frequencies >= low) & (frequencies < high)
        # one draw of some hundred waves
        assert measured[band].sum() == pytest.approx(asked[band].sum(), rel=0.2)


def test_a_frame_has_the_spectrum_of_its_sea():
    edges, measured = example.spectrum_of_frame(example.SEA)
    widths = np.diff(edges)
    assert 4 * np.sqrt((measured * widths).sum()) == pytest.approx(example.SEA.report().realised_significant_wave_height_m, rel=0.03)
    middles = np.sqrt(edges[1:] * edges[:-1])
    asked = example.SEA.energy_by_wave_number(middles)
    for low, high in ((0.05, 0.1), (0.1, 0.3), (0.3, 1), (1, 3), (3, 10)):
        band = (middles >= low) & (middles < high)
        assert (measured * widths)[band].sum() == pytest.approx((asked * widths)[band].sum(), rel=0.15)


def test_it_draws_an_image(tmp_path):
    example.main(str(tmp_path / "spectrum.png"))
    assert (tmp_path / "spectrum.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
