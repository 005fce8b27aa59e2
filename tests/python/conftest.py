"""Shared by the tests of the Python package: the native command, golden values and their seas."""

import ast
import inspect
import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pelagic
import pytest
from pelagic import _native

SOURCE = Path(__file__).resolve().parents[2]
GOLDEN = dict(line.split() for line in (SOURCE / "tests/golden/hashes.txt").read_text().splitlines())

# The scene of tests/golden_values_test.cpp.
SMALL_SEA = pelagic.Sea(cascades=3, resolution=32, wind_speed_mps=8, loop_period_s=40)
BOX = [(x, y, z) for x in (-2, 2) for y in (-0.5, 0.5) for z in (-1, 1)]
BOX_TRIANGLES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def bay():
    """Returns a beach with an island in front of it."""
    z, x = 5.0 * np.mgrid[:61, :81]
    squared = ((x - 150) ** 2 + (z - 120) ** 2) / 1600
    heights_m = (-12 + x * 0.035 + 16 / (1 + squared * squared)).astype(np.float32)
    return pelagic.ShoreOptions(heights_m, metres_per_sample=5, corner_x_m=-170, corner_z_m=-130, resolution=64)


def golden_rows(kind):
    """Returns the rows of tests/golden/values.txt by name."""
    rows = (line.split(" ", 2) for line in (SOURCE / "tests/golden/values.txt").read_text().splitlines())
    return {name: numbers for of, name, numbers in rows if of == kind}


def docstrings_of_fields(cls):
    body = ast.parse(inspect.getsource(cls)).body[0].body
    return {field.target.id: text.value.value for field, text in zip(body, body[1:])
            if isinstance(field, ast.AnnAssign) and isinstance(text, ast.Expr)}


def defaults_of_library(type_):
    """Returns the numbers that pelagic.h sets in a struct."""
    struct = _native.make(type_)
    return {name: getattr(struct, name) for name, *_ in type_._fields_}


def accepted_by_library(create, name, default):
    """Returns the range of a field, which the library's message about another value has."""
    with pytest.raises(ValueError) as refused:
        create(**{name: float("nan") if isinstance(default, float) else -2**31})
    return re.split(r" is out of range |, expected ", str(refused.value), 1)[1]


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
    for spreading in ("paper", "cosine-2s", "hasselmann"):
        seas[f"spreading-{spreading}-64"] = pelagic.Sea(**one_cascade, spreading=spreading)
    seas["shallow-64"] = pelagic.Sea(**one_cascade, depth_m=8)
    seas["breaking-swell-64"] = pelagic.Sea(**one_cascade, depth_m=2, swell_height_m=1, swell_direction_rad=2)
    seas["analytic-64"] = pelagic.Sea(waves="analytic", resolution=64, choppiness=1)
    seas["pond-64"] = pelagic.Sea(waves="pond", resolution=64)
    systems = (pelagic.WaveSystem(height_m=1.2, peak_period_s=12, direction_rad=2, spread_rad=0.26),
               pelagic.WaveSystem(spreading="hasselmann", wind_speed_mps=8, fetch_m=30e3, direction_rad=-1),
               pelagic.WaveSystem(spectrum="pierson-moskowitz", height_m=0.5))
    seas["systems"] = pelagic.Sea(systems=systems)
    seas["systems-64"] = pelagic.Sea(spectrum="none", resolution=64, patch_size_m=900, depth_m=20, systems=systems)
    seas["short-wave-cutoff-64"] = pelagic.Sea(**one_cascade, short_wave_cutoff=0.8)
    seas["none-64"] = pelagic.Sea(**one_cascade, spectrum="none", swell_height_m=2)
    seas["wind-sea-by-height"] = pelagic.Sea(wave_height_m=2, peak_period_s=7)
    for name in ("calm", "moderate", "rough", "storm"):
        seas[f"preset-{name}"] = pelagic.preset(name)
    return seas


@pytest.fixture
def small():
    """Returns a sea whose frames are fast to compute."""
    return pelagic.Sea(resolution=64, patch_size_m=250)
