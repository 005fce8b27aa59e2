# Runs in Blender after docs/recipes/blender.py and checks that all vertices are on the sea, and that
# the water has the foam of the map.
#
# usage: blender -b --python-exit-code 1 -P blender.py -P blender_check.py -- \
#          FOLDER IMAGE.png PELAGIC
import json
import sys
import tempfile
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from compare_with_query import compare

folder, _, pelagic = sys.argv[sys.argv.index("--") + 1:]
record = json.loads((Path(folder) / "sea.json").read_text())
length = record["sea"]["patch_size_m"]
N = record["sea"]["resolution"]

for frame in range(len(record["frames"])):
    bpy.context.scene.frame_set(frame + 1)
    drawn = bpy.data.objects["sea"].evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = drawn.to_mesh()
    world = [drawn.matrix_world @ vertex.co for vertex in mesh.vertices]
    assert len(world) == (3 * N + 1) ** 2, f"{len(world)} vertices are not three patches by three"
    places = [(v.x, v.z, -v.y) for v in world]  # Blender's z is up and its y is north, which is -z
    compare(pelagic, folder, frame, [p for p in places if p[0] < length and p[2] < length])
    compare(pelagic, folder, frame, places)
    drawn.to_mesh_clear()

# An image of what mixes foam into the water, of the middle patch from above. Without displacements,
# which make patches of foam smaller, its mean is the map's.
water = bpy.data.materials["water"].node_tree
mask = next(node for node in water.nodes if node.type == "MIX_RGB").inputs["Fac"].links[0].from_socket
emission = water.nodes.new("ShaderNodeEmission")
water.links.new(mask, emission.inputs["Color"])
water.links.new(emission.outputs["Emission"], water.nodes["Material Output"].inputs["Surface"])
bpy.data.objects["sea"].modifiers["displace"].show_render = False
scene = bpy.context.scene
scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", length
scene.camera.location, scene.camera.rotation_euler = (1.5 * length, -1.5 * length, 10), (0, 0, 0)
scene.cycles.samples = 4
scene.render.resolution_x = scene.render.resolution_y = N
scene.render.image_settings.file_format = "OPEN_EXR"


def mean_of(file):
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = "Non-Color"
    red = image.pixels[:][::4]
    return sum(red) / len(red)


with tempfile.TemporaryDirectory() as seen:
    for frame in range(len(record["frames"])):
        scene.frame_set(frame + 1)
        scene.render.filepath = f"{seen}/mask_{frame}.exr"
        bpy.ops.render.render(write_still=True)
        drawn, expected = mean_of(scene.render.filepath), mean_of(Path(folder) / f"foam_{frame:04}.png")
        print(f"mean foam of frame {frame}: {drawn:.5f}, of the map {expected:.5f}")
        assert expected > 0.01 and abs(drawn - expected) < 0.02 * expected, (drawn, expected)
