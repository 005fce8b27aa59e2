# Runs in Blender after docs/recipes/blender.py and checks that all vertices are on the sea.
#
# usage: blender -b --python-exit-code 1 -P blender.py -P blender_check.py -- \
#          FOLDER IMAGE.png PELAGIC
import json
import sys
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
