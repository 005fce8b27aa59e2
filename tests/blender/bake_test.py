"""Bakes: files, continuation after a stop, complete files only, and playback without the add-on.

usage: blender -b -P bake_test.py -- PELAGIC FOLDER"""
import json
import math
import os
import subprocess
import sys
from pathlib import Path

import bpy
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from beside_query import hash_of, values_of, vertices_of

from pelagic_ocean import bake

pelagic, folder = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_homefile(use_empty=True)
scene = bpy.context.scene
scene.render.fps, scene.frame_start, scene.frame_end = 25, 3, 8


def refused(what):
    try:
        bpy.ops.pelagic.bake()
    except RuntimeError as error:
        lines = str(error).strip().splitlines()
        assert len(lines) == 1 and what in lines[0], lines
        print("refused:", lines[0])
    else:
        assert False, "a bake that must fail succeeded"


bpy.ops.pelagic.add_ocean(preset="rough")
ocean = bpy.context.object
settings = ocean.pelagic
settings.resolution, settings.size, settings.wind_speed = 48, 60, 13.7
bpy.ops.pelagic.add_system()
bpy.ops.pelagic.add_system()
settings.systems[1].peak_period, settings.systems[1].direction = 9.7, math.radians(77.7)
bpy.ops.pelagic.remove_system(index=0)
assert [round(system.peak_period, 5) for system in settings.systems] == [9.7]
assert (settings.bake_start, settings.bake_end) == (3, 8), "the scene's range"

refused("//pelagic_bake/")  # the .blend has not been saved
blend = str(Path(folder) / "bake.blend")
bpy.ops.wm.save_as_mainfile(filepath=blend)
settings.bake_end = 2
refused("Bake End 2: must be at least 3")
settings.bake_end = 8
settings.keyframe_insert("wind_speed", frame=1)
refused("pelagic.wind_speed is animated")
ocean.animation_data_clear()
(Path(folder) / "a file").write_text("")
settings.bake_folder = str(Path(folder) / "a file")
refused("a file/Ocean: Not a directory")
settings.bake_folder = "//pelagic_bake/"

live = {}
for frame in range(3, 9):
    scene.frame_set(frame)
    live[frame] = vertices_of(ocean), values_of(ocean, "foam")


def files():
    return {path.name: path.read_bytes() for path in sorted(into.iterdir())}


# Stopped after two frames: only complete images have final names, and the next run continues.
into = Path(folder) / "pelagic_bake" / "Ocean"
work = bake.run(ocean, scene)
assert [next(work) for _ in range(2)] == [(1, 6), (2, 6)]
work.close()
assert set(files()) == {"bake.journal", "foam_0003.png", "foam_0004.png", "vertices.pc2.part"}, set(files())
# Simulates a crash: an incomplete frame and an incomplete line.
with open(into / "vertices.pc2.part", "ab") as file:
    file.write(b"half a frame")
with open(into / "bake.journal", "a") as file:
    file.write("0123")
first_two = os.stat(into / "foam_0003.png").st_mtime_ns
assert bpy.ops.pelagic.bake() == {"FINISHED"}
assert os.stat(into / "foam_0003.png").st_mtime_ns == first_two, "the run did not continue"
resumed = files()
assert set(resumed) == {"sea.json", "vertices.pc2"} | {f"foam_{frame:04d}.png" for frame in range(3, 9)}, set(resumed)

# A bake without a stop has equal bytes. A complete bake is left alone. Another sea restarts it.
for path in into.iterdir():
    path.unlink()
assert bpy.ops.pelagic.bake() == {"FINISHED"} and files() == resumed
stamp = os.stat(into / "vertices.pc2").st_mtime_ns
assert bpy.ops.pelagic.bake() == {"FINISHED"} and os.stat(into / "vertices.pc2").st_mtime_ns == stamp
bpy.ops.pelagic.go_live()
settings.seed = 2
assert bpy.ops.pelagic.bake() == {"FINISHED"}
other = files()
assert other["vertices.pc2"] != resumed["vertices.pc2"] and len(other["vertices.pc2"]) == len(resumed["vertices.pc2"])
bpy.ops.pelagic.go_live()
settings.seed = 1
assert bpy.ops.pelagic.bake() == {"FINISHED"} and files() == resumed

