# Renders docs/images/blender.jpg with Cycles: the ocean of docs/integrations/blender.md under a
# sky, with the add-on installed as documented there. Run in the clone:
#
#   mkdir -p out
#   blender -b --python-exit-code 1 -P docs/images/blender.py -- docs/images/blender.jpg
import math
import re
import sys

import bpy

page = open("docs/integrations/blender.md").read()
exec(re.search(r"^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL).group(1))
world = scene.world = bpy.data.worlds.new("sky")
world.use_nodes = True
nodes, links = world.node_tree.nodes, world.node_tree.links
sky = nodes.new("ShaderNodeTexSky")
sky.sun_elevation, sky.sun_rotation, sky.sun_intensity = math.radians(24), math.radians(-62), 0.25
links.new(sky.outputs["Color"], nodes["Background"].inputs["Color"])
nodes["Background"].inputs["Strength"].default_value = 0.14
camera = scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location, camera.rotation_euler, camera.data.lens = (0, -196, 10), (math.radians(84), 0, 0), 32
scene.collection.objects.link(camera)
scene.render.engine, scene.cycles.samples, scene.render.resolution_percentage = "CYCLES", 128, 100
scene.cycles.use_denoising = False  # Debian's Blender has no denoiser
scene.render.resolution_x, scene.render.resolution_y = 960, 420
scene.view_settings.view_transform = "Filmic"
sea.resolution = 1400
scene.render.image_settings.file_format = "JPEG"
scene.render.image_settings.quality = 88
scene.render.filepath = sys.argv[-1]
bpy.ops.render.render(write_still=True)
