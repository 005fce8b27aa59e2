"""Dynamic waves, shores and wave inputs, compared with the native command and closed forms."""

import dataclasses
import json
import re
import struct
import warnings
import zlib

import numpy as np
import pelagic
import pytest
from bits_test import assert_same_answers, csv_columns
from conftest import run_pelagic
from names_test import docstrings_of_fields
from pelagic import _pelagic

SEA = pelagic.Sea(cascades=2, resolution=32, wind_speed_mps=8)
SEA_FLAGS = ["--cascades", "2", "--resolution", "32", "--wind-speed", "8"]
GRID = pelagic.DynamicWavesOptions(resolution=64, depth_m=4000)
STONE = pelagic.Disturbance(mode="impulse", x_m=3, z_m=-2, radius_m=2, height_m=0.4)
BOAT = pelagic.Disturbance(shape="hull", x_m=-10, z_m=5, radius_m=1, length_m=4, height_m=-0.5, velocity_x_mps=6)
TICK_S = 1 / 60

FIELDS = {
    pelagic.AnalyticWave: _pelagic.analytic_wave_fields, pelagic.Disturbance: _pelagic.disturbance_fields,
    pelagic.DynamicWavesOptions: _pelagic.dynamic_waves_fields, pelagic.Rain: _pelagic.rain_fields, pelagic.Ripple: _pelagic.ripple_fields,
    pelagic.ShoreOptions: _pelagic.shore_fields,
}


@pytest.mark.parametrize("cls", FIELDS)
def test_options_have_the_fields_defaults_and_ranges_of_the_library(cls):
    here = {field.name: field.default for field in dataclasses.fields(cls) if field.name not in ("step", "shape", "mode", "heights_m")}
    assert here == {name: default for name, default, _ in FIELDS[cls]()}
    docs = docstrings_of_fields(cls)
    assert set(docs) == {field.name for field in dataclasses.fields(cls)}
    # shared docstrings of x_m and z_m have the range, too
    if cls is not pelagic.DynamicWavesOptions:
        for name, _, accepted in FIELDS[cls]():
            assert not re.match(r"[\[(]", accepted) or accepted in docs[name], name


def events_file(folder):
    """Writes the commands of play(): a stone at 0.5 s, a boat from 0.7 s for 1.5 s."""
    file = folder / "events.csv"
    file.write_text("time,x,z,radius,height,velocity,heading,duration,length,mode\n"
                    "0.5,3,-2,2,0.4,,,,,impulse\n"
                    "0.7,-10,5,1,-0.5,6,0,1.5,4,pressure\n")
    return file


def play(ocean, until_s):
    """Yields the frame and its time for each tick, from the tick before the first command."""
    waves = ocean.dynamic_waves
    waves.set_center(0, 0)
    number = None
    for tick in range(29, round(until_s / TICK_S) + 1):
        if tick == 30:
            waves.add_impulse(STONE)
        if tick == 42:
            number = waves.add_source(BOAT)
        if tick == 132:
            waves.remove_source(number)
        yield ocean.frame_at(tick / 60), tick


def test_dynamic_waves_are_identical_to_the_command(tmp_path):
    grid = ["--events", events_file(tmp_path), "--events-resolution", 64, "--events-at", "0,0"]
    run_pelagic("export", "--out", tmp_path / "out", *SEA_FLAGS, "--fps", 4, "--frames", "2-11", "--maps", "displacement", "--no-sync", *grid)
    wanted = {entry["time_s"]: entry for entry in json.loads((tmp_path / "out/sea.json").read_text())["frames"]}
    assert len(wanted) == 10
    where = np.random.default_rng(5).uniform(-20, 20, (200, 2))
    told = csv_columns(run_pelagic("query", "--points", "-", "--time", 2, "--interpolation", "linear", "--foam", *SEA_FLAGS, *grid,
                                   given="".join(f"{x!r},{z!r}\n" for x, z in where.tolist())))
    seen = {}
    with pelagic.Ocean(SEA, velocities=True, foam=True, dynamic_waves=GRID) as ocean:
        for frame, tick in play(ocean, 2.75):
            if tick / 60 in wanted:
                seen[tick / 60] = (f"{frame.hash:016x}", f"{frame.dynamic_waves.hash:016x}")
            if tick == 120:
                assert_same_answers(frame.query(where), told)
    assert seen == {time_s: (entry["hash"], entry["dynamic_waves_hash"]) for time_s, entry in wanted.items()}
    assert len({hash_ for _, hash_ in seen.values()}) == 10


