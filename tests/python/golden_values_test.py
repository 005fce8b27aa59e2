"""Values of tests/golden/values.txt, which the C++ test GoldenValues computes by the same calls."""

import dataclasses
import struct

import numpy as np
import pelagic
import pytest
from conftest import BOX, BOX_TRIANGLES, SMALL_SEA, bay, golden_rows

X = (1.5, -7.25, 12, 3, 60, 150.5, -60, 400)
Z = (0.25, 4, -9.75, -2, 40.5, 10, 100, -1000)


def hexadecimal(*numbers):
    """Returns the bits of hashes, doubles and floats."""
    return " ".join(f"{number:016x}" if isinstance(number, int) else struct.pack(">f" if isinstance(number, np.float32) else ">d", number).hex()
                    for number in numbers)


@pytest.mark.filterwarnings("ignore:the points span more than")
@pytest.mark.parametrize("options", [{"threads": 1}, {"threads": 3}, *({"isa": isa} for isa in pelagic.isas_here())], ids=str)
def test_an_ocean_with_dynamic_waves_and_a_shore(options):
    boat = {"shape": "hull", "x_m": -10, "z_m": 5, "radius_m": 1, "length_m": 4, "velocity_x_mps": 6}
    parts = {"dynamic_waves": pelagic.DynamicWavesOptions(resolution=64, border_m=8), "shore": bay()}
    with pelagic.Ocean(SMALL_SEA, velocities=True, foam=True, **parts, **options) as ocean:
        waves, hashes = ocean.dynamic_waves, {}
        waves.set_center(0.75, -1)
        for tick in range(61):
            if tick == 3:
                waves.add_impulse(pelagic.Disturbance(mode="impulse", x_m=3, z_m=-2, radius_m=2, height_m=0.4))
            if tick == 5:
                number = waves.add_source(pelagic.Disturbance(**boat, height_m=-0.5))
            if tick == 20:
                waves.set_source(number, pelagic.Disturbance(**boat, height_m=-1))
            if tick == 25:
                waves.set_rain(pelagic.Rain(drops_per_m2_s=0.5, radius_m=1, height_m=0.1, seed=3))
            if tick == 30:
                waves.add_impulse(pelagic.Disturbance(mode="foam", x_m=12, z_m=-10, height_m=0.3))
            if tick == 40:
                waves.remove_source(number)
                waves.set_rain(pelagic.Rain())
            frame = ocean.frame_at(tick / 60)
            if tick % 10 == 0:
                hashes[str(tick)] = hexadecimal(frame.hash, frame.foam_hash, frame.dynamic_waves.hash, frame.shore.hash)
        assert hashes == golden_rows("waves")

        for interpolation in ("linear", "cubic"):
            for samples in (frame.query(X, Z, interpolation=interpolation), frame.query(np.asfortranarray(np.stack([X, Z], 1)), interpolation=interpolation)):
                columns = [samples["height"], *samples["normal"].T, *samples["velocity"].T, samples["jacobian"], samples["error"], samples["foam"],
                           samples["converged"].astype(np.float32)]
                assert {str(i): hexadecimal(*row) for i, row in enumerate(zip(*columns))} == golden_rows(interpolation)
            assert frame.query(X[5], Z[5], interpolation=interpolation)["height"] == samples["height"][5]  # alone as well
        hits = frame.rays([(1.5, 12, -7), (150.5, 12, -7)], [1, -0.5, 0.25], 500)
        assert {str(i): hexadecimal(float(hits["distance"][i]), *map(float, hits["position"][i])) for i in (0, 1)} == golden_rows("ray")