# The command line reads sea.json and computes equal hashes.
record = json.loads(resumed["sea.json"])
assert [each["frame"] for each in record["frames"]] == list(range(3, 9)) and record["frames"][1]["time_s"] == 3 / 25
for each in record["frames"][::5]:
    assert hash_of(pelagic, ["--config", into / "sea.json"], each["time_s"]) == each["hash"]
    assert hash_of(pelagic, ["--preset", "rough", "--wind-speed", "13.7", "--system", "height=1 period=9.7 direction=77.7"], each["time_s"]) == each["hash"]

# The saved file plays without the add-on: bit-identical vertices, foam from its images.
bpy.ops.wm.save_as_mainfile(filepath=blend)
numpy.savez(Path(folder) / "live.npz", **{f"{kind}{frame}": both[part] for frame, both in live.items() for part, kind in enumerate(("vertices", "foam"))})
check = """
import bpy, numpy, sys
assert not hasattr(bpy.types.Object, "pelagic"), "the add-on is enabled"
live = numpy.load(sys.argv[-1])
scene, ocean = bpy.context.scene, bpy.data.objects["Ocean"]
(image,) = [node for node in ocean.material_slots[0].material.node_tree.nodes if node.type == "TEX_IMAGE"]
for frame in (3, 8, 5, 4):
    scene.frame_set(frame)
    mesh = ocean.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    places = numpy.empty(len(mesh.vertices) * 3, numpy.float32)
    mesh.vertices.foreach_get("co", places)
    assert places.tobytes() == live[f"vertices{frame}"].tobytes(), f"frame {frame} has other vertices"
# Renders the foam from above, flat and without light, a pixel per face, to see each frame's image.
side = 49
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", 60, (0, 0, 100)
scene.collection.objects.link(camera)
scene.camera = camera
ocean.modifiers.clear()
flat = (numpy.indices((side, side)).reshape(2, -1)[::-1].T / (side - 1) - 0.5) * 60
ocean.data.vertices.foreach_set("co", numpy.column_stack([flat, numpy.zeros(len(flat))]).astype(numpy.float32).ravel())
tree = ocean.material_slots[0].material.node_tree
glow = tree.nodes.new("ShaderNodeEmission")
tree.links.new(image.outputs["Color"], glow.inputs["Color"])
(out,) = [node for node in tree.nodes if node.type == "OUTPUT_MATERIAL"]
tree.links.new(glow.outputs[0], out.inputs["Surface"])
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 16, False
scene.view_settings.view_transform, scene.render.filter_size, scene.cycles.pixel_filter_type = "Raw", 0.01, "BOX"
scene.render.resolution_x = scene.render.resolution_y = 48
scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
for frame in (3, 8, 5):
    scene.frame_set(frame)
    scene.render.filepath = sys.argv[-1] + ".exr"
    bpy.ops.render.render(write_still=True)
    drawn = bpy.data.images.load(scene.render.filepath, check_existing=False)
    grey = numpy.empty(48 * 48 * 4, numpy.float32)
    drawn.pixels.foreach_get(grey)
    foam = live[f"foam{frame}"].reshape(side, side)
    faces = (foam[1:, 1:] + foam[1:, :-1] + foam[:-1, 1:] + foam[:-1, :-1]) / 4  # a pixel shows a face
    off = numpy.abs(grey.reshape(48, 48, 4)[:, :, 0] - faces)
    others = [numpy.abs(grey.reshape(48, 48, 4)[:, :, 0] - (lambda f: (f[1:, 1:] + f[1:, :-1] + f[:-1, 1:] + f[:-1, :-1]) / 4)(live[f"foam{n}"].reshape(side, side))).mean() for n in (3, 4, 5, 6, 7, 8) if n != frame]
    print("frame", frame, "foam off by", off.max(), off.mean(), "other frames' by", min(others), "most", faces.max())
    assert faces.max() > 0.2 and off.mean() < 0.5 * min(others) and off.mean() < 0.01
print("plays")
"""
environment = dict(os.environ, BLENDER_USER_RESOURCES=str(Path(folder) / "no home"))
answer = subprocess.run([bpy.app.binary_path, "-b", blend, "--factory-startup", "--python-exit-code", "1", "--python-expr", check, "--",
                         str(Path(folder) / "live.npz")], capture_output=True, text=True, env=environment)
print(answer.stdout[-1500:], answer.stderr[-1500:])
assert answer.returncode == 0 and "plays" in answer.stdout

# Back to live: the sea moves the mesh again.
bpy.ops.pelagic.go_live()
scene.frame_set(6)
assert not ocean.modifiers and vertices_of(ocean).tobytes() == live[6][0].tobytes()
assert ocean.material_slots[0].material.name == "Pelagic Water"
print("bake_test passed")
