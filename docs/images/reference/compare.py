# Compares the sea of `pelagic render` with the same sea path-traced by Cycles under the same sky:
# means of regions, as a table.
#
#   blender -b --python-exit-code 1 -P compare.py -- PELAGIC FOLDER
#     [--samples K] [--only SCENE] [--reuse] [--check]
#
# FOLDER receives images, `table.md` and `figures.json`. --reuse keeps references that exist in
# FOLDER; they have the light of sun and sky of the version that wrote them. --check exits with 1 if
# a region's luminance differs by more than `scenes.largest_difference`.
import argparse
import json
import math
import subprocess
import sys
import time
from pathlib import Path

import bpy
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))
import air
import cycles_scene
import regions
import scenes
import sea_mesh

def rgba(file):
    """Returns (width, height, RGBA floats with row 0 at the top); Blender's rows begin at the
    bottom."""
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    pixels = image.pixels[:]
    bpy.data.images.remove(image)
    rows = [pixels[4 * width * j:4 * width * (j + 1)] for j in reversed(range(height))]
    return width, height, [value for row in rows for value in row]


def colours(file):
    width, height, pixels = rgba(file)
    return width, height, [tuple(pixels[i:i + 3]) for i in range(0, len(pixels), 4)]


def write_png(file, images, width, height, exposure):
    """Writes images side by side, with one exposure, in sRGB without a filmic curve."""
    pair = bpy.data.images.new("pair", width * len(images), height)
    values = []
    for j in reversed(range(height)):
        for image in images:
            for colour in image[width * j:width * (j + 1)]:
                shown = [min(1, max(0, exposure * c)) for c in colour]
                values += [12.92 * c if c < 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055 for c in shown] + [1]
    pair.pixels.foreach_set(values)
    pair.filepath_raw, pair.file_format = str(file), "PNG"
    pair.save()
    bpy.data.images.remove(pair)


def numbers(values):
    return ",".join(str(v) for v in values)


class Comparison:
    def __init__(self, pelagic, folder, samples, threads, reuse):
        self.pelagic, self.folder, self.samples, self.threads, self.reuse = pelagic, folder, samples, threads, reuse
        self.cascades = None
        info = json.loads(subprocess.check_output([pelagic, "info", *scenes.sea, "--json"]))
        self.all_slopes = info["waves"]["slope_variance"]["cox_and_munk"]["total"]

    def read_cascades(self):
        if not self.cascades:
            export = self.folder / "sea"
            subprocess.check_call([self.pelagic, "export", "--out", str(export), *scenes.sea, "--overwrite"], stdout=subprocess.DEVNULL)
            self.cascades = sea_mesh.read_cascades(export, lambda file: rgba(file)[2])
        return self.cascades

    def ours(self, name, camera, target, sun):
        image, sky = self.folder / f"{name}_ours.exr", self.folder / f"{name}_sky.exr"
        said = subprocess.check_output([
            self.pelagic, "render", *scenes.sea, "--clouds", "0", "--camera", numbers(camera), "--target", numbers(target),
            "--spray", "off", "--sun", numbers(sun), "--fov", str(scenes.fov_deg), "--size", f"{scenes.width}x{scenes.height}",
            "--hdr", str(image), "--sky", str(sky), "--json"])
        said = json.loads(said)
        return image, sky, said["sky"], said["water"]

    def reference(self, name, camera, target, light, water, sky):
        """Renders two images, of the sun's light and of the sky's; their sum is the sea's."""
        files = {kind: self.folder / f"{name}_{kind}.exr" for kind in ("sun", "skylight")}
        if not (self.reuse and all(file.exists() for file in files.values())):
            cascades = self.read_cascades()
            # Half a pixel's width at the nearest water, and to 0.1 degrees below the horizon.
            finest = 2.0 ** round(math.log2(camera[1] * 0.0078 / 2))
            sea = sea_mesh.SeaMesh(cascades, finest, max(5e3, 573 * camera[1]), self.all_slopes)
            for kind, file in files.items():
                scene = cycles_scene.new_scene(self.samples, scenes.width, scenes.height, self.threads)
                sun = light["sun_direction"] if kind == "sun" else None
                cycles_scene.add_world(scene, None if sun else sky)
                if sun:
                    cycles_scene.add_sun(scene, sun, light["sun_irradiance"])
                cycles_scene.add_sea(scene, sea, cycles_scene.water_material(water, sun))
                cycles_scene.add_camera(scene, camera, target, scenes.fov_deg)
                cycles_scene.render(scene, file)
        _, _, of_sun = colours(files["sun"])
        _, _, of_sky = colours(files["skylight"])
        return [tuple(a + b for a, b in zip(*pair)) for pair in zip(of_sun, of_sky)]

    def compare(self, name):
        camera, target, sun = scenes.scenes[name]
        image, sky_file, light, water = self.ours(name, camera, target, sun)
        start = time.time()
        bare = self.reference(name, camera, target, light, water, sky_file)
        seconds = time.time() - start
        width, height, ours = colours(image)
        rays = list(regions.rays_of(camera, target, scenes.fov_deg, width, height))
        reference = [air.through_air(c, ray, camera[1], light) for c, ray in zip(bare, rays)]
        write_png(self.folder / f"{name}.png", (ours, reference), width, height, light["exposure"] * 0.5)
        parts = [regions.region_of(ray, Vector(light["sun_direction"])) for ray in rays]
        return {"ours": regions.means(ours, parts), "reference": regions.means(reference, parts), "seconds": seconds}


def table(figures):
    lines = ["| scene | region | reference: R, G, B | ours / reference: R, G, B | luminance |", "|---|---|---|---|---|"]
    for name, entry in figures.items():
        for region, reference in entry["reference"].items():
            ours = entry["ours"][region]
            ratio = [o / max(r, 1e-9) for o, r in zip(ours, reference)]
            light = regions.luminance(ours) / max(regions.luminance(reference), 1e-9)
            lines.append(f"| {name} | {region} | {', '.join(f'{v:.4f}' for v in reference)} | "
                         f"{', '.join(f'{v:.2f}' for v in ratio)} | {light:.2f} |")
    return "\n".join(lines) + "\n"


def too_different(figures):
    """Prints a line for each region that differs too much."""
    for name, entry in figures.items():
        for region, reference in entry["reference"].items():
            ratio = regions.luminance(entry["ours"][region]) / regions.luminance(reference)
            most = scenes.largest_difference(name, region)
            if abs(ratio - 1) > most:
                yield f"{name}, {region}: ours is {ratio:.2f} of the reference, may differ by {most:.2f}"


def main():
    parser = argparse.ArgumentParser(prog="compare.py")
    parser.add_argument("pelagic")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--samples", type=int, default=128)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--only", choices=list(scenes.scenes), action="append")
    parser.add_argument("--reuse", action="store_true")
    parser.add_argument("--check", action="store_true")
    asked = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    folder = asked.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    comparison = Comparison(asked.pelagic, folder, asked.samples, asked.threads, asked.reuse)
    figures = {name: comparison.compare(name) for name in asked.only or scenes.scenes}
    (folder / "figures.json").write_text(json.dumps(figures, indent=2))
    (folder / "table.md").write_text(table(figures))
    print(table(figures))
    differences = list(too_different(figures)) if asked.check else []
    print("\n".join(differences))
    if differences:
        sys.exit(1)


main()
