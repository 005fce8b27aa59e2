"""Hulls and sets of them: saved states, threads and errors."""

import math
import threading

import numpy as np
import pelagic
import pytest
from conftest import BOX, BOX_TRIANGLES

TICK_S = 1 / 60
STILL = pelagic.Sea(resolution=16, patch_size_m=100, wind_speed_mps=0.05)
ROUGH = pelagic.Sea(resolution=32, patch_size_m=250, wind_speed_mps=14)
GRID = pelagic.DynamicWavesOptions(resolution=64, side_m=32, border_m=4)

def test_a_hull_has_the_properties_of_its_arguments():
    hull = pelagic.Hull(BOX, BOX_TRIANGLES, 4100)
    assert hull.floats and hull.mass_kg == 4100
    assert hull.centre_m == pytest.approx((0, 0, 0), abs=1e-12) and hull.centre_of_mass_m == hull.centre_m
    assert not pelagic.Hull(np.array(BOX), np.array(BOX_TRIANGLES, np.uint8), np.float32(9000)).floats
    assert hull.digest != pelagic.Hull(BOX, BOX_TRIANGLES, 4100, roll_damping=0.1).digest


def test_a_rollback_replays_bit_equal():
    hull = pelagic.Hull(BOX, BOX_TRIANGLES, 3500)
    with pelagic.Ocean(ROUGH, depth=True, dynamic_waves=GRID) as ocean:
        bodies = pelagic.Bodies(ocean, wakes=True, threads=2)
        first = bodies.add(hull, hull.at_rest(-4, 1))
        bodies.set_inputs(first, force_n=(2000, 0, 0), wind_mps=(0, 0, 4))

        def advance(begin, end):
            for tick in range(begin, end):
                frame = ocean.frame_at(tick * TICK_S)
                bodies.press(frame, TICK_S)
                bodies.step(frame, TICK_S)

        advance(0, 20)
        ocean.frame_at(20 * TICK_S)
        saved, waves = bodies.save_state(), ocean.dynamic_waves.save_state()
        advance(20, 50)
        once = bodies.save_state()
        bodies.remove(first)
        ocean.dynamic_waves.restore_state(waves)
        bodies.restore_state(saved)
        advance(20, 50)
        assert bodies.save_state() == once and once != saved
        for damaged in (saved[:-1], b"", saved[:100] + b"?" + saved[101:]):
            with pytest.raises(ValueError, match="^the saved bodies (are damaged|have a wrong size), expected "):
                bodies.restore_state(damaged)
        assert bodies.save_state() == once


def test_bodies_and_queries_shift_with_the_origin():
    hull, origin = pelagic.Hull(BOX, BOX_TRIANGLES, 3500), np.array([1e7, -2e6])
    places = np.random.default_rng(1).uniform(-90, 90, (50, 2))
    found = []
    for shifts in (False, True):
        with pelagic.Ocean(ROUGH, depth=True, dynamic_waves=GRID) as ocean:
            bodies = pelagic.Bodies(ocean, wakes=True)
            body = bodies.add(hull, hull.at_rest(-4, 1))
            bodies.set_inputs(body, force_n=(2000, 0, 0))
            for tick in range(30):
                if shifts and tick == 10:
                    ocean.set_origin(*origin)
                frame = ocean.frame_at(tick * TICK_S)
                if shifts and tick == 10:
                    bodies.shift(*-origin)
                bodies.press(frame, TICK_S)
                bodies.step(frame, TICK_S)
            shift = origin if shifts else np.zeros(2)
            x, z = (places - shift).T
            at = bodies.state(body).position_m
            found.append((frame.hash, np.array(at) + (shift[0], 0, shift[1]), frame.query(x, z)["height"]))
            with pytest.raises(ValueError, match=r"^origin_z_m -200000000 is out of range \[-1e8, 1e8\]$"):
                ocean.set_origin(0, -2e8)
            with pytest.raises(ValueError, match="^body 1: the hull's position_m is out of range"):
                bodies.shift(3e8, 0)
    (still_hash, still_body, still_heights), (shifted_hash, body, heights) = found
    assert shifted_hash == still_hash
    assert np.allclose(body, still_body, rtol=0, atol=1e-6) and np.allclose(heights, still_heights, rtol=0, atol=1e-5)
    water = pelagic.ExactWater(ROUGH, time_s=2)
    before = water.sample([3, -1, 5])["pressure"]
    water.set_origin(*origin)
    assert np.isclose(water.sample([3 - origin[0], -1, 5 - origin[1]])["pressure"], before, rtol=0, atol=0.1)


def test_other_threads_run_during_steps():
    hull = pelagic.Hull(BOX, BOX_TRIANGLES, 3500)
    with pelagic.Ocean(ROUGH, depth=True) as ocean:
        sets = [pelagic.Bodies(ocean, threads=1) for _ in range(2)]
        for bodies in sets:
            bodies.add(hull, hull.at_rest(0, 0))
        frame = ocean.frame_at(0)
        steps = [threading.Thread(target=lambda of=of: [of.step(frame, TICK_S) for _ in range(20)]) for of in sets]
        for thread in steps:
            thread.start()
        for thread in steps:
            thread.join()
        assert sets[0].save_state() == sets[1].save_state()


