"""Views and commands of dynamic waves, shores and wave inputs."""

import dataclasses
import functools
import re
import warnings

import numpy as np
import pelagic
import pytest
from conftest import SMALL_SEA, accepted_by_library, bay, defaults_of_library, docstrings_of_fields
from pelagic import _native

GRID = pelagic.DynamicWavesOptions(resolution=64, depth_m=4000)
STONE = pelagic.Disturbance(mode="impulse", x_m=3, z_m=-2, radius_m=2, height_m=0.4)
BOAT = pelagic.Disturbance(shape="hull", x_m=-10, z_m=5, radius_m=1, length_m=4, height_m=-0.5, velocity_x_mps=6)
TICK_S = 1 / 60

# Of each class, the struct of C with a function that sets its defaults, if it has one.
OPTIONS = {
    pelagic.AnalyticWave: None, pelagic.Disturbance: _native.pelagic_disturbance,
    pelagic.DynamicWavesOptions: _native.pelagic_dynamic_waves_options,
    pelagic.Rain: _native.pelagic_rain, pelagic.Ripple: None,
    pelagic.ShoreOptions: _native.pelagic_shore_options,
    pelagic.SprayEmitter: _native.pelagic_spray_emitter,
    pelagic.SprayOptions: _native.pelagic_spray_options,
}


@pytest.mark.parametrize("cls", OPTIONS)
def test_options_have_the_defaults_and_ranges_of_the_library(cls):
    here = {field.name: field.default for field in dataclasses.fields(cls) if field.name not in ("step", "shape", "mode", "heights_m")}
    docs = docstrings_of_fields(cls)
    assert set(docs) == {field.name for field in dataclasses.fields(cls)}
    create = functools.partial(cls, np.zeros((3, 3))) if cls is pelagic.ShoreOptions else cls
    # shared docstrings of x_m and z_m have the range, too
    for name, default in here.items():
        accepted = accepted_by_library(create, name, default)
        assert cls is pelagic.DynamicWavesOptions or not re.match(r"[\[(]", accepted) or all(
                part.split(": ")[0] in docs[name] for part in accepted.split(", or ")), name
    if OPTIONS[cls]:
        there = defaults_of_library(OPTIONS[cls])
        here.pop("swash_m", None)  # 0 in C
        assert here == {name: there[name] for name in here}


def test_a_view_has_the_waves_at_their_position():
    with pelagic.Ocean(SMALL_SEA, dynamic_waves=dataclasses.replace(GRID, border_m=8)) as ocean:
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


def test_restored_states_continue():
    def frames(ocean, first):
        return [ocean.frame_at((first + tick) * TICK_S).dynamic_waves.hash for tick in range(30)]

    with pelagic.Ocean(SMALL_SEA, dynamic_waves=GRID) as ocean, pelagic.Ocean(SMALL_SEA, threads=1, dynamic_waves=GRID) as other:
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
        with pelagic.Ocean(SMALL_SEA, dynamic_waves=dataclasses.replace(GRID, side_m=48)) as unlike, pytest.raises(ValueError):
            unlike.dynamic_waves.restore_state(saved)
    with pytest.raises(ValueError, match="the ocean is closed"):
        waves.add_impulse(STONE)


def test_a_shore_is_a_part_of_its_frame():
    with pelagic.Ocean(SMALL_SEA, shore=bay()) as ocean, pelagic.Ocean(SMALL_SEA) as open_sea:
        frame = ocean.frame_at(12.34)
        shore = frame.shore
        assert frame.hash == open_sea.frame_at(12.34).hash
        assert (shore.columns, shore.x_m, shore.z_m) == (64, -170, -130)
        for array in (shore.depth_m, shore.height_m, shore.vertical_velocity_mps, shore.potential_m2ps, shore.reach_m, shore.foam):
            assert array.shape == (shore.rows, 64) and array.any() and not array.flags.writeable
        assert shore.weights_rgba8.shape == (shore.rows, 64, 4) and shore.weights_change_per_m > 0
        assert shore.height_min_m <= shore.height_m.min() < 0 < shore.height_m.max() <= shore.height_max_m
        del array
        hash_ = shore.hash
        assert ocean.frame_at(12.34 + SMALL_SEA.loop_period_s).shore.hash == hash_ != ocean.frame_at(13).shore.hash
        with pytest.raises(pelagic.StaleFrame):
            shore.hash
        with pytest.raises(ValueError, match="the sea of an ocean with a shore cannot change"):
            ocean.schedule_sea(SMALL_SEA, 20, 1)


def test_meshes_lie_on_the_surface_of_dynamic_waves_and_shores():
    z, x = np.mgrid[-300:300:50j, -300:300:50j]
    rest = np.stack([x.ravel(), z.ravel()], axis=1)
    near = rest / 30  # within the dynamic-wave grid
    parts = {"dynamic_waves": (near, {"dynamic_waves": GRID}), "shore": (rest, {"shore": bay()}),
             "both": (near, {"dynamic_waves": GRID, "shore": bay()})}
    with pelagic.Ocean(SMALL_SEA, velocities=True, foam=True) as open_sea:
        alone = open_sea.frame_at(12.5)
        for part, (points, options) in parts.items():
            with pelagic.Ocean(SMALL_SEA, velocities=True, foam=True, **options) as ocean:
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


def test_wave_inputs_may_change_and_belong_to_one_ocean(small):
    flat = {"wavelength_m": 250 / 8, "amplitude_m": 0.25}
    waves = pelagic.GerstnerInput([pelagic.AnalyticWave(**flat, direction_rad=np.pi / 2)], choppiness=0)
    rings = pelagic.RippleInput(pelagic.Ripple(**flat, x_m=125, z_m=125))
    with pelagic.Ocean(small) as alone:
        hash_ = alone.frame_at(0).hash
    with pelagic.Ocean(small, inputs=[waves, rings]) as ocean:
        both = ocean.frame_at(3).hash

        waves.set([])
        assert ocean.frame_at(0).hash != hash_
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
        "metres_per_sample 0 is out of range [0.001, 10000]": (ValueError, lambda: pelagic.ShoreOptions(heights, metres_per_sample=0)),
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