def test_foam_of_a_disturbance_has_no_waves():
    with pelagic.Ocean(SEA, dynamic_waves=GRID) as ocean:
        ocean.frame_at(0)
        ocean.dynamic_waves.add_impulse(pelagic.Disturbance(mode="foam", radius_m=2, height_m=0.3))
        view = ocean.frame_at(2 * TICK_S).dynamic_waves
        # half of the range from 0.2 to 0.4 m, less a tick's decay
        assert abs(int(view.foam[0, 0]) - 255 // 2) <= 4
        assert view.foam[0, 16] == 0 and view.height_min_m == view.height_max_m == 0


def test_a_view_has_the_waves_at_their_position():
    with pelagic.Ocean(SEA, dynamic_waves=dataclasses.replace(GRID, border_m=8)) as ocean:
        ocean.dynamic_waves.set_center(30.2, -7)
        ocean.frame_at(0)
        ocean.dynamic_waves.add_impulse(dataclasses.replace(STONE, x_m=33, z_m=-9))
        view = ocean.frame_at(2 * TICK_S).dynamic_waves
        assert (view.resolution, view.texel_m) == (64, 1)
        assert (view.height_m.shape, view.height_m.dtype, view.foam.dtype) == ((64, 64), np.float32, np.uint8)
        assert (view.first_x + 32, view.first_z + 32) == (30, -7)
        j, i = np.unravel_index(view.height_m.argmax(), (64, 64))
        assert (i, j) == (33 % 64, -9 % 64) and 0.3 < view.height_m[j, i] <= view.height_max_m
        lowest_first = np.roll(view.height_m, (-view.first_z, -view.first_x), (0, 1))
        assert lowest_first[-9 - view.first_z, 33 - view.first_x] == view.height_m[j, i]
        assert view.foam.max() > 0 and view.vertical_velocity_mps.any() and view.height_min_m <= view.height_m.min()
        with pytest.raises(ValueError):
            view.height_m[0, 0] = 1
        kept = view.height_m
        ocean.frame_at(3 * TICK_S)
        with pytest.raises(BufferError):
            ocean.frame_at(4 * TICK_S)
        del kept
        ocean.frame_at(4 * TICK_S)
        assert view.resolution == 64
        for ask in (lambda: view.height_m, lambda: view.hash):
            with pytest.raises(pelagic.StaleFrame):
                ask()


def test_sources_rain_and_restored_states_are_reproducible():
    def frames(ocean, first):
        return [ocean.frame_at((first + tick) * TICK_S).dynamic_waves.hash for tick in range(30)]

    with pelagic.Ocean(SEA, dynamic_waves=GRID) as ocean, pelagic.Ocean(SEA, threads=1, dynamic_waves=GRID) as other:
        waves = ocean.dynamic_waves
        boat = waves.add_source(BOAT)
        waves.set_rain(pelagic.Rain(drops_per_m2_s=0.5, radius_m=1, height_m=0.1, seed=3))
        frames(ocean, 0)
        saved = waves.save_state()
        assert isinstance(saved, bytes) and len(saved) > 17 * 64 * 64
        after = frames(ocean, 30)
        assert len(set(after)) == 30
        other.dynamic_waves.restore_state(saved)
        assert frames(other, 30) == after
        waves.restore_state(saved)
        assert frames(ocean, 30) == after
        waves.restore_state(saved)
        waves.set_source(boat, dataclasses.replace(BOAT, height_m=-1))
        deeper = frames(ocean, 30)
        waves.restore_state(saved)
        waves.remove_source(boat)
        waves.remove_source(boat)
        gone = frames(ocean, 30)
        waves.restore_state(saved)
        waves.set_rain(pelagic.Rain())
        assert len({after[-1], deeper[-1], gone[-1], frames(ocean, 30)[-1]}) == 4

        ocean.schedule(2)
        for ask in (waves.save_state, lambda: waves.restore_state(saved)):
            with pytest.raises(RuntimeError, match=r"^a frame is in flight; call complete\(\) first$"):
                ask()
        waves.add_impulse(STONE)  # for the next frame
        ocean.complete()
        before = ocean.frame_at(2).dynamic_waves.hash
        for damaged in (b"", saved[:-1], b"\xff" * len(saved)):
            with pytest.raises(ValueError) as refused:
                waves.restore_state(damaged)
            assert "\n" not in str(refused.value)
        assert ocean.frame_at(2).dynamic_waves.hash == before
        with pelagic.Ocean(SEA, dynamic_waves=dataclasses.replace(GRID, side_m=48)) as unlike, pytest.raises(ValueError):
            unlike.dynamic_waves.restore_state(saved)
    with pytest.raises(ValueError, match="the ocean is closed"):
        waves.add_impulse(STONE)


def png_of(pixels):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows, columns = pixels.shape
    lines = b"".join(b"\0" + line.tobytes() for line in pixels)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 0, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(lines))
            + chunk(b"IEND", b""))


