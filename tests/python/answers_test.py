"""Values of a frame, compared with independent computations."""

import signal
import warnings

import numpy as np
import pelagic
import pytest


def at_points(array, cascade, x, z, drift=(0, 0)):
    """Interpolates bilinearly and periodically on a cascade's grid, in double."""
    cosine, sine = cascade.rotation
    step = cascade.patch_size_m / cascade.resolution
    u, v = (cosine * x + sine * z) / step - drift[0], (cosine * z - sine * x) / step - drift[1]
    i, j = np.floor(u).astype(int), np.floor(v).astype(int)
    u, v = u - i, v - j
    n = cascade.resolution
    a = array.astype(np.float64)
    upper = a[j % n, i % n] * (1 - u) + a[j % n, (i + 1) % n] * u
    lower = a[(j + 1) % n, i % n] * (1 - u) + a[(j + 1) % n, (i + 1) % n] * u
    return upper * (1 - v) + lower * v


@pytest.fixture
def places():
    return np.random.default_rng(3).uniform(-900, 900, (40, 50, 2))


def test_displaced_is_the_sum_of_cascades(places):
    with pelagic.Ocean(pelagic.preset("rough"), foam=True) as ocean:
        frame = ocean.frame_at(3)
        x, z = places[..., 0], places[..., 1]
        moved = sum(np.stack([at_points(plane, cascade, x, z) for plane in (cascade.dx, cascade.height, cascade.dz)], -1) for cascade in frame.cascades)
        moved += np.stack([x, np.zeros_like(x), z], -1)
        shown = frame.displaced(places)
        assert shown.dtype == np.float32 and shown.shape == (40, 50, 3)
        # half of a float's last digit at 900 m is 3e-5
        np.testing.assert_allclose(shown, moved, rtol=0, atol=5e-5)
        np.testing.assert_array_equal(frame.displaced(x, z), shown)

        assert frame.cascades[3].compression is None and frame.cascades[3].snapshots is None
        breaking = lambda sums: np.clip(0.5 + (sums - frame.foam_threshold) / 0.3, 0, 1)
        foam = breaking(sum(-3 + 8 / 255 * at_points(cascade.compression, cascade, x, z) for cascade in frame.cascades[:3]))
        for snapshot, age in enumerate(frame.snapshot_ages):
            sums = sum(-3 + 8 / 255 * at_points(cascade.snapshots[snapshot // 4][..., snapshot % 4], cascade, x, z, cascade.drift)
                       for cascade in frame.cascades[:3])
            foam = np.maximum(foam, breaking(sums) - age)
        assert foam.max() > 0.2
        # floats of sums up to 5, over 0.3
        np.testing.assert_allclose(frame.displaced_foam(places), foam, rtol=0, atol=1e-4)


def test_undisplaced_points_are_sampled_at_once(places):
    points = places.reshape(-1, 2)
    with pelagic.Ocean(pelagic.preset("rough"), foam=True, velocities=True) as ocean:
        frame = ocean.frame_at(3)
        water = frame.sample_undisplaced(points)
        assert {name: (array.dtype.str, array.shape) for name, array in water.items()} == {
            "displacement": ("<f4", (2000, 3)), "velocity": ("<f4", (2000, 3)), "foam": ("<f4", (2000,))}
        drawn = water["displacement"] + np.stack([points[:, 0], np.zeros(2000), points[:, 1]], -1)
        # half of a float's last digit at 900 m
        np.testing.assert_allclose(drawn, frame.displaced(points), rtol=0, atol=4e-5)
        np.testing.assert_array_equal(water["foam"], frame.displaced_foam(points))
        moving = frame.query(drawn[:, [0, 2]], fields=["velocity"])["velocity"]
        # a millimetre away it differs
        np.testing.assert_allclose(water["velocity"], moving, rtol=0, atol=5e-3)
        for wrong in ([1.0, 2.0], [[1.0, 2.0, 3.0]], [[np.nan, 0.0]], [[0.0, 2e9]]):
            with pytest.raises(ValueError, match="^points.* (expected|is out of range) "):
                frame.sample_undisplaced(wrong)
    with pelagic.Ocean(pelagic.preset("rough")) as ocean:
        assert list(ocean.frame_at(3).sample_undisplaced(points)) == ["displacement"]


def test_a_query_returns_the_displaced_water_at_a_point(places):
    with pelagic.Ocean(pelagic.preset("moderate"), velocities=True) as ocean:
        frame = ocean.frame_at(3)
        drawn = frame.displaced(places)
        answers = frame.query(drawn[..., 0], drawn[..., 2])
        assert {name: (array.dtype.str, array.shape) for name, array in answers.items()} == {
            "height": ("<f4", (40, 50)), "normal": ("<f4", (40, 50, 3)), "jacobian": ("<f4", (40, 50)), "velocity": ("<f4", (40, 50, 3)),
            "converged": ("|b1", (40, 50)), "error": ("<f4", (40, 50))}
        assert answers["converged"].all()
        np.testing.assert_allclose(answers["height"], drawn[..., 1], rtol=0, atol=1e-3)
        np.testing.assert_allclose(np.linalg.norm(answers["normal"], axis=-1), 1, rtol=0, atol=1e-6)
        some = frame.query(drawn[..., 0], drawn[..., 2], fields=["height", "velocity"])
        assert sorted(some) == ["height", "velocity"]
        np.testing.assert_array_equal(some["velocity"], answers["velocity"])
        # A scalar z is broadcast to all x, as in NumPy.
        np.testing.assert_array_equal(frame.query([1.0, 2.0], 5.0)["height"], frame.query([[1.0, 5.0], [2.0, 5.0]])["height"])
        assert frame.query(1.0, 5.0)["height"].shape == ()
        assert frame.query(np.empty((0, 2)))["normal"].shape == (0, 3)


def test_rays_that_miss_have_no_place():
    with pelagic.Ocean(pelagic.preset("rough")) as ocean:
        frame = ocean.frame_at(3)
        up = frame.rays([0, -20, 0], [[0, 1, 0], [0, -1, 0]], [100, 50])
        np.testing.assert_array_equal(up["hit"], [True, False])
        np.testing.assert_array_equal(up["from_below"], [True, False])
        assert up["position"][0][1] == pytest.approx(float(frame.query(0, 0)["height"]), abs=2e-3)
        assert up["distance"][1] == np.inf and np.isnan(up["position"][1]).all() and np.isnan(up["normal"][1]).all()


def test_chains_halve_from_level_to_level(small):
    with pelagic.Ocean(small, slopes=True, foam=True) as ocean:
        cascade = ocean.frame_at(3).cascades[0]
        assert cascade.levels == 7
        for level in range(cascade.levels):
            side = 64 >> level
            for chain in (cascade.gradient_level, cascade.slopes_level, cascade.moments_level):
                assert chain(level).shape == (side, side, 4)
        for name in ("gradient", "slopes", "moments"):
            np.testing.assert_array_equal(getattr(cascade, name), getattr(cascade, f"{name}_level")(0))
        assert cascade.compression.shape == (64, 64) and [image.shape for image in cascade.snapshots] == 4 * [(64, 64, 4)]


def test_measured_height_is_that_of_the_sea():
    with pelagic.Ocean(pelagic.preset("rough")) as ocean:
        frame = ocean.frame_at(3)
        waves = ocean.sea.report()
        assert frame.significant_wave_height_m == pytest.approx(waves.significant_wave_height_m, rel=1e-9)
        # The cascades' heights are independent, so their variances add.
        assert frame.measured_significant_wave_height_m() == pytest.approx(
            4 * np.sqrt(sum(np.var(cascade.height.astype(float)) for cascade in frame.cascades)), rel=1e-6)


def test_a_frame_between_two_seas_has_both():
    first = pelagic.Sea(wind_speed_mps=10, roughness=0.2)
    then = pelagic.Sea(spectrum="phillips", spreading="hasselmann", swell_height_m=2, wind_speed_mps=8)
    with pelagic.Ocean(first, largest_peak_m=then.report().peak_wavelength_m) as ocean:
        ocean.schedule_sea(then, from_s=10, over_s=10)
        between = ocean.frame_at(14).sea
        assert 8 < between.wind_speed_mps < 10 and 0 < between.swell_height_m < 2
        assert between.spectrum == "jonswap" and ocean.frame_at(30).sea == then
    with pelagic.Ocean(first) as ocean, pytest.raises(ValueError, match=r"^change 1: peak_wavelength_m is .* largest_peak_m"):
        ocean.schedule_sea(then, from_s=10, over_s=10)


def test_a_series_equals_queries_of_frames():
    points, times = np.random.default_rng(4).uniform(-300, 300, (5, 7, 2)), [3.5, 0.0, 7.25]
    with pelagic.Ocean(pelagic.Sea(resolution=64), velocities=True, foam=True) as ocean:
        for interpolation in ("linear", "cubic"):
            series = ocean.series(points, times, interpolation=interpolation)
            assert series["height"].shape == (3, 5, 7) and series["normal"].shape == series["velocity"].shape == (3, 5, 7, 3)
            assert {name: array.dtype for name, array in series.items()}["converged"] == np.bool_
            for i, time_s in enumerate(times):
                answers = ocean.frame_at(time_s).query(points, interpolation=interpolation)
                assert list(answers) == list(series)
                for name in ("height", "normal", "jacobian", "velocity", "converged", "error"):
                    np.testing.assert_array_equal(series[name][i], answers[name], name)
        assert list(ocean.series([0, 0], [1], fields=["height"])) == ["height"]
        assert ocean.series([[0, 0]], [], fields=["normal"])["normal"].shape == (0, 1, 3)
        many = np.linspace(-3, 9, 40)  # several calls of the library, each of more times
        one_by_one = [ocean.frame_at(time_s).query(points)["normal"] for time_s in many]
        np.testing.assert_array_equal(ocean.series(points, many, interpolation="linear")["normal"], one_by_one)
        np.testing.assert_array_equal(ocean.series(points[0, 0], many[::-1], interpolation="linear")["normal"], np.array(one_by_one)[::-1, 0, 0])
        cubic = ocean.series(points, times)["height"]
        np.testing.assert_array_equal(cubic, ocean.series(points, times, interpolation="cubic")["height"])

        # A view of a frame is safe from a series, and an error does not change the ocean.
        frame = ocean.frame_at(1)
        view = frame.displacement
        with pytest.raises(BufferError):
            ocean.series(points, times)
        assert frame.is_alive
        del view
        ocean.series(points, [5])
        assert frame.is_alive
        ocean.series(points, [5, 6])
        with pytest.raises(pelagic.StaleFrame):
            frame.query(points)
        with pytest.raises(ValueError, match=r"times.shape is \(\), expected \(n,\): seconds"):
            ocean.series(points, 3.0)
        with pytest.raises(ValueError, match="times is nan, expected finite numbers of seconds"):
            ocean.series(points, [0, np.nan])
        assert ocean.frame_at(2).hash
    with pelagic.Ocean(pelagic.Sea(resolution=64)) as still:
        frame = still.frame_at(1)
        with pytest.raises(ValueError, match="velocities"):
            still.series(points, times, fields=["velocity"])
        assert not frame.is_alive and still.frame_at(2).is_alive and not frame.is_alive


def test_velocities_are_those_of_the_drawn_surface_or_of_the_water():
    sea, points = pelagic.Sea(resolution=64, patch_size_m=250), [[3.0, 4.0], [100.0, -20.0]]
    found = {}
    for velocities in (False, "none", True, "drawn", "water"):
        with pelagic.Ocean(sea, velocities=velocities) as ocean:
            frame = ocean.frame_at(9)
            found[velocities] = frame.query(points).get("velocity")
            if velocities not in (True, "drawn"):
                with pytest.raises(ValueError, match="^the frame does not have it: create the ocean with velocities=True$"):
                    frame.cascades[0].velocity_x
    assert found[False] is None and found["none"] is None and (found[True] == found["drawn"]).all()
    assert np.isfinite(found["water"]).all() and not np.allclose(found["water"], found["drawn"])
    with pytest.raises(ValueError, match="^velocities is 'sum', expected True, False, none, drawn or water$"):
        pelagic.Ocean(sea, velocities="sum")


def test_a_signal_ends_a_series(small):
    class Interrupted(Exception):
        pass

    def interrupt(*_):
        raise Interrupted

    count = 5_000_000
    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        with pelagic.Ocean(small) as ocean:
            expected = ocean.frame_at(7).hash
            signal.setitimer(signal.ITIMER_REAL, 0.05)
            with pytest.raises(Interrupted):
                ocean.series([0, 0], np.linspace(0, 100, count), fields=["height"])
            after = ocean.frame_at(7)
            assert after.hash == expected and after._number < count
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_a_series_longer_than_the_loop_is_rejected():
    with pelagic.Ocean(pelagic.Sea(resolution=64, patch_size_m=250)) as ocean:
        with pytest.raises(ValueError, match=r"^times span 7200 s, but the sea repeats after 3600 s: loop_period_s=10800 is long enough, "
                                             r"and repeats=True permits repetition$"):
            ocean.series([0, 0], [0, 3600, 7200])
        heights = ocean.series([0, 0], [0, 3600, 7200], repeats=True)["height"]
        assert heights[0] == heights[1] == heights[2]
        ocean.series([0, 0], [-1800, 1800])  # one loop, closed
    with pelagic.Ocean(pelagic.Sea(resolution=64, patch_size_m=250, loop_period_s=10800)) as ocean:
        assert len(set(ocean.series([0, 0], [0, 3600, 7200])["height"])) == 3


def test_points_beyond_the_repeat_length_give_a_warning(small):
    with pelagic.Ocean(small) as ocean:
        frame = ocean.frame_at(0)
        for ask in (frame.query, lambda points: ocean.series(points, [0])):
            with pytest.warns(UserWarning, match=r"^the points span more than the 250 m after which the longest waves repeat$") as noted:
                ask([[0, 0], [3, 251]])
            assert noted[0].filename == __file__
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                ocean.frame_at(0).query([[0, 0], [250, 250], [np.nan, 9]])
