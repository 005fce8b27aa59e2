"""Names, defaults, docstrings and error messages, compared with the C interface."""

import dataclasses
import inspect
import re
from pathlib import Path

import numpy as np
import pelagic
import pytest
from conftest import accepted_by_library, defaults_of_library, docstrings_of_fields
from pelagic import _native, _structs

PACKAGE = Path(pelagic.__file__).parent
CLASSES = ("Bodies", "Bounds", "Cascade", "DynamicWaves", "DynamicWavesView", "ExactWater", "Frame", "GerstnerInput", "Hull", "HullState", "Ocean",
           "RippleInput", "ShoreSurface", "WaveInput")


def test_a_sea_has_the_fields_and_defaults_of_the_library():
    here = {field.name: field.default for field in dataclasses.fields(pelagic.Sea)}
    assert {name: here.pop(name) for name in ("waves", "spectrum", "spreading")} == {
        "waves": "spectrum", "spectrum": "jonswap", "spreading": "donelan-banner"}
    assert here.pop("systems") == ()
    there = defaults_of_library(_native.pelagic_sea)
    assert here == {name: there[name] for name in here}


def test_a_wave_system_has_the_defaults_of_the_library():
    here = {field.name: field.default for field in dataclasses.fields(pelagic.WaveSystem)}
    assert (here.pop("spectrum"), here.pop("spreading")) == ("jonswap", "donelan-banner")
    there = defaults_of_library(_native.pelagic_wave_system)
    assert here == {name: there[name] for name in here}


def test_the_systems_of_a_sea_are_any_sequence_of_at_most_eight():
    system = pelagic.WaveSystem(height_m=2, spreading="hasselmann", direction_rad=1)
    struct = _native.sized(_native.pelagic_sea, systems=(_structs.struct_of(_native.pelagic_wave_system, system),) * 2, system_count=2)
    assert pelagic.Sea._of_library(struct).systems == (system, system)
    assert pelagic.Sea(systems=[]) == pelagic.Sea()
    for error, line, make in (
            (ValueError, "height_m -1 is out of range (0, 30], or 0: by the wind", lambda: pelagic.WaveSystem(height_m=-1)),
            (ValueError, "spectrum is chop, expected phillips-paper, phillips, pierson-moskowitz, jonswap or none", lambda: pelagic.WaveSystem(spectrum="chop")),
            (ValueError, "systems has 9 elements, expected 0 to 8", lambda: pelagic.Sea(systems=[system] * 9)),
            (TypeError, "systems is 3, expected a sequence of pelagic.WaveSystem", lambda: pelagic.Sea(systems=3)),
            (TypeError, "systems[1] is 3, expected a pelagic.WaveSystem", lambda: pelagic.Sea(systems=[system, 3]))):
        with pytest.raises(error) as refused:
            make()
        assert str(refused.value) == line


def test_a_hull_has_the_defaults_of_the_library():
    here = {name: parameter.default for name, parameter in inspect.signature(pelagic.Hull).parameters.items()
            if isinstance(parameter.default, float)}
    assert len(here) == 11
    there = defaults_of_library(_native.pelagic_hull_options)
    assert here == {name: there[name] for name in here}


def test_each_field_documents_its_range():
    docs = docstrings_of_fields(pelagic.Sea)
    assert set(docs) == {field.name for field in dataclasses.fields(pelagic.Sea)}
    named_differently = {"swell_spread_rad"}
    found = 0
    for field in dataclasses.fields(pelagic.Sea):
        if isinstance(field.default, (str, tuple)) or field.name in named_differently:
            continue
        interval = re.search(r"[\[(]-?[\d.].*?[\])]", accepted_by_library(pelagic.Sea, field.name, field.default))
        if interval:
            assert interval.group() in docs[field.name], field.name
            found += 1
    assert found > 15


def test_presets_are_seas_with_a_line_about_each():
    assert list(pelagic.presets)[:3] == ["pond", "calm", "lake"] and len(pelagic.presets) == 23
    assert list(pelagic.preset_summaries) == list(pelagic.presets)
    assert all(pelagic.preset_summaries.values())
    assert pelagic.preset("rough") is pelagic.presets["rough"]
    with pytest.raises(TypeError):
        pelagic.presets["rough"] = pelagic.Sea()
    with pytest.raises(dataclasses.FrozenInstanceError):
        pelagic.preset("rough").seed = 2
    assert dataclasses.replace(pelagic.preset("rough"), seed=2) != pelagic.preset("rough")


def test_everything_has_a_docstring():
    for cls in (getattr(pelagic, name) for name in CLASSES):
        assert cls.__doc__
        for name, value in vars(cls).items():
            if not name.startswith("_"):
                assert value.__doc__, name


