# Wakes of hulls in Godot: states of 200 frames in waves that equal those of the C interface bit for
# bit, and pressures that go with their hulls.
# usage: wakes_test.py PROJECT LIBRARY
import ctypes
import json
import sys
import tempfile
from pathlib import Path

from engine import run_headless, single

here = Path(__file__).parent
sys.path.append(str(here.parents[1] / "python/pelagic"))
sys.dont_write_bytecode = True
import _native as pelagic  # noqa: E402
from _native import make  # noqa: E402
from c_bodies import CBodies  # noqa: E402

project, library_file = sys.argv[1:]
step_s = 1 / 60

# A prism with pointed ends, 1 m high, half of it in the water. Its plan is 3 x 2 m between two
# triangles of 2 x 2 m.
outline = [(-1.5, 1), (1.5, 1), (3.5, 0), (1.5, -1), (-1.5, -1), (-3.5, 0)]
corners = [coordinate for y in (-0.5, 0.5) for x, z in outline for coordinate in (x, y, z)]
sides = [triangle for i in range(6) for j in [(i + 1) % 6] for triangle in ((i, j, j + 6), (i, j + 6, i + 6))]
caps = [triangle for i in range(1, 5) for triangle in ((6, 6 + i, 7 + i), (0, i + 1, i))]
faces = [corner for triangle in sides + caps for corner in triangle]
draught_m = 0.5
mass_kg = (3 * 2 + 2 * 2) * draught_m * 1025  # Archimedes
sea = {"cascades": 2, "resolution": 32, "wind_speed_mps": 8, "depth": True, "dynamic_waves": True,
       "dynamic_waves_resolution": 64, "dynamic_waves_side_m": 32, "dynamic_waves_border_m": 6}
still_sea = {**sea, "cascades": 1, "patch_size_m": 100, "wind_speed_mps": 0.01}
cases = [{"name": "ticks", "frames": 200, "steps": 1}, {"name": "slow", "frames": 66, "steps": 3}]
appended = 8  # bytes of the node after those of the C interface