def island():
    """Returns the bytes of heights from -20 to 10 m: an island in a bay, 40 rows of 48."""
    z, x = np.mgrid[-1:1:40j, -1:1:48j]
    return np.clip(220 * np.exp(-4 * (x**2 + z**2)) + 30 * x, 0, 255).astype(np.uint8)


def island_shore(**options):
    heights = (-20 + (island() * np.float32(1 / 255)).astype(np.float64) * 30).astype(np.float32)
    metres = 1000 / 48
    return pelagic.ShoreOptions(heights, metres_a_sample=metres, corner_x_m=-0.5 * metres * 47, corner_z_m=-0.5 * metres * 39, **options)


def test_shores_are_identical_to_the_command(tmp_path):
    floor = tmp_path / "floor.png"
    floor.write_bytes(png_of(island()))
    where = np.random.default_rng(6).uniform(-600, 600, (400, 2))
    told = csv_columns(run_pelagic("query", "--points", "-", "--time", 12.34, "--interpolation", "linear", "--foam", *SEA_FLAGS, "--shore",
                                   "--floor", floor, given="".join(f"{x!r},{z!r}\n" for x, z in where.tolist())))
    assert (told["depth"].astype(float) < 0).any()
    with pelagic.Ocean(SEA, velocities=True, foam=True, shore=island_shore()) as ocean, pelagic.Ocean(SEA) as open_sea:
        with pytest.warns(UserWarning, match="span more than"):
            answers = ocean.frame_at(12.34).query(where)
        assert_same_answers(answers, told)
        with pytest.warns(UserWarning, match="span more than"):
            assert list(ocean.series(where, [12.34])) == list(answers)

        frame = ocean.frame_at(12.34)
        shore = frame.shore
        assert frame.hash == open_sea.frame_at(12.34).hash
        assert (shore.columns, shore.x_m, shore.z_m) == (256, -0.5 * 1000 / 48 * 47, -0.5 * 1000 / 48 * 39)
        x, z = shore.x_m + 100 * shore.texel_m, shore.z_m + 80 * shore.texel_m
        told = csv_columns(run_pelagic("query", "--points", "-", "--time", 12.34, *SEA_FLAGS, "--shore", "--floor", floor, given=f"{x!r},{z!r}\n"))
        assert shore.depth_m[80, 100] == pytest.approx(float(told["depth"][0]), abs=1e-4)
        for array in (shore.depth_m, shore.height_m, shore.vertical_velocity_mps, shore.potential_m2ps, shore.reach_m, shore.foam):
            assert array.shape == (shore.rows, 256) and array.any() and not array.flags.writeable
        assert shore.weights_rgba8.shape == (shore.rows, 256, 4) and shore.weights_change_per_m > 0
        assert shore.height_min_m <= shore.height_m.min() < 0 < shore.height_m.max() <= shore.height_max_m
        del array
        hash_ = shore.hash
        assert ocean.frame_at(12.34 + SEA.loop_period_s).shore.hash == hash_ != ocean.frame_at(13).shore.hash
        with pytest.raises(pelagic.StaleFrame):
            shore.hash
        with pytest.raises(ValueError, match="the sea of an ocean with a shore cannot change"):
            ocean.schedule_sea(SEA, 20, 1)


