"""The package is bit-identical to the command line and to the golden hashes."""

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


def points():
    random = np.random.default_rng(7)
    near = random.uniform(-400, 400, (1500, 2))
    far = random.uniform(-1e7, 1e7, (500, 2))
    return np.concatenate([near, far, [[0, 0], [1e7 + 0.5, -3e6]]])


SEAS = {
    "four cascades": ({}, []),
    "rough": (None, ["--preset", "rough"]),
    "steep": ({"spectrum": "phillips-paper", "resolution": 64, "patch_size_m": 250, "choppiness": 1, "wind_speed_mps": 20},
               ["--spectrum", "phillips-paper", "--resolution", "64", "--patch-size", "250", "--choppiness", "1", "--wind-speed", "20"]),
}


def csv_columns(text):
    header, *rows = text.strip().split("\n")
    values = np.array([row.split(",") for row in rows])
    return {name: values[:, i] for i, name in enumerate(header.split(","))}


def assert_same_answers(answers, told):
    """Every number that the command prints is read back as the original float."""
    def column(name):
        return told[name].astype(np.float32)

    for name, theirs in (("height", "height"), ("jacobian", "jacobian"), ("error", "error_m"), ("foam", "foam")):
        np.testing.assert_array_equal(answers[name].view(np.uint32), column(theirs).view(np.uint32), name)
    for name, letter in (("normal", "n"), ("velocity", "v")):
        for axis, xyz in enumerate("xyz"):
            # contiguous, for its bits
            np.testing.assert_array_equal(np.ascontiguousarray(answers[name][:, axis]).view(np.uint32), column(letter + xyz).view(np.uint32), name)
    np.testing.assert_array_equal(answers["converged"], told["converged"] == "1")


@pytest.mark.parametrize("sea", SEAS)
def test_queries_are_bit_identical_to_the_command(sea):
    options, flags = SEAS[sea]
    where = points()
    given = "".join(f"{x!r},{z!r}\n" for x, z in where.tolist())
    told, told_by_cubic = (csv_columns(run_pelagic("query", "--points", "-", "--time", "12.34", "--foam", "--interpolation", interpolation,
                                                   *flags, given=given)) for interpolation in ("linear", "cubic"))
    wanted = pelagic.preset("rough") if options is None else pelagic.Sea(**options)
    with pelagic.Ocean(wanted, velocities=True, foam=True) as ocean:
        frame = ocean.frame_at(12.34)
        for answers in (frame.query(where), frame.query(where.tolist()), frame.query(where[:, 0], where[:, 1]),
                        frame.query(np.asfortranarray(where))):
            assert len(answers["height"]) == len(where) > 1000
            assert_same_answers(answers, told)
        assert_same_answers(frame.query(where, interpolation="cubic"), told_by_cubic)
        of_series = ocean.series(where, [12.34, 13])
        assert_same_answers({name: array[0] for name, array in of_series.items()}, told_by_cubic)
        frame = ocean.frame_at(12.34)
        for i in (0, 1700, len(where) - 1):  # alone as well
            assert frame.query(where[i])["height"] == answers["height"][i]
    if sea == "steep":
        assert answers["jacobian"].min() < 0.3  # crests are sharp


def read_exr(path, resolution, number):
    """Reads the displacements of an uncompressed EXR file: after the header the lines follow, each
    with y, byte count, and blue, green and red."""
    line = np.dtype([("y", "<i4"), ("bytes", "<i4"), ("bgr", np.dtype(number), (3, resolution))])
    lines = np.frombuffer(path.read_bytes()[-resolution * line.itemsize:], line)
    np.testing.assert_array_equal(lines["y"], np.arange(resolution))
    return lines["bgr"].transpose(0, 2, 1)[:, :, ::-1]


@pytest.mark.parametrize("flags, number", [(["--half"], "<f2"), ([], "<f4")], ids=["halves", "floats"])
def test_arrays_are_bit_identical_to_exported_images(tmp_path, flags, number):
    run_pelagic("export", "--out", tmp_path, "--preset", "rough", "--start", "12.34", "--maps", "displacement", "--compression", "none", *flags)
    hash_ = json.loads((tmp_path / "sea.json").read_text())["frames"][0]["hash"]
    with pelagic.Ocean(pelagic.preset("rough")) as ocean:
        frame = ocean.frame_at(12.34)
        assert f"{frame.hash:016x}" == hash_
        assert len(frame.cascades) == 4
        for i, cascade in enumerate(frame.cascades):
            exported = read_exr(tmp_path / f"displacement{f'_c{i}' if i else ''}_0000.exr", cascade.resolution, number)
            shown = cascade.displacement[:, :, :3] if number == "<f2" else np.stack([cascade.dx, cascade.height, cascade.dz], axis=-1)
            np.testing.assert_array_equal(shown, exported)
        np.testing.assert_array_equal(frame.displacement, frame.cascades[0].displacement)
        np.testing.assert_array_equal(frame.height, frame.cascades[0].height)


def test_transitions_are_identical_to_the_command(tmp_path):
    weather = tmp_path / "weather.toml"
    weather.write_text('preset = "calm"\n\n[[change]]\nfrom = 10\nover = 20\npreset = "storm"\n')
    where = points()[:200]
    given = "".join(f"{x!r},{z!r}\n" for x, z in where.tolist())
    storm = pelagic.preset("storm")
    with pelagic.Ocean(pelagic.preset("calm"), velocities=True, foam=True, largest_peak_m=storm.report().peak_wavelength_m) as ocean:
        ocean.schedule_sea(storm, from_s=10, over_s=20)
        for time_s in (5, 17.5, 40):
            told = csv_columns(run_pelagic("query", "--points", "-", "--time", time_s, "--foam", "--weather", weather, "--interpolation", "linear", given=given))
            assert_same_answers(ocean.frame_at(time_s).query(where), told)
        assert ocean.sea == storm
        assert ocean.frame_at(5).sea == pelagic.preset("calm")


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