def test_the_package_is_typed_and_has_the_projects_version():
    header = (Path(__file__).resolve().parents[2] / "capi/pelagic.h").read_text()
    assert pelagic.__version__ == ".".join(re.findall(r"^#define PELAGIC_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", header, re.MULTILINE))
    assert (PACKAGE / "py.typed").exists()


@pytest.mark.parametrize("bad, kind, line", [
    ({"wind_speed_mps": -3}, ValueError, "wind_speed_mps -3 is out of range (0, 60]"),
    ({"wind_speed_mps": float("nan")}, ValueError, "wind_speed_mps nan is out of range (0, 60]"),
    ({"wind_speed_mps": float("inf")}, ValueError, "wind_speed_mps inf is out of range (0, 60]"),
    ({"wind_speed_mps": "9"}, TypeError, "wind_speed_mps is '9', expected a number"),
    ({"wind_speed_mps": None}, TypeError, "wind_speed_mps is None, expected a number"),
    ({"wind_speed_mps": True}, TypeError, "wind_speed_mps is True, expected a number"),
    ({"resolution": 100}, ValueError, "resolution is 100, expected a power of two from 16 to 2048, or 0: chosen"),
    ({"resolution": 64.5}, TypeError, "resolution is 64.5, expected a whole number"),
    ({"resolution": 64.0}, TypeError, "resolution is 64.0, expected a whole number"),
    ({"seed": -1}, ValueError, "seed is -1, expected a whole number from 0 to 4294967295"),
    ({"seed": 2**32}, ValueError, "seed is 4294967296, expected a whole number from 0 to 4294967295"),
    ({"seed": 10**400}, ValueError, "seed is 1000"),
    ({"spectrum": "jonswop"}, ValueError, "spectrum is jonswop, expected phillips-paper, phillips, pierson-moskowitz, jonswap or none (the nearest is jonswap)"),
    ({"spectrum": 3}, TypeError, "spectrum is 3, expected a name: phillips-paper, phillips, pierson-moskowitz, jonswap or none"),
    ({"waves": "ponds"}, ValueError, "waves is ponds, expected spectrum, analytic, pond or regular (the nearest is pond)"),
    ({"spreading": "\n\x1b[31m"}, ValueError, r"spreading is \n\x1b[31m, expected paper, cosine-2s, hasselmann or donelan-banner"),
    ({"cascades": 3, "patch_size_m": 100}, ValueError, "cascades is 3, expected 1 where the side of the cascade is given"),
], ids=str)
def test_an_invalid_sea_raises_a_one_line_error(bad, kind, line):
    with pytest.raises(kind) as refused:
        pelagic.Sea(**bad)
    said = str(refused.value)
    assert said.startswith(line) and "\n" not in said and len(said) < 300


def test_numpy_scalars_are_accepted():
    sea = pelagic.Sea(wind_speed_mps=np.float32(9.5), resolution=np.int64(64), seed=np.uint32(4294967295), patch_size_m=250)
    with pelagic.Ocean(sea) as ocean, pelagic.Ocean(pelagic.Sea(wind_speed_mps=9.5, resolution=64, seed=4294967295, patch_size_m=250.0)) as same:
        assert ocean.frame_at(1).hash == same.frame_at(1).hash


