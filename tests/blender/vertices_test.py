"""Vertices, foam and velocities of oceans match the command line's, on frames in any order, saved
and loaded.

usage: blender -b -P vertices_test.py -- PELAGIC FOLDER"""
import math
import subprocess
import sys
from pathlib import Path

import bpy
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from beside_query import ask, bound_m, compare, hash_of, values_of, vertices_of

from pelagic_ocean import sea_object

pelagic, folder = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_homefile(use_empty=True)
scene = bpy.context.scene
scene.render.fps, scene.render.fps_base = 24, 1


def add(preset, **settings):
    assert bpy.ops.pelagic.add_ocean(preset=preset) == {"FINISHED"}
    ocean = bpy.context.object
    ocean.pelagic.resolution = 64
    for system in settings.pop("systems", []):
        assert bpy.ops.pelagic.add_system() == {"FINISHED"}
        for name, value in system.items():
            setattr(ocean.pelagic.systems[-1], name, value)
    for name, value in settings.items():
        setattr(ocean.pelagic, name, value)
    assert not ocean.pelagic.error, ocean.pelagic.error
    return ocean


# Options as typed in the panel and on the command line. Some numbers are not exact in a float.
oceans = {
    "moderate": (add("moderate"), ["--preset", "moderate"], {}),
    "typed": (add("swell", wind_speed=9.3, wind_direction=math.radians(33.3), fetch=81234.5, depth=37.7, choppiness=0.77,
                  short_wave_cutoff=0.1, swell_height=1.3, swell_period=10.7, swell_direction=math.radians(-123.4),
                  swell_spread=math.radians(21.5), seed=77, loop_period=91.7, spreading="hasselmann", size=41.3, velocity=True),
              "--preset swell --wind-speed 9.3 --wind-direction 33.3 --fetch 81234.5 --depth 37.7 --choppiness 0.77 "
              "--short-wave-cutoff 0.1 --swell-height 1.3 --swell-period 10.7 --swell-direction -123.4 --swell-spread 21.5 --seed 77 "
              "--loop-period 91.7 --spreading hasselmann".split(), {}),
    "one cascade": (add("rough", cascade_side=250, cascade_resolution="128", size=250, foam=False), "--preset rough --patch-size 250 --resolution 128".split(), {}),
    "elsewhere": (add("moderate", place=(123456.5, -9876.25), cascades=2), "--preset moderate --cascades 2".split(), {"place": (123456.5, -9876.25)}),
    "systems": (add("calm", foam=False, systems=[{"height": 1.3, "peak_period": 9.7, "direction": math.radians(77), "spread": math.radians(15)},
                                                 {"height": 0, "wind_speed": 7.7, "fetch": 54321, "spreading": "hasselmann"}]),
                ["--preset", "calm", "--system", "height=1.3 period=9.7 direction=77 spread=15",
                 "--system", "wind-speed=7.7 fetch=54321 spreading=hasselmann"], {}),
    "storm": (add("storm"), ["--preset", "storm"], {"folds": 0.01}),
    "analytic": (add("analytic-moderate", wave_strength=1.2, foam=False), "--preset analytic-moderate --wave-strength 1.2".split(), {}),
    "pond": (add("pond", size=3, foam=False), ["--preset", "pond"], {}),
}
slow = add("moderate", speed=0.5, time_offset=7.7, first_frame=10)


def go_to(frame, subframe=0.0):
    scene.frame_set(frame, subframe=subframe)
    return (frame - 1 + subframe) / 24


def bits():
    return {name: (vertices_of(ocean).tobytes(), values_of(ocean, "foam").tobytes() if ocean.pelagic.foam else b"")
            for name, (ocean, *_) in oceans.items()}


seen = {}
for frame, subframe in ((1, 0), (48, 0), (49, 0.25), (30, 0), (500, 0), (48, 0), (1, 0)):
    time_s = go_to(frame, subframe)
    now = bits()
    assert seen.setdefault((frame, subframe), now) == now, "a frame differs when it is shown again"
    if frame not in (49, 48):
        continue
    for name, (ocean, sea, how) in oceans.items():
        print(name, end=", ")
        there, is_seen = compare(pelagic, sea, time_s, ocean, **how)
        if ocean.pelagic.foam:
            foam = values_of(ocean, "foam")
            off = numpy.abs(foam - there["foam"])[is_seen]
            assert off.max() < 1e-3 and foam.max() > 0.05, f"{name}: foam up to {foam.max()}, {off.max()} off"
assert len({each["storm"] for each in seen.values()}) == len(seen), "the storm stands still"

# Velocities; query returns them in Pelagic's axes.
ocean, sea, _ = oceans["typed"]
there, _ = compare(pelagic, sea, go_to(100), ocean)
velocity = values_of(ocean, "velocity", "vector", 3)
told = numpy.stack([there["vx"], -there["vz"], there["vy"]], axis=1)
assert numpy.abs(velocity - told).max() < 1e-3 and numpy.abs(velocity).max() > 0.3
print(f"velocity within {numpy.abs(velocity - told).max():.2g} m/s")

# Time: half speed, 7.7 s at frame 10.
scene.frame_set(34)
compare(pelagic, ["--preset", "moderate"], 7.7 + 0.5, slow)

# The frame's hash is the command line's: no typed option is rounded.
for name in ("moderate", "typed", "one cascade", "systems"):
    ocean, sea, _ = oceans[name]
    ours = f"{sea_object.moved(ocean.pelagic, 12.25).frame.hash:016x}"
    assert ours == hash_of(pelagic, sea, 12.25), f"{name}: another hash than the command line's"

# The .blend, loaded in two other processes, has bit-identical vertices.
go_to(48)
blend = str(Path(folder) / "seas.blend")
bpy.ops.wm.save_as_mainfile(filepath=blend)
here = {ocean.name: vertices_of(ocean) for ocean, *_ in oceans.values()}
numpy.savez(Path(folder) / "seas.npz", **here)
check = """
import bpy, numpy, sys
sys.path.insert(0, sys.argv[-2])
from beside_query import vertices_of
kept = numpy.load(sys.argv[-1])
for step in ("loaded", "after other frames"):
    for name in kept.files:
        assert vertices_of(bpy.data.objects[name]).tobytes() == kept[name].tobytes(), name + " " + step
    bpy.context.scene.frame_set(7)
    assert vertices_of(bpy.data.objects[name]).tobytes() != kept[name].tobytes()
    bpy.context.scene.frame_set(48)
print("equal bits", len(kept.files))
"""
for _ in range(2):
    answer = subprocess.run([bpy.app.binary_path, "-b", blend, "--python-exit-code", "1", "--python-expr", check, "--",
                             str(Path(__file__).resolve().parent), str(Path(folder) / "seas.npz")], capture_output=True, text=True)
    assert answer.returncode == 0 and f"equal bits {len(oceans)}" in answer.stdout, answer.stdout + answer.stderr
print("vertices_test passed")
