"""Renders by `blender -b -a` show each frame's sea. With velocities Cycles makes motion blur.

usage: blender -b -P render_test.py -- PELAGIC FOLDER"""
import subprocess
import sys
from pathlib import Path

import bpy
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from beside_query import ask

pelagic, folder = sys.argv[sys.argv.index("--") + 1:]
# Pixels of 0.25 m, because a pixel averages foam, which has sharp edges.
side, size, frames = 160, 40, (5, 6, 7)
bpy.ops.wm.read_homefile(use_empty=True)
scene = bpy.context.scene
bpy.ops.pelagic.add_ocean(preset="rough")
ocean = bpy.context.object
ocean.pelagic.size, ocean.pelagic.resolution, ocean.pelagic.speed = size + 20, 250, 10
assert not ocean.pelagic.velocity

# Seen from above, each pixel emits the height of the water in red and its foam in green.
tree = ocean.data.materials[0].node_tree
tree.nodes.clear()
place, parts = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeSeparateXYZ")
foam, both = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeCombineXYZ")
foam.attribute_name = "foam"
raised = tree.nodes.new("ShaderNodeMath")  # light is never negative
raised.inputs[1].default_value = 100
glow, out = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
for a, b in ((place.outputs["Position"], parts.inputs[0]), (parts.outputs["Z"], raised.inputs[0]), (raised.outputs[0], both.inputs["X"]),
             (foam.outputs["Fac"], both.inputs["Y"]), (both.outputs[0], glow.inputs["Color"]), (glow.outputs[0], out.inputs["Surface"])):
    tree.links.new(a, b)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", size, (0, 0, 50)
scene.collection.objects.link(camera)
scene.camera = camera
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 32, False
scene.cycles.pixel_filter_type = "BOX"
scene.render.filter_size = 0.01
scene.view_settings.view_transform = "Raw"
scene.render.resolution_x = scene.render.resolution_y = side
scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"


def render(name):
    """Saves the scene and renders it in another process, as on a farm. Returns red, green and blue
    of each frame, the upper row first."""
    blend = str(Path(folder) / f"{name}.blend")
    scene.frame_set(1)
    bpy.ops.wm.save_as_mainfile(filepath=blend)
    subprocess.run([bpy.app.binary_path, "-b", blend, "--python-exit-code", "1", "-o", str(Path(folder) / f"{name}_####"), "-s", str(frames[0]),
                    "-e", str(frames[-1]), "-a"], check=True, capture_output=True)
    images = []
    for frame in frames:
        image = bpy.data.images.load(str(Path(folder) / f"{name}_{frame:04d}.exr"), check_existing=False)
        pixels = numpy.empty(side * side * 4, numpy.float32)
        image.pixels.foreach_get(pixels)
        images.append(pixels.reshape(side, side, 4)[::-1, :, :3])
    return numpy.array(images)


drawn = render("waves")
centres = ((numpy.arange(side) + 0.5) / side - 0.5) * size
# The upper row is +Y, Pelagic's -z.
points = numpy.stack(numpy.meshgrid(centres, centres), axis=2).reshape(-1, 2)
told = [ask(pelagic, ["--preset", "rough"], (frame - 1) * 10 / 24, points, "--foam") for frame in frames]
for image, frame in zip(drawn, frames):
    off = [numpy.abs(image[:, :, 0].ravel() - 100 - each["height"]).mean() for each in told]
    foam_off = [numpy.abs(image[:, :, 1].ravel() - each["foam"]).mean() for each in told]
    print(f"frame {frame}: height off by", numpy.round(off, 4), "foam by", numpy.round(foam_off, 4))
    assert numpy.argmin(off) == numpy.argmin(foam_off) == frame - frames[0]
    # Faces of 0.4 m smooth waves and foam.
    assert min(off) < 0.03 and min(foam_off) < 0.015 and min(off) < 0.2 * sorted(off)[1] and min(foam_off) < 0.5 * sorted(foam_off)[1]

# Keyed settings, which a render evaluates in its own copy of the object.
ocean.pelagic.keyframe_insert("time_offset", frame=frames[0])
ocean.pelagic.time_offset = 3
ocean.pelagic.keyframe_insert("time_offset", frame=frames[-1])
for curve in ocean.animation_data.action.fcurves:
    for key in curve.keyframe_points:
        key.interpolation = "LINEAR"
keyed = ask(pelagic, ["--preset", "rough"], 1.5 + (frames[1] - 1) * 10 / 24, points)
assert numpy.abs(render("keyed")[1, :, :, 0].ravel() - 100 - keyed["height"]).mean() < 0.03, "the key has no effect"
ocean.animation_data_clear()
ocean.pelagic.time_offset = 0

# Motion blur: without velocities the image stays; with them it is blurred along the motion.
scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1
still = render("still")
ocean.pelagic.velocity = True
blurred = render("blurred")
assert numpy.abs(still - drawn).max() < 0.2, "without velocities nothing should be blurred"
assert numpy.abs(blurred - drawn)[:, :, :, 0].mean() > 0.002, "with velocities nothing is blurred"

# Cycles' vectors, in pixels to a point's position in the frame before, match the velocities of
# `pelagic query`.
scene.render.use_motion_blur = False
scene.view_layers[0].use_pass_vector = scene.use_nodes = True
layers, composite = scene.node_tree.nodes["Render Layers"], scene.node_tree.nodes["Composite"]
scene.node_tree.links.new(layers.outputs["Vector"], composite.inputs["Image"])
back = render("vectors")[0]
pixels_per_frame = 10 / 24 * side / size
for axis, velocity in ((0, told[0]["vx"]), (1, -told[0]["vz"])):
    share = -numpy.polyfit(velocity * pixels_per_frame, back[:, :, axis].ravel(), 1)[0]
    print(f"vectors are {share:.3f} of the water's velocity")
    assert 0.94 < share < 1.03, "faces smooth waves, but not so much"
print("render_test passed")