def test_invalid_arguments_raise_a_one_line_error(small):
    with pytest.raises(ValueError, match=r"^preset is strom, expected pond, .* or beaufort-12 \(the nearest is storm\)$"):
        pelagic.preset("strom")
    with pytest.raises(ValueError, match=r" or beaufort-12$"):
        pelagic.preset("quiet night")
    with pytest.raises(TypeError, match=r'^sea is \'rough\', expected a pelagic.Sea, such as pelagic.preset\("rough"\)$'):
        pelagic.Ocean("rough")
    with pytest.raises(ValueError, match=r"^threads is 2000, expected "):
        pelagic.Ocean(small, threads=2000)
    with pytest.raises(ValueError, match=r"^isa is avx9, expected sse4.2, avx2, avx512 or neon$"):
        pelagic.Ocean(small, isa="avx9")
    with pelagic.Ocean(small, queries=False) as ocean, pytest.raises(ValueError, match="queries"):
        ocean.frame_at(0).query([[0, 0]])
    cases = {
        "points.shape is (2, 3), expected (..., 2): x and z of each point": lambda frame: frame.query([[0, 0, 0], [1, 1, 1]]),
        "points.shape is (), expected (..., 2): x and z of each point": lambda frame: frame.query(3.0),
        "points can't be made an array of numbers": lambda frame: frame.query([["a", "b"]]),
        "z can't be made an array of numbers": lambda frame: frame.query([1.0], "south"),
        "fields is depth, expected height, normal, jacobian, velocity, foam, converged or error": lambda frame: frame.query([[0, 0]], fields=["depth"]),
        "interpolation is quintic, expected linear or cubic": lambda frame: frame.query([[0, 0]], interpolation="quintic"),
        "tolerance_m 0 is out of range [1e-6, 1000]": lambda frame: frame.query([[0, 0]], tolerance_m=0),
        "ray 1: reach_m is nan, expected ": lambda frame: frame.rays([0, 9, 0], [0, -1, 0], [1.0, np.nan]),
        "ray 0: ": lambda frame: frame.rays([0, 9, 0], [0, 0, 0], 1.0),
        "directions.shape is (2,), expected (..., 3): x, y and z of each ray": lambda frame: frame.rays([0, 9, 0], [0, 0], 1.0),
        "point 1: a coordinate nan is out of range [-1e9, 1e9]": lambda frame: frame.displaced([[0, 0], [np.nan, 0]]),
        "the frame has no foam: create the ocean with foam=True": lambda frame: frame.foam_hash,
        "level is 7, expected 0 to 6": lambda frame: frame.cascades[0].gradient_level(7),
        "the frame does not have it: create the ocean with velocities=True": lambda frame: frame.cascades[0].velocity_y,
        "the frame does not have it: create the ocean with slopes=True": lambda frame: frame.cascades[0].slopes,
    }
    with pelagic.Ocean(small) as ocean:
        frame = ocean.frame_at(0)
        for line, ask in cases.items():
            with pytest.raises(ValueError) as refused:
                ask(frame)
            assert str(refused.value).startswith(line) and "\n" not in str(refused.value)
        for name in ("velocity", "foam"):
            with pytest.raises(ValueError, match=name.rstrip("y")):
                frame.query([[0, 0]], fields=[name])
        with pytest.raises(TypeError, match=r"^fields is 'height', expected a list of names$"):
            frame.query([[0, 0]], fields="height")
        with pytest.raises(ValueError, match="time_s is nan, expected a finite number"):
            ocean.frame_at(float("nan"))
        with pytest.raises(ValueError, match="over_s"):
            ocean.schedule_sea(small, 10, 0)
        assert ocean.frame_at(1).hash  # none of the errors had an effect


def test_arguments_of_a_wrong_type_are_named(small):
    with pelagic.Ocean(small) as ocean:
        frame = ocean.frame_at(0)
        for line, call in {
            "Ocean() needs sea": lambda: pelagic.Ocean(),
            "Ocean() has no argument query (the nearest is queries)": lambda: pelagic.Ocean(small, query=True),
            "Ocean() needs sea, and has no argument see (the nearest is sea)": lambda: pelagic.Ocean(see=small),
            "Sea() has no argument wind_speed (the nearest is wind_speed_mps)": lambda: pelagic.Sea(wind_speed=9),
            "Sea() has no argument xyz": lambda: pelagic.Sea(xyz=9),
            "frame_at() needs time_s": lambda: ocean.frame_at(),
            "frame_at() takes at most 1 without a name": lambda: ocean.frame_at(1, 2),
            "schedule_sea() needs from_s and over_s": lambda: ocean.schedule_sea(small),
            "query() needs points, and has no argument pionts (the nearest is points)": lambda: frame.query(pionts=[[0, 0]]),
            "query() is given points twice": lambda: frame.query([[0, 0]], points=[[0, 0]]),
            "series() needs times": lambda: ocean.series([[0, 0]]),
        }.items():
            with pytest.raises(TypeError) as refused:
                call()
            assert str(refused.value) == line and refused.value.__context__ is None


def test_signatures_are_those_of_the_methods():
    assert list(inspect.signature(pelagic.Ocean).parameters)[:2] == ["sea", "queries"]
    assert [str(parameter) for parameter in inspect.signature(pelagic.Ocean.schedule_sea).parameters.values()] == [
        "self", "sea: 'Sea'", "from_s: 'float'", "over_s: 'float'", "swell_from_m: 'float' = 0.0"]


def test_the_package_has_no_other_names():
    assert {name for name in dir(pelagic) if not name.startswith("_")} == set(pelagic.__all__)


def test_an_ocean_has_the_properties_of_its_options():
    with pelagic.Ocean(pelagic.Sea(resolution=32)) as ocean:
        threads = min(3, ocean.threads)  # no more than CPUs
    for isa in pelagic.isas_here():
        with pelagic.Ocean(pelagic.Sea(cascades=3, resolution=32), threads=3, isa=isa) as ocean:
            assert (ocean.threads, ocean.isa, ocean.resolution, ocean.cascade_count) == (threads, isa, 32, 3)
            assert len(ocean.frame_at(0).cascades) == 3 and ocean.memory_bytes > 3 * 32 * 32 * 8
            assert ocean.sea == pelagic.Sea(cascades=3, resolution=32)
