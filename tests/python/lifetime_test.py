"""Lifetimes of frames, arrays and oceans."""

import gc
import os
import subprocess
import sys
import textwrap

import numpy as np
import pelagic
import pytest


def test_a_view_is_the_oceans_memory_and_read_only(small):
    with pelagic.Ocean(small) as ocean:
        frame = ocean.frame_at(1)
        first, again = frame.displacement, frame.cascades[0].displacement
        assert first.dtype == np.float16 and first.shape == (64, 64, 4)
        assert np.shares_memory(first, again)
        assert not first.flags.writeable and not first.flags.owndata
        with pytest.raises(ValueError):
            first[0, 0, 0] = 1
        with pytest.raises(ValueError):
            first.flags.writeable = True
        height = frame.height
        height[:] = 0  # a copy
        assert frame.height.any()


def test_a_view_protects_its_memory_from_being_overwritten(small):
    with pelagic.Ocean(small) as ocean:
        kept = ocean.frame_at(1).displacement
        copy = kept.copy()
        ocean.frame_at(2)  # uses the memory of another frame
        np.testing.assert_array_equal(kept, copy)
        for ask in (ocean.frame_at, ocean.schedule):
            with pytest.raises(BufferError, match=r"an array of the frame of 1 s is still in use"):
                ask(3)
        np.testing.assert_array_equal(kept, copy)
        part = kept[3:5, ::2, 1]  # views of views, too
        del kept
        with pytest.raises(BufferError):
            ocean.frame_at(3)
        del part
        assert ocean.frame_at(3).time_s == 3
        np.testing.assert_array_equal(ocean.frame_at(1).displacement, copy)


def test_a_loop_that_keeps_the_last_array_raises_no_error(small):
    with pelagic.Ocean(small) as ocean:
        for time_s in range(20):
            displacement = ocean.frame_at(time_s).displacement
        assert displacement.any()


def test_a_frame_that_is_over_raises_an_error(small):
    with pelagic.Ocean(small, foam=True) as ocean:
        frame = ocean.frame_at(1)
        cascade = frame.cascades[0]
        hash_ = frame.hash
        ocean.frame_at(2)
        assert frame.hash == hash_ and frame.is_alive
        ocean.schedule(3)
        assert not frame.is_alive
        for ask in (lambda: frame.hash, lambda: frame.foam_hash, lambda: frame.displacement, lambda: frame.height, lambda: frame.cascades,
                    lambda: cascade.displacement, lambda: cascade.dx, lambda: cascade.compression, lambda: cascade.bounds, lambda: cascade.gradient_level(1),
                    lambda: frame.query([[0, 0]]), lambda: frame.rays([0, 9, 0], [0, -1, 0], 20), lambda: frame.displaced([[0, 0]]),
                    lambda: frame.displaced_foam([[0, 0]]), lambda: frame.sample_undisplaced([[0, 0]]), frame.measured_significant_wave_height_m):
            with pytest.raises(pelagic.StaleFrame, match="holds a later one"):
                ask()
        # its own data stays valid
        assert frame.time_s == 1 and frame.sea == small and frame.bounds.height_max_m > 0
        ocean.complete()


def test_frames_overlap_with_the_next(small):
    with pelagic.Ocean(small) as ocean:
        alone = [ocean.frame_at(t).hash for t in range(5)]
        ocean.schedule(0)
        seen = []
        for t in range(5):
            frame = ocean.complete()
            ocean.schedule(t + 1)
            seen.append(frame.hash)
        assert seen == alone
        ocean.complete()
        assert ocean.is_ready()


def test_calls_in_the_wrong_order_are_rejected(small):
    with pelagic.Ocean(small) as ocean:
        with pytest.raises(RuntimeError, match=r"no frame is in flight; call schedule\(\) first"):
            ocean.complete()
        ocean.schedule(1)
        for ask in (ocean.schedule, ocean.frame_at):
            with pytest.raises(RuntimeError, match=r"a frame is in flight; call complete\(\) first"):
                ask(2)
        assert ocean.complete().time_s == 1


def test_a_closed_ocean_raises_an_error(small):
    with pelagic.Ocean(small) as ocean:
        frame = ocean.frame_at(1)
        kept = frame.displacement
        copy = kept.copy()
        cascade = frame.cascades[0]
        assert not ocean.is_closed
    assert ocean.is_closed
    for ask in (lambda: ocean.frame_at(2), lambda: ocean.schedule(2), ocean.complete, ocean.is_ready, lambda: ocean.sea, lambda: ocean.isa,
                lambda: ocean.__enter__(), lambda: ocean.schedule_sea(small, 1, 1), lambda: frame.hash, lambda: frame.displacement,
                lambda: cascade.height, lambda: frame.query([[0, 0]])):
        with pytest.raises(ValueError, match="the ocean is closed"):
            ask()
    ocean.close()  # closing again is allowed
    gc.collect()
    np.testing.assert_array_equal(kept, copy)


def test_an_exception_closes_the_ocean_and_propagates(small):
    with pytest.raises(KeyError):
        with pelagic.Ocean(small) as ocean:
            ocean.schedule(1)  # in flight
            raise KeyError
    assert ocean.is_closed


def test_arrays_outlive_everything(small):
    def array():
        return pelagic.Ocean(small).frame_at(1).displacement

    kept = array()
    gc.collect()
    with pelagic.Ocean(small) as ocean:
        np.testing.assert_array_equal(kept, ocean.frame_at(1).displacement)


MEMORY = """
    import gc, sys
    import pelagic

    def bytes_resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * 4096

    sea = pelagic.Sea(resolution=16, patch_size_m=60)

    def references():
        return [sys.getrefcount(None), sys.getrefcount(True), sys.getrefcount(sea)]

    def frames(count):
        for i in range(count):
            frame = ocean.frame_at(i * 0.1)
            arrays = [frame.displacement, frame.height, frame.cascades[0].gradient, frame.cascades[0].compression]
            answers = frame.query([[i, 2.0], [3.0, 4.0]])
            frame.rays([0, 9, 0], [0, -1, 0], 20.0)
            frame.displaced([[1.0, i]])
            sea_of_frame, bounds = frame.sea, frame.bounds
            for wrong in (lambda: frame.query("x"), lambda: frame.cascades[0].gradient_level(9), lambda: ocean.frame_at(float("nan"))):
                try:
                    wrong()
                except ValueError:
                    pass

    with pelagic.Ocean(sea, foam=True) as ocean:
        frames(1000)
        gc.collect()
        before, held = bytes_resident(), references()
        frames(10000)
        gc.collect()
        print(bytes_resident() - before, max(abs(now - then) for now, then in zip(references(), held)))

    # Oceans, too: each of these uses 4 megabytes, which are freed when it is closed, even if it or
    # a frame of it is still referenced.
    kept = []
    for i in range(100):
        with pelagic.Ocean(pelagic.Sea(), queries=False) as ocean:
            frame = ocean.frame_at(i)
            view = frame.displacement if i % 2 else None
        view = None
        kept.append((ocean, frame))
    print(bytes_resident() - before)
"""


def test_ten_thousand_frames_use_constant_memory():
    printed = subprocess.run([sys.executable, "-c", textwrap.dedent(MEMORY)], check=True, capture_output=True, text=True,
                             env={**os.environ, "MALLOC_ARENA_MAX": "2"}).stdout
    frames, references, oceans = map(int, printed.split())
    assert frames < 512 * 1024  # fifty bytes a frame would be more
    assert oceans < 32 * 1024 * 1024
    assert references < 1000  # one a frame would be ten thousand
