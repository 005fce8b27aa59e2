# Wakes of hulls in Godot: states of 200 frames in waves that equal those of the C interface bit for
# bit, draughts at rest and waves of a towed hull at several frame rates, and pressures that go with
# their hulls.
# usage: wakes_test.py PROJECT LIBRARY
import ctypes
import json
import math
import sys
import tempfile
from pathlib import Path

from engine import run_headless, single

here = Path(__file__).parent
sys.path.append(str(here.parent / "bindings"))
sys.dont_write_bytecode = True
import pelagic_ctypes as pelagic  # noqa: E402

project, library_file = sys.argv[1:]
step_s = 1 / 60

# A box of 4 x 1 x 2 m, half of it in the water.
corners = [coordinate for x in (-2, 2) for y in (-0.5, 0.5) for z in (-1, 1) for coordinate in (x, y, z)]
faces = [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3]
mass_kg = 0.5 * 8 * 1025
draught_m = 0.5  # Archimedes
sea = {"cascades": 2, "resolution": 32, "wind_speed_mps": 8, "velocities": True, "dynamic_waves": True,
       "dynamic_waves_resolution": 64, "dynamic_waves_side_m": 32, "dynamic_waves_border_m": 6}
still_sea = {**sea, "cascades": 1, "patch_size_m": 100, "wind_speed_mps": 0.01}
cases = [{"name": "ticks", "frames": 200, "steps": 1}, {"name": "slow", "frames": 66, "steps": 3}]
appended = 32  # bytes of the node after those of the C interface


def sized(type_, **fields):
    return type_(struct_size=ctypes.sizeof(type_), **fields)


class CInterface:
    def __init__(self):
        self.library = pelagic.load(library_file)
        options = sized(pelagic.pelagic_sea)
        self.call("sea_defaults", options)
        options.cascades, options.resolution, options.wind_speed_mps = sea["cascades"], sea["resolution"], sea["wind_speed_mps"]
        waves = sized(pelagic.pelagic_dynamic_waves_options)
        self.call("dynamic_waves_defaults", waves)
        waves.resolution, waves.side_m, waves.border_m = 64, 32, 6
        self.ocean, self.waves, self.hull = ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_void_p()
        self.call("ocean_create", options,
                  sized(pelagic.pelagic_ocean_options, queries=1, velocities=1, dynamic_waves=ctypes.addressof(waves)),
                  ctypes.byref(self.ocean))
        self.call("ocean_dynamic_waves", self.ocean, ctypes.byref(self.waves))
        hull = sized(pelagic.pelagic_hull_options)
        self.call("hull_defaults", hull)
        hull.mass_kg = mass_kg
        self.call("hull_create",
                  sized(pelagic.pelagic_hull_mesh, vertex_count=len(corners) // 3, vertices_m=(ctypes.c_double * len(corners))(*corners),
                        triangle_count=len(faces) // 3, triangles=(ctypes.c_uint32 * len(faces))(*faces)),
                  hull, ctypes.byref(self.hull))

    def call(self, name, *arguments):
        status = getattr(self.library, "pelagic_" + name)(*arguments)
        assert status == pelagic.PELAGIC_OK, f"{name}: {self.library.pelagic_last_error().decode()}"

    def bodies(self, *places, wakes=1):
        bodies, number = ctypes.c_void_p(), ctypes.c_uint32()
        self.call("bodies_create", self.ocean, sized(pelagic.pelagic_bodies_options, wakes=wakes), ctypes.byref(bodies))
        for x_m, z_m in places:
            state = sized(pelagic.pelagic_hull_state)
            self.call("hull_at_rest", self.hull, x_m, z_m, 0.0, state)
            self.call("bodies_add", bodies, self.hull, state, number)
        return bodies

    def saved(self, bodies):
        count = ctypes.c_size_t()
        self.call("bodies_save_state", bodies, None, 0, count)
        saved = (ctypes.c_uint8 * count.value)()
        self.call("bodies_save_state", bodies, saved, count, count)
        return bytes(saved)

    def frames(self, frames, steps):
        """Yields the state after the steps of each frame, and the hash of its dynamic waves."""
        bodies = None
        for frame in range(frames):
            if bodies:
                self.call("bodies_press", bodies, sum([step_s] * steps))
            self.call("ocean_schedule", self.ocean, frame * steps / 60.0)
            self.call("ocean_complete", self.ocean, sized(pelagic.pelagic_frame))
            bodies = bodies or self.bodies((0, 0))
            inputs = sized(pelagic.pelagic_hull_inputs)
            inputs.force.force_n[:] = [3000, 0, 500] if frame < frames // 2 else [0, 0, 0]
            self.call("bodies_set_inputs", bodies, 1, inputs)
            for _ in range(steps):
                self.call("bodies_step", bodies, step_s)
            hash_ = ctypes.c_uint64()
            self.call("dynamic_waves_hash", self.waves, hash_)
            yield self.saved(bodies), f"{hash_.value:016x}"


def play(work, given, fps):
    # The engine's triangles are wound the other way.
    numbers = [number for i in range(0, len(faces), 3) for number in (faces[i], faces[i + 2], faces[i + 1])]
    common = {"vertices": corners, "numbers": numbers, "half_height_m": 0.5, "mass_kg": mass_kg, "sea": sea, "still_sea": still_sea}
    return run_headless(project, here / "wakes.gd", work, {"GIVEN": json.dumps({**common, **given}), "FILES": str(work)}, fps=fps)


def water(name, at_s):
    return [at_s, "water", name]


def draughts(until_s):
    return [[half / 2, "draught"] for half in range(1, 2 * until_s)]


# Pressures that begin and end: the hull's hollow after each change.
changes = [*draughts(13), water("rest", 13), [13, "free_hull"], water("none", 19), [19, "make_hull"], water("rest", 32),
           [32, "leave"], water("none", 38), [38, "enter"], water("rest", 50),
           [50, "set", "hull", "wake", False], water("none", 56), [56, "set", "hull", "wake", True], water("rest", 68),
           [68, "set", "ocean", "foam", False], water("none", 68.1), water("rest", 80),
           [80, "set", "hull", "playing", False], water("none", 86), [86, "set", "hull", "playing", True], water("rest", 98),
           [98, "refusals"], [98, "free_ocean"], [99, "refusals"], [99, "make_ocean"], water("rest", 112), [112, "draught"],
           [112, "refusals"], [112, "end"]]
tow = [*draughts(16), [16, "set", "hull", "inertia_kgm2", [4000, 1e8, 6000]], [24, "set", "hull", "force_n", [1500, 0, 0]],
       [40, "profile"], [40, "refusals"], [40, "end"]]
with tempfile.TemporaryDirectory() as folder:
    work = Path(folder)
    there = CInterface()
    (work / "two").write_bytes(there.saved(there.bodies((0, 0), (9, 0))) + bytes(appended))
    (work / "dry").write_bytes(there.saved(there.bodies((0, 0), wakes=0)) + bytes(appended))
    says = play(work, {"cases": cases, "events": changes}, 60)
    print(says["lines"])
    for fps in (60, 30, 144, 45, 8):
        t = play(work, {"events": tow, "follow": True, "towed_s": 34}, fps)
        print(fps, t["draught"], t["speed"], t["profile"], t["refusals"])
