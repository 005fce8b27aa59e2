# Draws docs/images/blender.jpg in Blender, by Cycles on the CPU, with the add-on installed (docs/users/blender.md):
#
#   blender -b --python-exit-code 1 -P docs/images/blender.py -- docs/images/blender.jpg
import math
import sys

import bpy

bpy.ops.wm.read_homefile(use_empty=True)
scene = bpy.context.scene
bpy.ops.pelagic.add_ocean(preset="storm")
sea = bpy.context.object.pelagic
sea.wind_direction = math.radians(60)
sea.size, sea.resolution = 400, 1400
scene.frame_set(120)

world = scene.world = bpy.data.worlds.new("sky")
world.use_nodes = True
sky = world.node_tree.nodes.new("ShaderNodeTexSky")
sky.sun_elevation, sky.sun_rotation, sky.sun_intensity = math.radians(24), math.radians(-62), 0.25
world.node_tree.links.new(sky.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.14

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (0, -196, 10)
camera.rotation_euler = (math.radians(84), 0, 0)
camera.data.lens = 32
scene.collection.objects.link(camera)
scene.camera = camera
scene.render.engine = "CYCLES"
scene.cycles.samples = 128
scene.cycles.use_denoising = False  # Debian's Blender is built without a denoiser
scene.render.resolution_x, scene.render.resolution_y = 960, 420
scene.render.image_settings.file_format = "JPEG"
scene.render.image_settings.quality = 88
scene.render.filepath = sys.argv[-1]
scene.view_settings.view_transform = "Filmic"
bpy.ops.render.render(write_still=True)
