# Compares the texture of `pelagic render` with that of the same sea path-traced by Cycles: contrast
# in boxes, outliers, jumps, quartiles and means of regions.
#
#   blender -b --python-exit-code 1 -P texture.py -- PELAGIC FOLDER
#     [--renew] [--reuse] [--only SCENE] [--samples K]
#
# FOLDER receives images. --renew path-traces the references of both seeds and writes their measures
# to `texture.json`. --reuse keeps Pelagic's images that exist in FOLDER. Measures of these images
# are compared with those in `texture.json`, and the exit status is 1 if one is out of bounds.
import argparse
import json
import math
import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import air
import cycles_scene
import regions
import texture_bounds
import texture_gusts
import texture_mesh
import texture_metrics

width, height, fov_deg = 480, 270, 60
stored = Path(__file__).resolve().parent / "texture.json"
bounces = 4  # between waves

# Name: sea, camera, target, light; as options of `pelagic render`.
scenes = {
    "rough": (["--preset", "rough", "--seed", "12"], (0, 1.6, 0), (30, 1.2, 5), ["--sun", "10,35", "--cloud-seed", "4"]),
    "calm": (["--preset", "calm", "--seed", "2"], (0, 1.7, 0), (20, 1, 5), ["--light", "overcast", "--cloud-seed", "4"]),
}
seeds = (1, 2)