class CInterface(CBodies):
    def __init__(self):
        super().__init__(library_file)
        options = make(pelagic.pelagic_sea)
        options.cascades, options.resolution, options.wind_speed_mps = sea["cascades"], sea["resolution"], sea["wind_speed_mps"]
        waves = make(pelagic.pelagic_dynamic_waves_options)
        waves.resolution, waves.side_m, waves.border_m = 64, 32, 6
        self.ocean, self.waves, self.hull = ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_void_p()
        self.call("ocean_create", options,
                  make(pelagic.pelagic_ocean_options, queries=1, depth=1, dynamic_waves=ctypes.addressof(waves)),
                  ctypes.byref(self.ocean))
        self.call("ocean_dynamic_waves", self.ocean, ctypes.byref(self.waves))
        hull = make(pelagic.pelagic_hull_options)
        hull.mass_kg, hull.centre_of_mass_m = mass_kg, self.address(ctypes.c_double, (0, 0, 0))
        self.call("hull_create",
                  make(pelagic.pelagic_hull_mesh, vertex_count=len(corners) // 3, vertices_m=self.address(ctypes.c_double, corners),
                        triangle_count=len(faces) // 3, triangles=self.address(ctypes.c_uint32, faces)),
                  hull, ctypes.byref(self.hull))

    def bodies(self, *places, wakes=1):
        bodies, number = ctypes.c_void_p(), ctypes.c_uint32()
        self.call("bodies_create", self.ocean, make(pelagic.pelagic_bodies_options, wakes=wakes), ctypes.byref(bodies))
        for x_m, z_m in places:
            state = pelagic.pelagic_hull_state()
            self.call("hull_at_rest", self.hull, x_m, z_m, 0.0, state)
            self.call("bodies_add", bodies, self.hull, state, ctypes.byref(number))
        return bodies

    def frames(self, frames, steps):
        """Yields the state after the steps of each frame, and the hash of its dynamic waves."""
        bodies = None
        for frame in range(frames):
            if bodies:
                self.call("bodies_press", bodies, sum([step_s] * steps))
            self.call("ocean_schedule", self.ocean, frame * steps / 60.0)
            self.call("ocean_complete", self.ocean, pelagic.pelagic_frame())
            bodies = bodies or self.bodies((0, 0))
            inputs = make(pelagic.pelagic_hull_inputs)
            inputs.force.force_n[:] = [3000, 0, 500] if frame < frames // 2 else [0, 0, 0]
            self.call("bodies_set_inputs", bodies, 1, inputs)
            for _ in range(steps):
                self.call("bodies_step", bodies, step_s, None)
            hash_ = ctypes.c_uint64()
            self.call("dynamic_waves_hash", self.waves, ctypes.byref(hash_))
            yield self.saved(bodies), f"{hash_.value:016x}"


def play(work, given, fps):
    # The engine's triangles are wound the other way.
    numbers = [number for i in range(0, len(faces), 3) for number in (faces[i], faces[i + 2], faces[i + 1])]
    common = {"vertices": corners, "numbers": numbers, "mass_kg": mass_kg, "sea": sea, "still_sea": still_sea}
    return run_headless(project, here / "wakes.gd", work, {"GIVEN": json.dumps({**common, **given}), "FILES": str(work)}, fps=fps)


def water(name, at_s):
    return [at_s, "water", name]


def check_water(says):
    for words in says["water"]:
        name, height_m = words.split()
        expected_m, bound_m = (-draught_m, 0.02 * draught_m) if name == "rest" else (0, 0.03 * draught_m)
        assert abs(float(height_m) - expected_m) < bound_m, says["water"]


# The hull's hollow after changes that begin or end its pressure.
changes = [water("rest", 13), [13, "free_hull"], water("none", 19), [19, "make_hull"], water("rest", 32),
           [32, "leave"], water("none", 38), [38, "enter"], water("rest", 50),
           [50, "set", "hull", "wake", False], water("none", 56), [56, "set", "hull", "wake", True], water("rest", 68),
           [68, "set", "ocean", "foam", False], water("none", 68.1), water("rest", 80),
           [80, "set", "hull", "playing", False], water("none", 86), [86, "set", "hull", "playing", True], water("rest", 98),
           [98, "refusals"], [98, "free_ocean"], [99, "refusals"], [99, "make_ocean"], water("rest", 112), [112, "refusals"], [112, "end"]]
errors = [
    "the saved hull is damaged, expected the bytes that save_state() returned",
    "the saved bodies have a wrong size, expected as many bytes as their counts give",
    "the saved hull is damaged, expected the bytes that save_state() returned",
    "the number of saved bodies is 2, expected 1",
    "the saved bodies have no wakes, expected bodies with wakes",
]


with tempfile.TemporaryDirectory() as folder:
    work = Path(folder)
    there = CInterface()
    (work / "two").write_bytes(there.saved(there.bodies((0, 0), (9, 0))) + bytes(appended))
    (work / "dry").write_bytes(there.saved(there.bodies((0, 0), wakes=0)) + bytes(appended))
    says = play(work, {"cases": cases, "events": changes}, 60)

    compared = 0
    for case in cases:
        states = (work / case["name"]).read_bytes()
        size = len(states) // case["frames"]
        assert len(says[case["name"]]) == case["frames"]
        seen = set()
        for frame, (state, waves) in enumerate(CInterface().frames(case["frames"], case["steps"])):
            assert states[size * frame:size * (frame + 1) - appended] == state, (case["name"], frame)
            assert says[case["name"]][frame] == waves, (case["name"], frame)
            seen.add(waves)
            compared += 1
        assert len(seen) > 0.9 * case["frames"], "the hull makes waves"
    assert says["restored"] == ["same True", "new True"], says["restored"]
    assert json.loads(single(says, "errors")) == errors, says["errors"]
    assert single(says, "unchanged") == "True"

    # Hollows in the first and in the second ocean. At the end the hull has turned by 15 degrees,
    # and the depth of its hollow differs by 8 % between texels.
    hollows_m = [(draught_m, 0), (0, draught_m), (0, draught_m / 2), (0, draught_m / 2), (0, draught_m / 2)]
    for height_m, hollow_m in zip(map(float, says["moved"]), [hollow_m for pair in hollows_m for hollow_m in pair], strict=True):
        assert abs(height_m + hollow_m) < (0.1 * hollow_m or 0.03 * draught_m), says["moved"]
    assert single(says, "moved_errors") == "[]"

    assert len(says["water"]) == sum(event[1] == "water" for event in changes)
    check_water(says)
    assert list(map(json.loads, says["refusals"])) == [[], ["ocean is ../sea, expected the path of a PelagicOcean"], []], says["refusals"]
    # Frames of many steps, and steps of several frames.
    for fps in (8, 144):
        check_water(play(work, {"events": [water("rest", 13), [13, "end"]]}, fps))
print(f"{compared} states and hashes and {len(errors)} errors agree")
