"""Work in Blender: undo, several oceans, duplicates, invalid options, presets, keys, edit mode, and
disabling and enabling the add-on.

usage: blender -b -P artist_test.py -- PELAGIC FOLDER"""
import os
import shutil
import subprocess
import sys
from pathlib import Path

import addon_utils
import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from beside_query import compare, vertices_of

from pelagic_ocean import library, sea_object, timeline

pelagic, folder = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_homefile(use_empty=True)
scene = bpy.context.scene


def bits(name):
    return vertices_of(bpy.data.objects[name]).tobytes()


# Several oceans in a scene differ. A moved object keeps its sea. Neighbours join without a seam.
bpy.ops.pelagic.add_ocean(preset="moderate")
bpy.context.object.pelagic.resolution = 32
bpy.ops.pelagic.add_ocean(preset="storm")
bpy.context.object.pelagic.resolution = 32
bpy.ops.pelagic.add_ocean(preset="moderate")
east = bpy.context.object
east.pelagic.resolution, east.pelagic.place, east.location = 32, (100, 0), (100, 0, 0)
scene.frame_set(30)
assert len({bits(name) for name in ("Ocean", "Ocean.001", "Ocean.002")}) == 3
left, right = vertices_of(bpy.data.objects["Ocean"]).reshape(33, 33, 3)[:, -1], vertices_of(east).reshape(33, 33, 3)[:, 0]
assert abs(left - right - (100, 0, 0)).max() < 1e-5, "neighbours do not join"
normals = [polygon.normal.z for polygon in bpy.data.objects["Ocean"].data.polygons]
assert min(normals) > 0.3, "faces look down"
assert bpy.data.objects["Ocean"].data.materials[0] == east.data.materials[0]

# Undo and redo restore the vertices together with the settings.
first = bpy.data.objects["Ocean"]
bpy.context.view_layer.objects.active = first
bpy.ops.ed.undo_push(message="before")
before, wind_before = bits("Ocean"), first.pelagic.wind_speed
first.pelagic.wind_speed = 15
bpy.ops.ed.undo_push(message="wind")
after = bits("Ocean")
assert after != before
bpy.ops.ed.undo()
assert bpy.data.objects["Ocean"].pelagic.wind_speed == wind_before and bits("Ocean") == before
bpy.ops.ed.redo()
assert bpy.data.objects["Ocean"].pelagic.wind_speed == 15 and bits("Ocean") == after
bpy.ops.ed.undo()
bpy.context.view_layer.objects.active = bpy.data.objects["Ocean"]
bpy.ops.pelagic.preset("EXEC_DEFAULT", True, preset="rough")
assert bits("Ocean") != before and bpy.data.objects["Ocean"].pelagic.preset == "rough"
bpy.ops.ed.undo()
assert bpy.data.objects["Ocean"].pelagic.preset == "moderate" and bits("Ocean") == before, "a preset is not undone"
compare(pelagic, ["--preset", "moderate"], 29 / 24, bpy.data.objects["Ocean"])

scene = bpy.context.scene  # undo replaced all data-blocks

# Scenes that are shown alternately, as in the sequencer, keep their oceans.
other = bpy.data.scenes.new("other")
made = dict(sea_object.oceans)
assert len(made) == 3
other.frame_set(3)
scene.frame_set(30)
assert sea_object.oceans == made, "oceans are made again"
bpy.data.scenes.remove(other)

# Every preset sets all options of the library's sea of that name.
first = bpy.data.objects["Ocean"]
first.pelagic.foam = False
for name in library.pelagic.presets:
    first.pelagic.size = 3 if name == "pond" else 100
    assert bpy.ops.pelagic.preset(preset=name) == {"FINISHED"} and not first.pelagic.error, first.pelagic.error
    assert sea_object.sea_of(first.pelagic) == library.pelagic.preset(name), name
bpy.ops.pelagic.preset(preset="moderate")
first.pelagic.size = 100

# Invalid options: one line in the panel, and the mesh stays as it was, also on other frames.
scene.frame_set(40)
kept = bits("Ocean")
first.pelagic.cascade_side = 250
first.pelagic.cascades = 3
assert first.pelagic.error == "cascades is 3, expected 1 where the side of the cascade is given", first.pelagic.error
one_cascade = bits("Ocean")
scene.frame_set(41)
assert bits("Ocean") == one_cascade != kept, "the mesh changed in spite of invalid options"
first.pelagic.cascades = 0
assert first.pelagic.error == ""
compare(pelagic, ["--preset", "moderate", "--patch-size", "250"], 40 / 24, first)
first.pelagic.cascade_side = 0
for operator in (bpy.ops.pelagic.add_ocean, bpy.ops.pelagic.preset):
    try:
        operator(preset="strom")
        assert False, "accepted an unknown preset"
    except RuntimeError as error:
        assert "Preset strom: must be one of " in str(error) and len(str(error).strip().splitlines()) == 1, error