def texels(file):
    """Returns an array of rows, columns and RGBA, row 0 at the top."""
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = "Non-Color"
    columns, rows = image.size
    values = np.empty(columns * rows * 4, np.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    return values.reshape(rows, columns, 4)[::-1]


class Ripples:
    """Slopes as an image: red along x, green along Blender's y, Pelagic's -z."""
    side_m = texture_mesh.ripple_side_m

    def __init__(self, slopes, mean_square):
        self.mean_square = mean_square
        n = slopes.shape[0]
        values = np.zeros((n, n, 4), np.float32)
        values[..., 0], values[..., 1], values[..., 3] = -slopes[..., 0], slopes[..., 1], 1
        self.image = bpy.data.images.new("ripples", n, n, float_buffer=True, is_data=True)
        self.image.pixels.foreach_set(values.reshape(-1))
        self.image.update()


def write_png(file, image, exposure):
    shown = np.clip(exposure * image[::-1, :, :3], 0, 1)
    values = np.ones(image.shape[:2] + (4,), np.float32)
    values[..., :3] = np.where(shown < 0.0031308, 12.92 * shown, 1.055 * shown ** (1 / 2.4) - 0.055)
    png = bpy.data.images.new("shown", image.shape[1], image.shape[0])
    png.pixels.foreach_set(values.reshape(-1))
    png.filepath_raw, png.file_format = str(file), "PNG"
    png.save()
    bpy.data.images.remove(png)


def numbers(values):
    return ",".join(str(v) for v in values)


class Comparison:
    def __init__(self, pelagic, folder, samples, reuse):
        self.pelagic, self.folder, self.samples, self.reuse = pelagic, folder, samples, reuse

    def ours(self, name):
        """Returns Pelagic's image and the object that `render --json` prints."""
        sea, camera, target, light = scenes[name]
        file = self.folder / f"{name}_ours.exr"
        said = self.folder / f"{name}.json"
        if not (self.reuse and file.exists() and said.exists()):
            said.write_bytes(subprocess.check_output([
                self.pelagic, "render", *sea, *light, "--camera", numbers(camera),
                "--target", numbers(target), "--fov", str(fov_deg), "--size", f"{width}x{height}",
                "--spray", "off", "--crest-glow", "0", "--hdr", str(file),
                "--out", str(self.folder / f"{name}_shown.png"), "--sky", str(self.sky(name)), "--quiet", "--json"]))
        printed, image = json.loads(said.read_text()), texels(file)
        write_png(self.folder / f"{name}_ours.png", image, printed["sky"]["exposure"] * 0.5)
        return image, printed

    def sky(self, name):
        return self.folder / f"{name}_sky.exr"

    def sea(self, name):
        """Returns the mesh without ripples, their longest wave and their mean square slope."""
        sea, camera, target, _ = scenes[name]
        info = json.loads(subprocess.check_output([self.pelagic, "info", *sea, "--json"]))["waves"]["slope_variance"]
        export = self.folder / f"{name}_sea"
        subprocess.check_call([self.pelagic, "export", "--out", str(export), *sea, "--overwrite", "--quiet"])
        cascades, every = texture_mesh.read_cascades(export, texels), info["cox_and_munk"]["total"]
        mean_square = texture_mesh.ripple_part * (every - info["all"]["total"])
        azimuth = math.atan2(target[2] - camera[2], target[0] - camera[0])
        mesh = texture_mesh.PolarSea(cascades, azimuth, every - mean_square, texture_gusts.gusts)
        print(f"{name}: mean square slopes: all {every:.4f}, ripples {mean_square:.4f}, mesh from near to far", mesh.shown.round(4), flush=True)
        return mesh, min(c.shortest for c in cascades), mean_square

    def reference(self, name, seed, printed, mesh, longest_ripple_m, mean_square):
        _, camera, target, _ = scenes[name]
        light, image = printed["sky"], 0
        slopes = texture_mesh.ripples(longest_ripple_m, mean_square, seed)
        for kind in ("sun", "sky"):
            scene = cycles_scene.new_scene(self.samples, width, height, 2)
            scene.cycles.seed = seed
            scene.cycles.max_bounces = scene.cycles.glossy_bounces = bounces
            scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 1
            sun = light["sun_direction"] if kind == "sun" else None
            cycles_scene.add_world(scene, None if sun else self.sky(name))
            if sun:
                cycles_scene.add_sun(scene, sun, light["sun_irradiance"])
            material = cycles_scene.opaque_water_material(printed["water"], light, sun, Ripples(slopes, mean_square))
            cycles_scene.add_sea(scene, mesh, material, smooth=True)
            cycles_scene.add_camera(scene, camera, target, fov_deg)
            scene.camera.data.clip_start = 0.02
            file = self.folder / f"{name}_{seed}_{kind}.exr"
            cycles_scene.render(scene, file)
            image = image + texels(file)[..., :3]
        rays = regions.rays_of(camera, target, fov_deg, width, height)
        seen = [air.through_air(c, ray, camera[1], light) for c, ray in zip(image.reshape(-1, 3).tolist(), rays)]
        seen = np.array(seen).reshape(height, width, 3)
        write_png(self.folder / f"{name}_{seed}.png", seen, light["exposure"] * 0.5)
        return texture_metrics.measures(seen, name)

    def renew(self, name):
        image, printed = self.ours(name)
        print(name, json.dumps(texture_metrics.measures(image, name), indent=1))
        sea = self.sea(name)
        return [self.reference(name, seed, printed, *sea) for seed in seeds]


def rounded(value):
    return {key: rounded(v) for key, v in value.items()} if isinstance(value, dict) else float(f"{value:.4g}")


def main():
    parser = argparse.ArgumentParser(prog="texture.py")
    parser.add_argument("pelagic")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--samples", type=int, default=48)
    parser.add_argument("--only", choices=list(scenes), action="append")
    parser.add_argument("--renew", action="store_true")
    parser.add_argument("--reuse", action="store_true")
    asked = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    folder = asked.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    comparison = Comparison(asked.pelagic, folder, asked.samples, asked.reuse)
    references = json.loads(stored.read_text()) if stored.exists() else {}
    names = asked.only or list(scenes)
    if asked.renew:
        references.update({name: [rounded(m) for m in comparison.renew(name)] for name in names})
        stored.write_text(json.dumps(references, indent=1) + "\n")
    ours = {name: texture_metrics.measures(comparison.ours(name)[0], name) for name in names}
    print(texture_bounds.table(references, ours))
    faults = texture_bounds.faults(references, ours) + texture_bounds.unsteady(references)
    print("\n".join(faults))
    if faults:
        sys.exit(1)


main()