def test_spray():
    sea = dataclasses.replace(SMALL_SEA, wind_speed_mps=18)
    bow = pelagic.SprayEmitter(time_s=2, x_m=1, y_m=2, z_m=-4, extent_m=0.5, velocity_x_mps=3, velocity_y_mps=4, spread_mps=1, radius_m=0.0625, count=10)
    hashes, droplets = {}, {}
    with pelagic.Ocean(sea, spray=pelagic.SprayOptions()) as ocean, pelagic.Ocean(sea, threads=1, spray=pelagic.SprayOptions()) as other:
        ocean.set_spray_center(5, -3)
        ocean.emit([bow])
        other.set_spray_center(5, -3)
        other.restore_spray(ocean.save_spray())
        for time in ("2.0625", "7.25"):
            frame = ocean.frame_at(float(time))
            hashes[time] = hexadecimal(frame.spray_hash, len(frame.droplets))
            for name, droplet in (("first", frame.droplets[0]), ("last", frame.droplets[-1])):
                values = (*droplet["position"], *droplet["velocity"], droplet["radius"], droplet["opacity"], droplet["age"])
                droplets[f"{time}-{name}"] = hexadecimal(*values)
            assert other.frame_at(float(time)).spray_hash == frame.spray_hash
            del droplet
        assert hashes == golden_rows("spray") and droplets == golden_rows("droplet")
        with pytest.raises(ValueError, match=r"^x_m 200000000 is out of range \[-1e8, 1e8\]$"):
            ocean.set_spray_center(2e8, 0)
        with pytest.raises(TypeError, match=r"^emitters\[0\] is 3, expected a pelagic.SprayEmitter"):
            ocean.emit([3])
        with pytest.raises(ValueError, match="^the saved spray is damaged"):
            ocean.restore_spray(bytes(64))
    with pelagic.Ocean(SMALL_SEA) as without:
        with pytest.raises(ValueError, match="^the ocean has no spray: create the ocean with spray="):
            without.emit([bow])
        with pytest.raises(ValueError, match="^the frame has no spray: create the ocean with spray="):
            without.frame_at(0).droplets


@pytest.mark.filterwarnings("ignore:the points span more than")
def test_a_sea_level_and_a_current():
    with pelagic.Ocean(SMALL_SEA) as ocean:
        ocean.set_water_frame(sea_level_m=3, current_mps=(1.5, -0.5))
        heights = ocean.frame_at(10).query(X, Z)["height"]
        assert {str(i): hexadecimal(height) for i, height in enumerate(heights)} == golden_rows("lifted")
        with pytest.raises(ValueError, match=r"^sea_level_m 1001 is out of range \[-1000, 1000\]$"):
            ocean.set_water_frame(sea_level_m=1001)


def test_exact_water():
    water = pelagic.ExactWater(SMALL_SEA, time_s=12.5, threads=2)
    y = (-1.5, -0.25, -20, 0, 1, -3, -100, -4000)
    below, surface = water.sample(np.stack([X, y, Z], 1)), water.sample_surface(np.stack([X, Z], 1))
    columns = below["depth"], below["pressure"], *below["velocity"].T, *below["acceleration"].T
    assert {str(i): hexadecimal(*row) for i, row in enumerate(zip(*columns))} == golden_rows("exact")
    columns = surface["height"], *surface["velocity"].T
    assert {str(i): hexadecimal(*row) for i, row in enumerate(zip(*columns))} == golden_rows("exact-surface")
    assert np.allclose(np.linalg.norm(surface["normal"], axis=1), 1)

    water.set_time(3)
    assert water.sample(np.zeros((2, 0, 3)))["velocity"].shape == (2, 0, 3)
    assert water.sample([0, -1, 0])["pressure"].shape == () and water.sample_surface([[[0, 0]]])["height"].shape == (1, 1)
    lifted = pelagic.ExactWater(SMALL_SEA, time_s=3, sea_level_m=2, current_mps=(1, 0), water_density_kgpm3=1000)
    here, there = water.sample([0, -3, 0]), lifted.sample([3, -1, 0])
    assert np.isclose(there["pressure"], here["pressure"] / 1.025) and np.allclose(there["velocity"], here["velocity"] + np.array([1, 0, 0]))
    for error, line, call in (
            (ValueError, "y[1] is -4001, expected at least -4000, the sea floor", lambda: water.sample([[0, 0, 0], [0, -4001, 0]])),
            (ValueError, "points.shape is (2,), expected (..., 3): x, y and z of each point", lambda: water.sample([0, 0])),
            (ValueError, "time_s is inf, expected a finite number", lambda: water.set_time(float("inf"))),
            (ValueError, "water_density_kgpm3 0 is out of range [500, 2000]", lambda: pelagic.ExactWater(SMALL_SEA, water_density_kgpm3=0)),
            (ValueError, "waves is pond, expected spectrum, analytic or regular", lambda: pelagic.ExactWater(pelagic.preset("pond"))),
            (TypeError, "sea is 3, expected a pelagic.Sea, such as pelagic.preset(\"rough\")", lambda: pelagic.ExactWater(3))):
        with pytest.raises(error) as refused:
            call()
        assert str(refused.value) == line


