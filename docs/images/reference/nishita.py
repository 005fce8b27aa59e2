# Compares the sky of `pelagic render --sky` with Blender's: Nishita 1993 ("Display of the Earth
# Taking into Account Atmospheric Scattering"), with air, dust and ozone of a clear day. Both are
# divided by their irradiance on a level plane.
#
#   blender -b --python-exit-code 1 -P nishita.py -- PELAGIC FOLDER
import json
import math
import subprocess
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import cycles_scene
import regions

width, height = 128, 64
looks = {"zenith": (0, 85), "45 degrees up, away from the sun": (180, 45), "horizon, across": (90, 2), "horizon, away": (180, 2)}


def image(file):
    """Returns the radiance as a function of azimuth and elevation, degrees, and the irradiance on a
    level plane."""
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = "Non-Color"
    (w, h), pixels = image.size, image.pixels[:]

    def at(azimuth, elevation):
        i, j = int((azimuth / 360 + 0.5) % 1 * w), min(h - 1, int((elevation / 180 + 0.5) * h))
        return pixels[4 * (j * w + i):4 * (j * w + i) + 3]

    irradiance = [0.0] * 3
    for j in range(90):
        for i in range(0, 360, 3):
            weight = math.sin(math.radians(j + 0.5)) * math.cos(math.radians(j + 0.5)) * math.radians(1) * math.radians(3)
            irradiance = [a + weight * b for a, b in zip(irradiance, at(i, j + 0.5))]
    return at, irradiance


def nishita(file, elevation):
    scene = cycles_scene.new_scene(4, width, height, 2)
    world = scene.world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    sky = world.node_tree.nodes.new("ShaderNodeTexSky")
    sky.sky_type, sky.sun_disc = "NISHITA", False
    sky.sun_elevation, sky.sun_rotation = math.radians(elevation), math.radians(90)  # towards +x
    world.node_tree.links.new(sky.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.cycles.panorama_type = "PANO", "EQUIRECTANGULAR"
    camera.rotation_euler = (math.pi / 2, 0, -math.pi / 2)  # +x in the middle
    scene.collection.objects.link(camera)
    scene.camera = camera
    cycles_scene.render(scene, file)


def main():
    pelagic, folder = sys.argv[sys.argv.index("--") + 1:]
    folder = Path(folder).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    print("| sun | " + " | ".join(f"{name}: R, G, B" for name in looks) + " |\n|---|" + "---|" * len(looks))
    for elevation in (4, 15, 35, 60):
        ours = folder / "ours.exr"
        subprocess.check_output([pelagic, "render", "--clouds", "0", "--wind-speed", "5", "--sun", f"0,{elevation}", "--sky", str(ours)])
        nishita(folder / "nishita.exr", elevation)
        (a, sum_a), (b, sum_b) = image(ours), image(folder / "nishita.exr")
        cells = []
        for azimuth, up in looks.values():
            level_a, level_b = regions.luminance(sum_a), regions.luminance(sum_b)
            ratio = [(x / level_a) / (y / level_b) for x, y in zip(a(azimuth, up), b(azimuth, up))]
            cells.append(", ".join(f"{r:.2f}" for r in ratio))
        print(f"| {elevation} degrees | " + " | ".join(cells) + " |")


main()
