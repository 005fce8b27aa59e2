"""Shared by the tests of the Python package: the native command, and the seas of the golden hashes.
"""

import os
import subprocess
from pathlib import Path

import pelagic
import pytest

SOURCE = Path(__file__).resolve().parents[2]
GOLDEN = dict(line.split() for line in (SOURCE / "tests/golden/hashes.txt").read_text().splitlines())


def run_pelagic(*arguments, given=None):
    """Returns the output of the command, whose path is in the environment variable PELAGIC."""
    done = subprocess.run([os.environ["PELAGIC"], *map(str, arguments)], input=given, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def golden_seas():
    one_cascade = {"resolution": 64, "patch_size_m": 250}
    seas = {"default": pelagic.Sea()}
    for spectrum in ("phillips-paper", "phillips", "pierson-moskowitz", "jonswap"):
        seas[f"{spectrum}-64"] = pelagic.Sea(**one_cascade, spectrum=spectrum)
    for spreading in ("cosine-2s", "hasselmann", "donelan-banner"):
        seas[f"spreading-{spreading}-64"] = pelagic.Sea(**one_cascade, spreading=spreading)
    seas["shallow-64"] = pelagic.Sea(**one_cascade, depth_m=8)
    seas["breaking-swell-64"] = pelagic.Sea(**one_cascade, depth_m=2, swell_height_m=1, swell_direction_rad=2)
    seas["analytic-64"] = pelagic.Sea(waves="analytic", resolution=64, choppiness=1)
    seas["pond-64"] = pelagic.Sea(waves="pond", resolution=64)
    seas["short-wave-cutoff-64"] = pelagic.Sea(**one_cascade, short_wave_cutoff=0.8)
    for name in ("calm", "moderate", "rough", "storm"):
        seas[f"preset-{name}"] = pelagic.preset(name)
    return seas


@pytest.fixture
def small():
    """Returns a sea whose frames are fast to compute."""
    return pelagic.Sea(resolution=64, patch_size_m=250)