@pytest.mark.filterwarnings("ignore:the points span more")
def test_water_of_a_frame():
    points = np.stack([X, (-1.5, -0.25, -20, 0, 1, -3, -100, -4000), Z], 1)
    with pelagic.Ocean(SMALL_SEA, depth=True) as ocean:
        frame = ocean.frame_at(12.5)
        water, height = frame.sample_water(points), frame.query(X, Z)["height"]
        assert np.allclose(water["depth"], height - points[:, 1], atol=1e-4)
        in_air = water["depth"] < 0
        assert in_air.any() and (water["pressure"][in_air] < 0).all() and (water["pressure"][~in_air] > 0).all()
        # Waves hardly reach the depths of the last points.
        assert np.allclose(water["pressure"][-2:], 1025 * 9.80665 * -points[-2:, 1], rtol=0.01)
        assert np.linalg.norm(water["velocity"], axis=1)[-1] < 1e-9 and np.linalg.norm(water["velocity"], axis=1).max() > 1e-4
        assert np.linalg.norm(water["acceleration"], axis=1)[-1] < 0.01 < np.linalg.norm(water["acceleration"], axis=1)[0]
        lighter = frame.sample_water(points, water_density_kgpm3=1000, interpolation="cubic", footprint_m=1e4)
        assert np.isclose(lighter["pressure"][-1], water["pressure"][-1] / 1.025)
        longer = frame.query(X, Z, fields=["height", "jacobian", "velocity"], footprint_m=20)
        assert (longer["jacobian"] == 1).all() and longer["velocity"].shape == (8, 3) and not np.allclose(longer["height"], height, atol=1e-3)
        many = frame.sample_water(np.tile(points, (100, 1, 1)))
        assert all((many[name] == water[name]).all() for name in water)
        assert frame.sample_water(np.zeros((2, 0, 3)))["velocity"].shape == (2, 0, 3) and frame.sample_water([0, -1, 0])["depth"].shape == ()
        assert np.isnan(frame.sample_water([0, np.inf, 0])["pressure"])
        with pelagic.Ocean(SMALL_SEA) as shallow:
            without = shallow.frame_at(0)
            for error, line, call in (
                    (ValueError, "the frame has no water below its surface: create the ocean with depth=True", lambda: without.sample_water(points)),
                    (ValueError, "y[0] is -4001, expected at least -4000, the sea floor", lambda: frame.sample_water([[0, -4001, 0]])),
                    (ValueError, "points.shape is (2,), expected (..., 3): x, y and z of each point", lambda: frame.sample_water([0, 0])),
                    (ValueError, "points.footprint_m is -1, expected 0 or more", lambda: frame.sample_water(points, footprint_m=-1)),
                    (ValueError, "footprint_m is -1, expected 0 or more", lambda: frame.query(X, Z, footprint_m=-1)),
                    (ValueError, "footprint_m needs water below the surface: create the ocean with depth=True", lambda: without.query(X, Z, footprint_m=1)),
                    (ValueError, "interpolation is sinc, expected linear or cubic", lambda: frame.sample_water(points, interpolation="sinc")),
                    (ValueError, "water_density_kgpm3 0 is out of range [500, 2000]", lambda: frame.sample_water(points, water_density_kgpm3=0))):
                with pytest.raises(error) as refused:
                    call()
                assert str(refused.value) == line
        for time_s in (13, 14):
            ocean.frame_at(time_s)
        with pytest.raises(pelagic.StaleFrame):
            frame.sample_water(points)


def test_a_transition():
    with pelagic.Ocean(SMALL_SEA) as ocean:
        later = pelagic.Sea(cascades=3, resolution=32, wind_speed_mps=6, loop_period_s=40)
        ocean.schedule_sea(later, from_s=10, over_s=20)
        assert {time: hexadecimal(ocean.frame_at(float(time)).hash) for time in ("5", "17.5", "40")} == golden_rows("transition")
        assert ocean.sea == later and ocean.frame_at(5).sea == SMALL_SEA


