"""Frames have the golden hashes of seas, with all options and presets."""

import json

import numpy as np
import pelagic
import pytest
from conftest import GOLDEN, golden_seas, run_pelagic

TIMES = {"0": 0.0, "12.34": 12.34}


@pytest.mark.parametrize("options", [{}, {"threads": 1}, {"threads": 3}, {"velocities": True, "foam": True, "gradients": True, "slopes": True},
                                     {"queries": False}, *({"isa": isa} for isa in pelagic.isas_here())], ids=str)
def test_frames_have_the_golden_hashes(options):
    seen = {}
    for name, sea in golden_seas().items():
        with pelagic.Ocean(sea, **options) as ocean:
            for text, time_s in TIMES.items():
                seen[f"{name}@{text}"] = ocean.frame_at(time_s).hash
    assert seen == {name: int(GOLDEN[name], 16) for name in seen}
    # All hashes, except those of queries and of foam.
    assert {name for name in GOLDEN if name not in seen} == {
        "foam-folded", "foam-cascades", "queries-analytic", "queries-pond", "queries-folded", "queries-smooth", "queries-cascades"}


def test_foam_has_the_golden_hash():
    with pelagic.Ocean(pelagic.Sea(cascades=4, resolution=64, choppiness=1), foam=True) as ocean:
        assert ocean.frame_at(12.34).foam_hash == int(GOLDEN["foam-cascades"], 16)


@pytest.mark.parametrize("name", ["lake", "storm", "analytic-moderate", "pond", "beaufort-7"])
def test_presets_are_those_of_the_command(name):
    said = json.loads(run_pelagic("info", "--json", "--preset", name))
    with pelagic.Ocean(pelagic.preset(name)) as ocean:
        frame = ocean.frame_at(0)
        assert f"{frame.hash:016x}" == said["first_frame"]["hash"]
        assert np.float32(frame.bounds.height_max_m) == np.float32(said["first_frame"]["height_max_m"])
    report = pelagic.preset(name).report()
    assert report.significant_wave_height_m == pytest.approx(said["waves"]["significant_wave_height_m"]["expected"], rel=1e-12)


def test_an_ocean_without_planes_has_bit_identical_textures():
    sea = pelagic.Sea(resolution=64)
    with pelagic.Ocean(sea) as ocean, pelagic.Ocean(sea, queries=False, planes=False) as textures:
        expected, frame = ocean.frame_at(2), textures.frame_at(2)
        for one, other in zip(expected.cascades, frame.cascades, strict=True):
            assert one.displacement.tobytes() == other.displacement.tobytes()
            assert one.slopes.tobytes() == other.slopes.tobytes()
        refused = {
            "the frame does not have it: create the ocean with planes=True": lambda: frame.cascades[0].height,
            "the frame has no planes: create the ocean with planes=True": lambda: frame.displaced([[0, 0]]),
            "wave heights cannot be measured in a frame without planes": lambda: frame.measured_significant_wave_height_m(),
            "queries cannot be combined with an ocean without planes": lambda: pelagic.Ocean(sea, planes=False),
        }
        for line, ask in refused.items():
            with pytest.raises(ValueError) as error:
                ask()
            assert str(error.value) == line
