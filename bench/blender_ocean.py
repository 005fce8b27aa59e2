# Benchmark of Pelagic's ocean and Blender's own Ocean modifier in one Blender: 256 faces a side,
# and the time from a step of the timeline to the moved mesh. Both take turns, frame by frame;
# prints medians.
#
#   blender -b --python-exit-code 1 -P bench/blender_ocean.py [-- --resolution 16 --frames 40]
#
# --resolution is the modifier's: its mesh and its transform have the square of it, 256 by 256 for
# 16.
import argparse
import statistics
import sys
import time

import bpy

arguments = argparse.ArgumentParser()
arguments.add_argument("--resolution", type=int, default=16)
arguments.add_argument("--frames", type=int, default=40)
options = arguments.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
side = options.resolution ** 2

bpy.ops.wm.read_homefile(use_empty=True)
own_scene, our_scene = bpy.context.scene, bpy.data.scenes.new("Pelagic")


def make_own(foam):
    mesh = bpy.data.meshes.new("own")
    ocean = bpy.data.objects.new("own", mesh)
    own_scene.collection.objects.link(ocean)
    modifier = ocean.modifiers.new("ocean", "OCEAN")
    modifier.geometry_mode, modifier.spatial_size, modifier.size = "GENERATE", 100, 1
    modifier.resolution = modifier.viewport_resolution = options.resolution
    modifier.wind_velocity, modifier.choppiness = 8, 0.8
    modifier.spectrum, modifier.fetch_jonswap = "JONSWAP", 150
    modifier.use_foam = foam
    if foam:
        modifier.foam_layer_name = "foam"
    # The modifier follows the timeline as intended by its authors: a driven time, one second a
    # second.
    curve = modifier.driver_add("time")
    curve.driver.expression = "frame / 24"
    return ocean


def make_ours(settings):
    with bpy.context.temp_override(scene=our_scene, view_layer=our_scene.view_layers[0], collection=our_scene.collection):
        bpy.ops.pelagic.add_ocean(preset="moderate")
    (ocean,) = our_scene.collection.objects
    for name, value in (("resolution", side), ("size", 100), *settings.items()):
        setattr(ocean.pelagic, name, value)
    return ocean


def step(scene, ocean, frame):
    """Returns the milliseconds until the frame's mesh exists."""
    layer = scene.view_layers[0]
    before = time.perf_counter()
    scene.frame_set(frame)
    drawn = ocean.evaluated_get(layer.depsgraph).data
    height = drawn.vertices[len(drawn.vertices) // 3].co.z
    elapsed = time.perf_counter() - before
    assert len(drawn.polygons) == side * side, len(drawn.polygons)
    step.heights.setdefault(ocean.name, set()).add(height)
    return 1000 * elapsed


step.heights = {}


def beside(what, foam, settings):
    own, ours = make_own(foam), make_ours(settings)
    times = {"own": [], "ours": []}
    for frame in range(1, options.frames + 4):
        pair = step(own_scene, own, frame), step(our_scene, ours, frame)
        if frame > 3:  # both have computed their tables
            times["own"].append(pair[0])
            times["ours"].append(pair[1])
    assert all(len(heights) > options.frames // 2 for heights in step.heights.values()), "a sea stands still"
    step.heights.clear()
    own_ms, our_ms = (statistics.median(times[name]) for name in ("own", "ours"))
    ratios = sorted(a / b for a, b in zip(times["own"], times["ours"]))
    quarter = len(ratios) // 4
    print(f"{what:<42} {own_ms:8.1f} {our_ms:8.1f} {own_ms / our_ms:7.1f}   {ratios[quarter]:.1f} to {ratios[-1 - quarter]:.1f}")
    for each in (own, ours):
        bpy.data.objects.remove(each)


print(f"{side} x {side} faces, {options.frames} frames, ms a frame, medians")
print(f"{'':<42} {'modifier':>8} {'Pelagic':>8} {'ratio':>7}   its quartiles")
beside("no foam; four cascades of 128", False, {"foam": False})
beside("no foam; one cascade as fine as the mesh", False, {"foam": False, "cascade_side": 100, "cascade_resolution": str(side)})
beside("foam (Pelagic's lasts); four cascades of 128", True, {"foam": True})