def test_a_shore_and_wave_inputs():
    with pelagic.Ocean(SMALL_SEA, shore=bay()) as ocean:
        assert {time: hexadecimal(ocean.frame_at(float(time)).shore.hash) for time in ("0", "7.3")} == golden_rows("shore")
    waves, wavelength_m = [], 180.0
    for i in range(20):
        waves.append(pelagic.AnalyticWave(amplitude_m=0.003 * wavelength_m, wavelength_m=wavelength_m, direction_rad=0.61 * (i % 7) - 1.9,
                                          phase_rad=0.43 * (i % 11) - 2))
        wavelength_m *= 0.77
    for name, sea in (("stack", {"cascades": 3, "wind_speed_mps": 12}), ("pond", {"waves": "pond"})):
        rings = pelagic.RippleInput(pelagic.Ripple(x_m=7.3, z_m=-2.9, wavelength_m=9, amplitude_m=0.5, reach_m=40))
        inputs = [pelagic.GerstnerInput(waves, 0.9), rings]
        with pelagic.Ocean(pelagic.Sea(resolution=64, loop_period_s=30, **sea), velocities=True, slopes=True, foam=True, inputs=inputs) as ocean:
            frame = ocean.frame_at(4.321)
            found = [hexadecimal(frame.hash, frame.foam_hash)]
            rings.set(pelagic.Ripple(x_m=-3, z_m=1e6, wavelength_m=13, amplitude_m=0.25, phase_rad=1))
            frame = ocean.frame_at(4.444)
            found.append(hexadecimal(frame.hash, frame.foam_hash))
        golden = golden_rows("input")[name].split()
        assert found == [" ".join(golden[:2]), " ".join(golden[3:5])]


def test_planes_have_the_golden_hashes():
    for name in ("jonswap", "phillips-paper"):
        with pelagic.Ocean(pelagic.Sea(spectrum=name, resolution=64, patch_size_m=250, spreading="paper", lean=0, loop_period_s=200, roughness=0.1)) as ocean:
            [cascade] = ocean.frame_at(12.34).cascades
            planes, halves = np.stack([cascade.dx, cascade.height, cascade.dz]), cascade.displacement[..., :3].copy()
        hash_ = 0xCBF29CE484222325  # FNV-1a of the bits
        for bits in planes.view(np.uint32).ravel().tolist():
            hash_ = (hash_ ^ bits) * 0x100000001B3 % 2**64
        assert hexadecimal(hash_) == golden_rows("displacement")[f"{name}-64@12.34"]
        np.testing.assert_array_equal(halves, np.moveaxis(planes, 0, -1).astype(np.float16))


def test_bodies():
    hull = pelagic.Hull(BOX, BOX_TRIANGLES, 2500, centre_of_mass_m=(0, -0.125, 0), roll_damping=0.125)
    afloat = (hull.volume_m3, hull.draught_m, hull.height_m, hull.waterplane_m2, hull.roll_gm_m, hull.pitch_gm_m)
    assert {"box": hexadecimal(*afloat)} == golden_rows("hull")
    waves = pelagic.DynamicWavesOptions(resolution=64, side_m=32, border_m=4)
    with pelagic.Ocean(SMALL_SEA, depth=True, dynamic_waves=waves) as ocean:
        bodies = pelagic.Bodies(ocean, wakes=True)
        numbers = [bodies.add(hull, hull.at_rest(1, -2, 0.25)), bodies.add(hull, hull.at_rest(-5, 4))]
        bodies.set_inputs(numbers[1], force_n=(900, 0, 0), wind_mps=(0, 0, 5))
        for tick in range(40):
            frame = ocean.frame_at(tick / 60)
            bodies.press(frame, 1 / 60)
            bodies.step(frame, 1 / 60)
        states, loads = map(bodies.state, numbers), map(bodies.loads, numbers)
        assert {str(number): hexadecimal(*state.position_m, *state.orientation, *state.velocity_mps, *state.angular_velocity_radps)
                for number, state in zip(numbers, states)} == golden_rows("body")
        assert {str(number): hexadecimal(*of["total_force_n"], *of["total_torque_nm"]) for number, of in zip(numbers, loads)} == golden_rows("force")