def test_meshes_lie_on_the_surface_of_dynamic_waves_and_shores():
    z, x = np.mgrid[-300:300:50j, -300:300:50j]
    rest = np.stack([x.ravel(), z.ravel()], axis=1)
    near = rest / 30  # within the dynamic-wave grid
    parts = {"dynamic_waves": (near, {"dynamic_waves": GRID}), "shore": (rest, {"shore": island_shore()}),
             "both": (near, {"dynamic_waves": GRID, "shore": island_shore()})}
    with pelagic.Ocean(SEA, velocities=True, foam=True) as open_sea:
        alone = open_sea.frame_at(12.5)
        for part, (points, options) in parts.items():
            with pelagic.Ocean(SEA, velocities=True, foam=True, **options) as ocean:
                ocean.frame_at(12.4)
                if "dynamic_waves" in options:
                    ocean.dynamic_waves.add_impulse(STONE)
                frame = ocean.frame_at(12.5)
                mesh = frame.sample_undisplaced(points)
                moved = mesh["displacement"]
                drawn = points + moved[:, ::2]
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    surface = frame.query(drawn)
                assert surface["converged"].all(), part
                np.testing.assert_allclose(moved[:, 1], surface["height"], rtol=0, atol=2e-5, err_msg=part)
                np.testing.assert_allclose(mesh["velocity"], surface["velocity"], rtol=0, atol=2e-4, err_msg=part)
                np.testing.assert_allclose(mesh["foam"], surface["foam"], rtol=0, atol=2e-4, err_msg=part)
                shown = np.column_stack([points[:, 0], np.zeros(len(points)), points[:, 1]]) + moved
                np.testing.assert_allclose(frame.displaced(points), shown, rtol=0, atol=4e-5, err_msg=part)
                np.testing.assert_array_equal(frame.displaced_foam(points), mesh["foam"], err_msg=part)
            others = alone.sample_undisplaced(points)["displacement"]
            assert np.abs(moved - others)[:, 1].max() > 0.1, part
            assert ("shore" in options) == bool(np.abs(moved - others)[:, 0].max() > 0.01), part


