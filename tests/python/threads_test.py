"""Other Python threads run while the sea is computed and queried, and may query it themselves."""

import sys
import threading
import time

import numpy as np
import pelagic
import pytest


@pytest.fixture
def counter():
    """Counts in another thread, which runs only when this thread releases the interpreter lock,
    because the switch interval is practically infinite."""
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e6)
    counts = [0]
    is_over = threading.Event()

    def count():
        while not is_over.is_set():
            counts[0] += 1
            time.sleep(0)  # releases the lock, too

    thread = threading.Thread(target=count)
    thread.start()
    yield counts
    is_over.set()
    thread.join()
    sys.setswitchinterval(interval)


def calls():
    def scheduled(ocean):
        ocean.schedule(1)
        return ocean.complete

    points = np.random.default_rng(1).uniform(-1000, 1000, (20000, 2))
    rays = np.random.default_rng(1).uniform([-50, 9, -50], [50, 20, 50], (100, 3))
    return {
        "frame_at": lambda ocean: lambda: ocean.frame_at(1),
        "complete": scheduled,
        "query": lambda ocean: lambda frame=ocean.frame_at(1): frame.query(points),
        "rays": lambda ocean: lambda frame=ocean.frame_at(1): frame.rays(rays, [1, -0.01, 0.3], 3000),
        "displaced": lambda ocean: lambda frame=ocean.frame_at(1): frame.displaced(points),
        "hash": lambda ocean: lambda frame=ocean.frame_at(1): frame.hash,
        "Ocean": lambda ocean: lambda: pelagic.Ocean(pelagic.Sea(resolution=256)),
    }


@pytest.mark.parametrize("name", calls())
def test_calls_release_the_interpreter_lock(counter, name):
    with pelagic.Ocean(pelagic.Sea(resolution=256), threads=1) as ocean:
        for _ in range(1000):  # a busy machine may not schedule the other thread the first time
            call = calls()[name](ocean)
            before = counter[0]
            call()
            if counter[0] > before:
                return
        pytest.fail(f"{name} keeps all other threads of Python from running")


def test_the_counter_stops_while_the_lock_is_held(counter):
    before = counter[0]
    sum(range(3_000_000))
    assert counter[0] == before


def test_concurrent_queries_are_bit_identical():
    points = np.random.default_rng(2).uniform(-1000, 1000, (5000, 2))
    with pelagic.Ocean(pelagic.preset("rough")) as ocean:
        frame = ocean.frame_at(1)
        expected = frame.query(points)
        wrong = []

        def ask():
            for _ in range(10):
                answers = frame.query(points)
                wrong.extend(name for name in expected if not np.array_equal(answers[name], expected[name]))

        threads = [threading.Thread(target=ask) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert wrong == []


def test_queries_during_other_frames_are_bit_identical_or_raise_an_error(small):
    points = np.random.default_rng(2).uniform(-1000, 1000, (3000, 2))
    with pelagic.Ocean(small, threads=2) as ocean:
        expected = {}
        for time_s in range(8):
            frame = ocean.frame_at(time_s)
            expected[time_s] = (frame.hash, frame.query(points)["height"])
        newest, wrong, answered = [frame], [], [0]
        is_over = threading.Event()

        def ask():
            while not is_over.is_set():
                asked = newest[0]
                hash_, heights = expected[asked.time_s]
                try:
                    if asked.hash != hash_ or not np.array_equal(asked.query(points)["height"], heights):
                        wrong.append(asked.time_s)
                    answered[0] += 1
                except pelagic.StaleFrame:
                    pass

        threads = [threading.Thread(target=ask) for _ in range(4)]
        for thread in threads:
            thread.start()
        count = 0
        while count < 500 or answered[0] < 50:
            newest[0] = ocean.frame_at(count % 8)
            count += 1
        is_over.set()
        for thread in threads:
            thread.join()
        assert wrong == []


def test_threads_may_share_one_ocean(small):
    with pelagic.Ocean(small) as ocean:
        expected = {time_s: ocean.frame_at(time_s).hash for time_s in range(8)}
        wrong, right = [], []

        def compute(seed):
            for time_s in np.random.default_rng(seed).integers(0, 8, 100).tolist():
                frame = ocean.frame_at(time_s)
                try:
                    (right if frame.hash == expected[time_s] else wrong).append(time_s)
                except pelagic.StaleFrame:
                    pass

        threads = [threading.Thread(target=compute, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert wrong == [] and right


def test_closing_waits_for_queries():
    points = np.random.default_rng(2).uniform(-1000, 1000, (20000, 2))
    for _ in range(10):
        ocean = pelagic.Ocean(pelagic.Sea(), threads=1)
        frame = ocean.frame_at(1)
        expected = frame.query(points)["height"]
        found = []

        def ask():
            try:
                while True:
                    found.append(np.array_equal(frame.query(points)["height"], expected))
            except ValueError as closed:
                found.append("closed" in str(closed))

        thread = threading.Thread(target=ask)
        thread.start()
        while len(found) < 2:
            time.sleep(0)
        ocean.close()
        thread.join()
        assert all(found)
