# Reads the meshes of an export in Blender, and compares them with `pelagic query`.
#
# usage: blender -b --python-exit-code 1 -P mesh_check.py -- FOLDER IMAGE.png PELAGIC
import json
import math
import sys
from pathlib import Path

import bpy
import numpy

numpy.bool = bool  # Debian's glTF importer is older than Debian's numpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from compare_with_query import ask, compare

folder, image, pelagic = sys.argv[sys.argv.index("--") + 1:]
record = json.loads((Path(folder) / "sea.json").read_text())
frames = len(record["frames"])
N = record["sea"]["resolution"]
loop_s = record["sea"]["loop_period_s"]


def read(operator, name):
    """Returns the single mesh of a file, in an empty scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    group, call = operator.split(".")
    getattr(getattr(bpy.ops, group), call)(filepath=str(Path(folder).resolve() / name))
    (mesh,) = [each for each in bpy.data.objects if each.type == "MESH"]
    assert len(mesh.data.vertices) == (N + 1) ** 2
    return mesh


def places_of(mesh, is_rotated=True):
    """Returns vertices in Pelagic's axes: importers of formats with y up rotate it to Blender's z.
    """
    drawn = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
    vertices = [drawn.matrix_world @ vertex.co for vertex in drawn.to_mesh().vertices]
    drawn.to_mesh_clear()
    return [(v.x, v.z, -v.y) if is_rotated else (v.x, v.y, v.z) for v in vertices]


def check_look(mesh, frame, places, colour, has_normals):
    """Checks normals, foam and texture coordinates of a file's frame."""
    sea = ask(pelagic, folder, frame, places, "--foam")
    data = mesh.data
    assert max(row["foam"] for row in sea) > 0.1, "a sea without foam tells nothing about it"
    greys = data.color_attributes[0]
    rows = sea if greys.domain == "POINT" else [sea[loop.vertex_index] for loop in data.loops]
    worst = max(abs(getattr(grey, colour)[0] - row["foam"]) for grey, row in zip(greys.data, rows))
    print(f"  foam within {worst:.3g}")
    assert worst < (0.5 + 1.14) / 255, "half a byte, and half a byte of sRGB, in which Blender keeps it, 2.28 times as wide at white"
    if has_normals:
        data.calc_normals_split()
        to_sea = mesh.matrix_world.to_3x3()
        least = 1
        for loop in data.loops:
            n, row = to_sea @ loop.normal, sea[loop.vertex_index]
            least = min(least, n.x * row["nx"] + n.z * row["ny"] - n.y * row["nz"])
        angle = math.degrees(math.acos(min(1, least)))
        print(f"  normals within {angle:.3g} degrees")
        assert angle < 0.1, "Blender keeps normals of corners in 16 bits an angle"
    for loop, uv in zip(data.loops, data.uv_layers[0].data):
        j, i = divmod(loop.vertex_index, N + 1)
        assert abs(uv.uv.x - (i + 0.5) / N) < 1e-5 and abs(uv.uv.y - (1 - (j + 0.5) / N)) < 1e-5


for frame in (0, frames - 1):
    # Blender treats colours of OBJ and PLY as sRGB; those of glTF are linear by its specification.
    for operator, name, colour, is_rotated in (("wm.obj_import", f"mesh_{frame:04}.obj", "color_srgb", True),
                                              ("import_mesh.ply", f"mesh_{frame:04}.ply", "color_srgb", False),
                                              ("import_scene.gltf", f"mesh_{frame:04}.glb", "color", True)):
        print(operator, name)
        mesh = read(operator, name)
        places = places_of(mesh, is_rotated)
        compare(pelagic, folder, frame, places)
        # Blender 3.4 reads no normals of PLY
        check_look(mesh, frame, places, colour, has_normals=is_rotated)

print("modifier Mesh Cache, mesh.mdd")
mesh = read("wm.obj_import", "mesh_0000.obj")
cache = mesh.modifiers.new("cache", "MESH_CACHE")
cache.cache_format, cache.filepath, cache.frame_start = "MDD", str(Path(folder).resolve() / "mesh.mdd"), 1
for frame in range(frames):
    bpy.context.scene.frame_set(frame + 1)
    compare(pelagic, folder, frame, places_of(mesh))

print("import_scene.gltf mesh.glb")
mesh = read("import_scene.gltf", "mesh.glb")
scene = bpy.context.scene
for frame in range(frames + 1):  # the last frame equals the first
    at = frame * loop_s / frames * scene.render.fps
    scene.frame_set(int(at), subframe=at - int(at))
    compare(pelagic, folder, frame % frames, places_of(mesh))

# Renders an image for inspection: the last file with its own material, foam by colour, under a sky.
scene.frame_set(0)
world = scene.world = bpy.data.worlds.new("sky")
world.use_nodes = True
sky = world.node_tree.nodes.new("ShaderNodeTexSky")
sky.sun_elevation, sky.sun_rotation, sky.sun_intensity = math.radians(28), math.radians(75), 0.2
world.node_tree.links.new(sky.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.12
side = record["export"]["mesh"]["side_m"]
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (0.05 * side, -0.95 * side, 0.08 * side)
camera.rotation_euler = (math.radians(78), 0, math.radians(-45))
scene.collection.objects.link(camera)
scene.camera = camera
scene.render.engine = "CYCLES"
scene.cycles.samples = 32
scene.cycles.use_denoising = False  # Debian's Blender is built without a denoiser
scene.render.resolution_x, scene.render.resolution_y = 640, 360
scene.render.filepath = str(Path(image).resolve())
bpy.ops.render.render(write_still=True)