# Duplicates: one with its own mesh, and one that shares the mesh until its sea changes.
for linked in (False, True):
    for each in bpy.context.selected_objects:
        each.select_set(False)
    first.select_set(True)
    bpy.context.view_layer.objects.active = first
    bpy.ops.object.duplicate(linked=linked)
    twin = bpy.context.object
    assert bits(twin.name) == bits("Ocean")
    twin.pelagic.seed = 5
    assert bits(twin.name) != bits("Ocean") and twin.data != first.data
    bpy.data.objects.remove(twin)

# Keyed settings have the values of the frame.
first.pelagic.wind_speed = 5
first.pelagic.keyframe_insert("wind_speed", frame=1)
first.pelagic.wind_speed = 10
first.pelagic.keyframe_insert("wind_speed", frame=41)
for curve in first.animation_data.action.fcurves:
    for key in curve.keyframe_points:
        key.interpolation = "LINEAR"
scene.frame_set(41)
compare(pelagic, ["--preset", "moderate", "--wind-speed", "10"], 40 / 24, first)
scene.frame_set(21)
compare(pelagic, ["--preset", "moderate", "--wind-speed", "7.5"], 20 / 24, first)
assert len(sea_object.oceans) <= 4, "oceans of earlier wind speeds are kept"
first.animation_data_clear()

# In edit mode the mesh is left alone.
bpy.context.view_layer.objects.active = first
bpy.ops.object.mode_set(mode="EDIT")
scene.frame_set(50)
bpy.ops.object.mode_set(mode="OBJECT")
scene.frame_set(51)
compare(pelagic, ["--preset", "moderate", "--wind-speed", repr(first.pelagic.wind_speed)], 50 / 24, first)

# Disabling the add-on removes everything it registered. The settings stay in the file.
menu = bpy.types.VIEW3D_MT_mesh_add


def left_behind():
    return ([each for called, handler in timeline.handlers for each in called if each == handler],
            [name for name in dir(bpy.types) if "PELAGIC" in name or name == "PelagicOcean"],
            hasattr(bpy.types.Object, "pelagic"),
            [draw for draw in menu._dyn_ui_initialize() if "pelagic" in draw.__module__],
            [name for name in dir(bpy.ops) if name == "pelagic" and dir(bpy.ops.pelagic)],
            [path for path in sys.path if "pelagic_ocean" in path], dict(sea_object.oceans))


wind = first.pelagic.wind_speed
for _ in range(3):
    there = left_behind()
    assert len(there[0]) == 4 and there[2] and len(there[3]) == 1 and not there[5], there
    addon_utils.disable("pelagic_ocean")
    assert left_behind() == ([], [], False, [], [], [], {}), left_behind()
    kept = bits("Ocean")
    scene.frame_set(scene.frame_current + 1)
    assert bits("Ocean") == kept, "the mesh still moves"
    addon_utils.enable("pelagic_ocean")
    from pelagic_ocean import sea_object, timeline
first = bpy.data.objects["Ocean"]
assert first.pelagic.is_ocean and first.pelagic.wind_speed == wind
scene.frame_set(70)
compare(pelagic, ["--preset", "moderate", "--wind-speed", repr(round(wind, 5))], 69 / 24, first)
# With a zip made for another system Blender starts, and the panel has one line with the reason.
home = Path(folder) / "another home"
shutil.copytree(os.environ["BLENDER_USER_RESOURCES"], home)
(home / "scripts/addons/pelagic_ocean/python/pelagic/libpelagic_c.so").write_bytes(b"MZ")
check = """
import bpy
from pelagic_ocean import library
assert library.problem.startswith("The add-on's library does not load in Python 3") and "\\n" not in library.problem, library.problem
assert not bpy.ops.pelagic.add_ocean.poll()
print("has a reason")
"""
answer = subprocess.run([bpy.app.binary_path, "-b", "--python-exit-code", "1", "--python-expr", check], capture_output=True, text=True,
                        env=dict(os.environ, BLENDER_USER_RESOURCES=str(home)))
assert answer.returncode == 0 and "has a reason" in answer.stdout and "Traceback" not in answer.stdout + answer.stderr, answer.stdout + answer.stderr
print("artist_test passed")
