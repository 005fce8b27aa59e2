# A sea of `pelagic export` in Blender: a mesh whose vertices a modifier displaces, three patches by
# three, with foam.
#
#   blender -b --python-exit-code 1 -P blender.py -- FOLDER IMAGE.png
#
# FOLDER is an export with --patch-size 300 --maps displacement,foam: one cascade. In the window:
# Scripting, open this file, set the two names.
import json
import math
import sys
from pathlib import Path

import bpy

folder, image = sys.argv[sys.argv.index("--") + 1:][:2]
folder = Path(folder).resolve()
record = json.loads((folder / "sea.json").read_text())
for name in ("displacement_0000.exr", "foam_0000.png"):
    if not (folder / name).exists():
        sys.exit(f"{folder} has no {name}; export with --patch-size 300 --maps displacement,foam")
N = record["sea"]["resolution"]
L = record["sea"]["patch_size_m"]
frames = len(record["frames"])
patches = 3

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.frame_start, scene.frame_end = 1, frames


def load(name):
    """A sequence of numbers, not of colours: no colour space, and alpha is an independent value."""
    image = bpy.data.images.load(str(folder / name))
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "CHANNEL_PACKED"
    image.source = "SEQUENCE" if frames > 1 else "FILE"
    return image


def play(user):
    """Frame 1 of the scene is file 0000; after the last file the first one follows."""
    user.frame_start, user.frame_duration, user.frame_offset = 1, frames, -1
    user.use_cyclic = user.use_auto_refresh = True


# Vertex (i, j) has the reference position x = i L/N, z = j L/N in Pelagic's axes: x east, y up, z
# south. It uses texel (i, j). Texel rows count from the upper edge of the image, v from the lower
# edge. Column N and row N repeat the first.
mesh = bpy.data.meshes.new("sea")
mesh.from_pydata([(i * L / N, 0, j * L / N) for j in range(N + 1) for i in range(N + 1)], [],
                 [(a, a + N + 1, a + N + 2, a + 1) for j in range(N) for a in range(j * (N + 1), j * (N + 1) + N)])
mesh.polygons.foreach_set("use_smooth", [True] * (N * N))
uv = mesh.uv_layers.new(name="texels")
for loop in mesh.loops:
    j, i = divmod(loop.vertex_index, N + 1)
    uv.data[loop.index].uv = ((i + 0.5) / N, 1 - (j + 0.5) / N)
sea = bpy.data.objects.new("sea", mesh)
# Blender's z is up: y becomes z, and z, which is south, becomes -y
sea.rotation_euler.x = math.radians(90)
scene.collection.objects.link(sea)

texture = bpy.data.textures.new("displacement", "IMAGE")
texture.image = load("displacement_0000.exr")
texture.extension = "REPEAT"
texture.use_interpolation = False  # a vertex uses its own texel
texture.use_clamp = False  # negative numbers are below the still water level
play(texture.image_user)
displace = sea.modifiers.new("displace", "DISPLACE")
displace.texture = texture
displace.texture_coords, displace.uv_layer = "UV", "texels"
displace.direction, displace.space = "RGB_TO_XYZ", "LOCAL"
displace.mid_level, displace.strength = 0, 1
for axis in (0, 2):
    cascades = sea.modifiers.new("patches", "ARRAY")
    cascades.count = patches
    cascades.use_relative_offset, cascades.use_constant_offset = False, True
    cascades.constant_offset_displace = [L if axis == k else 0 for k in range(3)]
    cascades.use_merge_vertices, cascades.merge_threshold = True, 1e-3

# The foam map is the fraction of the surface that foam covers.
water = bpy.data.materials.new("water")
water.use_nodes = True
nodes, links = water.node_tree.nodes, water.node_tree.links
surface = nodes["Principled BSDF"]
surface.inputs["Roughness"].default_value = 0.08
surface.inputs["IOR"].default_value = 1.333
foam = nodes.new("ShaderNodeTexImage")
foam.image = load("foam_0000.png")
play(foam.image_user)
colour = nodes.new("ShaderNodeMixRGB")
colour.inputs["Color1"].default_value = (0.004, 0.022, 0.035, 1)
colour.inputs["Color2"].default_value = (0.8, 0.85, 0.88, 1)
links.new(foam.outputs["Color"], colour.inputs["Fac"])
links.new(colour.outputs["Color"], surface.inputs["Base Color"])
mesh.materials.append(water)

# A sky, and a camera in the south-west of the middle patch that looks north-east.
world = scene.world = bpy.data.worlds.new("sky")
world.use_nodes = True
sky = world.node_tree.nodes.new("ShaderNodeTexSky")
sky.sun_elevation, sky.sun_rotation = math.radians(28), math.radians(75)
sky.sun_intensity = 0.2
world.node_tree.links.new(sky.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.12
highest = max(frame["height_max_m"] for frame in record["frames"])
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (L, -2 * L, 3 * highest + 3)
camera.rotation_euler = (math.radians(84), 0, math.radians(-45))
scene.collection.objects.link(camera)
scene.camera = camera

scene.render.engine = "CYCLES"
scene.cycles.samples = 32
scene.cycles.use_denoising = False  # Debian's Blender is built without a denoiser
scene.render.resolution_x, scene.render.resolution_y = 640, 360
scene.frame_set(1)
scene.render.filepath = str(Path(image).resolve())
bpy.ops.render.render(write_still=True)
