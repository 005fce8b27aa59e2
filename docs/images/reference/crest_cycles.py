# Path-traces one case of crest_light.py, to check it.
#
#   blender -b --python-exit-code 1 -P docs/images/reference/crest_cycles.py -- FOLDER [--samples K]
#
# Cycles cannot connect a point in the water with a lamp, because the surface refracts. So the sun
# is a disc of the sky, 5 degrees in radius, which paths meet by chance. The surface is smooth glass
# and the water a homogeneous volume; all channels have the optics of Jerlov type II in green.
import argparse
import math
import sys
from pathlib import Path

import bmesh
import bpy
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))
import cycles_scene

amplitude_m, steepness = 1.5, 0.44
sun_elevation_deg, eye_elevation_deg, disc_deg = 20, 10, 5
absorption_per_m, scattering_per_m, backscattering_per_m = 0.07426, 0.2467, 0.002862
heights = (0.9, 0.7, 0.5, 0.3, 0.0, -0.3)
bottom_m, half_width_m, periods = -60, 100, 9


def add_water(scene):
    k = steepness / amplitude_m
    steps = 200 * periods
    line = []
    for i in range(steps + 1):
        s = (i / steps - 0.5) * periods * 2 * math.pi / k
        line.append((s - amplitude_m * math.sin(k * s), amplitude_m * math.cos(k * s)))
    outline = line + [(line[-1][0], bottom_m), (line[0][0], bottom_m)]
    count = len(outline)
    vertices = [(x, z, y) for z in (-half_width_m, half_width_m) for x, y in outline]
    faces = [(i, (i + 1) % count, count + (i + 1) % count, count + i) for i in range(count)]
    faces += [tuple(reversed(range(count))), tuple(range(count, 2 * count))]
    mesh = bpy.data.meshes.new("water")
    mesh.from_pydata(vertices, [], faces)
    mesh.validate()
    # Normals must point out of the volume.
    shape = bmesh.new()
    shape.from_mesh(mesh)
    bmesh.ops.recalc_face_normals(shape, faces=shape.faces)
    shape.to_mesh(mesh)
    for polygon in mesh.polygons:
        polygon.use_smooth = polygon.normal.z > 0.5
    material = bpy.data.materials.new("water")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    out = nodes.new("ShaderNodeOutputMaterial")
    glass = nodes.new("ShaderNodeBsdfGlass")
    glass.distribution = "SHARP"
    glass.inputs["IOR"].default_value = cycles_scene.water_index
    glass.inputs["Color"].default_value = (1, 1, 1, 1)
    links.new(glass.outputs["BSDF"], out.inputs["Surface"])
    absorb, scatter, both = (nodes.new(kind) for kind in (
        "ShaderNodeVolumeAbsorption", "ShaderNodeVolumeScatter", "ShaderNodeAddShader"))
    absorb.inputs["Color"].default_value = (0, 0, 0, 1)
    absorb.inputs["Density"].default_value = absorption_per_m
    scatter.inputs["Color"].default_value = (1, 1, 1, 1)
    scatter.inputs["Density"].default_value = scattering_per_m
    scatter.inputs["Anisotropy"].default_value = cycles_scene.henyey_greenstein_g(backscattering_per_m / scattering_per_m)
    links.new(absorb.outputs["Volume"], both.inputs[0])
    links.new(scatter.outputs["Volume"], both.inputs[1])
    links.new(both.outputs["Shader"], out.inputs["Volume"])
    material.cycles.homogeneous_volume = True
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("water", mesh))


def add_disc(scene):
    world = scene.world = bpy.data.worlds.new("sun")
    world.use_nodes = True
    world.cycles.sampling_method = "NONE"
    nodes = cycles_scene.Nodes(world.node_tree)
    e, r = math.radians(sun_elevation_deg), math.radians(disc_deg)
    where = nodes.add("ShaderNodeTexCoord").outputs["Generated"]
    cosine = nodes.vector("DOT_PRODUCT", where, (-math.cos(e), 0, math.sin(e)))
    inside = nodes.math("GREATER_THAN", cosine, math.cos(r))
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    nodes.give(background.inputs["Strength"], nodes.math("MULTIPLY", inside, 1 / (math.pi * math.sin(r) ** 2)))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--samples", type=int, default=8192)
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    options.folder.mkdir(parents=True, exist_ok=True)
    width, height = 32, 48
    scene = cycles_scene.new_scene(options.samples, width, height, 2)
    scene.cycles.max_bounces = scene.cycles.transmission_bounces = scene.cycles.volume_bounces = 128
    scene.render.filter_size = 0.01
    add_disc(scene)
    add_water(scene)
    k = steepness / amplitude_m

    def face(part):
        s = math.acos(part) / k
        return Vector((s - amplitude_m * math.sin(k * s), 0, part * amplitude_m))

    e = math.radians(eye_elevation_deg)
    to_eye, up = Vector((math.cos(e), 0, math.sin(e))), Vector((-math.sin(e), 0, math.cos(e)))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    top, low = face(1.0).dot(up), face(-0.4).dot(up)
    camera.data.sensor_fit = "VERTICAL"
    camera.data.ortho_scale = top - low
    camera.location = up * (0.5 * (top + low)) + to_eye * (face(0.4).dot(to_eye) + 6)
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = to_eye.to_track_quat("Z", "Y")
    scene.collection.objects.link(camera)
    scene.camera = camera
    file = options.folder / "crest.exr"
    cycles_scene.render(scene, file)

    image = bpy.data.images.load(str(file))
    pixels = image.pixels[:]
    rows = [pixels[4 * width * j:4 * width * (j + 1):4] for j in range(height)]  # from the bottom
    for part in heights:
        at = (face(part).dot(up) - low) / (top - low) * height - 0.5
        # Above these rows the crest mirrors the sun.
        near = [r for j, r in enumerate(rows) if abs(j - at) <= 1.5]
        values = [v for r in near for v in r]
        mean = sum(values) / len(values)
        error = math.sqrt(sum((v - mean) ** 2 for v in values)) / len(values)
        print(f"height {part:5.2f} A: radiance {mean:.5f} +- {error:.5f}")


main()