def test_invalid_arguments_raise_a_one_line_error():
    hull = pelagic.Hull(BOX, BOX_TRIANGLES, 4100)
    with pelagic.Ocean(STILL, depth=True) as ocean, pelagic.Ocean(STILL, depth=True) as other:
        bodies = pelagic.Bodies(ocean)
        number = bodies.add(hull, hull.at_rest(0, 0))
        state, frame = bodies.state(number), ocean.frame_at(0)
        before = bodies.save_state()
        with pelagic.Ocean(STILL) as without_depth:
            cases = {
                (TypeError, "ocean is None, expected a pelagic.Ocean"): lambda: pelagic.Bodies(None),
                (TypeError, "hull is None, expected a pelagic.Hull"): lambda: bodies.add(None, state),
                (TypeError, "state is None, expected a pelagic.HullState"): lambda: bodies.add(hull, None),
                (TypeError, "state is 3, expected a pelagic.HullState"): lambda: bodies.set_state(number, 3),
                (TypeError, "frame is None, expected a pelagic.Frame"): lambda: bodies.step(None, TICK_S),
                (TypeError, "saved is str, expected bytes that save_state() returned"): lambda: bodies.restore_state("x"),
                (TypeError, "Hull() needs mass_kg"): lambda: pelagic.Hull(BOX, BOX_TRIANGLES),
                (ValueError, "the ocean has no depth: create it with depth=True"): lambda: pelagic.Bodies(without_depth),
                (ValueError, "the ocean has no dynamic waves: create it with dynamic_waves="): lambda: pelagic.Bodies(ocean, wakes=True),
                (ValueError, "the frame is one of another ocean"): lambda: bodies.step(other.frame_at(0), TICK_S),
                (ValueError, "step_s -1 is out of range [0, inf) s"): lambda: bodies.step(frame, -1),
                (ValueError, "number is 9, expected that of a body"): lambda: bodies.state(9),
                (ValueError, "number is -1, expected a number that add() returned"): lambda: bodies.loads(-1),
                (ValueError, "force_n is (1, 2), expected x, y and z"): lambda: bodies.set_inputs(number, force_n=(1, 2)),
                (ValueError, "the hull's input wind_mps is out of range [-1e3, 1e3]"): lambda: bodies.set_inputs(number, wind_mps=(0, np.nan, 0)),
                (ValueError, "the hull's position_m is out of range [-1e8, 1e8]"): lambda: setattr(state, "position_m", (0, 2e8, 0)),
                (ValueError, "the hull's orientation is not a unit quaternion"): lambda: setattr(state, "orientation", (0, 0, 0, 2)),
                (ValueError, "the hull is open at the edge between "): lambda: pelagic.Hull(BOX, BOX_TRIANGLES[1:], 9),
                (ValueError, "the hull's volume is -8 m^3: its triangles are wound inwards"): lambda: pelagic.Hull(BOX, [t[::-1] for t in BOX_TRIANGLES], 9),
                (ValueError, "vertex 0: x nan is out of range [-1000, 1000] m"): lambda: pelagic.Hull([(np.nan, 0, 0), *BOX[1:]], BOX_TRIANGLES, 9),
                (ValueError, "the hull has 1000000 triangles, expected 4 to 4096"): lambda: pelagic.Hull(BOX, np.zeros((1000000, 3), int), 9),
                (ValueError, "triangle 0 of the hull has vertex -1, expected 0 to 7"): lambda: pelagic.Hull(BOX, [(-1, 1, 3), *BOX_TRIANGLES[1:]], 9),
                (ValueError, "triangles can't be made an array of whole numbers"): lambda: pelagic.Hull(BOX, np.array(BOX_TRIANGLES, float), 9),
                (ValueError, "vertices has another shape, expected (n, 3)"): lambda: pelagic.Hull([1, 2], BOX_TRIANGLES, 9),
                (ValueError, "mass_kg 0 is out of range [1e-6, 1e10]"): lambda: pelagic.Hull(BOX, BOX_TRIANGLES, 0),
                (ValueError, "heading_rad is inf, expected a finite number"): lambda: hull.at_rest(0, 0, math.inf),
            }
            for (kind, line), call in cases.items():
                with pytest.raises(kind) as refused:
                    call()
                assert str(refused.value).startswith(line) and "\n" not in str(refused.value)
        assert bodies.save_state() == before
    with pytest.raises(ValueError, match="^the ocean is closed$"):
        bodies.step(frame, TICK_S)


def test_bodies_may_outlive_their_ocean():
    hull = pelagic.Hull(BOX, BOX_TRIANGLES, 4100)
    with pelagic.Ocean(STILL, depth=True, dynamic_waves=GRID) as ocean:
        bodies = pelagic.Bodies(ocean, wakes=True)
        bodies.add(hull, hull.at_rest(0, 0))
    del ocean, hull
    with pytest.raises(ValueError, match="^the ocean is closed$"):
        bodies.state(1)
    del bodies


def test_coefficients_are_read_from_texts():
    def rows(columns):
        return "".join(f"{period} {mode} {mode} {columns}\n" for period in (1, 2, 4, 8) for mode in range(1, 7))

    hull = pelagic.Hull(BOX, BOX_TRIANGLES, 3500, radiation_text=rows("3 0.5"))
    assert hull.digest != pelagic.Hull(BOX, BOX_TRIANGLES, 3500).digest
    with pytest.raises(ValueError, match=r"^radiation_text: line 19: B\(1,1\) is negative, expected damping$"):
        pelagic.Hull(BOX, BOX_TRIANGLES, 3500, radiation_text=rows("3 -0.5"))