def test_wave_inputs_add_their_waves(small):
    flat = {"wavelength_m": 250 / 8, "amplitude_m": 0.25}
    waves = pelagic.GerstnerInput([pelagic.AnalyticWave(**flat, direction_rad=np.pi / 2)], choppiness=0)
    rings = pelagic.RippleInput(pelagic.Ripple(**flat, x_m=125, z_m=125))
    with pelagic.Ocean(small) as alone:
        wind, hash_ = alone.frame_at(0).height, alone.frame_at(0).hash
    with pelagic.Ocean(small, inputs=[waves, rings]) as ocean:
        z, x = np.mgrid[:64, :64] * 250 / 64
        wavelength, reach = 250 / 8, 125
        q = np.sqrt((x - 125)**2 + (z - 125)**2 + (wavelength / 2)**2)
        window = np.maximum(0, 1 - ((x - 125)**2 + (z - 125)**2) / reach**2)**2
        ripple = 0.25 * window * np.sqrt(wavelength / 2 / q) * np.cos(2 * np.pi * (q / wavelength - 0.5))
        wave = 0.25 * np.cos(2 * np.pi * z / wavelength)
        np.testing.assert_allclose(ocean.frame_at(0).height - wind, wave + ripple, rtol=0, atol=2e-5)
        both = ocean.frame_at(3).hash

        waves.set([])
        np.testing.assert_allclose(ocean.frame_at(0).height - wind, ripple, rtol=0, atol=2e-5)
        rings.set(pelagic.Ripple())
        assert ocean.frame_at(0).hash == hash_
        for input_ in (waves, rings):
            with pytest.raises(ValueError, match=r"^inputs\[0\] is in use, expected an input of its own$"):
                pelagic.Ocean(small, inputs=[input_])
    waves.set([pelagic.AnalyticWave()])  # belongs to a closed ocean
    again = [pelagic.GerstnerInput([pelagic.AnalyticWave(**flat, direction_rad=np.pi / 2)], choppiness=0),
             pelagic.RippleInput(pelagic.Ripple(**flat, x_m=125, z_m=125))]
    with pytest.raises(ValueError):
        pelagic.Ocean(small, threads=2000, inputs=again)
    with warnings.catch_warnings(), pytest.raises(UserWarning, match="hold no waves shorter than"):
        warnings.simplefilter("error")
        pelagic.Ocean(pelagic.Sea(resolution=64), largest_peak_m=2000, inputs=again)
    # free, because those oceans were not created
    with pelagic.Ocean(small, threads=1, inputs=again) as ocean:
        assert ocean.frame_at(3).hash == both


def test_a_sea_level_and_a_current_move_the_water(small):
    # the water of x at 10 s comes from x - 10 U
    with pelagic.Ocean(SEA) as still, pelagic.Ocean(SEA) as moving:
        moving.set_water_frame(sea_level_m=3, current_mps=(1.5, -0.5))
        x, z = np.array([0.0, 7.0]), np.array([2.0, -40.0])
        heights = moving.frame_at(10).query(x, z)["height"]
        np.testing.assert_array_equal(heights, (still.frame_at(10).query(x - 15, z + 5)["height"].astype(float) + 3).astype(np.float32))
        assert moving.frame_at(10).hash == still.frame_at(10).hash
        with pytest.raises(ValueError, match=r"^sea_level_m 1001 is out of range \[-1000, 1000\]$"):
            moving.set_water_frame(sea_level_m=1001)


def test_invalid_values_raise_a_one_line_error(small):
    heights = np.zeros((4, 4))
    cases = {
        "radius_m 0 is out of range [0.001, 1000]": (ValueError, lambda: pelagic.Disturbance(radius_m=0)),
        "radius_m is 'wide', expected a number": (TypeError, lambda: pelagic.Disturbance(radius_m="wide")),
        "mode is pull, expected pressure, relaxation, impulse or foam": (ValueError, lambda: pelagic.Disturbance(mode="pull")),
        "shape is 3, expected a name: gauss or hull": (TypeError, lambda: pelagic.Disturbance(shape=3)),
        "Disturbance() has no argument radius (the nearest is radius_m)": (TypeError, lambda: pelagic.Disturbance(radius=3)),
        "resolution is 100, expected 64, 128, 256, 512 or 1024": (ValueError, lambda: pelagic.DynamicWavesOptions(resolution=100)),
        "border_m is 20, expected at most a quarter of side_m, 16": (ValueError, lambda: pelagic.DynamicWavesOptions(border_m=20)),
        "step is euler, expected spectral or verlet": (ValueError, lambda: pelagic.DynamicWavesOptions(step="euler")),
        "seed is -1, expected a whole number from 0 to 4294967295": (ValueError, lambda: pelagic.Rain(seed=-1)),
        "metres_a_sample 0 is out of range [0.001, 10000]": (ValueError, lambda: pelagic.ShoreOptions(heights, metres_a_sample=0)),
        "rows is 1, expected 2 to 4096": (ValueError, lambda: pelagic.ShoreOptions(heights[:1])),
        "heights_m.ndim is 1, expected 2: an array of (rows, columns)": (ValueError, lambda: pelagic.ShoreOptions(heights[0])),
        "heights_m nan is out of range [-11000, 9000]": (ValueError, lambda: pelagic.ShoreOptions(heights + np.nan)),
        "heights_m can't be made an array of numbers": (ValueError, lambda: pelagic.ShoreOptions("flat")),
        "wavelength_m -1 is out of range [0.01, 1000]": (ValueError, lambda: pelagic.AnalyticWave(wavelength_m=-1)),
        "amplitude_m is 1, expected at most wavelength_m / (2 pi), ": (ValueError, lambda: pelagic.Ripple(amplitude_m=1)),
        "steepness is ": (ValueError, lambda: pelagic.GerstnerInput([pelagic.AnalyticWave(amplitude_m=5)])),
        "choppiness 2 is out of range [0, 1]": (ValueError, lambda: pelagic.GerstnerInput([pelagic.AnalyticWave()], 2)),
        "waves[1] is 3, expected a pelagic.AnalyticWave": (TypeError, lambda: pelagic.GerstnerInput([pelagic.AnalyticWave(), 3])),
        "ripple is 3, expected a pelagic.Ripple": (TypeError, lambda: pelagic.RippleInput(3)),
        "inputs[0] is 3, expected a list of ": (TypeError, lambda: pelagic.Ocean(small, inputs=[3])),
        "inputs is 3, expected a list of ": (TypeError, lambda: pelagic.Ocean(small, inputs=3)),
        "dynamic_waves is True, expected a pelagic.DynamicWavesOptions": (TypeError, lambda: pelagic.Ocean(small, dynamic_waves=True)),
        "shore is 3, expected a pelagic.ShoreOptions": (TypeError, lambda: pelagic.Ocean(small, shore=3)),
        "cascades is 1, expected 2 to 4 where there is a shore": (ValueError, lambda: pelagic.Ocean(small, shore=pelagic.ShoreOptions(heights))),
    }
    with pelagic.Ocean(small) as still, pelagic.Ocean(small, dynamic_waves=GRID) as ocean:
        waves, frame = ocean.dynamic_waves, still.frame_at(0)
        hash_ = ocean.frame_at(0).dynamic_waves.hash
        cases |= {
            "the ocean has no dynamic waves: create the ocean with dynamic_waves=pelagic.DynamicWavesOptions()": (ValueError, lambda: still.dynamic_waves),
            "the frame has no dynamic waves: create the ocean with ": (ValueError, lambda: frame.dynamic_waves),
            "the frame has no shore: create the ocean with shore=pelagic.ShoreOptions(heights_m)": (ValueError, lambda: frame.shore),
            "disturbance is 3, expected a pelagic.Disturbance": (TypeError, lambda: waves.add_impulse(3)),
            "source is None, expected a pelagic.Disturbance": (TypeError, lambda: waves.add_source(None)),
            "number is -1, expected a number that add_source() returned": (ValueError, lambda: waves.set_source(-1, BOAT)),
            "number is 'boat', expected a whole number": (TypeError, lambda: waves.remove_source("boat")),
            "set_source() needs source": (TypeError, lambda: waves.set_source(1)),
            "the centre 1000000000 is out of range [-1e8, 1e8]": (ValueError, lambda: waves.set_center(1e9, 0)),
            "the centre nan is out of range [-1e8, 1e8]": (ValueError, lambda: waves.set_center(0, np.nan)),
            "z_m is 'far', expected a number": (TypeError, lambda: waves.set_center(0, "far")),
            "radius_m 9 is out of range [0.001, 4], to a 16th of side_m": (ValueError, lambda: waves.set_rain(pelagic.Rain(1, radius_m=9))),
            "rain is 3, expected a pelagic.Rain": (TypeError, lambda: waves.set_rain(3)),
            "saved is list, expected bytes that save_state() returned": (TypeError, lambda: waves.restore_state([1])),
        }
        for line, (kind, ask) in cases.items():
            with pytest.raises(kind) as refused:
                ask()
            assert str(refused.value).startswith(line) and "\n" not in str(refused.value), line
        assert ocean.frame_at(0).dynamic_waves.hash == hash_  # none of the errors had an effect
